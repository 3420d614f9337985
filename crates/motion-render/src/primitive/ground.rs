//! The floor with its grid.

use crate::gpu::Gpu;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec};
use crate::shader_source::GROUND;
use crate::shared_bindings::SharedBindings;

/// Draws the floor.
#[derive(Debug)]
pub(crate) struct GroundPlane(wgpu::RenderPipeline);

impl GroundPlane {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let spec = PipelineSpec {
            shader: GROUND,
            vertex: "vertex",
            fragment: Some("floor_and_grid"),
            groups: &[Some(&shared.frame_layout)],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            // From below, too, the floor hides what stands on it.
            cull: false,
            output: Output::Color(Blend::Replace),
            depth: Depth::TestAndWrite,
        };
        Self(spec.create(gpu))
    }

    /// Into the picture, after what stands on it.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.0);
        pass.draw(0..4, 0..1);
    }
}
