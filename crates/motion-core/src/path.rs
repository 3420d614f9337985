//! A path through the graph: which stretches of which clips a motion is made of.

use crate::graph::{EdgeId, MotionGraph};
use crate::ids::ClipId;
use crate::units::FrameIdx;

/// A stretch of a clip, both ends shown; the next piece follows at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Piece {
    /// The clip.
    pub clip: ClipId,
    /// First frame shown.
    pub from: FrameIdx,
    /// Last frame shown.
    pub to: FrameIdx,
}

impl Piece {
    /// How many frames are shown; at least 1 in a valid piece.
    #[inline]
    pub fn n_frames(self) -> usize {
        (self.to.idx() + 1).saturating_sub(self.from.idx())
    }
}

/// A start, cuts, and an end. The start and end frames are choices like the cuts are.
///
/// Invariants, checked by [`Path::is_valid`]:
/// 1. Each cut leaves the clip that the one before entered (the first: the first clip).
/// 2. Each piece shows at least one frame: `to_frame(e_k) < from_frame(e_{k+1})`, and the same
///    from the start to the first cut and from the last cut to the end.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Path {
    /// The clip it begins in.
    pub first_clip: ClipId,
    /// The first frame shown.
    pub start: FrameIdx,
    /// The cuts, edges of any level.
    pub cuts: Vec<EdgeId>,
    /// The last frame shown, in the last clip.
    pub end: FrameIdx,
}

impl Path {
    /// Whether the rules of a path hold in `graph`.
    pub fn is_valid(&self, graph: &MotionGraph) -> bool {
        let mut clip = self.first_clip;
        let mut entered = self.start;
        if clip.idx() >= graph.n_clips() {
            return false;
        }
        for &cut in &self.cuts {
            if cut.0 as usize >= graph.forest.n_nodes() {
                return false;
            }
            let pair = graph.forest.pair_of(cut);
            let edge = graph.forest.edge(cut);
            if pair.from != clip || edge.from_frame <= entered {
                return false;
            }
            clip = pair.to;
            entered = edge.to_frame;
        }
        entered <= self.end && self.end.0 < graph.clip_frames[clip.idx()]
    }

    /// The pieces in order; the path must be valid.
    pub fn pieces(&self, graph: &MotionGraph) -> Vec<Piece> {
        let mut pieces = Vec::with_capacity(self.cuts.len() + 1);
        let (mut clip, mut from) = (self.first_clip, self.start);
        for &cut in &self.cuts {
            let edge = graph.forest.edge(cut);
            pieces.push(Piece { clip, from, to: FrameIdx(edge.from_frame.0 - 1) });
            clip = graph.forest.pair_of(cut).to;
            from = edge.to_frame;
        }
        pieces.push(Piece { clip, from, to: self.end });
        pieces
    }
}
