//! Bodies: all joints of a picture in one buffer, one draw for all bodies of a model.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec4};
use motion_scene::body::{Body, Emphasis, Look};
use motion_scene::bounds::Bounds;
use motion_scene::mesh::MeshId;
use motion_scene::scene::Scene;

use crate::buffers::GrowBuffer;
use crate::frustum::Frustum;
use crate::gpu::Gpu;
use crate::mesh_cache::{MeshCache, VERTEX_LAYOUT};
use crate::pipeline::{Blend, Depth, Output, PipelineSpec, STORAGE, bind_group_layout};
use crate::shader_source::{SKINNED_MESH, SKINNED_SHADOW};
use crate::shared_bindings::SharedBindings;
use crate::view::View;

/// Keep in sync with `Joint` in common/skinning.wgsl: the first three rows of a matrix.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct GpuJoint([Vec4; 3]);

impl GpuJoint {
    pub(crate) fn new(world_from_mesh: &Mat4) -> Self {
        let rows = world_from_mesh.transpose();
        Self([rows.x_axis, rows.y_axis, rows.z_axis])
    }
}

/// Keep in sync with `Instance` in `common/body.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GpuInstance {
    tint: Vec4,
    first_joint: u32,
    pick: u32,
    emphasis: u32,
    unused: u32,
}

/// For what a body is drawn; bodies of one purpose, model and level are one draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Purpose {
    Solid,
    Ghost,
    Shadow,
    Mask,
    Id,
}

#[derive(Clone, Debug)]
struct Batch {
    purpose: Purpose,
    model: MeshId,
    level: usize,
    instances: std::ops::Range<u32>,
}

/// How many triangles a body gets for each squared pixel of its height: on a graphics card one for
/// about six pixels of it, in software, where small triangles cost as much as large ones, for about
/// twenty.
const DETAIL: f32 = 0.04;
const SOFTWARE_DETAIL: f32 = 0.012;
/// Its shadow is soft.
const SHADOW_SHARE: f32 = 0.3;

/// Draws bodies.
#[derive(Debug)]
pub(crate) struct SkinnedMeshes {
    skin_layout: wgpu::BindGroupLayout,
    skin_group: wgpu::BindGroup,
    joints: GrowBuffer,
    instances: GrowBuffer,
    batches: Vec<Batch>,
    n_triangles: u64,
    solid: TwoSided,
    ghost_depth: TwoSided,
    ghost: TwoSided,
    shadow: wgpu::RenderPipeline,
    mask: wgpu::RenderPipeline,
    id: wgpu::RenderPipeline,
}

/// The same pipeline with the backs of triangles hidden and shown.
#[derive(Debug)]
struct TwoSided {
    front: wgpu::RenderPipeline,
    both: wgpu::RenderPipeline,
}

impl SkinnedMeshes {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings, meshes: &MeshCache) -> Self {
        let vertex = wgpu::ShaderStages::VERTEX;
        let both_stages = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let skin_layout =
            bind_group_layout(gpu, "skin", &[(vertex, STORAGE), (both_stages, STORAGE)]);
        let joints = GrowBuffer::new(gpu, "joints", wgpu::BufferUsages::STORAGE);
        let instances = GrowBuffer::new(gpu, "instances", wgpu::BufferUsages::STORAGE);
        let skin_group = skin_group(gpu, &skin_layout, &joints, &instances);

        let groups = [
            Some(&shared.frame_layout),
            Some(&shared.shadow_layout),
            Some(&skin_layout),
            Some(&meshes.part_layout),
        ];
        let spec = |fragment, output, depth, cull| PipelineSpec {
            shader: SKINNED_MESH,
            vertex: "vertex",
            fragment,
            groups: &groups,
            buffers: &[VERTEX_LAYOUT],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull,
            output,
            depth,
        };
        let two_sided = |fragment, output, depth| TwoSided {
            front: spec(fragment, output, depth, true).create(gpu),
            both: spec(fragment, output, depth, false).create(gpu),
        };
        let over = Output::Color(Blend::Over);
        let shadow_groups = [Some(&shared.frame_layout), None, Some(&skin_layout)];
        let shadow = PipelineSpec {
            shader: SKINNED_SHADOW,
            fragment: None,
            groups: &shadow_groups,
            output: Output::ShadowMap,
            ..spec(None, Output::ShadowMap, Depth::TestAndWrite, false)
        };
        Self {
            solid: two_sided(Some("solid"), Output::Color(Blend::Replace), Depth::TestAndWrite),
            ghost_depth: two_sided(Some("nothing"), Output::DepthOfColor, Depth::TestAndWrite),
            ghost: two_sided(Some("ghost"), over, Depth::Test),
            shadow: shadow.create(gpu),
            mask: spec(Some("mask"), Output::Mask, Depth::Ignore, false).create(gpu),
            id: spec(Some("id"), Output::Ids, Depth::TestAndWrite, false).create(gpu),
            skin_group,
            skin_layout,
            joints,
            instances,
            batches: Vec::new(),
            n_triangles: 0,
        }
    }

    /// Uploads the bodies of a scene whose models are known and have as many joints.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, meshes: &MeshCache, scene: &Scene, view: &View) {
        let mut joints: Vec<GpuJoint> = Vec::new();
        let mut entries: Vec<(Purpose, MeshId, usize, GpuInstance)> = Vec::new();
        let frustum = Frustum::new(view.camera.clip_from_world(view.viewport()));
        let detail = if gpu.is_software() { SOFTWARE_DETAIL } else { DETAIL };
        for body in &scene.bodies {
            let Some(model) = meshes.get(body.model) else { continue };
            let joint_from_mesh = model.model.levels()[0].joint_from_mesh();
            if joint_from_mesh.len() != body.world_from_joint.len() {
                continue;
            }
            let Some(bounds) = model.model.bounds(&body.world_from_joint) else { continue };
            let instance = GpuInstance {
                tint: Vec4::from(match body.look {
                    Look::Solid(tint) => tint.0,
                    // No light falls on ghosts: theirs is a stored colour.
                    Look::Ghost(tint) => tint.to_srgb(),
                }),
                first_joint: joints.len() as u32,
                pick: body.pick.map_or(0, |id| id.0.get()),
                emphasis: emphasis_code(body.emphasis),
                unused: 0,
            };
            let pairs = body.world_from_joint.iter().zip(joint_from_mesh);
            joints.extend(pairs.map(|(world, bind)| GpuJoint::new(&(*world * *bind))));
            let wanted = detail * height_px(&bounds, view).powi(2);
            if body.casts_shadow() {
                let level = model.level_with(SHADOW_SHARE * wanted);
                entries.push((Purpose::Shadow, body.model, level, instance));
            }
            if !frustum.may_see(&bounds) {
                continue;
            }
            let level = model.level_with(wanted);
            for purpose in purposes(body) {
                entries.push((purpose, body.model, level, instance));
            }
        }
        // Stable: bodies of one batch keep the scene's order.
        entries.sort_by_key(|&(purpose, model, level, _)| (purpose, model, level));
        self.batches.clear();
        for (idx, &(purpose, model, level, _)) in (0_u32..).zip(&entries) {
            match self.batches.last_mut() {
                Some(last) if (last.purpose, last.model, last.level) == (purpose, model, level) => {
                    last.instances.end = idx + 1;
                }
                _ => {
                    self.batches.push(Batch { purpose, model, level, instances: idx..idx + 1 });
                }
            }
        }
        let is_drawn = |purpose| matches!(purpose, Purpose::Solid | Purpose::Ghost);
        self.n_triangles = self
            .batches
            .iter()
            .filter(|batch| is_drawn(batch.purpose))
            .filter_map(|batch| {
                let mesh = &meshes.get(batch.model)?.levels[batch.level];
                Some(u64::from(mesh.n_triangles()) * batch.instances.len() as u64)
            })
            .sum();
        let instances: Vec<GpuInstance> = entries.iter().map(|entry| entry.3).collect();
        let has_new_joints = self.joints.write(gpu, &joints);
        let has_new_instances = self.instances.write(gpu, &instances);
        if has_new_joints || has_new_instances {
            self.skin_group = skin_group(gpu, &self.skin_layout, &self.joints, &self.instances);
        }
    }

    /// Triangles in the picture, shadows and marks apart.
    pub(crate) fn n_triangles(&self) -> u64 {
        self.n_triangles
    }

    /// How many draws the picture's bodies take, shadows and marks apart.
    pub(crate) fn n_batches(&self) -> usize {
        let is_drawn = |batch: &&Batch| matches!(batch.purpose, Purpose::Solid | Purpose::Ghost);
        self.batches.iter().filter(is_drawn).count()
    }

    /// Solid bodies, into the picture.
    pub(crate) fn draw_solid(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &MeshCache) {
        self.draw_parts(pass, meshes, Purpose::Solid, &self.solid);
    }

    /// Ghosts, into the picture: first how near they are, so that only the nearest surface is
    /// seen, then that surface.
    pub(crate) fn draw_ghosts(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &MeshCache) {
        self.draw_parts(pass, meshes, Purpose::Ghost, &self.ghost_depth);
        self.draw_parts(pass, meshes, Purpose::Ghost, &self.ghost);
    }

    /// What stops light, into the shadow map.
    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &MeshCache) {
        self.draw_whole(pass, meshes, Purpose::Shadow, &self.shadow);
    }

    /// What is outlined, into the mask.
    pub(crate) fn draw_mask(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &MeshCache) {
        self.draw_parts_with(pass, meshes, Purpose::Mask, |_| &self.mask);
    }

    /// What has a name, into the names.
    pub(crate) fn draw_ids(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &MeshCache) {
        self.draw_parts_with(pass, meshes, Purpose::Id, |_| &self.id);
    }

    fn draw_parts(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        meshes: &MeshCache,
        purpose: Purpose,
        pipeline: &TwoSided,
    ) {
        let by_side = |both| if both { &pipeline.both } else { &pipeline.front };
        self.draw_parts_with(pass, meshes, purpose, by_side);
    }

    fn draw_parts_with<'a>(
        &'a self,
        pass: &mut wgpu::RenderPass<'_>,
        meshes: &MeshCache,
        purpose: Purpose,
        pipeline: impl Fn(bool) -> &'a wgpu::RenderPipeline,
    ) {
        for batch in self.batches.iter().filter(|batch| batch.purpose == purpose) {
            let Some(model) = meshes.get(batch.model) else { continue };
            let mesh = &model.levels[batch.level];
            pass.set_bind_group(2, &self.skin_group, &[]);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            for part in &mesh.parts {
                pass.set_pipeline(pipeline(part.is_double_sided));
                pass.set_bind_group(3, &part.group, &[]);
                pass.draw_indexed(part.indices.clone(), 0, batch.instances.clone());
            }
        }
    }

    fn draw_whole(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        meshes: &MeshCache,
        purpose: Purpose,
        pipeline: &wgpu::RenderPipeline,
    ) {
        pass.set_pipeline(pipeline);
        for batch in self.batches.iter().filter(|batch| batch.purpose == purpose) {
            let Some(model) = meshes.get(batch.model) else { continue };
            let mesh = &model.levels[batch.level];
            pass.set_bind_group(2, &self.skin_group, &[]);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.n_indices, 0, batch.instances.clone());
        }
    }
}

/// 0 for nothing, 1 selected, 2 hovered, as the shaders have it.
pub(crate) fn emphasis_code(emphasis: Emphasis) -> u32 {
    match emphasis {
        Emphasis::None => 0,
        Emphasis::Selected => 1,
        Emphasis::Hovered => 2,
    }
}

fn purposes(body: &Body) -> impl Iterator<Item = Purpose> {
    let shown = match body.look {
        Look::Solid(_) => Purpose::Solid,
        Look::Ghost(_) => Purpose::Ghost,
    };
    let mask = (body.emphasis != Emphasis::None).then_some(Purpose::Mask);
    let id = body.pick.map(|_| Purpose::Id);
    [Some(shown), mask, id].into_iter().flatten()
}

/// How high a body is on the picture, roughly.
fn height_px(bounds: &Bounds, view: &View) -> f32 {
    let viewport = view.viewport();
    let Some(at) = view.camera.project(bounds.center(), viewport) else { return f32::MAX };
    bounds.size().max_element() / view.camera.metres_per_px(at.depth_m, viewport)
}

fn skin_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    joints: &GrowBuffer,
    instances: &GrowBuffer,
) -> wgpu::BindGroup {
    let resources = [joints.buffer().as_entire_binding(), instances.buffer().as_entire_binding()];
    gpu.create_bind_group("skin", layout, &resources)
}
