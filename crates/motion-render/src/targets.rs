//! Textures that a picture is drawn into.

use crate::gpu::Gpu;
use crate::pipeline::{COLOR_FORMAT, DEPTH_FORMAT, MASK_FORMAT, N_SAMPLES};

/// The textures of one size; made anew when the size changes.
#[derive(Debug)]
pub struct Targets {
    size: wgpu::Extent3d,
    color: wgpu::Texture,
    pub(crate) color_samples: wgpu::TextureView,
    pub(crate) color_resolved: wgpu::TextureView,
    pub(crate) depth: wgpu::TextureView,
    mask: Option<Mask>,
}

/// The mask of outlines, made when something is first outlined.
#[derive(Debug)]
pub(crate) struct Mask {
    pub(crate) samples: wgpu::TextureView,
    pub(crate) resolved: wgpu::TextureView,
}

impl Targets {
    /// Textures for a picture; sizes are brought to what the device can hold.
    pub fn new(gpu: &Gpu, width_px: u32, height_px: u32) -> Self {
        let most = gpu.device().limits().max_texture_dimension_2d;
        let size = wgpu::Extent3d {
            width: width_px.clamp(1, most),
            height: height_px.clamp(1, most),
            depth_or_array_layers: 1,
        };
        let color = gpu.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: COLOR_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let color_resolved = color.create_view(&wgpu::TextureViewDescriptor::default());
        Self {
            size,
            color,
            color_samples: attachment(gpu, "color samples", size, COLOR_FORMAT, N_SAMPLES),
            color_resolved,
            depth: attachment(gpu, "depth", size, DEPTH_FORMAT, N_SAMPLES),
            mask: None,
        }
    }

    /// Columns and rows.
    pub fn size_px(&self) -> (u32, u32) {
        (self.size.width, self.size.height)
    }

    /// The finished picture, `Rgba8Unorm` holding sRGB.
    pub fn picture(&self) -> &wgpu::Texture {
        &self.color
    }

    /// The mask of outlines; gives whether it was made just now.
    pub(crate) fn mask(&mut self, gpu: &Gpu) -> (&Mask, bool) {
        let is_new = self.mask.is_none();
        let size = self.size;
        let mask = self.mask.get_or_insert_with(|| Mask {
            samples: attachment(gpu, "mask samples", size, MASK_FORMAT, N_SAMPLES),
            resolved: attachment(gpu, "mask", size, MASK_FORMAT, 1),
        });
        (mask, is_new)
    }
}

fn attachment(
    gpu: &Gpu,
    label: &str,
    size: wgpu::Extent3d,
    format: wgpu::TextureFormat,
    sample_count: u32,
) -> wgpu::TextureView {
    let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    if sample_count == 1 {
        usage |= wgpu::TextureUsages::TEXTURE_BINDING;
    }
    let texture = gpu.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
