//! What a BVH file gives back of the motion that was written to it.

use std::path::Path;

use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;

use super::write::nested_order;
use super::{BvhWriteOptions, read};
use crate::diagnostic::{FileError, Warnings};

/// The largest difference between a motion and what is read back of its file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundTrip {
    /// The largest distance of a joint from where it was, over all frames, metres.
    pub worst_m: f32,
    /// The joint that it is of.
    pub joint: JointIdx,
    /// The frame that it is in.
    pub frame: usize,
}

/// Reads the text of a file that was written with `options` and compares every joint in every frame.
/// Fails where it cannot be read or holds another number of frames or joints.
pub fn round_trip(
    bytes: &[u8],
    path: &Path,
    skeleton: &Skeleton,
    motion: &Motion,
    options: &BvhWriteOptions,
) -> Result<RoundTrip, FileError> {
    let mut warnings = Warnings::new();
    let bvh = read(bytes, path, &mut warnings)?;
    let (read_skeleton, read_motion) =
        bvh.to_motion(options.metres_per_unit, path, &mut warnings)?;
    let order = nested_order(skeleton);
    if read_motion.n_frames() != motion.n_frames() || read_motion.n_joints() != order.len() {
        let what = "what was written reads back as another motion";
        return Err(FileError::new(path, what, "check the disk and try again"));
    }
    let mut worst = RoundTrip { worst_m: 0.0, joint: JointIdx(0), frame: 0 };
    let (mut was_m, mut is_m, mut rotations) = (Vec::new(), Vec::new(), Vec::new());
    for frame in 0..motion.n_frames() {
        motion.forward_kinematics(skeleton, frame, &mut was_m, &mut rotations);
        read_motion.forward_kinematics(&read_skeleton, frame, &mut is_m, &mut rotations);
        for (&(joint, _), is_m) in order.iter().zip(&is_m) {
            let away_m = was_m[joint.idx()].distance(*is_m);
            if away_m > worst.worst_m {
                worst = RoundTrip { worst_m: away_m, joint, frame };
            }
        }
    }
    Ok(worst)
}
