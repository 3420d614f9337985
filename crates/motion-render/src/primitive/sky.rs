//! What is behind everything.

use crate::gpu::Gpu;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec};
use crate::shader_source::SKY;
use crate::shared_bindings::SharedBindings;

/// Keep in sync with `BANDS` in `sky.wgsl`.
const N_BANDS: u32 = 32;

/// Draws the sky.
#[derive(Debug)]
pub(crate) struct Sky(wgpu::RenderPipeline);

impl Sky {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let spec = PipelineSpec {
            shader: SKY,
            vertex: "vertex",
            fragment: Some("gradient"),
            groups: &[Some(&shared.frame_layout)],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            cull: false,
            output: Output::Color(Blend::Replace),
            depth: Depth::Test,
        };
        Self(spec.create(gpu))
    }

    /// Into what is left of the picture.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.0);
        pass.draw(0..2 * (N_BANDS + 1), 0..1);
    }
}
