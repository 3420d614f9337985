//! Plans to make mannequins of.

use glam::{Quat, Vec3};

use crate::body_plan::{BodyPart, BodyPlan, PlanJoint, Side};
use crate::mannequin::figure::sign;

type Row = (Option<usize>, [f32; 3], Option<BodyPart>);

/// A plan from parents, places and parts.
fn plan(joints: &[Row], sole_m: f32) -> BodyPlan {
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

/// A body with a back of these places and limbs of these on the left, mirrored to the right.
fn person(
    back: &[([f32; 3], BodyPart)],
    arm: [[f32; 3]; 4],
    leg: [[f32; 3]; 4],
    sole: f32,
) -> BodyPlan {
    use BodyPart as P;
    let mut rows: Vec<Row> = Vec::new();
    for &(position, part) in back {
        rows.push((rows.len().checked_sub(1), position, Some(part)));
    }
    let chest = back.iter().rposition(|b| b.1 == P::Spine).unwrap_or(0);
    for side in Side::BOTH {
        let mut limb = |from: usize, places: [[f32; 3]; 4], parts: [BodyPart; 4]| {
            let mut parent = from;
            for (place, part) in places.into_iter().zip(parts) {
                rows.push((Some(parent), [place[0] * sign(side), place[1], place[2]], Some(part)));
                parent = rows.len() - 1;
            }
        };
        limb(chest, arm, [P::Collar(side), P::UpperArm(side), P::Forearm(side), P::Hand(side)]);
        limb(0, leg, [P::Thigh(side), P::Shin(side), P::Foot(side), P::Toes(side)]);
    }
    plan(&rows, sole)
}

/// The built-in skeleton: Mixamo's joints in a T-pose.
pub(super) fn mixamo() -> BodyPlan {
    use BodyPart as P;
    person(
        &[
            ([0.0, 0.99, 0.0], P::Hips),
            ([0.0, 1.08, -0.01], P::Spine),
            ([0.0, 1.195, -0.015], P::Spine),
            ([0.0, 1.32, -0.015], P::Spine),
            ([0.0, 1.465, -0.015], P::Neck),
            ([0.0, 1.555, 0.0], P::Head),
        ],
        [
            [0.055, 1.425, -0.015],
            [0.18, 1.425, -0.015],
            [0.465, 1.425, -0.015],
            [0.715, 1.425, -0.015],
        ],
        [[0.092, 0.925, 0.0], [0.092, 0.505, 0.0], [0.092, 0.08, 0.0], [0.092, 0.025, 0.125]],
        0.025,
    )
}

/// Bone lengths of `LaFAN1`'s files, put in a T-pose.
pub(super) fn lafan() -> BodyPlan {
    use BodyPart as P;
    person(
        &[
            ([0.0, 0.972, 0.0], P::Hips),
            ([0.0, 1.041, -0.026], P::Spine),
            ([0.0, 1.167, -0.026], P::Spine),
            ([0.0, 1.290, -0.026], P::Spine),
            ([0.0, 1.548, -0.026], P::Neck),
            ([0.0, 1.666, -0.026], P::Head),
        ],
        [[0.06, 1.488, -0.04], [0.173, 1.488, -0.04], [0.503, 1.488, -0.04], [0.755, 1.488, -0.04]],
        [[0.105, 0.953, 0.0], [0.105, 0.518, 0.0], [0.105, 0.094, 0.0], [0.105, 0.029, 0.16]],
        0.029,
    )
}

/// The zero pose of a CMU file (subject 2): legs astride, sides that differ, helpers of no length
/// without a part.
pub(super) fn cmu() -> BodyPlan {
    use BodyPart as P;
    use Side::{Left, Right};
    const UNIT_M: f32 = 0.056_444;
    let offsets: &[(Option<usize>, [f32; 3], Option<P>)] = &[
        (None, [0.0, 17.6, 0.0], Some(P::Hips)),
        (Some(0), [0.0, 0.0, 0.0], None),
        (Some(1), [1.65674, -1.80282, 0.62477], Some(P::Thigh(Left))),
        (Some(2), [2.5972, -7.13576, 0.0], Some(P::Shin(Left))),
        (Some(3), [2.49236, -6.8477, 0.0], Some(P::Foot(Left))),
        (Some(4), [0.19704, -0.54136, 2.14581], Some(P::Toes(Left))),
        (Some(0), [0.0, 0.0, 0.0], None),
        (Some(6), [-1.6107, -1.80282, 0.62476], Some(P::Thigh(Right))),
        (Some(7), [-2.59502, -7.12977, 0.0], Some(P::Shin(Right))),
        (Some(8), [-2.4678, -6.78024, 0.0], Some(P::Foot(Right))),
        (Some(9), [-0.23024, -0.63258, 2.13368], Some(P::Toes(Right))),
        (Some(0), [0.0, 0.0, 0.0], None),
        (Some(11), [0.01961, 2.0545, -0.14112], Some(P::Spine)),
        (Some(12), [0.01021, 2.06436, -0.05921], Some(P::Spine)),
        (Some(13), [0.00151, 2.06805, 0.00804], Some(P::Neck)),
        (Some(14), [0.00713, 1.56711, 0.14968], None),
        (Some(15), [0.03429, 1.56041, -0.10006], Some(P::Head)),
        (Some(13), [0.00151, 2.06805, 0.00804], Some(P::Collar(Left))),
        (Some(17), [3.54205, 0.90436, -0.17364], Some(P::UpperArm(Left))),
        (Some(18), [4.86513, 0.0, 0.0], Some(P::Forearm(Left))),
        (Some(19), [3.35554, 0.0, 0.0], Some(P::Hand(Left))),
        (Some(20), [1.67777, 0.0, 0.0], None),
        (Some(20), [1.67777, 0.0, 0.0], None),
        (Some(13), [0.00151, 2.06805, 0.00804], Some(P::Collar(Right))),
        (Some(23), [-3.49802, 0.75994, -0.32616], Some(P::UpperArm(Right))),
        (Some(24), [-5.02649, 0.0, 0.0], Some(P::Forearm(Right))),
        (Some(25), [-3.36431, 0.0, 0.0], Some(P::Hand(Right))),
        (Some(26), [-1.68216, 0.0, 0.0], None),
        (Some(26), [-1.68216, 0.0, 0.0], None),
    ];
    let mut rows: Vec<Row> = Vec::new();
    for &(parent, offset, part) in offsets {
        let from = parent.map_or(Vec3::ZERO, |parent: usize| Vec3::from(rows[parent].1));
        rows.push((parent, (from + Vec3::from(offset) * UNIT_M).into(), part));
    }
    let mut plan = plan(&rows, 0.028);
    let toes = [5, 10];
    for toe in toes {
        plan.joints[toe].end_m = Some(plan.joints[toe].position_m + Vec3::Z * 1.112 * UNIT_M);
    }
    let low = toes.map(|toe| plan.joints[toe].position_m.y).into_iter().fold(f32::MAX, f32::min);
    for joint in &mut plan.joints {
        joint.position_m.y += 0.028 - low;
        joint.end_m = joint.end_m.map(|end| end + Vec3::Y * (0.028 - low));
    }
    plan
}

/// A child of 1.08 m.
pub(super) fn child() -> BodyPlan {
    scaled(mixamo(), 0.62)
}

/// The same plan at another size.
pub(super) fn scaled(mut plan: BodyPlan, scale: f32) -> BodyPlan {
    for joint in &mut plan.joints {
        joint.position_m *= scale;
        joint.end_m = joint.end_m.map(|end| end * scale);
    }
    plan.sole_m = plan.sole_m.map(|sole| sole * scale);
    plan
}

/// Only hips, a one-link back, and two-joint limbs.
fn sparse() -> BodyPlan {
    let mut plan = mixamo();
    for joint in &mut plan.joints {
        let is_kept = matches!(
            joint.part,
            Some(
                BodyPart::Hips
                    | BodyPart::UpperArm(_)
                    | BodyPart::Forearm(_)
                    | BodyPart::Thigh(_)
                    | BodyPart::Shin(_)
                    | BodyPart::Foot(_)
            )
        );
        if !is_kept {
            joint.part = None;
        }
    }
    plan.joints[2].part = Some(BodyPart::Spine);
    plan.sole_m = [0.08; 2]; // of the ankles, since the toes are unknown
    plan
}

/// Every human plan, with a name.
pub(super) fn every_human() -> [(&'static str, BodyPlan); 5] {
    [
        ("Mixamo", mixamo()),
        ("LaFAN1", lafan()),
        ("CMU", cmu()),
        ("child", child()),
        ("sparse", sparse()),
    ]
}

/// A four-legged body whose joints have no parts.
pub(super) fn dog() -> BodyPlan {
    let mut rows: Vec<Row> = vec![
        (None, [0.0, 0.5, -0.3], None),
        (Some(0), [0.0, 0.52, 0.0], None),
        (Some(1), [0.0, 0.5, 0.3], None),
        (Some(2), [0.0, 0.68, 0.42], None),
        (Some(3), [0.0, 0.70, 0.60], None),
        (Some(0), [0.0, 0.55, -0.45], None),
        (Some(5), [0.0, 0.50, -0.65], None),
    ];
    for (root, z) in [(0, -0.3), (2, 0.3)] {
        for x in [0.09, -0.09] {
            rows.push((Some(root), [x, 0.45, z], None));
            rows.push((Some(rows.len() - 1), [x, 0.25, z - 0.03], None));
            rows.push((Some(rows.len() - 1), [x, 0.03, z], None));
        }
    }
    plan(&rows, 0.0)
}

/// Six links, one after the other.
pub(super) fn robot_arm() -> BodyPlan {
    let rows: Vec<Row> = [
        [0.0, 0.0, 0.0],
        [0.0, 0.3, 0.0],
        [0.0, 0.9, 0.1],
        [0.0, 1.2, 0.6],
        [0.0, 1.1, 0.9],
        [0.0, 0.9, 1.0],
    ]
    .into_iter()
    .enumerate()
    .map(|(idx, place)| (idx.checked_sub(1), place, None))
    .collect();
    plan(&rows, 0.0)
}

/// A helix of `n` joints with bones of `bone_m`.
pub(super) fn chain(n: usize, bone_m: f32) -> BodyPlan {
    let rows: Vec<Row> = (0..n)
        .map(|idx| {
            let turn = idx as f32 * 0.9;
            let place = Vec3::new(turn.cos(), 0.15 * idx as f32, turn.sin()) * bone_m;
            (idx.checked_sub(1), place.into(), None)
        })
        .collect();
    plan(&rows, 0.0)
}
