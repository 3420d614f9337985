//! What several primitives bind: what is known of the picture, and the shadow map.

use crate::buffers::fixed_buffer;
use crate::frame_uniform::FrameUniform;
use crate::gpu::Gpu;
use crate::pipeline::{DEPTH_FORMAT, UNIFORM, bind_group_layout, texture_binding};

/// A frame uniform with its bind group: group 0 of every shader.
#[derive(Debug)]
pub(crate) struct FrameBinding {
    buffer: wgpu::Buffer,
    pub(crate) group: wgpu::BindGroup,
}

impl FrameBinding {
    fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, label: &str) -> Self {
        let zero = [bytemuck::Zeroable::zeroed(); 1];
        let buffer = fixed_buffer::<FrameUniform>(gpu, label, wgpu::BufferUsages::UNIFORM, &zero);
        let group = gpu.create_bind_group(label, layout, &[buffer.as_entire_binding()]);
        Self { buffer, group }
    }

    /// Replaces the uniform.
    pub(crate) fn write(&self, gpu: &Gpu, uniform: &FrameUniform) {
        gpu.queue().write_buffer(&self.buffer, 0, bytemuck::bytes_of(uniform));
    }
}

/// The shared layouts and what is bound to them.
#[derive(Debug)]
pub(crate) struct SharedBindings {
    pub(crate) frame_layout: wgpu::BindGroupLayout,
    pub(crate) shadow_layout: wgpu::BindGroupLayout,
    /// The camera's picture.
    pub(crate) frame: FrameBinding,
    /// The key light's.
    pub(crate) light: FrameBinding,
    /// The part of the camera's picture that is picked from.
    pub(crate) pick: FrameBinding,
    shadow_sampler: wgpu::Sampler,
    shadow_map: wgpu::Texture,
    pub(crate) shadow_view: wgpu::TextureView,
    pub(crate) shadow_group: wgpu::BindGroup,
}

impl SharedBindings {
    /// With a small shadow map.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let frame_layout = bind_group_layout(gpu, "frame", &[(both, UNIFORM)]);
        let shadow_layout = bind_group_layout(
            gpu,
            "shadow",
            &[
                (wgpu::ShaderStages::FRAGMENT, texture_binding(wgpu::TextureSampleType::Depth)),
                (
                    wgpu::ShaderStages::FRAGMENT,
                    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
                ),
            ],
        );
        let shadow_sampler = gpu.device().create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let (shadow_map, shadow_view, shadow_group) =
            shadow_map(gpu, &shadow_layout, &shadow_sampler, 256);
        Self {
            frame: FrameBinding::new(gpu, &frame_layout, "frame"),
            light: FrameBinding::new(gpu, &frame_layout, "light"),
            pick: FrameBinding::new(gpu, &frame_layout, "pick"),
            frame_layout,
            shadow_layout,
            shadow_sampler,
            shadow_map,
            shadow_view,
            shadow_group,
        }
    }

    /// Columns and rows of the shadow map.
    pub(crate) fn shadow_px(&self) -> u32 {
        self.shadow_map.width()
    }

    /// Makes the shadow map at least this large.
    pub(crate) fn grow_shadow_map(&mut self, gpu: &Gpu, size_px: u32) {
        if size_px > self.shadow_px() {
            (self.shadow_map, self.shadow_view, self.shadow_group) =
                shadow_map(gpu, &self.shadow_layout, &self.shadow_sampler, size_px);
        }
    }
}

fn shadow_map(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    sampler: &wgpu::Sampler,
    size_px: u32,
) -> (wgpu::Texture, wgpu::TextureView, wgpu::BindGroup) {
    let texture = gpu.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow map"),
        size: wgpu::Extent3d { width: size_px, height: size_px, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let resources =
        [wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(sampler)];
    let group = gpu.create_bind_group("shadow", layout, &resources);
    (texture, view, group)
}
