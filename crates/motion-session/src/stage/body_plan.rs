//! What a mannequin needs to know of a skeleton.

use glam::Quat;
use motion_core::bind_pose::BindPose;
use motion_core::contacts::{self, Side};
use motion_core::floor::Soles;
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::skeleton::{JointRole, Skeleton};
use motion_scene::body_plan::{self as plan, BodyPart, BodyPlan, PlanJoint};

use super::head_droop::head_droop_rad;

/// A bone end nearer to its joint than this is a file's way of saying nothing, metres.
const MIN_END_M: f32 = 0.005;

/// The pose in which a body stands with its toe joints as high as `soles` say, both on the whole.
pub fn standing_pose(skeleton: &Skeleton, motion: Option<&Motion>, soles: Soles) -> BindPose {
    let pose = BindPose::of(skeleton, motion);
    let lifts = Side::BOTH.into_iter().filter_map(|side| {
        let toe = contacts::toe_joint(skeleton, side)?;
        Some(soles.height_m[side.idx()] - pose.positions_m()[toe.idx()].y)
    });
    let lifts: Vec<f32> = lifts.collect();
    if lifts.is_empty() {
        return pose;
    }
    let lift_m = lifts.iter().sum::<f32>() / lifts.len() as f32;
    let sole_m = pose.sole_below_feet_m() + lift_m;
    pose.with_sole(sole_m)
}

/// The plan of a body that stands as `skeleton` does, its soles as high as clips or a mesh say.
///
/// `motion` helps to find the standing pose of a skeleton whose rest pose is not one, and how its
/// head joint leans.
pub fn body_plan(skeleton: &Skeleton, motion: Option<&Motion>, soles: Soles) -> BodyPlan {
    let pose = standing_pose(skeleton, motion, soles);
    let parts = parts(skeleton);
    let droop = motion.map_or(0.0, |motion| head_droop_rad(skeleton, motion, &pose));
    let joints = skeleton.joints().iter().enumerate().map(|(idx, joint)| {
        let (at_m, turn) = (pose.positions_m()[idx], pose.world_from_joint()[idx]);
        let end = joint.end_site_m.filter(|end| end.length() > MIN_END_M);
        // The face looks ahead while the head joint leans as much as it does on the whole.
        let lean = if parts[idx] == Some(BodyPart::Head) { droop } else { 0.0 };
        PlanJoint {
            parent: joint.parent.map(JointIdx::idx),
            position_m: at_m,
            world_from_joint: Quat::from_rotation_x(lean) * turn,
            end_m: end.map(|end| at_m + turn * end),
            part: parts[idx],
        }
    });
    BodyPlan { joints: joints.collect(), sole_m: soles.height_m }
}

/// What every joint moves. Joints of the back and the neck that play no role of their own (the
/// fourth link of a back, say) are told by what they lie between.
fn parts(skeleton: &Skeleton) -> Vec<Option<BodyPart>> {
    let joints = skeleton.joints();
    let mut parts: Vec<Option<BodyPart>> = (0..joints.len())
        .map(|idx| skeleton.roles().role_of(JointIdx::from_idx(idx)).map(part_of_role))
        .collect();
    let above = |start: Option<JointIdx>| {
        std::iter::successors(start, |joint| skeleton.joint(*joint).parent)
    };
    let trunk_end = skeleton.by_role(JointRole::Neck).or(skeleton.by_role(JointRole::Head));
    let is_back = |joint: JointIdx| {
        let hips = skeleton.by_role(JointRole::Hips);
        above(skeleton.joint(joint).parent).any(|above| Some(above) == hips)
    };
    for joint in above(trunk_end) {
        if parts[joint.idx()].is_none() && is_back(joint) {
            parts[joint.idx()] = Some(BodyPart::Spine);
        }
    }
    if let Some(neck) = skeleton.by_role(JointRole::Neck) {
        let head = skeleton.by_role(JointRole::Head);
        for joint in above(head).take_while(|joint| *joint != neck) {
            parts[joint.idx()].get_or_insert(BodyPart::Neck);
        }
    }
    parts
}

fn part_of_role(role: JointRole) -> BodyPart {
    use JointRole as R;
    use plan::Side::{Left, Right};
    match role {
        R::Hips => BodyPart::Hips,
        R::Spine | R::Spine1 | R::Spine2 => BodyPart::Spine,
        R::Neck => BodyPart::Neck,
        R::Head => BodyPart::Head,
        R::LeftShoulder => BodyPart::Collar(Left),
        R::LeftArm => BodyPart::UpperArm(Left),
        R::LeftForeArm => BodyPart::Forearm(Left),
        R::LeftHand => BodyPart::Hand(Left),
        R::RightShoulder => BodyPart::Collar(Right),
        R::RightArm => BodyPart::UpperArm(Right),
        R::RightForeArm => BodyPart::Forearm(Right),
        R::RightHand => BodyPart::Hand(Right),
        R::LeftUpLeg => BodyPart::Thigh(Left),
        R::LeftLeg => BodyPart::Shin(Left),
        R::LeftFoot => BodyPart::Foot(Left),
        R::LeftToeBase => BodyPart::Toes(Left),
        R::RightUpLeg => BodyPart::Thigh(Right),
        R::RightLeg => BodyPart::Shin(Right),
        R::RightFoot => BodyPart::Foot(Right),
        R::RightToeBase => BodyPart::Toes(Right),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use motion_core::skeleton::Joint;

    use super::*;
    use crate::fixture::library;

    #[test]
    fn feet_stand_on_the_floor_and_roles_become_parts() {
        let library = library();
        let skeleton = library.clips.skeleton();
        let plan = body_plan(skeleton, None, Soles { height_m: [0.03; 2] });
        let joint = |name: &str| plan.joints[skeleton.by_name(name).unwrap().idx()];
        assert!((joint("LeftToeBase").position_m.y - 0.03).abs() < 1e-6);
        assert_eq!(joint("LeftUpLeg").part, Some(BodyPart::Thigh(plan::Side::Left)));
        assert!(joint("LeftUpLeg").position_m.x > 0.0, "its left is at +X");
        let head = joint("Head");
        let end = head.end_m.unwrap();
        assert!((end - head.position_m).y > 0.04, "the end site is kept: {end}");
        assert!(plan.joints.iter().enumerate().all(|(i, j)| j.parent.is_none_or(|p| p < i)));
    }

    #[test]
    fn links_without_a_role_belong_to_what_they_lie_between() {
        let names = ["Hips", "Spine", "Spine1", "Spine2", "xtra", "Neck", "bit", "Head", "hat"];
        let joints = names.iter().enumerate().map(|(idx, name)| Joint {
            name: (*name).to_owned(),
            parent: idx.checked_sub(1).map(JointIdx::from_idx),
            offset_m: Vec3::Y * 0.1,
            end_site_m: None,
        });
        let skeleton = Skeleton::new(joints.collect()).unwrap();
        let found = parts(&skeleton);
        assert_eq!(found[4], Some(BodyPart::Spine));
        assert_eq!(found[6], Some(BodyPart::Neck));
        assert_eq!(found[8], None);
    }
}
