//! A neutral mannequin around any skeleton, made by code from the skeleton alone.
//!
//! ```
//! use glam::{Quat, Vec3};
//! use motion_scene::body_plan::{BodyPlan, PlanJoint};
//! use motion_scene::mannequin::mannequin;
//!
//! let joint = |parent, position_m| PlanJoint {
//!     parent,
//!     position_m,
//!     world_from_joint: Quat::IDENTITY,
//!     end_m: None,
//!     part: None,
//! };
//! let joints = vec![joint(None, Vec3::ZERO), joint(Some(0), Vec3::Y)];
//! let model = mannequin(&BodyPlan { joints, sole_m: [0.0; 2] });
//! assert!(model.levels()[0].triangles().len() > 100);
//! ```
//!
//! **Method.** The body is a signed distance field ([`field`]): tapered, lopsided elliptic tubes
//! and ellipsoids ([`shape`]) for trunk, head, arms and legs ([`torso`], [`head`], [`arm`],
//! [`leg`]), which flow into each other by smooth minima along the bone tree only, so that an arm
//! never grows together with the flank it hangs beside. Surface nets on a grid that is finer at
//! head, hands and feet make triangles of it ([`surface`], [`search`], [`grid`]); edge collapses
//! make the levels of detail ([`simplify`]); the finer levels' vertices are put back onto the
//! surface, and normals are its gradient. Of a body that is its own mirror image one half is made.
//!
//! **Proportions.** All tables are for a body of 1.75 m and scale with the plan's bones. The shares
//! of body height are those of Drillis and Contini (1966) as printed by Winter ([`figure`]). Girths
//! were chosen by eye, between a woman's and a man's; such a body has 60 litres. A plan that lacks
//! parts gets them where they usually are.
//!
//! **Feet.** The sole is a plane `sole_m` below the toe joint of the bind pose (the ankle without
//! one), heel included: a flat foot whose joint is that high touches the floor, and nothing of it
//! is below. It is level in the bind pose, but for a zero pose that straddles with straight ankles,
//! as CMU's does, where it leans with the shin; [`figure`] tells how that is seen.
//!
//! **Skin.** Shares are smooth functions of the place in the bind pose ([`human`]). Kneecaps stay
//! with the thigh and elbow points with the forearm, which keeps the corners of bent limbs. Joints
//! at the same place count as the last of them; joints below a hand are ignored, since captured
//! fingers turn over.
//!
//! **Same plan, same bytes**, on any number of threads: threads share out places, each of which is
//! computed alone.

mod arm;
mod field;
mod figure;
mod generic;
mod grid;
mod head;
mod human;
mod leg;
mod needle;
mod quadric;
mod search;
mod shape;
mod simplify;
mod surface;
mod torso;
mod weights;

use std::sync::Arc;

use glam::{Mat4, Vec2, Vec3};
use rayon::prelude::*;

use crate::body_plan::BodyPlan;
use crate::color::LinearRgba;
use crate::mesh::{BodyModel, Material, MeshPart, SkinnedMesh, Vertex};

use field::{Field, Layer, Plane};
use figure::Figure;
use generic::Generic;
use grid::{Detail, Grid};
use human::Human;
use simplify::Simplifier;
use surface::RawMesh;
use weights::Weights;

/// Most triangles of each level, finest first.
pub const LEVEL_TRIANGLES: [usize; 4] = [14_000, 4_000, 1_200, 400];

/// The step of the grid where there is no detail, for a body of 1.75 m.
const STEP_M: f32 = 0.015;

/// Joints after these have no skin.
const MAX_JOINTS: usize = 1 << 16;

/// The mannequin for a plan, at [`LEVEL_TRIANGLES`] triangles or fewer.
///
/// Plans with hips or a back, and a leg or an arm, are human: what they lack is made up (an arm
/// without a hand joint has a hand that moves with the forearm). All others get limbs around
/// their bones. Numbers that are not finite count as the parent's place; a plan without joints
/// gets a small round thing with one joint.
pub fn mannequin(plan: &BodyPlan) -> BodyModel {
    let positions_m = positions_m(plan);
    let body = match Figure::read(plan, &positions_m) {
        Some(figure) => Body::Human(Box::new(Human::new(figure))),
        None => Body::Generic(Generic::new(plan, &positions_m)),
    };
    let joint_from_mesh = joint_from_mesh(plan, &positions_m);
    let levels = raw_levels(&body)
        .into_iter()
        .filter_map(|raw| skinned(&body, raw, &joint_from_mesh))
        .map(Arc::new)
        .collect();
    BodyModel::new(levels).expect("every field has a surface on its grid")
}

/// Joint positions with a stand-in for those that are not finite; at least one.
fn positions_m(plan: &BodyPlan) -> Vec<Vec3> {
    let mut positions_m: Vec<Vec3> = Vec::with_capacity(plan.joints.len());
    for joint in plan.joints.iter().take(MAX_JOINTS) {
        let parent = joint.parent.filter(|&parent| parent < positions_m.len());
        let usual_m = parent.map_or(Vec3::ZERO, |parent| positions_m[parent]);
        // Beyond this, squares of lengths leave the numbers that f32 holds.
        let is_near = joint.position_m.is_finite() && joint.position_m.abs().max_element() < 1e8;
        positions_m.push(if is_near { joint.position_m } else { usual_m });
    }
    positions_m
}

fn joint_from_mesh(plan: &BodyPlan, positions_m: &[Vec3]) -> Vec<Mat4> {
    if positions_m.is_empty() {
        return vec![Mat4::IDENTITY];
    }
    let of = |(joint, &at): (&crate::body_plan::PlanJoint, &Vec3)| {
        let rotation = joint.world_from_joint;
        let length = rotation.length();
        let is_rotation = rotation.is_finite() && length > 1e-6;
        let back = if is_rotation { rotation.normalize().inverse() } else { glam::Quat::IDENTITY };
        Mat4::from_quat(back) * Mat4::from_translation(-at)
    };
    plan.joints.iter().zip(positions_m).map(of).collect()
}

/// What is being made.
enum Body {
    Human(Box<Human>),
    Generic(Generic),
}

impl Body {
    fn layer(&self) -> &Layer {
        match self {
            Self::Human(human) => &human.body,
            Self::Generic(generic) => &generic.body,
        }
    }

    fn scale(&self) -> f32 {
        match self {
            Self::Human(human) => human.scale(),
            Self::Generic(generic) => generic.scale(),
        }
    }

    fn details(&self) -> Vec<Detail> {
        match self {
            Self::Human(human) => human.details(),
            Self::Generic(generic) => generic.details(),
        }
    }

    fn mirror_x_m(&self) -> Option<f32> {
        match self {
            Self::Human(human) => human.mirror_x_m(),
            Self::Generic(_) => None,
        }
    }

    fn importance(&self, p: Vec3, level: usize) -> f32 {
        match self {
            Self::Human(human) => human.importance(p, level),
            Self::Generic(_) => 1.0,
        }
    }

    fn weights(&self, p: Vec3) -> Weights {
        match self {
            Self::Human(human) => human.weights(p),
            Self::Generic(generic) => generic.weights(p),
        }
    }

    fn sole(&self, p: Vec3, slack_m: f32) -> Option<Plane> {
        match self {
            Self::Human(human) => human.sole(p, slack_m),
            Self::Generic(_) => None,
        }
    }
}

/// A level's triangles with the normals of the body there.
struct RawLevel {
    mesh: RawMesh,
    normals: Vec<Vec3>,
}

fn raw_levels(body: &Body) -> Vec<RawLevel> {
    let layer = body.layer();
    let scale = body.scale();
    let mirror_x_m = body.mirror_x_m();
    let bounds_m = layer.bounds_m();
    let middle_x_m = mirror_x_m.unwrap_or(0.5 * (bounds_m[0].x + bounds_m[1].x));
    let grid =
        Grid::new(bounds_m, middle_x_m, mirror_x_m.is_some(), STEP_M * scale, &body.details());
    let mut raw = surface::polygonise(Field::new(layer), &grid);
    let halves = if mirror_x_m.is_some() { 2 } else { 1 };
    let mut levels: Vec<RawLevel> = Vec::new();
    for (idx, n_triangles) in LEVEL_TRIANGLES.into_iter().enumerate() {
        let importance =
            raw.positions_m.par_iter().map(|&p| body.importance(p, idx)).collect::<Vec<_>>();
        let mut simplifier = Simplifier::new(&raw, mirror_x_m, &importance);
        simplifier.drop_needles();
        simplifier.reduce_to(n_triangles / halves);
        raw = simplifier.mesh();
        let mut mesh = raw.clone();
        let before = levels.last().map_or(usize::MAX, |level| level.mesh.triangles.len());
        if mesh.triangles.len() * halves >= before {
            break;
        }
        let normals = settle(body, &mut mesh, mirror_x_m, idx);
        let mut level = RawLevel { mesh, normals };
        if let Some(x) = mirror_x_m {
            let n = level.mesh.positions_m.len();
            let inner: Vec<usize> = (0..n).filter(|&v| level.mesh.positions_m[v].x != x).collect();
            level.mesh = level.mesh.mirrored(x);
            level.normals.extend(
                inner
                    .into_iter()
                    .map(|v| level.normals[v] * Vec3::new(-1.0, 1.0, 1.0))
                    .collect::<Vec<_>>(),
            );
        }
        levels.push(level);
    }
    levels
}

/// Puts a level's vertices onto the surface (the coarsest keep where they make up for their flat
/// triangles) and the sole's onto the floor; gives the normals there.
fn settle(body: &Body, mesh: &mut RawMesh, mirror_x_m: Option<f32>, level: usize) -> Vec<Vec3> {
    let scale = body.scale();
    let everywhere = Field::new(body.layer());
    let step_m = 0.0015 * scale;
    let n_steps = [2, 1, 0, 0][level];
    let put = |p: Vec3| -> (Vec3, Vec3) {
        let border_x_m = mirror_x_m.filter(|&x| p.x == x);
        let (mut p, mut gradient) = (p, Vec3::Y);
        let field = everywhere.within(p, 0.012 * scale, 0.0);
        for _ in 0..n_steps {
            gradient = field.gradient(p, step_m);
            let move_m = -field.distance_m(p) * gradient / gradient.length_squared().max(0.05);
            p += move_m.clamp_length_max(0.004 * scale);
            if let Some(x) = border_x_m {
                p.x = x;
            }
        }
        let wide = field.gradient(p, step_m * (1 << level) as f32);
        gradient = if wide.length() > 1e-3 { wide } else { gradient };
        if border_x_m.is_some() {
            gradient.x = 0.0;
        }
        (p, gradient.try_normalize().unwrap_or(Vec3::Y))
    };
    let settled: Vec<(Vec3, Vec3)> = mesh.positions_m.par_iter().map(|&p| put(p)).collect();
    let normals = settled.iter().map(|s| s.1).collect();
    let before_m = std::mem::take(&mut mesh.positions_m);
    mesh.positions_m = settled.into_iter().map(|s| s.0).collect();
    lay_soles(body, mesh, [0.003, 0.005, 0.010, 0.020][level] * scale);
    needle::put_back(mesh, &before_m);
    normals
}

/// Puts the corners of triangles that look down from just above a sole's plane exactly there, and
/// lifts what is below it.
fn lay_soles(body: &Body, mesh: &mut RawMesh, slack_m: f32) {
    let mut is_sole = vec![false; mesh.positions_m.len()];
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| mesh.positions_m[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let lies = |p: &Vec3| body.sole(*p, slack_m).is_some_and(|s| s.normal.dot(normal) < -0.85);
        if [a, b, c].iter().all(lies) {
            for v in t {
                is_sole[*v as usize] = true;
            }
        }
    }
    for (p, is_sole) in mesh.positions_m.iter_mut().zip(is_sole) {
        if let Some(sole) = body.sole(*p, if is_sole { slack_m } else { 0.0 }) {
            *p -= sole.normal * sole.above_m(*p);
        }
    }
}

fn skinned(body: &Body, raw: RawLevel, joint_from_mesh: &[Mat4]) -> Option<SkinnedMesh> {
    let n_triangles = u32::try_from(raw.mesh.triangles.len()).ok()?;
    let vertices = raw
        .mesh
        .positions_m
        .par_iter()
        .zip(&raw.normals)
        .map(|(&position_m, &normal)| {
            let (joints, weights) = body.weights(position_m).four();
            Vertex { position_m, normal, uv: Vec2::ZERO, joints, weights }
        })
        .collect();
    let material = Material {
        base_color: LinearRgba::WHITE,
        texture: None,
        roughness: 0.62,
        alpha_cutoff: 0.0,
        double_sided: false,
    };
    let parts = vec![MeshPart { first_triangle: 0, n_triangles, material }];
    SkinnedMesh::new(vertices, raw.mesh.triangles, joint_from_mesh.to_vec(), parts).ok()
}

#[cfg(test)]
mod tests;
