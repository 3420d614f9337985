//! Lines around what is selected or hovered.

use glam::Vec4;
use motion_scene::color::ColorRole;
use motion_scene::scene::Scene;

use crate::buffers::GrowBuffer;
use crate::gpu::Gpu;
use crate::pipeline::{
    Blend, Depth, Output, PipelineSpec, UNIFORM, bind_group_layout, texture_binding,
};
use crate::shader_source::OUTLINE;
use crate::shared_bindings::SharedBindings;

/// Draws outlines from a mask.
#[derive(Debug)]
pub(crate) struct Outline {
    layout: wgpu::BindGroupLayout,
    colors: GrowBuffer,
    group: Option<wgpu::BindGroup>,
    pipeline: wgpu::RenderPipeline,
}

impl Outline {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let stage = wgpu::ShaderStages::FRAGMENT;
        let mask = texture_binding(wgpu::TextureSampleType::Float { filterable: false });
        let layout = bind_group_layout(gpu, "outline", &[(stage, mask), (stage, UNIFORM)]);
        let spec = PipelineSpec {
            shader: OUTLINE,
            vertex: "vertex",
            fragment: Some("outline"),
            groups: &[Some(&shared.frame_layout), Some(&layout)],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: false,
            output: Output::Color(Blend::Over),
            depth: Depth::Ignore,
        };
        Self {
            pipeline: spec.create(gpu),
            colors: GrowBuffer::new(gpu, "outline colors", wgpu::BufferUsages::UNIFORM),
            layout,
            group: None,
        }
    }

    /// Takes the theme's colours and, where it is another than last time, the mask.
    pub(crate) fn prepare(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        new_mask: Option<&wgpu::TextureView>,
    ) {
        let roles = [ColorRole::Selected, ColorRole::Hovered];
        let colors = roles.map(|role| Vec4::from(role.color(scene.theme).to_srgb()));
        self.colors.write(gpu, &colors);
        if let Some(mask) = new_mask {
            let resources = [
                wgpu::BindingResource::TextureView(mask),
                self.colors.buffer().as_entire_binding(),
            ];
            self.group = Some(gpu.create_bind_group("outline", &self.layout, &resources));
        }
    }

    /// Over the picture.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(group) = &self.group {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(1, group, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
