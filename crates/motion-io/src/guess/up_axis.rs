//! Which axis of the world is up, from where heads are above feet.

use glam::{Quat, Vec3};
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::skeleton::{JointRole, Skeleton};

use super::Guess;

/// An axis of the file's world that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpAxis {
    /// As here.
    Y,
    /// As in many modelling programs.
    Z,
}

impl UpAxis {
    /// The axis's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Y => "Y",
            Self::Z => "Z",
        }
    }

    /// The turn that brings the axis to +Y: none, or a quarter turn about X.
    pub fn y_up_from_file(self) -> Quat {
        match self {
            Self::Y => Quat::IDENTITY,
            Self::Z => Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2),
        }
    }
}

/// At most so many frames are looked at.
const MAX_FRAMES: usize = 100;

/// To be sure, the mean direction from feet to head must have this length along the axis, and be
/// this much longer there than along either other axis. Cartwheels pass, a body on the floor
/// does not.
const MIN_UPRIGHT: f32 = 0.25;
const MIN_RATIO: f32 = 1.5;

/// The axis along which the body is upright on the whole: head above feet, or what stands for
/// them. Unsure (and Y) where it lies about too much, or its parts are not recognised.
pub fn guess_up_axis(skeleton: &Skeleton, motion: &Motion) -> Guess<UpAxis> {
    use JointRole::{Head, Hips, LeftFoot, LeftLeg, Neck, RightFoot, RightLeg, Spine1};
    let first = |roles: &[JointRole]| roles.iter().find_map(|&role| skeleton.by_role(role));
    let unsure = Guess { value: UpAxis::Y, sure: false };
    let Some(top) = first(&[Head, Neck, Spine1]) else { return unsure };
    let left = first(&[LeftFoot, LeftLeg, Hips]).unwrap_or(JointIdx(0));
    let right = first(&[RightFoot, RightLeg, Hips]).unwrap_or(JointIdx(0));

    let step = motion.n_frames().div_ceil(MAX_FRAMES).max(1);
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    let mut sum = Vec3::ZERO;
    let mut n_frames = 0;
    for frame in (0..motion.n_frames()).step_by(step) {
        motion.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
        let bottom = 0.5 * (positions[left.idx()] + positions[right.idx()]);
        sum += (positions[top.idx()] - bottom).normalize_or_zero();
        n_frames += 1;
    }
    let mean = sum / n_frames.max(1) as f32;
    let size = mean.abs();
    let (value, upright, other) = if mean.z > mean.y {
        (UpAxis::Z, mean.z, size.x.max(size.y))
    } else {
        (UpAxis::Y, mean.y, size.x.max(size.z))
    };
    let sure = upright >= MIN_UPRIGHT && upright >= MIN_RATIO * other;
    if sure { Guess { value, sure } } else { unsure }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guess::test_body::{body, still};

    #[test]
    fn y_and_z_are_recognised() {
        let skeleton = body(1.0);
        assert_eq!(guess_up_axis(&skeleton, &still(&skeleton, Quat::IDENTITY)).value, UpAxis::Y);
        let to_z = UpAxis::Z.y_up_from_file().inverse();
        let guess = guess_up_axis(&skeleton, &still(&skeleton, to_z));
        assert_eq!(guess, Guess { value: UpAxis::Z, sure: true });
    }

    #[test]
    fn a_body_that_lies_is_not_sure() {
        let skeleton = body(1.0);
        let lying = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
        assert!(!guess_up_axis(&skeleton, &still(&skeleton, lying)).sure);
    }

    #[test]
    fn the_turn_brings_z_up() {
        assert!((UpAxis::Z.y_up_from_file() * Vec3::Z).distance(Vec3::Y) < 1e-6);
    }
}
