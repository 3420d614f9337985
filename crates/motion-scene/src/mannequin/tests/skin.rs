//! What bending does to the skin.

use glam::{Mat4, Quat, Vec3};

use super::bodies::{lafan, mixamo};
use crate::body_plan::{BodyPart, BodyPlan, Side};
use crate::mannequin::mannequin;
use crate::mesh::SkinnedMesh;

/// `world_from_joint` of a plan whose bind pose has no rotations, with one joint and all below it
/// turned.
fn posed(plan: &BodyPlan, part: BodyPart, turn: Quat) -> (Vec<Mat4>, Vec3) {
    let joint = plan.joints.iter().position(|j| j.part == Some(part)).unwrap();
    let pivot = plan.joints[joint].position_m;
    let mut is_below = vec![false; plan.joints.len()];
    let world = plan
        .joints
        .iter()
        .enumerate()
        .map(|(idx, j)| {
            is_below[idx] = idx == joint || j.parent.is_some_and(|parent| is_below[parent]);
            if is_below[idx] {
                Mat4::from_rotation_translation(turn, pivot + turn * (j.position_m - pivot))
            } else {
                Mat4::from_translation(j.position_m)
            }
        })
        .collect();
    (world, pivot)
}

/// How far the skin is from `from` along `direction`: the last surface that a ray leaves.
fn flesh_m(mesh: &SkinnedMesh, world: &[Mat4], from: Vec3, direction: Vec3, reach_m: f32) -> f32 {
    let skin = mesh.skin_matrices(world);
    let at = |v: u32| SkinnedMesh::skinned_position_m(&mesh.vertices()[v as usize], &skin);
    let mut last = 0.0_f32;
    for t in mesh.triangles() {
        let [a, b, c] = t.map(at);
        let (e, f) = (b - a, c - a);
        let h = direction.cross(f);
        let det = e.dot(h);
        if det.abs() < 1e-12 {
            continue;
        }
        let s = from - a;
        let u = s.dot(h) / det;
        let q = s.cross(e);
        let (v, w) = (direction.dot(q) / det, f.dot(q) / det);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && w > 0.0 && w < reach_m {
            last = last.max(w);
        }
    }
    last
}

/// Linear blending leaves cos(θ/2) of what is shared half and half: 0.5 at 120°, 0.34 at 140°.
///
/// Checks that the flesh over the outer side of a hinge, halfway through the bend, is at least
/// `share` of what it is when straight.
#[track_caller]
fn check_hinge(plan: &BodyPlan, part: BodyPart, axis: Vec3, degrees: f32, outer: Vec3, share: f32) {
    let model = mannequin(plan);
    let mesh = &model.levels()[0];
    let (straight, pivot) = posed(plan, part, Quat::IDENTITY);
    let before_m = flesh_m(mesh, &straight, pivot, outer, 0.12);
    let (bent, _) = posed(plan, part, Quat::from_axis_angle(axis, degrees.to_radians()));
    let half = Quat::from_axis_angle(axis, 0.5 * degrees.to_radians());
    let after_m = flesh_m(mesh, &bent, pivot, half * outer, 0.12);
    assert!(after_m > share * before_m, "{part:?}: {after_m} m of {before_m} m are left");
}

#[test]
fn a_bent_knee_keeps_its_corner() {
    for plan in [mixamo(), lafan()] {
        for side in Side::BOTH {
            check_hinge(&plan, BodyPart::Shin(side), Vec3::X, 120.0, Vec3::Z, 0.52);
        }
    }
}

#[test]
fn a_bent_elbow_keeps_its_corner() {
    for (side, way) in [(Side::Left, -1.0), (Side::Right, 1.0)] {
        check_hinge(&mixamo(), BodyPart::Forearm(side), Vec3::Y * way, 140.0, -Vec3::Z, 0.3);
    }
}

#[test]
fn the_bind_pose_is_the_mesh_itself() {
    let plan = mixamo();
    let model = mannequin(&plan);
    let world: Vec<Mat4> = plan
        .joints
        .iter()
        .map(|j| Mat4::from_rotation_translation(j.world_from_joint, j.position_m))
        .collect();
    let mesh = &model.levels()[0];
    let skin = mesh.skin_matrices(&world);
    for v in mesh.vertices() {
        let moved = SkinnedMesh::skinned_position_m(v, &skin).distance(v.position_m);
        assert!(moved < 1e-5, "moved by {moved} m");
    }
}

/// Two ends of an edge never follow quite different joints: no tears.
#[test]
fn shares_change_smoothly() {
    let plan = mixamo();
    let model = mannequin(&plan);
    let mesh = &model.levels()[0];
    let share = |v: u32, joint: usize| -> f32 {
        let v = &mesh.vertices()[v as usize];
        let of = v.joints.iter().zip(&v.weights).filter(|(j, _)| usize::from(**j) == joint);
        of.map(|(_, w)| *w).sum()
    };
    for &[a, b, c] in mesh.triangles() {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            let at = |v: u32| mesh.vertices()[v as usize].position_m;
            let way_m = at(a).distance(at(b));
            for joint in 0..plan.joints.len() {
                let change = (share(a, joint) - share(b, joint)).abs();
                // From none to all takes no less than 2 cm.
                assert!(change < 0.12 + 50.0 * way_m, "joint {joint}: {change} over {way_m} m");
            }
        }
    }
}
