//! No plan makes it panic.

use glam::{Quat, Vec3};
use proptest::prelude::*;

use super::bodies::{cmu, mixamo};
use super::check_closed;
use crate::body_plan::{BodyPlan, PlanJoint};
use crate::mannequin::{LEVEL_TRIANGLES, mannequin};

/// Human plans with bones of other lengths, parts left out and joints on top of each other.
fn humans() -> impl Strategy<Value = BodyPlan> {
    let bone = prop_oneof![4 => 0.3_f32..3.0, 1 => Just(0.0_f32)];
    let bones = prop::collection::vec(bone, 29);
    let keeps = prop::collection::vec(prop::bool::weighted(0.8), 29);
    (any::<bool>(), bones, keeps, 0.06_f32..6.0, -0.5_f32..0.5).prop_map(
        |(is_cmu, bones, keeps, scale, sole_m)| {
            let mut plan = if is_cmu { cmu() } else { mixamo() };
            let before: Vec<Vec3> = plan.joints.iter().map(|j| j.position_m).collect();
            for idx in 0..plan.joints.len() {
                let Some(parent) = plan.joints[idx].parent else { continue };
                let bone = (before[idx] - before[parent]) * bones[idx];
                plan.joints[idx].position_m = plan.joints[parent].position_m + bone;
                if !keeps[idx] {
                    plan.joints[idx].part = None;
                }
            }
            plan.sole_m = [sole_m; 2];
            super::bodies::scaled(plan, scale)
        },
    )
}

/// Trees of joints anywhere, some of them nowhere.
fn trees() -> impl Strategy<Value = BodyPlan> {
    let number = prop_oneof![30 => -1.0_f32..1.0, 1 => Just(f32::NAN), 1 => Just(0.0_f32)];
    let joint = (any::<prop::sample::Index>(), prop::array::uniform3(number));
    (prop::collection::vec(joint, 1..24), -2.0_f32..2.0).prop_map(|(joints, size)| {
        let size = 10.0_f32.powf(size);
        let joint = |(idx, (parent, place)): (usize, (prop::sample::Index, [f32; 3]))| PlanJoint {
            parent: (idx > 0).then(|| parent.index(idx)),
            position_m: Vec3::from(place) * size,
            world_from_joint: Quat::IDENTITY,
            end_m: (idx % 3 == 0).then(|| Vec3::from(place) * 1.2 * size),
            part: None,
        };
        let joints = joints.into_iter().enumerate().map(joint).collect();
        BodyPlan { joints, sole_m: [0.0; 2] }
    })
}

fn check(plan: &BodyPlan) {
    let model = mannequin(plan);
    for (level, most) in model.levels().iter().zip(LEVEL_TRIANGLES) {
        let n = level.triangles().len();
        assert!(n <= most, "{n} triangles, not {most}");
        check_closed(level);
    }
}

proptest! {
    // Each takes a good part of a second where nothing is optimised.
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn every_human_plan_has_a_closed_skin(plan in humans()) {
        check(&plan);
    }

    #[test]
    fn every_tree_has_a_closed_skin(plan in trees()) {
        check(&plan);
    }
}
