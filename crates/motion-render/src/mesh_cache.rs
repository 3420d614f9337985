//! Models uploaded once, by id.

use std::collections::BTreeMap;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::Vec4;
use motion_scene::mesh::{BodyModel, Material, MeshId, SkinnedMesh, Texture};

use crate::buffers::fixed_buffer;
use crate::gpu::Gpu;
use crate::mipmaps::mip_levels;
use crate::pipeline::{UNIFORM, bind_group_layout, texture_binding};

/// A vertex as it is stored. Keep in sync with `Vertex` in `common/body.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GpuVertex {
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
    joints: [u16; 4],
    weights: [f32; 4],
}

const ATTRIBUTES: [wgpu::VertexAttribute; 5] = wgpu::vertex_attr_array![
    0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Uint16x4, 4 => Float32x4
];

/// How [`GpuMesh::vertices`] are laid out.
pub(crate) const VERTEX_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<GpuVertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &ATTRIBUTES,
};

/// Keep in sync with `Part` in `skinned_mesh.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct PartUniform {
    base_color: Vec4,
    surface: Vec4,
}

/// Triangles of one material.
#[derive(Debug)]
pub(crate) struct GpuPart {
    pub(crate) indices: std::ops::Range<u32>,
    pub(crate) group: wgpu::BindGroup,
    pub(crate) is_double_sided: bool,
}

/// One level of a model.
#[derive(Debug)]
pub(crate) struct GpuMesh {
    pub(crate) vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    pub(crate) n_indices: u32,
    pub(crate) parts: Vec<GpuPart>,
}

impl GpuMesh {
    /// How many triangles it has.
    pub(crate) fn n_triangles(&self) -> u32 {
        self.n_indices / 3
    }
}

/// A model: its levels on the device, and what the processor needs of it.
#[derive(Debug)]
pub(crate) struct GpuModel {
    pub(crate) model: BodyModel,
    /// Finest first.
    pub(crate) levels: Vec<GpuMesh>,
}

impl GpuModel {
    /// The coarsest level with at least `n_triangles`, else the finest.
    pub(crate) fn level_with(&self, n_triangles: f32) -> usize {
        let is_enough = |mesh: &GpuMesh| mesh.n_triangles() as f32 >= n_triangles;
        self.levels.iter().rposition(is_enough).unwrap_or(0)
    }
}

/// All models.
#[derive(Debug)]
pub(crate) struct MeshCache {
    pub(crate) part_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    white: wgpu::TextureView,
    models: BTreeMap<MeshId, GpuModel>,
}

impl MeshCache {
    /// No models.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let stage = wgpu::ShaderStages::FRAGMENT;
        let part_layout = bind_group_layout(
            gpu,
            "part",
            &[
                (stage, UNIFORM),
                (stage, texture_binding(wgpu::TextureSampleType::Float { filterable: true })),
                (stage, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            ],
        );
        let sampler = gpu.device().create_sampler(&wgpu::SamplerDescriptor {
            label: Some("base color"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let white = upload(gpu, &Texture { width: 1, height: 1, rgba: vec![255; 4] });
        Self { part_layout, sampler, white, models: BTreeMap::new() }
    }

    /// The model of that name.
    pub(crate) fn get(&self, id: MeshId) -> Option<&GpuModel> {
        self.models.get(&id)
    }

    /// Uploads a model, in place of one with the same name. Does nothing for the very same model.
    pub(crate) fn set(&mut self, gpu: &Gpu, id: MeshId, model: &BodyModel) {
        let is_same = |known: &GpuModel| {
            let (ours, new) = (known.model.levels(), model.levels());
            ours.len() == new.len() && ours.iter().zip(new).all(|(a, b)| Arc::ptr_eq(a, b))
        };
        if self.models.get(&id).is_some_and(is_same) {
            return;
        }
        let levels = model.levels().iter().map(|mesh| self.upload_mesh(gpu, mesh)).collect();
        self.models.insert(id, GpuModel { model: model.clone(), levels });
    }

    /// Forgets a model.
    pub(crate) fn remove(&mut self, id: MeshId) {
        self.models.remove(&id);
    }

    fn upload_mesh(&self, gpu: &Gpu, mesh: &SkinnedMesh) -> GpuMesh {
        let vertices: Vec<GpuVertex> = mesh
            .vertices()
            .iter()
            .map(|v| GpuVertex {
                position: v.position_m.into(),
                normal: v.normal.into(),
                uv: v.uv.into(),
                joints: v.joints,
                weights: v.weights,
            })
            .collect();
        let parts = mesh.parts().iter().map(|part| {
            let first = part.first_triangle * 3;
            GpuPart {
                indices: first..first + part.n_triangles * 3,
                group: self.part_group(gpu, &part.material),
                is_double_sided: part.material.double_sided,
            }
        });
        GpuMesh {
            vertices: fixed_buffer(gpu, "vertices", wgpu::BufferUsages::VERTEX, &vertices),
            indices: fixed_buffer(gpu, "indices", wgpu::BufferUsages::INDEX, mesh.triangles()),
            n_indices: 3 * mesh.triangles().len() as u32,
            parts: parts.collect(),
        }
    }

    fn part_group(&self, gpu: &Gpu, material: &Material) -> wgpu::BindGroup {
        let uniform = PartUniform {
            base_color: Vec4::from(material.base_color.0),
            // A mirror of a point light would show nothing but sparks.
            surface: Vec4::new(material.roughness.clamp(0.2, 1.0), material.alpha_cutoff, 0.0, 0.0),
        };
        let uniform = fixed_buffer(gpu, "part", wgpu::BufferUsages::UNIFORM, &[uniform]);
        let own = material.texture.as_deref().map(|texture| upload(gpu, texture));
        let view = own.as_ref().unwrap_or(&self.white);
        gpu.create_bind_group(
            "part",
            &self.part_layout,
            &[
                uniform.as_entire_binding(),
                wgpu::BindingResource::TextureView(view),
                wgpu::BindingResource::Sampler(&self.sampler),
            ],
        )
    }
}

fn upload(gpu: &Gpu, texture: &Texture) -> wgpu::TextureView {
    let most = gpu.device().limits().max_texture_dimension_2d;
    let levels = mip_levels(texture);
    // A texture that is too large for the device begins with a smaller level.
    let fitting: Vec<Texture> =
        levels.into_iter().filter(|level| level.width.max(level.height) <= most).collect();
    let first = &fitting[0];
    let on_gpu = gpu.create_texture(&wgpu::TextureDescriptor {
        label: Some("base color"),
        size: extent(first),
        mip_level_count: fitting.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (mip_level, level) in (0..).zip(&fitting) {
        gpu.queue().write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &on_gpu,
                mip_level,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            &level.rgba,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * level.width),
                rows_per_image: None,
            },
            extent(level),
        );
    }
    on_gpu.create_view(&wgpu::TextureViewDescriptor::default())
}

fn extent(texture: &Texture) -> wgpu::Extent3d {
    wgpu::Extent3d { width: texture.width, height: texture.height, depth_or_array_layers: 1 }
}
