//! Poses between frames.

use glam::{Mat4, Quat, Vec3};
use motion_core::motion::Motion;
use motion_core::rotation::slerp;
use motion_core::skeleton::Skeleton;

/// Two neighbouring frames and how far from the first to the second (0 to 1) a moment is. What is
/// before the first frame or no number is the first, what is past the last the last.
pub(crate) fn between(n_frames: usize, frame: f64) -> (usize, usize, f32) {
    let last = n_frames.saturating_sub(1);
    let at = if frame.is_nan() { 0.0 } else { frame.clamp(0.0, last as f64) };
    let a = at.floor() as usize;
    (a, (a + 1).min(last), (at - a as f64) as f32)
}

/// Where every joint is at `frame`, which may lie between two: positions interpolated linearly,
/// rotations by slerp, ends held.
///
/// The motion must be the skeleton's.
pub fn pose_at(skeleton: &Skeleton, motion: &Motion, frame: f64) -> Vec<Mat4> {
    let (a, b, t) = between(motion.n_frames(), frame);
    let roots = motion.root_positions_m();
    let pairs = motion.rotations(a).iter().zip(motion.rotations(b));
    let local: Vec<Quat> =
        pairs.map(|(&from, &to)| if t > 0.0 { slerp(from, to, t) } else { from }).collect();
    let mut placed: Vec<(Vec3, Quat)> = Vec::with_capacity(local.len());
    for (joint, &rotation) in skeleton.joints().iter().zip(&local) {
        placed.push(match joint.parent {
            None => (roots[a].lerp(roots[b], t), rotation),
            Some(parent) => {
                let (at, turn) = placed[parent.idx()];
                (at + turn * joint.offset_m, turn * rotation)
            }
        });
    }
    placed.into_iter().map(|(at, turn)| Mat4::from_rotation_translation(turn, at)).collect()
}

/// Where the root is at `frame`, metres.
pub fn root_at_m(motion: &Motion, frame: f64) -> Vec3 {
    let (a, b, t) = between(motion.n_frames(), frame);
    motion.root_positions_m()[a].lerp(motion.root_positions_m()[b], t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::library;

    #[test]
    fn whole_frames_are_those_of_forward_kinematics() {
        let library = library();
        let (skeleton, motion) = (library.clips.skeleton(), &library.clips.clips()[0].motion);
        let (mut positions, mut rotations) = (Vec::new(), Vec::new());
        motion.forward_kinematics(skeleton, 7, &mut positions, &mut rotations);
        for (world, (&at, &turn)) in
            pose_at(skeleton, motion, 7.0).iter().zip(positions.iter().zip(&rotations))
        {
            assert!(world.abs_diff_eq(Mat4::from_rotation_translation(turn, at), 1e-5));
        }
    }

    #[test]
    fn between_frames_bodies_move_evenly_and_ends_are_held() {
        let library = library();
        let (skeleton, motion) = (library.clips.skeleton(), &library.clips.clips()[0].motion);
        let root = |frame: f64| pose_at(skeleton, motion, frame)[0].w_axis.truncate();
        assert!(root(3.5).distance(0.5 * (root(3.0) + root(4.0))) < 1e-5);
        let last = (motion.n_frames() - 1) as f64;
        assert_eq!(root(last + 20.0), root(last));
        assert_eq!(root(-1.0), root(0.0));
        assert_eq!(root(f64::NAN), root(0.0));
        assert_eq!(root_at_m(motion, 3.5), root(3.5));
    }
}
