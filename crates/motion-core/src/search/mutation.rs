//! The changes that the search makes to a path, as data (AF02 section 5).

use crate::graph::{EdgeId, Forest};
use crate::ids::ClipId;
use crate::path::Path;
use crate::units::FrameIdx;

/// A change of a path. Pieces are counted from 0; cut `k` leads from piece `k` to piece `k + 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mutation {
    /// Keep pieces up to `keep`, leave it by `cut`, go on in piece `resume`. Whatever was
    /// between is deleted; where `resume <= keep`, pieces are shown again.
    Reconnect { keep: usize, resume: usize, cut: EdgeId },
    /// The same with a stretch of another clip between: leave by `out`, come back by `back`.
    Detour { keep: usize, resume: usize, out: EdgeId, back: EdgeId },
    /// Begin at `start` of the clip that `cut` leaves, and by it reach piece `resume`.
    NewStart { resume: usize, start: FrameIdx, cut: EdgeId },
    /// Leave piece `keep` by `cut` and end at frame `end` of the clip that it enters.
    NewEnd { keep: usize, cut: EdgeId, end: FrameIdx },
    /// Begin at another frame of the first clip.
    MoveStart { start: FrameIdx },
    /// End at another frame of the last clip.
    MoveEnd { end: FrameIdx },
    /// Replace two cuts (or one, when `first == second`) by others of the same clips: children,
    /// in AF02.
    Refine { first: usize, first_cut: EdgeId, second: usize, second_cut: EdgeId },
}

/// Mutations of one kind at one place compete with each other only.
pub(crate) type StructureKey = (u8, usize, usize, u32);

impl Mutation {
    /// What is changed, not how: two mutations with one key are variants of each other.
    pub(crate) fn structure(&self, forest: &Forest) -> StructureKey {
        let entered = |cut: EdgeId| forest.pair_of(cut).to.0;
        match *self {
            Self::Reconnect { keep, resume, .. } => (0, keep, resume, 0),
            Self::Detour { keep, resume, out, .. } => (1, keep, resume, entered(out)),
            Self::NewStart { resume, cut, .. } => (2, 0, resume, forest.pair_of(cut).from.0),
            Self::NewEnd { keep, cut, .. } => (3, keep, 0, entered(cut)),
            Self::MoveStart { .. } => (4, 0, 0, 0),
            Self::MoveEnd { .. } => (5, 0, 0, 0),
            Self::Refine { first, second, .. } => (6, first, second, 0),
        }
    }

    /// The changed path. It is valid when the frames agree, which the scoring checks.
    pub(crate) fn apply(&self, path: &Path, forest: &Forest) -> Path {
        let mut new = path.clone();
        let spliced = |keep: usize, between: &[EdgeId], resume: usize| -> Vec<EdgeId> {
            let mut cuts = path.cuts[..keep].to_vec();
            cuts.extend_from_slice(between);
            cuts.extend_from_slice(&path.cuts[resume..]);
            cuts
        };
        match *self {
            Self::Reconnect { keep, resume, cut } => new.cuts = spliced(keep, &[cut], resume),
            Self::Detour { keep, resume, out, back } => {
                new.cuts = spliced(keep, &[out, back], resume);
            }
            Self::NewStart { resume, start, cut } => {
                let clip: ClipId = forest.pair_of(cut).from;
                new.first_clip = clip;
                new.start = start;
                new.cuts = spliced(0, &[cut], resume);
            }
            Self::NewEnd { keep, cut, end } => {
                new.cuts = spliced(keep, &[cut], path.cuts.len());
                new.end = end;
            }
            Self::MoveStart { start } => new.start = start,
            Self::MoveEnd { end } => new.end = end,
            Self::Refine { first, first_cut, second, second_cut } => {
                new.cuts[first] = first_cut;
                new.cuts[second] = second_cut;
            }
        }
        new
    }
}
