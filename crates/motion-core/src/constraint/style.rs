//! Tagged clips preferred over a stretch of time. Soft.

use crate::clip::Clip;
use crate::tags::HandTags;

/// One tolerance: this share of the frames without the tag.
pub const TOLERANCE_SHARE: f32 = 0.10;

/// A wished style.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleConstraint {
    /// First frame.
    pub from: u32,
    /// Last frame.
    pub to: u32,
    /// The tag of the frames that are preferred.
    pub tag: String,
    /// Factor of the share of frames without the tag, in tolerances.
    pub weight: f32,
    /// Tags given by hand, which clips have beside those that were found in them.
    pub by_hand: HandTags,
}

impl StyleConstraint {
    /// For each frame of a clip whether it has the tag.
    pub fn frames_with_tag(&self, clip: &Clip) -> Vec<bool> {
        self.by_hand.frames_with_tag(clip, &self.tag)
    }

    /// How many frames it speaks of.
    pub fn n_frames(&self) -> u32 {
        self.to - self.from + 1
    }

    /// What each frame without the tag adds to the score. It is the share that counts, not its
    /// square: half of a stretch in the wrong style is half as bad, wherever it lies.
    pub fn cost_of_a_frame(&self) -> f32 {
        self.weight / (TOLERANCE_SHARE * self.n_frames() as f32)
    }
}
