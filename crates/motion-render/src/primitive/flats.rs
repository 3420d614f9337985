//! Flat shapes in their own colour: rings, arrows, discs.

use bytemuck::{Pod, Zeroable};
use motion_scene::color::LinearRgba;
use motion_scene::marker::Flat;
use motion_scene::scene::Scene;

use crate::buffers::GrowBuffer;
use crate::gpu::Gpu;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec};
use crate::shader_source::FLATS;
use crate::shared_bindings::SharedBindings;

const VERTEX: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x4, 2 => Uint32];

/// Keep in sync with `Vertex` in flats.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GpuFlatVertex {
    p_in_world: [f32; 3],
    color: [f32; 4],
    pick: u32,
}

/// Draws flat shapes.
#[derive(Debug)]
pub(crate) struct Flats {
    /// All in the scene's order, in which they cover each other, then those with names again.
    vertices: GrowBuffer,
    n_shown: u32,
    shown: wgpu::RenderPipeline,
    id: wgpu::RenderPipeline,
}

impl Flats {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let spec = |fragment, output, depth| {
            let spec = PipelineSpec {
                shader: FLATS,
                vertex: "vertex",
                fragment: Some(fragment),
                groups: &[Some(&shared.frame_layout)],
                buffers: &[wgpu::VertexBufferLayout {
                    array_stride: size_of::<GpuFlatVertex>() as u64,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &VERTEX,
                }],
                topology: wgpu::PrimitiveTopology::TriangleList,
                cull: false,
                output,
                depth,
            };
            spec.create(gpu)
        };
        Self {
            vertices: GrowBuffer::new(gpu, "flats", wgpu::BufferUsages::VERTEX),
            n_shown: 0,
            shown: spec("flat", Output::Color(Blend::Over), Depth::Test),
            id: spec("id", Output::Ids, Depth::TestAndWrite),
        }
    }

    /// Uploads the flat shapes of a scene and the flat parts of its checkpoints.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, scene: &Scene) {
        let marks = scene.checkpoints.iter().flat_map(|mark| mark.to_flats(scene.theme));
        let all: Vec<Flat> = scene.flats.iter().cloned().chain(marks).collect();
        let mut vertices: Vec<GpuFlatVertex> = all.iter().flat_map(corners).collect();
        self.n_shown = vertices.len() as u32;
        vertices.extend(all.iter().filter(|flat| flat.pick.is_some()).flat_map(corners));
        self.vertices.write(gpu, &vertices);
    }

    /// Into the picture, after the floor.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_with(pass, &self.shown, 0..self.n_shown);
    }

    /// What has a name, into the names.
    pub(crate) fn draw_ids(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_with(pass, &self.id, self.n_shown..self.vertices.len());
    }

    fn draw_with(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        vertices: std::ops::Range<u32>,
    ) {
        if !vertices.is_empty() {
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, self.vertices.buffer().slice(..));
            pass.draw(vertices, 0..1);
        }
    }
}

/// Whole triangles only.
fn corners(flat: &Flat) -> impl Iterator<Item = GpuFlatVertex> {
    let color = flat.color.unwrap_or(LinearRgba::WHITE).to_srgb();
    let pick = flat.pick.map_or(0, |id| id.0.get());
    let whole = &flat.points_m[..flat.points_m.len() / 3 * 3];
    whole.iter().map(move |&point| GpuFlatVertex { p_in_world: point.into(), color, pick })
}
