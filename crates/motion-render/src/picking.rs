//! What is under the pointer: names drawn into a few pixels around it.

use glam::{Mat4, Vec2, Vec3};
use motion_scene::body::PickId;
use motion_scene::scene::Scene;

use crate::gpu::Gpu;
use crate::pipeline::{DEPTH_FORMAT, ID_FORMAT};
use crate::readback::Readback;
use crate::renderer::Renderer;
use crate::view::View;

/// Columns and rows that are looked at: near misses count.
const SIZE_PX: u32 = 9;

/// The few pixels that names are drawn into.
#[derive(Debug)]
pub(crate) struct IdTarget {
    pub(crate) size_px: u32,
    ids: wgpu::Texture,
    pub(crate) ids_view: wgpu::TextureView,
    pub(crate) depth: wgpu::TextureView,
}

/// Finds what is under the pointer. Answers come when the device has drawn; nobody need wait.
#[derive(Debug)]
pub struct Picker {
    target: IdTarget,
    readback: Readback,
}

impl Picker {
    /// A picker for one pointer.
    pub fn new(gpu: &Gpu) -> Self {
        let make = |label, format, usage| {
            gpu.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: SIZE_PX, height: SIZE_PX, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            })
        };
        let ids = make("names", ID_FORMAT, wgpu::TextureUsages::COPY_SRC);
        let depth = make("depth of names", DEPTH_FORMAT, wgpu::TextureUsages::empty());
        let view_of = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        let target =
            IdTarget { size_px: SIZE_PX, ids_view: view_of(&ids), depth: view_of(&depth), ids };
        Self { target, readback: Readback::new(gpu, SIZE_PX, SIZE_PX) }
    }

    /// Asks what is at `px` of the picture. An earlier question that has no answer yet is dropped.
    pub fn ask(&mut self, renderer: &mut Renderer, scene: &Scene, view: &View, px: Vec2) {
        let gpu = renderer.gpu().clone();
        let mut encoder = gpu
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("names") });
        let part = part_from_clip(px, view, SIZE_PX);
        renderer.draw_ids(&mut encoder, scene, view, part, &self.target);
        self.readback.copy(&mut encoder, &self.target.ids);
        gpu.queue().submit([encoder.finish()]);
        self.readback.begin();
    }

    /// The answer, once it is there: `Some(None)` for nothing under the pointer.
    pub fn poll(&mut self, gpu: &Gpu) -> Option<Option<PickId>> {
        let bytes = self.readback.poll(gpu)?;
        Some(nearest_to_middle(&bytes))
    }

    /// Asks and waits for the answer; `None` without one because the device is gone.
    pub fn pick(
        &mut self,
        renderer: &mut Renderer,
        scene: &Scene,
        view: &View,
        px: Vec2,
    ) -> Option<Option<PickId>> {
        self.ask(renderer, scene, view, px);
        let bytes = self.readback.wait(renderer.gpu())?;
        Some(nearest_to_middle(&bytes))
    }
}

/// From the whole picture's clip space to that of the `size_px` pixels around `px`.
fn part_from_clip(px: Vec2, view: &View, size_px: u32) -> Mat4 {
    let picture = Vec2::new(view.width_px as f32, view.height_px as f32);
    let middle = Vec2::new(2.0 * px.x / picture.x - 1.0, 1.0 - 2.0 * px.y / picture.y);
    let scale = picture / size_px as f32;
    Mat4::from_scale(scale.extend(1.0))
        * Mat4::from_translation(Vec3::new(-middle.x, -middle.y, 0.0))
}

/// Of all names the one nearest to the middle, where the pointer is.
fn nearest_to_middle(bytes: &[u8]) -> Option<PickId> {
    let half = (SIZE_PX / 2) as i32;
    let names = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let places = (0..SIZE_PX as i32).flat_map(|y| (0..SIZE_PX as i32).map(move |x| (x, y)));
    places
        .zip(names)
        .filter_map(|((x, y), name)| {
            let id = PickId(std::num::NonZeroU32::new(name)?);
            Some(((x - half).pow(2) + (y - half).pow(2), id))
        })
        .min()
        .map(|(_, id)| id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_wins() {
        let mut bytes = vec![0; 4 * (SIZE_PX * SIZE_PX) as usize];
        assert_eq!(nearest_to_middle(&bytes), None);
        let mut put = |x: u32, y: u32, name: u8| bytes[4 * (y * SIZE_PX + x) as usize] = name;
        put(0, 0, 7);
        put(5, 4, 9);
        put(4, 7, 8);
        assert_eq!(nearest_to_middle(&bytes), PickId::nth(8));
    }
}
