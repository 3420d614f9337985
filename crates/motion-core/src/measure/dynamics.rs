//! How fast joints move and turn, and how abruptly.
//!
//! All by finite differences of world positions between neighbouring frames, which for n frames
//! give n − 1 speeds, n − 2 accelerations and n − 3 jerks per joint. Motions too short for one
//! have 0.

use glam::Vec3;

use crate::contacts::percentile;
use crate::ground::yaw_series_rad;
use crate::motion::Motion;
use crate::rotation;

/// The definition of `joint_speed_max_m_s`.
pub const SPEED_DEFINITION: &str = "largest speed of any joint between neighbouring frames";

/// The definition of `joint_acceleration_p99_m_s2`.
pub const ACCELERATION_DEFINITION: &str =
    "99th percentile over frames and joints of |x(f−1) − 2 x(f) + x(f+1)| · fps²";

/// The definition of `joint_jerk_p99_m_s3`.
pub const JERK_DEFINITION: &str =
    "99th percentile over frames and joints of |x(f+2) − 3 x(f+1) + 3 x(f) − x(f−1)| · fps³";

/// The definition of `rotation_step_max_deg`.
pub const ROTATION_STEP_DEFINITION: &str =
    "largest change of a joint's local rotation between neighbouring frames";

/// The definition of `travel_m`.
pub const TRAVEL_DEFINITION: &str = "length of the root joint's way over the ground";

/// The definition of `turn_deg`.
pub const TURN_DEFINITION: &str =
    "heading of the last frame less that of the first, left positive, whole turns counted";

/// Largest speed of any joint, m/s.
pub fn speed_max_m_s(positions_m: &[Vec3], motion: &Motion) -> f32 {
    let mut speeds = differences(positions_m, motion, [-1.0, 1.0, 0.0, 0.0], 1);
    percentile(&mut speeds, 1.0)
}

/// 99th percentile of joint accelerations, m/s².
pub fn acceleration_p99_m_s2(positions_m: &[Vec3], motion: &Motion) -> f32 {
    let mut accelerations = differences(positions_m, motion, [1.0, -2.0, 1.0, 0.0], 2);
    percentile(&mut accelerations, 0.99)
}

/// 99th percentile of joint jerks, m/s³.
pub fn jerk_p99_m_s3(positions_m: &[Vec3], motion: &Motion) -> f32 {
    let mut jerks = differences(positions_m, motion, [-1.0, 3.0, -3.0, 1.0], 3);
    percentile(&mut jerks, 0.99)
}

/// Lengths of the differences of `order` with the given weights, times fps to that order, for
/// every joint and every frame that has them.
fn differences(positions_m: &[Vec3], motion: &Motion, weights: [f32; 4], order: usize) -> Vec<f32> {
    let n_joints = motion.n_joints();
    let rate = motion.fps().get().powi(order as i32) as f32;
    let n = positions_m.len().saturating_sub(order * n_joints);
    (0..n)
        .map(|idx| {
            let sum: Vec3 = (0..=order).map(|k| positions_m[idx + k * n_joints] * weights[k]).sum();
            sum.length() * rate
        })
        .collect()
}

/// Largest change of a joint's rotation between neighbouring frames, radians.
pub fn rotation_step_max_rad(motion: &Motion) -> f32 {
    let mut largest = 0f32;
    for frame in 1..motion.n_frames() {
        for (&a, &b) in motion.rotations(frame - 1).iter().zip(motion.rotations(frame)) {
            largest = largest.max(rotation::angle_between_rad(a, b));
        }
    }
    largest
}

/// Length of the root's way over the ground, metres.
pub fn travel_m(motion: &Motion) -> f32 {
    motion
        .root_positions_m()
        .windows(2)
        .map(|pair| f64::from((pair[1].x - pair[0].x).hypot(pair[1].z - pair[0].z)))
        .sum::<f64>() as f32
}

/// Change of the heading over the motion, radians.
pub fn turn_rad(motion: &Motion) -> f32 {
    let yaw = yaw_series_rad(motion);
    yaw[yaw.len() - 1] - yaw[0]
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;
    use crate::units::Fps;

    /// One joint on z(t) = ½·2·t² + t³/6·6 at 30 frames per second, turning 0.1 rad a frame.
    fn accelerating() -> Motion {
        let at = |f: usize| f as f32 / 30.0;
        let roots = (0..31).map(|f| Vec3::Z * (at(f).powi(2) + at(f).powi(3))).collect();
        let turns = (0..31).map(|f| Quat::from_rotation_y(-0.1 * f as f32)).collect();
        Motion::new(Fps::THIRTY, 1, roots, turns).expect("valid by construction")
    }

    #[test]
    fn a_known_path_has_its_derivatives() {
        let motion = accelerating();
        let at = motion.root_positions_m();
        // Speed 2t + 3t² between the last two frames; acceleration 2 + 6t; jerk 6.
        assert!((speed_max_m_s(at, &motion) - 4.87).abs() < 0.01);
        assert!((acceleration_p99_m_s2(at, &motion) - 7.8).abs() < 0.1);
        assert!((jerk_p99_m_s3(at, &motion) - 6.0).abs() < 0.3);
        assert!((travel_m(&motion) - 2.0).abs() < 1e-4);
        assert!((rotation_step_max_rad(&motion) - 0.1).abs() < 1e-4);
        assert!((turn_rad(&motion) + 3.0).abs() < 1e-3, "whole turns count");
    }

    #[test]
    fn one_frame_has_no_dynamics() {
        let still = accelerating().slice(0, 1);
        let at = still.root_positions_m();
        assert_eq!(speed_max_m_s(at, &still), 0.0);
        assert_eq!(acceleration_p99_m_s2(at, &still), 0.0);
        assert_eq!(jerk_p99_m_s3(at, &still), 0.0);
        assert_eq!(rotation_step_max_rad(&still), 0.0);
    }
}
