//! What a motion keeps when another body does it.

use super::*;
use crate::contacts::{Side, toe_joint};
use crate::rotation::angle_between_rad;
use crate::skeleton::Joint;
use crate::testing::bodies::{a_pose, along_one_axis, lively, standing_motion, t_pose};
use crate::testing::{Walk, joint, legs};

fn between(source: &Skeleton, target: &Skeleton) -> Retarget {
    let (a, b) = (BindPose::of(source, None), BindPose::of(target, None));
    Retarget::new(source, &a, target, &b).expect("both are people")
}

/// Largest distance between joints of two motions of one skeleton, metres.
fn worst_m(skeleton: &Skeleton, a: &Motion, b: &Motion) -> f32 {
    let (a, b) = (a.joint_positions_m(skeleton), b.joint_positions_m(skeleton));
    a.iter().zip(&b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

fn direction(skeleton: &Skeleton, motion: &Motion, frame: usize, role: JointRole) -> Vec3 {
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    motion.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
    bone_direction(skeleton, &positions, role).expect("the body has that bone")
}

#[test]
fn the_same_body_does_the_same() {
    for body in [t_pose(1.0), a_pose(1.2), along_one_axis()] {
        let motion = lively(&body);
        let image = between(&body, &body).apply(&motion);
        for frame in 0..motion.n_frames() {
            let pairs = motion.rotations(frame).iter().zip(image.rotations(frame));
            let worst = pairs.map(|(&a, &b)| angle_between_rad(a, b)).fold(0.0, f32::max);
            assert!(worst < 1e-5, "{worst} rad");
        }
        assert!(worst_m(&body, &motion, &image) < 1e-5);
    }
}

#[test]
fn arms_point_where_they_pointed_whatever_the_rest_pose() {
    use JointRole::{LeftArm, LeftForeArm, LeftLeg, RightArm, RightForeArm, RightUpLeg};
    let (source, target) = (t_pose(1.0), a_pose(0.8));
    let motion = lively(&source);
    let image = between(&source, &target).apply(&motion);
    for frame in [0, 11, 39] {
        for role in [LeftArm, LeftForeArm, RightArm, RightForeArm, LeftLeg, RightUpLeg] {
            let was = direction(&source, &motion, frame, role);
            let is = direction(&target, &image, frame, role);
            assert!(was.distance(is) < 1e-4, "{role:?} {was} {is}");
        }
    }
}

#[test]
fn a_larger_body_does_it_larger() {
    let (source, target) = (t_pose(1.0), t_pose(1.5));
    let motion = lively(&source);
    let retarget = between(&source, &target);
    assert!((retarget.leg_ratio() - 1.5).abs() < 1e-6);
    let image = retarget.clone().apply(&motion);
    let start = motion.root_positions_m()[0].with_y(0.0);
    let a = motion.joint_positions_m(&source);
    let b = image.joint_positions_m(&target);
    for (a, b) in a.iter().zip(&b) {
        assert!((start + 1.5 * (*a - start)).distance(*b) < 1e-4, "{a} {b}");
    }
    let kept = retarget.with_path(PathScale::Keep).apply(&motion);
    for (a, b) in motion.root_positions_m().iter().zip(kept.root_positions_m()) {
        assert_eq!((a.x, a.z), (b.x, b.z));
    }
}

#[test]
fn planted_feet_stay_planted_on_the_floor() {
    let source = legs();
    let motion = Walk { n_frames: 60, speed_m_s: 0.5, turn_rad_s: 0.3, phase: 0.0 }.motion();
    // Longer, in other proportions, the ankles higher, with feet apart at rest.
    let joints = source.joints().iter().map(|joint| {
        let offset_m = match joint.name.as_str() {
            "LeftLeg" | "RightLeg" => Quat::from_rotation_z(0.1) * Vec3::new(0.0, -0.6, 0.0),
            "LeftFoot" | "RightFoot" => Vec3::new(0.0, -0.55, 0.0),
            "LeftToeBase" | "RightToeBase" => Vec3::new(0.0, -0.1, 0.2),
            _ => joint.offset_m,
        };
        Joint { offset_m, ..joint.clone() }
    });
    let target = Skeleton::new(joints.collect()).unwrap();
    let retarget = between(&source, &target);
    let image = retarget.apply(&motion);
    for side in Side::BOTH {
        let path = |skeleton: &Skeleton, motion: &Motion| {
            motion.joint_path_m(skeleton, toe_joint(skeleton, side).unwrap())
        };
        let (was, is) = (path(&source, &motion), path(&target, &image));
        for frame in 1..motion.n_frames() {
            let step = was[frame].distance(was[frame - 1]);
            if step < 1e-4 {
                let slide = is[frame].distance(is[frame - 1]);
                // Thigh and shin do not scale alike, so what was still moves a little.
                assert!(slide < 0.006, "{slide} m in frame {frame}");
                // The source's toe joints stand 3 cm above the ground.
                let height = is[frame].y;
                assert!((height - retarget.leg_ratio() * 0.03).abs() < 0.02, "{height} m");
            }
        }
    }
}

#[test]
fn a_sole_stands_on_the_floor() {
    let (source, target) = (t_pose(1.0), t_pose(1.3));
    let (a, b) = (BindPose::of(&source, None), BindPose::of(&target, None).with_sole(0.04));
    let standing = [a.positions_m()[0]; 2].to_vec();
    let still = Motion::new(crate::units::Fps::THIRTY, 22, standing, vec![Quat::IDENTITY; 44]);
    let image = Retarget::new(&source, &a, &target, &b).unwrap().apply(&still.unwrap());
    assert!((image.root_positions_m()[1].y - b.positions_m()[0].y).abs() < 1e-6);
}

#[test]
fn bones_along_one_axis_make_the_same_motion() {
    let (source, target) = (along_one_axis(), t_pose(1.0));
    let motion = standing_motion(&source, 0.7);
    let bind = BindPose::of(&source, Some(&motion));
    let retarget = Retarget::new(&source, &bind, &target, &BindPose::of(&target, None)).unwrap();
    let image = retarget.apply(&motion);
    for frame in 0..motion.n_frames() {
        for role in [JointRole::LeftUpLeg, JointRole::RightLeg, JointRole::LeftArm] {
            let was = direction(&source, &motion, frame, role);
            let is = direction(&target, &image, frame, role);
            assert!(was.distance(is) < 1e-3, "{role:?} of frame {frame}: {was} {is}");
        }
        // The heading of the source's root is the target's.
        let (heading, _) = rotation::twist_about_y(image.root_rotation(frame));
        assert!((heading - 0.7).abs() < 1e-3, "{heading}");
    }
}

#[test]
fn a_shorter_back_bends_as_far() {
    use JointRole::{Hips, Neck};
    let source = t_pose(1.0);
    let joints = source.joints().iter().enumerate().filter(|(idx, _)| *idx != 10);
    let joints = joints.map(|(_, joint)| {
        let parent = joint.parent.map(|p| JointIdx(if p.0 >= 10 { p.0 - 1 } else { p.0 }));
        let name = if joint.name == "Spine2" { "Spine1".into() } else { joint.name.clone() };
        Joint { name, parent, ..joint.clone() }
    });
    let target = Skeleton::new(joints.collect()).unwrap();
    let motion = lively(&source);
    let image = between(&source, &target).apply(&motion);
    let chest = |skeleton: &Skeleton, motion: &Motion, name: &str| {
        let (mut positions, mut rotations) = (Vec::new(), Vec::new());
        motion.forward_kinematics(skeleton, 20, &mut positions, &mut rotations);
        rotations[skeleton.by_name(name).unwrap().idx()]
    };
    let (was, is) = (chest(&source, &motion, "Spine2"), chest(&target, &image, "Spine1"));
    assert!(angle_between_rad(was, is) < 1e-4);
    assert!(target.by_role(Hips).is_some() && target.by_role(Neck).is_some());
}

#[test]
fn a_root_above_the_hips_is_carried_along() {
    let source = t_pose(1.0);
    let mut joints = vec![joint("Reference", None, [0.0; 3])];
    joints.extend(source.joints().iter().map(|joint| Joint {
        parent: Some(joint.parent.map_or(JointIdx(0), |p| JointIdx(p.0 + 1))),
        offset_m: if joint.parent.is_none() { Vec3::Y } else { joint.offset_m },
        ..joint.clone()
    }));
    let target = Skeleton::new(joints).unwrap();
    let motion = lively(&source);
    let retarget = between(&source, &target);
    assert_eq!(retarget.still_joints().collect::<Vec<_>>(), [JointIdx(0)]);
    let image = retarget.apply(&motion);
    let was = motion.joint_positions_m(&source);
    let is = image.joint_positions_m(&target);
    for frame in 0..motion.n_frames() {
        for idx in 0..22 {
            let (a, b) = (was[frame * 22 + idx], is[frame * 23 + idx + 1]);
            assert!(a.distance(b) < 1e-4, "joint {idx} of frame {frame}: {a} {b}");
        }
    }
}

#[test]
fn parts_that_are_missing_are_named() {
    let person = t_pose(1.0);
    let worm = [joint("a", None, [0.0; 3]), joint("LeftLeg", Some(0), [0.0, -1.0, 0.0])];
    let worm = Skeleton::new(worm.to_vec()).unwrap();
    let (a, b) = (BindPose::of(&person, None), BindPose::of(&worm, None));
    let error = Retarget::new(&person, &a, &worm, &b).unwrap_err();
    assert_eq!(error.to_string(), "the target has no Hips, RightUpLeg");
    assert_eq!(error.missing_in_source, []);
    // What has no parts can still do its own motions.
    assert!(Retarget::new(&worm, &b, &worm, &b).is_ok());
}
