//! A foot touches the floor when its toe joint is as high as the plan says.

use glam::{Quat, Vec3};

use super::bodies::{child, cmu, every_human, lafan, mixamo};
use crate::body_plan::{BodyPart, BodyPlan, Side};
use crate::mannequin::mannequin;
use crate::mesh::SkinnedMesh;

fn place(plan: &BodyPlan, part: BodyPart) -> (usize, Vec3) {
    let joint = plan.joints.iter().position(|j| j.part == Some(part)).unwrap();
    (joint, plan.joints[joint].position_m)
}

/// Vertices that foot and toes move, seen from the toe joint with the foot flat: `flat` turns the
/// bind pose's foot to where it stands.
fn foot(mesh: &SkinnedMesh, plan: &BodyPlan, side: Side, flat: Quat) -> Vec<Vec3> {
    let (foot, _) = place(plan, BodyPart::Foot(side));
    let (toes, ball_m) = place(plan, BodyPart::Toes(side));
    mesh.vertices()
        .iter()
        .filter(|v| {
            let is_foot = |j: u16| usize::from(j) == foot || usize::from(j) == toes;
            let shares = v.joints.iter().zip(&v.weights).filter(|(j, _)| is_foot(**j));
            shares.map(|(_, w)| *w).sum::<f32>() > 0.9
        })
        .map(|v| flat * (v.position_m - ball_m))
        .collect()
}

#[track_caller]
fn check_sole(name: &str, plan: &BodyPlan, flat: [Quat; 2]) {
    for level in mannequin(plan).levels() {
        for side in Side::BOTH {
            let points = foot(level, plan, side, flat[side.idx()]);
            let sole_m = plan.sole_m[side.idx()];
            let low = points.iter().map(|p| p.y + sole_m).fold(f32::MAX, f32::min);
            assert!(low.abs() < 1e-3, "{name}, {side:?}: the lowest point is at {low} m");
            // Heel and ball both stand, the toes' tip nearly.
            let ankle_m = flat[side.idx()]
                * (place(plan, BodyPart::Foot(side)).1 - place(plan, BodyPart::Toes(side)).1);
            let stands = |p: &&Vec3| (p.y + sole_m).abs() < 1e-3;
            let back = points.iter().filter(stands).map(|p| p.z).fold(f32::MAX, f32::min);
            let front = points.iter().filter(stands).map(|p| p.z).fold(f32::MIN, f32::max);
            assert!(back < ankle_m.z, "{name}: the heel is off the floor");
            assert!(front > 0.0, "{name}: the ball is off the floor");
        }
    }
}

#[test]
fn the_sole_is_flat_and_at_its_height() {
    for (name, plan) in [("Mixamo", mixamo()), ("LaFAN1", lafan()), ("child", child())] {
        check_sole(name, &plan, [Quat::IDENTITY; 2]);
    }
}

/// CMU's zero pose straddles with straight ankles; its feet are flat when the legs are plumb.
#[test]
fn a_straddled_zero_pose_stands_on_its_soles_with_plumb_legs() {
    let plan = cmu();
    let flat = Side::BOTH.map(|side| {
        let shin = place(&plan, BodyPart::Foot(side)).1 - place(&plan, BodyPart::Shin(side)).1;
        let ahead = place(&plan, BodyPart::Toes(side)).1 - place(&plan, BodyPart::Foot(side)).1;
        let forward = Vec3::new(ahead.x, 0.0, ahead.z).normalize_or_zero();
        Quat::from_rotation_arc(shin.reject_from(forward).normalize_or_zero(), -Vec3::Y)
    });
    check_sole("CMU", &plan, flat);
}

#[test]
fn nothing_is_below_the_floor() {
    for (name, plan) in every_human() {
        if name == "CMU" {
            continue; // its feet lean in the bind pose
        }
        for level in mannequin(&plan).levels() {
            let low = level.vertices().iter().map(|v| v.position_m.y).fold(f32::MAX, f32::min);
            assert!(low.abs() < 1e-3, "{name}: {low}");
        }
    }
}
