//! A path of a beam so far.

use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;

/// Pieces of a seed show at least this many frames: shorter ones are left to the mutations.
const MIN_PIECE: u32 = 8;

/// A path so far: it has just entered a clip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) clip: ClipId,
    pub(super) entered: u32,
    /// The motion's frame that shows `entered`.
    pub(super) at: u32,
    pub(super) world_from_clip: PlanarTransform,
    /// Everything that frames before `at` cost, cuts included.
    pub(super) cost: f32,
    /// The node before and the cut that led here.
    pub(super) before: Option<(u32, EdgeId)>,
    /// The next anchor that is not certain yet.
    pub(super) next_anchor: usize,
    /// Frames of the clip before this one must be shown.
    pub(super) must_show: u32,
}

impl Node {
    /// The first frame of the clip at which a seed cuts away.
    pub(super) fn may_leave(&self) -> u32 {
        self.must_show.max(self.entered + MIN_PIECE)
    }
}
