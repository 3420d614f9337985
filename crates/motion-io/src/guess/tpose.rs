//! A T-pose before the motion, which many programs put into the first frame.

use glam::{Quat, Vec3};
use motion_core::motion::Motion;
use motion_core::rotation::angle_between_rad;
use motion_core::skeleton::{JointRole, Skeleton};

/// Poses this close (mean over joints) are the same one, held; degrees.
const HELD_DEG: f32 = 0.01;
/// A pose is the rest pose where no joint is further from it; degrees.
const AT_REST_DEG: f32 = 1.0;
/// The motion begins with a jump of at least this (mean over joints); degrees.
const MIN_JUMP_DEG: f32 = 3.0;
/// And with at least so many times the step that follows it.
const JUMP_RATIO: f32 = 4.0;

/// How many frames at the start show a T-pose that is no part of the motion; 0 for none.
///
/// It is one where the body holds its rest pose, or its arms straight out to the sides, and then
/// jumps to the motion within a frame. The root does not count: it may be anywhere.
pub fn n_leading_tpose_frames(skeleton: &Skeleton, motion: &Motion) -> usize {
    let n_frames = motion.n_frames();
    let Some(n_held) = (1..n_frames).find(|&frame| step_deg(motion, 0, frame) > HELD_DEG) else {
        return 0;
    };
    if n_held + 1 >= n_frames {
        return 0;
    }
    let jump = step_deg(motion, n_held - 1, n_held);
    let next = step_deg(motion, n_held, n_held + 1);
    let jumps = jump > MIN_JUMP_DEG && jump > JUMP_RATIO * next;
    if jumps && (is_at_rest(motion) || has_arms_out(skeleton, motion)) { n_held } else { 0 }
}

/// Mean angle between two frames over all joints but the root, degrees.
fn step_deg(motion: &Motion, a: usize, b: usize) -> f32 {
    let pairs = motion.rotations(a).iter().zip(motion.rotations(b)).skip(1);
    let sum: f32 = pairs.map(|(&a, &b)| angle_between_rad(a, b)).sum();
    (sum / (motion.n_joints().max(2) - 1) as f32).to_degrees()
}

fn is_at_rest(motion: &Motion) -> bool {
    let mut angles =
        motion.rotations(0).iter().skip(1).map(|&q| angle_between_rad(Quat::IDENTITY, q));
    angles.all(|angle_rad| angle_rad.to_degrees() < AT_REST_DEG)
}

/// Whether both arms point straight away from each other, across the body, in the first frame.
fn has_arms_out(skeleton: &Skeleton, motion: &Motion) -> bool {
    use JointRole::{Head, Hips, LeftArm, LeftHand, RightArm, RightHand};
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    motion.forward_kinematics(skeleton, 0, &mut positions, &mut rotations);
    let direction = |from: JointRole, to: JointRole| -> Option<Vec3> {
        let (from, to) = (skeleton.by_role(from)?, skeleton.by_role(to)?);
        (positions[to.idx()] - positions[from.idx()]).try_normalize()
    };
    let directions =
        (direction(LeftArm, LeftHand), direction(RightArm, RightHand), direction(Hips, Head));
    let (Some(left), Some(right), Some(up)) = directions else { return false };
    left.dot(right) < -0.9 && left.dot(up).abs() < 0.3
}

#[cfg(test)]
mod tests {
    use motion_core::units::Fps;

    use super::*;
    use crate::guess::test_body::body;

    /// `n_tpose` frames at rest, then `n_frames` of a slow swing of every joint about a pose.
    fn swing(skeleton: &Skeleton, n_tpose: usize, n_frames: usize, pose_rad: f32) -> Motion {
        let n = n_tpose + n_frames;
        let rotations = (0..n).flat_map(|frame| {
            let angle = if frame < n_tpose { 0.0 } else { pose_rad + 0.01 * (frame as f32).sin() };
            std::iter::repeat_n(Quat::from_rotation_x(angle), skeleton.n_joints())
        });
        let rotations = rotations.collect();
        Motion::new(Fps::THIRTY, skeleton.n_joints(), vec![Vec3::Y; n], rotations).unwrap()
    }

    #[track_caller]
    fn check(n_tpose: usize, n_frames: usize, pose_rad: f32, expected: usize) {
        let skeleton = body(1.0);
        let motion = swing(&skeleton, n_tpose, n_frames, pose_rad);
        assert_eq!(n_leading_tpose_frames(&skeleton, &motion), expected);
    }

    #[test]
    fn a_t_pose_before_a_motion_is_found() {
        check(1, 20, 0.5, 1);
        check(3, 20, 0.5, 3);
    }

    #[test]
    fn a_motion_without_one_is_left_alone() {
        check(0, 20, 0.5, 0);
        check(0, 20, 0.0, 0);
        check(1, 20, 0.02, 0);
        check(5, 0, 0.0, 0);
        check(1, 1, 0.5, 0);
        check(1, 0, 0.5, 0);
    }

    #[test]
    fn arms_out_count_whatever_the_rest_pose() {
        // Every joint turned by the same root-side rotation still has its arms out; legs are bent
        // so that it is not at rest.
        let skeleton = body(1.0);
        let mut motion = swing(&skeleton, 1, 20, 0.5);
        let thigh = skeleton.by_role(JointRole::LeftUpLeg).unwrap();
        motion.rotations_mut(0)[thigh.idx()] = Quat::from_rotation_x(0.1);
        assert_eq!(n_leading_tpose_frames(&skeleton, &motion), 1);
    }
}
