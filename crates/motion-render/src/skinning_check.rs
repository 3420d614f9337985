//! What the device computes for a skin, fetched: the twin of
//! [`SkinnedMesh::skinned_position_m`](motion_scene::mesh::SkinnedMesh::skinned_position_m).
//!
//! The shader is made of the same `common/skinning.wgsl` that drawing uses.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use motion_scene::mesh::SkinnedMesh;

use crate::buffers::fixed_buffer;
use crate::gpu::Gpu;
use crate::primitive::skinned_mesh::GpuJoint;
use crate::shader_source::SKINNED_POSITIONS;

/// Keep in sync with `Vertex` in `skinned_positions.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct CheckVertex {
    position: Vec4,
    weights: Vec4,
    joints: [u32; 4],
}

/// Where the device puts every vertex, metres. `world_from_mesh` holds a matrix for each joint.
/// `None` if the device does not answer.
pub fn positions_on_device_m(
    gpu: &Gpu,
    mesh: &SkinnedMesh,
    world_from_mesh: &[Mat4],
) -> Option<Vec<Vec3>> {
    let vertices: Vec<CheckVertex> = mesh
        .vertices()
        .iter()
        .map(|v| CheckVertex {
            position: v.position_m.extend(1.0),
            weights: Vec4::from(v.weights),
            joints: v.joints.map(u32::from),
        })
        .collect();
    let joints: Vec<GpuJoint> = world_from_mesh.iter().map(GpuJoint::new).collect();
    let storage = wgpu::BufferUsages::STORAGE;
    let vertices = fixed_buffer(gpu, "vertices", storage, &vertices);
    let joints = fixed_buffer(gpu, "joints", storage, &joints);
    let zeros = vec![Vec4::ZERO; mesh.vertices().len()];
    let out = fixed_buffer(gpu, "positions", storage | wgpu::BufferUsages::COPY_SRC, &zeros);
    let device = gpu.device();
    let fetched = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("fetched positions"),
        size: out.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(SKINNED_POSITIONS.name),
        layout: None,
        module: &SKINNED_POSITIONS.module(device),
        entry_point: Some("skin"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let group = |index: u32, resources: &[wgpu::BindingResource<'_>]| {
        gpu.create_bind_group("skin", &pipeline.get_bind_group_layout(index), resources)
    };
    let data = group(0, &[vertices.as_entire_binding(), out.as_entire_binding()]);
    let skin = group(2, &[joints.as_entire_binding()]);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &data, &[]);
        pass.set_bind_group(2, &skin, &[]);
        pass.dispatch_workgroups((mesh.vertices().len() as u32).div_ceil(64), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&out, 0, &fetched, 0, out.size());
    gpu.queue().submit([encoder.finish()]);
    fetched.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
    let mapped = fetched.slice(..).get_mapped_range().ok()?;
    Some(mapped.chunks_exact(16).map(position).collect())
}

fn position(bytes: &[u8]) -> Vec3 {
    bytemuck::pod_read_unaligned::<Vec4>(bytes).truncate()
}
