//! What darkens the floor: shadow and contact, only where there may be any.

use std::collections::BTreeSet;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};
use motion_scene::scene::Scene;

use crate::buffers::GrowBuffer;
use crate::gpu::Gpu;
use crate::mesh_cache::MeshCache;
use crate::pipeline::{Blend, Depth, Output, PipelineSpec};
use crate::primitive::solids::corners_m;
use crate::shader_source::GROUND_SHADE;
use crate::shared_bindings::SharedBindings;

/// Keep in sync with `Cell` in `ground_shade.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct GpuCell([f32; 3]);

/// Draws shadow and contact on the floor.
#[derive(Debug)]
pub(crate) struct GroundShade {
    cells: GrowBuffer,
    balls: GrowBuffer,
    shadow: wgpu::RenderPipeline,
    contact: wgpu::RenderPipeline,
}

/// The floor is shaded in squares of this size; only those that a shadow may touch are looked at.
const CELL_M: f32 = 0.5;
/// Edges of shadows are soft.
const SOFT_M: f32 = 0.04;
/// Joints up to this high darken the floor below them.
const CONTACT_HEIGHT_M: f32 = 0.22;
/// The flesh around a foot's joint.
const CONTACT_RADIUS_M: f32 = 0.055;
/// More cells than any scene needs; beyond them shadows on the floor end.
const MAX_CELLS: usize = 20_000;

impl GroundShade {
    pub(crate) fn new(gpu: &Gpu, shared: &SharedBindings) -> Self {
        let groups = [Some(&shared.frame_layout), Some(&shared.shadow_layout)];
        let cell = wgpu::vertex_attr_array![0 => Float32x3];
        let ball = wgpu::vertex_attr_array![0 => Float32x4];
        let layout = |stride: usize, attributes| wgpu::VertexBufferLayout {
            array_stride: stride as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes,
        };
        let cells = [layout(size_of::<GpuCell>(), cell.as_slice())];
        let balls = [layout(size_of::<Vec4>(), ball.as_slice())];
        let spec = |vertex, fragment, buffers| {
            let spec = PipelineSpec {
                shader: GROUND_SHADE,
                vertex,
                fragment: Some(fragment),
                groups: &groups,
                buffers,
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                cull: false,
                output: Output::Color(Blend::Multiply),
                depth: Depth::Test,
            };
            spec.create(gpu)
        };
        Self {
            cells: GrowBuffer::new(gpu, "shadow cells", wgpu::BufferUsages::VERTEX),
            balls: GrowBuffer::new(gpu, "contacts", wgpu::BufferUsages::VERTEX),
            shadow: spec("shadow_cell", "shadow", &cells),
            contact: spec("contact_quad", "contact", &balls),
        }
    }

    /// Finds where the scene's bodies and solids darken the floor.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, meshes: &MeshCache, scene: &Scene) {
        if scene.ground.is_none() {
            self.cells.write::<GpuCell>(gpu, &[]);
            self.balls.write::<Vec4>(gpu, &[]);
            return;
        }
        let mut squares = Squares::default();
        let mut balls: Vec<Vec4> = Vec::new();
        let towards_key = scene.light.towards_key;
        // The shadow of a ball is longer than the ball where light falls at a slant.
        let slant = 1.0 / towards_key.y.max(0.05);
        for body in scene.bodies.iter().filter(|body| body.casts_shadow()) {
            let Some(model) = meshes.get(body.model) else { continue };
            for (joint, radius_m) in model.model.balls_m(&body.world_from_joint) {
                squares.add(&[on_floor(joint, towards_key)], radius_m * slant + SOFT_M);
                if joint.y < CONTACT_HEIGHT_M && joint.is_finite() {
                    balls.push(joint.extend(CONTACT_RADIUS_M));
                }
            }
        }
        for solid in scene.solids.iter().filter(|solid| solid.casts_shadow()) {
            let corners = corners_m(solid).map(|corner| on_floor(corner, towards_key));
            squares.add(&corners, SOFT_M);
        }
        self.cells.write(gpu, &squares.cells());
        self.balls.write(gpu, &balls);
    }

    /// Into the picture, after the floor.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        for (pipeline, instances) in [(&self.shadow, &self.cells), (&self.contact, &self.balls)] {
            if instances.len() > 0 {
                pass.set_pipeline(pipeline);
                pass.set_vertex_buffer(0, instances.buffer().slice(..));
                pass.draw(0..4, 0..instances.len());
            }
        }
    }
}

/// Where the shadow of a point falls; points below the floor count as on it.
fn on_floor(point_m: Vec3, towards_key: Vec3) -> Vec3 {
    let height_m = point_m.y.max(0.0);
    point_m - towards_key * (height_m / towards_key.y.max(0.05))
}

/// Squares of the floor, each once.
#[derive(Default)]
struct Squares(BTreeSet<(i32, i32)>);

impl Squares {
    /// Adds the squares under the box around points of the floor.
    fn add(&mut self, points_m: &[Vec3], margin_m: f32) {
        if points_m.iter().any(|point| !point.is_finite()) {
            return;
        }
        let span = |axis: usize| {
            let values = points_m.iter().map(|point| point[axis]);
            let least = values.clone().fold(f32::INFINITY, f32::min) - margin_m;
            let most = values.fold(f32::NEG_INFINITY, f32::max) + margin_m;
            ((least / CELL_M).floor() as i32, (most / CELL_M).floor() as i32)
        };
        let (xs, zs) = (span(0), span(2));
        for x in xs.0..=xs.1 {
            for z in zs.0..=zs.1 {
                if self.0.len() >= MAX_CELLS {
                    return;
                }
                self.0.insert((x, z));
            }
        }
    }

    fn cells(&self) -> Vec<GpuCell> {
        let corner = |idx: i32| idx as f32 * CELL_M;
        self.0.iter().map(|&(x, z)| GpuCell([corner(x), corner(z), CELL_M])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_counted_once() {
        let mut squares = Squares::default();
        squares.add(&[Vec3::ZERO], 0.1);
        squares.add(&[Vec3::new(0.05, 0.0, -0.05)], 0.1);
        assert_eq!(squares.cells().len(), 4, "four squares meet at the origin");
        squares.add(&[Vec3::NAN], 0.1);
        squares.add(&[Vec3::new(f32::INFINITY, 0.0, 0.0)], 0.1);
        assert_eq!(squares.cells().len(), 4);
        squares.add(&[Vec3::splat(-1e9), Vec3::splat(1e9)], 0.1);
        assert_eq!(squares.cells().len(), MAX_CELLS);
    }

    #[test]
    fn shadows_fall_away_from_the_light() {
        let at = on_floor(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.6, 0.8, 0.0));
        assert!((at - Vec3::new(-0.5, 0.0, 3.0)).length() < 1e-6, "{at}");
    }
}
