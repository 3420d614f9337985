//! A frame of a clip at a frame of the motion. Hard: met exactly.

use glam::Vec2;

use super::{BodyConstraint, Tolerance};
use crate::ids::ClipId;
use crate::path::Piece;
use crate::units::FrameIdx;

/// A wished pose, and where it is to be taken if that is said. The pose is hard; its place is as soft in
/// the search as a checkpoint's, and exact in the finished motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseConstraint {
    /// When.
    pub frame: u32,
    /// Which clip.
    pub clip: ClipId,
    /// Which frame of it.
    pub clip_frame: FrameIdx,
    /// Where the torso's frame is to be `(x, z)`, metres.
    pub ground_m: Option<Vec2>,
    /// Which way it is to face, radians.
    pub heading_rad: Option<f32>,
    /// Height of what the body stands on, metres.
    pub height_m: Option<f32>,
    /// Factor of the squared error of the place.
    pub weight: f32,
    /// How far off is well.
    pub tolerance: Tolerance,
}

impl PoseConstraint {
    /// A pose anywhere.
    pub fn new(frame: u32, clip: ClipId, clip_frame: FrameIdx) -> Self {
        Self {
            frame,
            clip,
            clip_frame,
            ground_m: None,
            heading_rad: None,
            height_m: None,
            weight: 1.0,
            tolerance: Tolerance::default(),
        }
    }

    /// The piece that must be shown at the frame.
    pub fn piece(&self) -> Piece {
        Piece { clip: self.clip, from: self.clip_frame, to: self.clip_frame }
    }

    /// Its place as a checkpoint at its own frame; parts that are not asked for have an infinite
    /// tolerance. `None` where no place is asked for.
    pub fn place(&self) -> Option<BodyConstraint> {
        if self.ground_m.is_none() && self.heading_rad.is_none() && self.height_m.is_none() {
            return None;
        }
        let mut tolerance = self.tolerance;
        if self.ground_m.is_none() {
            tolerance.position_m = f32::INFINITY;
        }
        if self.heading_rad.is_none() {
            tolerance.heading_rad = f32::INFINITY;
        }
        Some(BodyConstraint {
            frame: self.frame,
            position_m: self.ground_m.unwrap_or_default(),
            heading_rad: self.heading_rad.unwrap_or_default(),
            height_m: self.height_m,
            weight: self.weight,
            tolerance,
        })
    }
}
