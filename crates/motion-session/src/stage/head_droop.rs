//! How far a skeleton's head joint leans forward when its owner looks ahead.
//!
//! Markers on a head say how it turns, not where its face is: in many captured sets (CMU's among
//! them) the head joint of people who walk and look ahead leans forward by 10° to 20°, and a face
//! put on it straight would look at the floor all day.

use glam::{Quat, Vec3};
use motion_core::bind_pose::BindPose;
use motion_core::motion::Motion;
use motion_core::skeleton::{JointRole, Skeleton};

/// So much a head may lean without anything being meant by it, degrees.
const NATURAL_DEG: f32 = 5.0;
/// More is the person's doing, not the markers', degrees.
const MOST_DEG: f32 = 14.0;
/// Only while the hips stand as upright as this (the cosine of some 25°) is the head looked at.
const UPRIGHT: f32 = 0.9;
/// So many moments are looked at.
const N_LOOKS: usize = 200;
/// With fewer upright moments nothing is said, seconds.
const LEAST_SECS: f64 = 0.5;

/// How far the head joint leans forward on the whole, beyond what is natural; 0 to 14°, in radians.
pub fn head_droop_rad(skeleton: &Skeleton, motion: &Motion, bind: &BindPose) -> f32 {
    let roles = [JointRole::Head, JointRole::Hips].map(|role| skeleton.by_role(role));
    let [Some(head), Some(hips)] = roles else { return 0.0 };
    let step = motion.n_frames().div_ceil(N_LOOKS).max(1);
    let (mut positions, mut rotations): (Vec<Vec3>, Vec<Quat>) = (Vec::new(), Vec::new());
    let mut leans_deg = Vec::new();
    for frame in (0..motion.n_frames()).step_by(step) {
        motion.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
        let since_bind = |joint: usize| rotations[joint] * bind.world_from_joint()[joint].inverse();
        if (since_bind(hips.idx()) * Vec3::Y).y > UPRIGHT {
            let ahead = since_bind(head.idx()) * Vec3::Z;
            leans_deg.push((-ahead.y).clamp(-1.0, 1.0).asin().to_degrees());
        }
    }
    if ((leans_deg.len() * step) as f64) < LEAST_SECS * motion.fps().get() {
        return 0.0;
    }
    leans_deg.sort_by(f32::total_cmp);
    let median_deg = leans_deg[leans_deg.len() / 2];
    (median_deg - NATURAL_DEG).clamp(0.0, MOST_DEG).to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::library;

    #[test]
    fn what_is_steady_is_the_markers_doing() {
        let library = library();
        let skeleton = library.clips.skeleton();
        let bind = BindPose::of(skeleton, None);
        let head = skeleton.by_role(JointRole::Head).unwrap();
        let walk = &library.clips.clips()[0].motion;
        let own_deg = head_droop_rad(skeleton, walk, &bind).to_degrees();
        assert!(own_deg < 3.0, "the built-in people look ahead: {own_deg}");
        for (lean_deg, expected_deg) in [(15.0_f32, 10.0), (60.0, 14.0), (-30.0, 0.0)] {
            let mut leaning = walk.clone();
            for frame in 0..leaning.n_frames() {
                leaning.rotations_mut(frame)[head.idx()] =
                    Quat::from_rotation_x(lean_deg.to_radians());
            }
            let droop_deg = head_droop_rad(skeleton, &leaning, &bind).to_degrees();
            assert!((droop_deg - expected_deg).abs() < 6.0, "{lean_deg}: {droop_deg}");
        }
    }
}
