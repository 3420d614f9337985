//! From a path that was found to a motion and what the report says of it.

mod measured;
pub(crate) mod misses;
mod targets;

use std::sync::Arc;

use motion_core::assemble::{Assembler, Plan, Policies};
use motion_core::by_hand::{self, ByHand};
use motion_core::floor::Soles;
use motion_core::ground::{Contacts, GroundTrack};
use motion_core::ids::ClipId;
use motion_core::measure::{Support, measure};
use motion_core::motion::Motion;
use motion_core::path::Piece;
use motion_core::score::{ScoreTerms, lay_end_to_end};
use motion_core::units::FrameIdx;
use motion_io::report_file::{AlternativeReport, PieceReport, SeamReport, Terms};

use measured::Finish;
use misses::{Misses, constraint_reports};
pub(crate) use targets::read_at;

use crate::Library;
use crate::problem::CharacterProblem;
use crate::quality::{quality_report, source_foot_slide_cm_per_s};
use crate::solve_job::Alternative;

/// A motion for one character.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The motion, on the library's skeleton.
    pub motion: Arc<Motion>,
    /// The motion without what is changed by hand; `None` where nothing is.
    pub before_hand: Option<Arc<Motion>>,
    /// Which frame of `before_hand` each frame shows; `None` where it is not retimed.
    pub source_frames: Option<Arc<[f64]>>,
    /// What the report says of it, but for the files.
    pub report: AlternativeReport,
}

/// A take put together and corrected, before anything is laid over it.
#[derive(Clone, Debug)]
pub struct Assembly {
    motion: Arc<Motion>,
    contacts: Vec<Contacts>,
    levels_m: Vec<f32>,
    soles: Soles,
    source_slide_cm_per_s: Option<f64>,
    /// Which frame of which clip each frame shows.
    shown: Vec<(ClipId, FrameIdx)>,
    /// Without what is measured on the finished motion.
    report: AlternativeReport,
}

/// Makes the motion of `alternative`, with what is changed by hand on it. `rank` counts from 1, the
/// best.
///
/// `None` only where the path is not of this library.
pub fn finish(
    library: &Library,
    assembler: &Assembler<'_>,
    character: &CharacterProblem,
    alternative: &Alternative,
    by_hand: Option<&ByHand>,
    rank: u32,
) -> Option<Finished> {
    let assembly = assemble(library, assembler, character, alternative, rank)?;
    Some(assembly.finish(library, character, by_hand))
}

/// Puts the take of `alternative` together and corrects it.
///
/// `None` only where the path is not of this library.
pub fn assemble(
    library: &Library,
    assembler: &Assembler<'_>,
    character: &CharacterProblem,
    alternative: &Alternative,
    rank: u32,
) -> Option<Assembly> {
    let Alternative { path, judgement, .. } = alternative;
    let (graph, clips) = (&library.graph, &library.clips);
    let pieces = path.pieces(graph);
    let wishes = &character.problem.wishes;
    let start = judgement.world_from_start;
    let raw: Vec<_> =
        lay_end_to_end(clips, &pieces).into_iter().map(|torso| start * torso).collect();
    let targets = targets::targets(wishes, &raw);
    let hard_frames = targets::hard_frames(wishes);
    let plan = Plan { pieces: &pieces, start, targets: &targets, hard_frames: &hard_frames };
    let made = assembler.assemble(&plan, Policies::BEST).ok()?;
    let seams = path.cuts.iter().zip(made.starts.iter().skip(1)).map(|(&cut, start)| SeamReport {
        frame: start.0,
        level: graph.forest.level(cut),
        leaf: graph.forest.is_leaf(cut),
        cost: digits_of(graph.forest.edge(cut).cost),
        bridge: graph.forest.is_bridge(cut),
    });
    let sources = pieces.iter().map(|piece| piece.clip);
    let source_slide_cm_per_s = source_foot_slide_cm_per_s(clips, sources);
    let frames_of = |piece: &Piece| {
        let clip = piece.clip;
        (piece.from.0..=piece.to.0).map(move |frame| (clip, FrameIdx(frame)))
    };
    let shown = pieces.iter().flat_map(frames_of).collect();
    let pieces = pieces.iter().map(|piece| PieceReport {
        clip: clips.clip(piece.clip).id.clone(),
        from: piece.from.0,
        to: piece.to.0,
    });
    let terms = judgement.terms;
    let report = AlternativeReport {
        rank,
        score: digits_of(terms.total()),
        terms: terms_report(&terms),
        frames: judgement.n_frames,
        pieces: pieces.collect(),
        seams: seams.collect(),
        raw: constraint_reports(character, &Misses::before_correction(judgement)),
        final_: Vec::new(),
        quality: None,
        found_at_s: Some(alternative.found_at_s),
        files: Vec::new(),
    };
    Some(Assembly {
        motion: Arc::new(made.motion),
        contacts: made.contacts,
        levels_m: made.levels_m,
        soles: assembler.soles(),
        source_slide_cm_per_s,
        shown,
        report,
    })
}

impl Assembly {
    /// The finished motion, with what is changed by hand on it and everything measured on that.
    ///
    /// Frames of constraints and cuts are then those of the retimed motion.
    pub fn finish(
        &self,
        library: &Library,
        character: &CharacterProblem,
        by_hand: Option<&ByHand>,
    ) -> Finished {
        let skeleton = library.clips.skeleton();
        let by_hand = by_hand.filter(|layer| !layer.is_empty());
        let source_frames: Option<Arc<[f64]>> = by_hand
            .filter(|layer| !layer.retime.is_identity())
            .map(|layer| layer.retime.source_frames(self.motion.n_frames()).into());
        let motion = match by_hand {
            Some(layer) => Arc::new(by_hand::apply(layer, skeleton, &self.motion)),
            None => Arc::clone(&self.motion),
        };
        let (mut contacts, mut levels_m) = (self.contacts.clone(), self.levels_m.clone());
        let mut shown = self.shown.clone();
        let mut report = self.report.clone();
        if let Some(frames) = source_frames.as_deref() {
            contacts = frames.iter().map(|at| self.contacts[at.round() as usize]).collect();
            shown = frames.iter().map(|at| self.shown[at.round() as usize]).collect();
            levels_m = frames.iter().map(|&at| between(&self.levels_m, at)).collect();
            let last = frames.len().saturating_sub(1);
            for seam in &mut report.seams {
                let shown = frames.partition_point(|&at| at < f64::from(seam.frame)).min(last);
                seam.frame = u32::try_from(shown).unwrap_or(u32::MAX);
            }
        }
        let track = GroundTrack::new(&motion, &levels_m, contacts.clone());
        let support = Support { levels_m, contacts, soles: self.soles };
        let mut quality = quality_report(&measure(skeleton, &motion, Some(&support)));
        quality.source_foot_slide_cm_per_s = self.source_slide_cm_per_s;
        report.frames = u32::try_from(motion.n_frames()).unwrap_or(u32::MAX);
        report.quality = Some(quality);
        let finished = Finish { library, motion: &motion, track: &track, shown: &shown };
        report.final_ = constraint_reports(character, &finished.misses(character));
        let before_hand = by_hand.map(|_| Arc::clone(&self.motion));
        Finished { motion, before_hand, source_frames, report }
    }
}

/// The level between two frames' levels, metres.
fn between(levels_m: &[f32], at: f64) -> f32 {
    let frame = at.floor() as usize;
    let (a, b) = (levels_m[frame], levels_m[(frame + 1).min(levels_m.len() - 1)]);
    a + (b - a) * (at - at.floor()) as f32
}

/// The number as people write it: 0.1, where f64 would show what f32 makes of it
/// (0.10000000149).
pub(crate) fn digits_of(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

fn terms_report(terms: &ScoreTerms) -> Terms {
    let ScoreTerms { continuity, length, body, joint, style, path, environment } = *terms;
    let [continuity, length, body, joint, style, path, environment] =
        [continuity, length, body, joint, style, path, environment].map(digits_of);
    Terms { continuity, length, body, joint, style, path, environment }
}
