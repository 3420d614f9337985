//! What is not met, and by which motion: all that changes are thought of from.

use glam::Vec3;
use motion_core::ids::{ClipId, JointIdx};
use motion_core::path::Path;
use motion_core::planar::PlanarTransform;
use motion_core::score::{Judgement, Wishes, lay_end_to_end};
use motion_core::units::FrameIdx;

use crate::Library;
use crate::document::{CharacterIdx, ConstraintRef, Document};
use crate::problem::CharacterProblem;
use crate::unmet::missed::{Missed, missed};

/// A character whose best motion misses something.
#[derive(Debug)]
pub(crate) struct Case<'a> {
    pub(super) document: &'a Document,
    pub(super) character: CharacterIdx,
    pub(super) asked: &'a CharacterProblem,
    pub(super) library: &'a Library,
    /// Of the best motion.
    pub(super) judgement: &'a Judgement,
    /// What it misses.
    pub(super) missed: Vec<Missed>,
    /// Its torsos before correction, frame by frame.
    pub(super) torsos: Vec<PlanarTransform>,
    shown: Vec<(ClipId, FrameIdx)>,
}

impl<'a> Case<'a> {
    /// The case of a character whose best motion is `path`; `None` where it misses nothing.
    pub(crate) fn new(
        (document, character): (&'a Document, CharacterIdx),
        asked: &'a CharacterProblem,
        library: &'a Library,
        path: &Path,
        judgement: &'a Judgement,
    ) -> Option<Self> {
        let missed = missed(&asked.problem.wishes, judgement);
        if missed.is_empty() {
            return None;
        }
        let pieces = path.pieces(&library.graph);
        let start = judgement.world_from_start;
        let torsos = lay_end_to_end(&library.clips, &pieces);
        let frames_of = |piece: &motion_core::path::Piece| {
            let clip = piece.clip;
            (piece.from.0..=piece.to.0).map(move |frame| (clip, FrameIdx(frame)))
        };
        Some(Self {
            document,
            character,
            asked,
            library,
            judgement,
            missed,
            torsos: torsos.into_iter().map(|torso| start * torso).collect(),
            shown: pieces.iter().flat_map(frames_of).collect(),
        })
    }

    /// What is asked.
    pub(super) fn wishes(&self) -> &'a Wishes {
        &self.asked.problem.wishes
    }

    /// The constraint `id` of the character.
    pub(super) fn at(&self, id: &str) -> ConstraintRef {
        ConstraintRef::new(self.character, id)
    }

    /// The torso at a frame before correction, or at the last one.
    pub(super) fn torso(&self, frame: u32) -> PlanarTransform {
        let last = self.torsos.len().saturating_sub(1);
        self.torsos.get((frame as usize).min(last)).copied().unwrap_or(PlanarTransform::IDENTITY)
    }

    /// Where a joint is at a frame before correction, metres; `None` behind the end.
    pub(super) fn joint_m(&self, joint: JointIdx, frame: u32) -> Option<Vec3> {
        let &(clip, clip_frame) = self.shown.get(frame as usize)?;
        let clip = self.library.clips.clip(clip);
        let one = clip.motion.slice(clip_frame.idx(), clip_frame.idx() + 1);
        let in_clip = *one.joint_path_m(self.library.clips.skeleton(), joint).first()?;
        let own = clip.track.world_from_torso.get(clip_frame.idx())?;
        Some((self.torso(frame) * own.inverse()).apply(in_clip))
    }
}
