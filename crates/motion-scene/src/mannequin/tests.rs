//! What every mannequin promises, on bodies of four kinds and on random ones.

use std::collections::BTreeSet;

use glam::Quat;

use super::*;
use crate::body_plan::{BodyPart, PlanJoint, Side};

/// A plan from its joints: name for the reader, parent, place, part.
fn plan(joints: &[(Option<usize>, [f32; 3], Option<BodyPart>)], sole_m: f32) -> BodyPlan {
    let joints = joints
        .iter()
        .map(|&(parent, position, part)| PlanJoint {
            parent,
            position_m: position.into(),
            world_from_joint: Quat::IDENTITY,
            end_m: None,
            part,
        })
        .collect();
    BodyPlan { joints, sole_m: [sole_m; 2] }
}

/// The built-in skeleton: Mixamo's joints, T-pose, 1.75 m.
fn mixamo() -> BodyPlan {
    use BodyPart as P;
    let mut joints = vec![
        (None, [0.0, 0.99, 0.0], Some(P::Hips)),
        (Some(0), [0.0, 1.08, -0.01], Some(P::Spine)),
        (Some(1), [0.0, 1.195, -0.015], Some(P::Spine)),
        (Some(2), [0.0, 1.32, -0.015], Some(P::Spine)),
        (Some(3), [0.0, 1.465, -0.015], Some(P::Neck)),
        (Some(4), [0.0, 1.555, 0.0], Some(P::Head)),
    ];
    for side in Side::BOTH {
        let x = figure::sign(side);
        let first = joints.len();
        joints.extend([
            (Some(3), [0.055 * x, 1.425, -0.015], Some(P::Collar(side))),
            (Some(first), [0.18 * x, 1.425, -0.015], Some(P::UpperArm(side))),
            (Some(first + 1), [0.465 * x, 1.425, -0.015], Some(P::Forearm(side))),
            (Some(first + 2), [0.715 * x, 1.425, -0.015], Some(P::Hand(side))),
            (Some(0), [0.092 * x, 0.925, 0.0], Some(P::Thigh(side))),
            (Some(first + 4), [0.092 * x, 0.505, 0.0], Some(P::Shin(side))),
            (Some(first + 5), [0.092 * x, 0.08, 0.0], Some(P::Foot(side))),
            (Some(first + 6), [0.092 * x, 0.025, 0.125], Some(P::Toes(side))),
        ]);
    }
    plan(&joints, 0.025)
}

#[track_caller]
fn check_closed(mesh: &SkinnedMesh) {
    let mut edges: BTreeSet<(u32, u32)> = BTreeSet::new();
    for &[a, b, c] in mesh.triangles() {
        assert!(a != b && b != c && c != a, "a triangle without area");
        for (from, to) in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert((from, to)), "edge {from}-{to} is there twice");
        }
    }
    for &(from, to) in &edges {
        assert!(edges.contains(&(to, from)), "edge {from}-{to} is open");
    }
}

#[test]
fn a_mannequin_is_closed_at_every_level() {
    let model = mannequin(&mixamo());
    assert_eq!(model.levels().len(), LEVEL_TRIANGLES.len());
    for (level, most) in model.levels().iter().zip(LEVEL_TRIANGLES) {
        assert!(level.triangles().len() <= most, "{} triangles", level.triangles().len());
        check_closed(level);
    }
}

#[test]
fn the_sole_is_on_the_floor() {
    for level in mannequin(&mixamo()).levels() {
        let low = level.vertices().iter().map(|v| v.position_m.y).fold(f32::MAX, f32::min);
        assert!(low.abs() < 1e-4, "{low}");
    }
}
