//! Lines and dots of even width on the picture.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use motion_scene::line::{Line, Occlusion};
use motion_scene::scene::Scene;

use crate::buffers::GrowBuffer;
use crate::gpu::Gpu;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec};
use crate::shader_source::LINES;
use crate::shared_bindings::SharedBindings;

const PIECE: [wgpu::VertexAttribute; 5] = wgpu::vertex_attr_array![
    0 => Float32x3, 1 => Float32, 2 => Float32x3, 3 => Uint32, 4 => Float32x4
];

/// Keep in sync with `Piece` in lines.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GpuPiece {
    from_in_world: [f32; 3],
    width_px: f32,
    to_in_world: [f32; 3],
    pick: u32,
    color: [f32; 4],
}

/// A line is picked within this of its middle, whatever its width, points.
const PICK_WIDTH_PT: f32 = 9.0;

/// Draws lines.
#[derive(Debug)]
pub(crate) struct Lines {
    /// Pieces that bodies hide, then those that nothing hides, then all that have names.
    pieces: GrowBuffer,
    n_hidden: u32,
    n_shown: u32,
    n_named: u32,
    hidden: wgpu::RenderPipeline,
    shown: wgpu::RenderPipeline,
    id: wgpu::RenderPipeline,
}

impl Lines {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let spec = |fragment, output, depth| {
            let spec = PipelineSpec {
                shader: LINES,
                vertex: "vertex",
                fragment: Some(fragment),
                groups: &[Some(&shared.frame_layout)],
                buffers: &[wgpu::VertexBufferLayout {
                    array_stride: size_of::<GpuPiece>() as u64,
                    step_mode: wgpu::VertexStepMode::Instance,
                    attributes: &PIECE,
                }],
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                cull: false,
                output,
                depth,
            };
            spec.create(gpu)
        };
        let over = Output::Color(Blend::Over);
        Self {
            pieces: GrowBuffer::new(gpu, "lines", wgpu::BufferUsages::VERTEX),
            n_hidden: 0,
            n_shown: 0,
            n_named: 0,
            hidden: spec("line", over, Depth::Test),
            shown: spec("line", over, Depth::Ignore),
            id: spec("id", Output::Ids, Depth::TestAndWrite),
        }
    }

    /// Uploads the lines of a scene, those of its trails and of its joint targets.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, scene: &Scene, pixels_per_point: f32) {
        let trails = scene.trails.iter().flat_map(|trail| trail.to_lines(scene.theme));
        let targets = scene.joint_targets.iter().flat_map(|target| target.to_lines(scene.theme));
        let (mut hidden, mut shown, mut named) = (Vec::new(), Vec::new(), Vec::new());
        for line in scene.lines.iter().cloned().chain(trails).chain(targets) {
            let list = match line.occlusion {
                Occlusion::Hidden => &mut hidden,
                Occlusion::Shown => &mut shown,
            };
            list.extend(pieces(&line, line.width_pt * pixels_per_point));
            if line.pick.is_some() {
                let width_pt = line.width_pt.max(PICK_WIDTH_PT);
                named.extend(pieces(&line, width_pt * pixels_per_point));
            }
        }
        self.n_hidden = hidden.len() as u32;
        self.n_shown = shown.len() as u32;
        self.n_named = named.len() as u32;
        self.pieces.write(gpu, &[hidden, shown, named].concat());
    }

    /// Those that bodies hide, into the picture.
    pub(crate) fn draw_hidden(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(pass, &self.hidden, 0..self.n_hidden);
    }

    /// Those that nothing hides, into the picture.
    pub(crate) fn draw_shown(&self, pass: &mut wgpu::RenderPass<'_>) {
        let end = self.n_hidden + self.n_shown;
        self.draw(pass, &self.shown, self.n_hidden..end);
    }

    /// What has a name, into the names.
    pub(crate) fn draw_ids(&self, pass: &mut wgpu::RenderPass<'_>) {
        let first = self.n_hidden + self.n_shown;
        self.draw(pass, &self.id, first..first + self.n_named);
    }

    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        pieces: std::ops::Range<u32>,
    ) {
        if !pieces.is_empty() {
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, self.pieces.buffer().slice(..));
            pass.draw(0..4, pieces);
        }
    }
}

fn pieces(line: &Line, width_px: f32) -> impl Iterator<Item = GpuPiece> {
    let piece = move |from: Vec3, to: Vec3| GpuPiece {
        from_in_world: from.into(),
        width_px,
        to_in_world: to.into(),
        pick: line.pick.map_or(0, |id| id.0.get()),
        color: line.color.to_srgb(),
    };
    let points = &line.points_m;
    let dot = (points.len() == 1).then(|| piece(points[0], points[0]));
    dot.into_iter().chain(points.windows(2).map(move |pair| piece(pair[0], pair[1])))
}
