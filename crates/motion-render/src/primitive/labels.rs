//! Words with plates behind them, and the numbers of the floor's metres.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use motion_scene::color::{ColorRole, LinearRgba};
use motion_scene::label::{Anchor, Label, LabelPlace};
use motion_scene::line::Occlusion;
use motion_scene::scene::Scene;

use crate::buffers::GrowBuffer;
use crate::glyph_atlas::GlyphAtlas;
use crate::gpu::Gpu;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec, bind_group_layout, texture_binding};
use crate::shader_source::LABELS;
use crate::shared_bindings::SharedBindings;
use crate::view::View;

const QUAD: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4, 2 => Float32x4, 3 => Float32x2];

/// Keep in sync with `Quad` in labels.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GpuQuad {
    place: [f32; 4],
    source: [f32; 4],
    color: [f32; 4],
    radius: f32,
    depth: f32,
}

/// Free space between words and the edge of their plate, points.
const PADDING_PT: Vec2 = Vec2::new(6.0, 2.5);
const RADIUS_PT: f32 = 4.0;
/// Between a place and words beside or above it, points.
const DISTANCE_PT: f32 = 8.0;
/// How much nearer than their place words are, of the camera's distance.
const UPRIGHT_SHARE: f32 = 0.05;
/// Numbers of metres, points.
const METRE_PT: f32 = 10.5;

/// Draws labels.
#[derive(Debug)]
pub(crate) struct Labels {
    atlas: GlyphAtlas,
    group: wgpu::BindGroup,
    quads: GrowBuffer,
    pipeline: wgpu::RenderPipeline,
}

impl Labels {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let texture = texture_binding(wgpu::TextureSampleType::Float { filterable: false });
        let layout = bind_group_layout(gpu, "letters", &[(wgpu::ShaderStages::FRAGMENT, texture)]);
        let atlas = GlyphAtlas::new(gpu);
        let resources = [wgpu::BindingResource::TextureView(&atlas.view())];
        let spec = PipelineSpec {
            shader: LABELS,
            vertex: "vertex",
            fragment: Some("label"),
            groups: &[Some(&shared.frame_layout), Some(&layout)],
            buffers: &[wgpu::VertexBufferLayout {
                array_stride: size_of::<GpuQuad>() as u64,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &QUAD,
            }],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            cull: false,
            output: Output::Color(Blend::Over),
            depth: Depth::Test,
        };
        Self {
            group: gpu.create_bind_group("letters", &layout, &resources),
            quads: GrowBuffer::new(gpu, "labels", wgpu::BufferUsages::VERTEX),
            pipeline: spec.create(gpu),
            atlas,
        }
    }

    /// Lays out the words of a scene: its labels, its marks', the floor's.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, scene: &Scene, view: &View) {
        self.atlas.make_room();
        let theme = scene.theme;
        let mut labels: Vec<(f32, Label)> = Vec::new();
        let has_marks =
            scene.ground.is_some_and(|ground| ground.has_grid && ground.has_metre_marks);
        let metres = if has_marks { metre_labels(scene, view) } else { Vec::new() };
        let marks = scene.checkpoints.iter().filter_map(|mark| mark.to_label(theme));
        let targets = scene.joint_targets.iter().filter_map(|target| target.to_label(theme));
        for label in scene.labels.iter().cloned().chain(marks).chain(targets) {
            let depth_m = match label.place {
                LabelPlace::Picture(_) => 0.0,
                LabelPlace::World(at) => {
                    let Some(at) = view.camera.project(at, view.viewport()) else { continue };
                    at.depth_m
                }
            };
            labels.push((depth_m, label));
        }
        // The nearest is drawn last.
        labels.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut quads: Vec<GpuQuad> = Vec::new();
        for label in metres.iter().chain(labels.iter().map(|(_, label)| label)) {
            self.add(&mut quads, label, view);
        }
        self.atlas.upload(gpu);
        self.quads.write(gpu, &quads);
    }

    /// Over the picture.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        if self.quads.len() > 0 {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(1, &self.group, &[]);
            pass.set_vertex_buffer(0, self.quads.buffer().slice(..));
            pass.draw(0..4, 0..self.quads.len());
        }
    }

    fn add(&mut self, quads: &mut Vec<GpuQuad>, label: &Label, view: &View) {
        let scale = view.pixels_per_point;
        let (at_px, gap) = match label.place {
            LabelPlace::Picture(at_pt) => (at_pt * scale, 0.0),
            LabelPlace::World(at) => match view.camera.project(at, view.viewport()) {
                Some(at) => (at.px, DISTANCE_PT * scale + clear_px(label, at.depth_m, view)),
                None => return,
            },
        };
        let depth = match (label.place, label.occlusion) {
            (LabelPlace::World(at), Occlusion::Hidden) => {
                // Letters stand up; their lower halves must not sink into the floor.
                let nearer = at - view.camera.forward() * (UPRIGHT_SHARE * view.camera.distance_m);
                let clip = view.camera.clip_from_world(view.viewport()).project_point3(nearer);
                clip.z.clamp(0.0, 1.0)
            }
            _ => 1.0,
        };
        let words = self.atlas.lay_out(&label.text, label.size_pt * scale);
        if words.glyphs.is_empty() || !at_px.is_finite() {
            return;
        }
        let size = Vec2::new(words.width_px, words.height_px);
        let corner = match label.anchor {
            Anchor::Center => at_px - 0.5 * size,
            Anchor::Below => at_px - Vec2::new(0.5 * size.x, size.y + gap),
            Anchor::Left => at_px + Vec2::new(gap, -0.5 * size.y),
        };
        let corner = corner.round();
        if let Some(plate) = label.plate {
            let padding = PADDING_PT * scale;
            let (from, size) = (corner - padding, size + 2.0 * padding);
            quads.push(GpuQuad {
                place: [from.x, from.y, size.x, size.y],
                source: [0.0; 4],
                color: plate.to_srgb(),
                radius: RADIUS_PT * scale,
                depth,
            });
        }
        quads.extend(words.glyphs.iter().map(|glyph| {
            let [x, y, width, height] = glyph.source.map(|texels| texels as f32);
            GpuQuad {
                place: [corner.x + glyph.at[0], corner.y + glyph.at[1], width, height],
                source: [x, y, width, height],
                color: label.color.to_srgb(),
                radius: 0.0,
                depth,
            }
        }));
    }
}

/// How much of the picture a disc on the floor takes upwards, from its middle.
fn clear_px(label: &Label, depth_m: f32, view: &View) -> f32 {
    /// The words are higher than a point: seen flat, they still need some way.
    const LEAST_SHARE: f32 = 0.3;
    let radius_px = label.clear_m / view.camera.metres_per_px(depth_m, view.viewport());
    radius_px * view.camera.pitch_rad.sin().abs().max(LEAST_SHARE)
}

/// Numbers along both axes of the floor, as close as they can be read.
fn metre_labels(scene: &Scene, view: &View) -> Vec<Label> {
    /// So many on either side of the middle of the picture.
    const N_EACH_WAY: i32 = 6;
    /// At least this far apart, points.
    const APART_PT: f32 = 70.0;
    let camera = &view.camera;
    // Seen from the side the axes are one line and the numbers would lie on each other.
    if camera.pitch_rad.abs() < 0.05 {
        return Vec::new();
    }
    let m_per_pt = camera.metres_per_px(camera.distance_m, view.viewport()) * view.pixels_per_point;
    let steps = [1, 2, 5, 10, 20, 50, 100];
    let is_wide = |step: &&i32| **step as f32 >= APART_PT * m_per_pt;
    let Some(&step) = steps.iter().find(is_wide) else { return Vec::new() };
    let color = ColorRole::FaintText.color(scene.theme).with_alpha(0.75);
    let mut labels = Vec::new();
    for (axis, middle_m) in [(Vec3::X, camera.target_m.x), (Vec3::Z, camera.target_m.z)] {
        let middle = (middle_m / step as f32).round() as i32;
        for k in middle - N_EACH_WAY..=middle + N_EACH_WAY {
            let metres = k * step;
            // The origin has one number, not two.
            if metres == 0 && axis == Vec3::Z {
                continue;
            }
            labels.push(metre_label(axis * metres as f32, metres, color));
        }
    }
    labels
}

fn metre_label(at_m: Vec3, metres: i32, color: LinearRgba) -> Label {
    Label {
        text: if metres == 0 { "0 m".to_owned() } else { metres.to_string() },
        place: LabelPlace::World(at_m),
        anchor: Anchor::Left,
        clear_m: 0.0,
        occlusion: Occlusion::Hidden,
        size_pt: METRE_PT,
        color,
        plate: None,
    }
}
