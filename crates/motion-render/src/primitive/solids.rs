//! Boxes, cylinders and balls.

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};
use motion_scene::body::Emphasis;
use motion_scene::scene::Scene;
use motion_scene::solid::{Shape, Solid};

use crate::buffers::{GrowBuffer, fixed_buffer};
use crate::gpu::Gpu;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec};
use crate::primitive::skinned_mesh::emphasis_code;
use crate::shader_source::{SOLIDS, SOLIDS_SHADOW};
use crate::shared_bindings::SharedBindings;
use crate::solid_shapes::{SHAPES, ShapeVertex, shape_triangles};

const VERTEX: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
const INSTANCE: [wgpu::VertexAttribute; 5] = wgpu::vertex_attr_array![
    2 => Float32x4, 3 => Float32x4, 4 => Float32x4, 5 => Float32x4, 6 => Uint32x2
];

/// Keep in sync with `Vertex` in solids.wgsl and `solids_shadow.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GpuSolid {
    rows: [Vec4; 3],
    color: Vec4,
    marks: [u32; 2],
    unused: [u32; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Purpose {
    Opaque,
    SeeThrough,
    Shadow,
    Mask,
    Id,
}

/// Draws solids.
#[derive(Debug)]
pub(crate) struct Solids {
    vertices: wgpu::Buffer,
    /// Vertices of each shape, in the order of [`SHAPES`].
    ranges: Vec<std::ops::Range<u32>>,
    instances: GrowBuffer,
    batches: Vec<(Purpose, Shape, std::ops::Range<u32>)>,
    opaque: wgpu::RenderPipeline,
    see_through: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    mask: wgpu::RenderPipeline,
    id: wgpu::RenderPipeline,
}

impl Solids {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let mut all: Vec<ShapeVertex> = Vec::new();
        let mut ranges = Vec::with_capacity(SHAPES.len());
        for shape in SHAPES {
            let first = all.len() as u32;
            all.extend(shape_triangles(shape));
            ranges.push(first..all.len() as u32);
        }
        let layouts = [
            wgpu::VertexBufferLayout {
                array_stride: size_of::<ShapeVertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &VERTEX,
            },
            wgpu::VertexBufferLayout {
                array_stride: size_of::<GpuSolid>() as u64,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &INSTANCE,
            },
        ];
        let groups = [Some(&shared.frame_layout), Some(&shared.shadow_layout)];
        let spec = |fragment, output, depth| PipelineSpec {
            shader: SOLIDS,
            vertex: "vertex",
            fragment: Some(fragment),
            groups: &groups,
            buffers: &layouts,
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: true,
            output,
            depth,
        };
        let shadow = PipelineSpec {
            shader: SOLIDS_SHADOW,
            fragment: None,
            groups: &groups[..1],
            ..spec("", Output::ShadowMap, Depth::TestAndWrite)
        };
        let opaque = spec("solid", Output::Color(Blend::Replace), Depth::TestAndWrite);
        Self {
            vertices: fixed_buffer(gpu, "solids", wgpu::BufferUsages::VERTEX, &all),
            ranges,
            instances: GrowBuffer::new(gpu, "solid instances", wgpu::BufferUsages::VERTEX),
            batches: Vec::new(),
            opaque: opaque.create(gpu),
            see_through: spec("solid", Output::Color(Blend::Over), Depth::Test).create(gpu),
            shadow: shadow.create(gpu),
            mask: spec("mask", Output::Mask, Depth::Ignore).create(gpu),
            id: spec("id", Output::Ids, Depth::TestAndWrite).create(gpu),
        }
    }

    /// Uploads the solids of a scene and the balls of its joint targets.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, scene: &Scene) {
        let targets = scene.joint_targets.iter().map(|target| target.to_solid(scene.theme));
        let mut entries: Vec<(Purpose, Shape, GpuSolid)> = Vec::new();
        for solid in scene.solids.iter().copied().chain(targets) {
            let rows = solid.world_from_solid.transpose();
            let on_gpu = GpuSolid {
                rows: [rows.x_axis, rows.y_axis, rows.z_axis],
                color: Vec4::from(solid.color.0),
                marks: [solid.pick.map_or(0, |id| id.0.get()), emphasis_code(solid.emphasis)],
                unused: [0; 2],
            };
            entries.extend(purposes(&solid).map(|purpose| (purpose, solid.shape, on_gpu)));
        }
        entries.sort_by_key(|&(purpose, shape, _)| (purpose, shape));
        self.batches.clear();
        for (idx, &(purpose, shape, _)) in (0_u32..).zip(&entries) {
            match self.batches.last_mut() {
                Some(last) if (last.0, last.1) == (purpose, shape) => last.2.end = idx + 1,
                _ => self.batches.push((purpose, shape, idx..idx + 1)),
            }
        }
        let instances: Vec<GpuSolid> = entries.iter().map(|entry| entry.2).collect();
        self.instances.write(gpu, &instances);
    }

    /// What hides what is behind it, into the picture.
    pub(crate) fn draw_opaque(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(pass, Purpose::Opaque, &self.opaque);
    }

    /// What is seen through, into the picture.
    pub(crate) fn draw_see_through(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(pass, Purpose::SeeThrough, &self.see_through);
    }

    /// What stops light, into the shadow map.
    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(pass, Purpose::Shadow, &self.shadow);
    }

    /// What is outlined, into the mask.
    pub(crate) fn draw_mask(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(pass, Purpose::Mask, &self.mask);
    }

    /// What has a name, into the names.
    pub(crate) fn draw_ids(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(pass, Purpose::Id, &self.id);
    }

    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        purpose: Purpose,
        pipeline: &wgpu::RenderPipeline,
    ) {
        for (_, shape, instances) in self.batches.iter().filter(|batch| batch.0 == purpose) {
            let vertices = self.ranges[*shape as usize].clone();
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, self.vertices.slice(..));
            pass.set_vertex_buffer(1, self.instances.buffer().slice(..));
            pass.draw(vertices, instances.clone());
        }
    }
}

fn purposes(solid: &Solid) -> impl Iterator<Item = Purpose> {
    let is_opaque = solid.color.0[3] >= 1.0;
    let shown = if is_opaque { Purpose::Opaque } else { Purpose::SeeThrough };
    let shadow = solid.casts_shadow().then_some(Purpose::Shadow);
    let mask = (solid.emphasis != Emphasis::None).then_some(Purpose::Mask);
    let id = solid.pick.map(|_| Purpose::Id);
    [Some(shown), shadow, mask, id].into_iter().flatten()
}

/// The corners of what holds a solid.
pub(crate) fn corners_m(solid: &Solid) -> [Vec3; 8] {
    std::array::from_fn(|corner| {
        let side = |axis: usize| if corner >> axis & 1 == 0 { -0.5 } else { 0.5 };
        solid.world_from_solid.transform_point3(Vec3::new(side(0), side(1), side(2)))
    })
}
