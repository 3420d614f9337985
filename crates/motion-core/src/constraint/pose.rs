//! A frame of a clip at a frame of the motion. Hard: met exactly.

use crate::ids::ClipId;
use crate::units::FrameIdx;

/// A wished pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PoseConstraint {
    /// When.
    pub frame: u32,
    /// Which clip.
    pub clip: ClipId,
    /// Which frame of it.
    pub clip_frame: FrameIdx,
}
