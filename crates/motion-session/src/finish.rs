//! From a path that was found to a motion and what the report says of it.

use motion_core::assemble::{Assembled, Assembler, BodyTarget, Plan, Policies};
use motion_core::constraint::BodyError;
use motion_core::ground::GroundTrack;
use motion_core::measure::{Support, measure};
use motion_core::motion::Motion;
use motion_core::units::FrameIdx;
use motion_io::report_file::{AlternativeReport, ConstraintReport, PieceReport, SeamReport, Terms};

use crate::Library;
use crate::problem::CharacterProblem;
use crate::quality::{quality_report, source_foot_slide_cm_per_s};
use crate::solve_job::Alternative;

/// A motion for one character.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The motion, on the library's skeleton.
    pub motion: Motion,
    /// What the report says of it, but for the files.
    pub report: AlternativeReport,
}

/// Makes the motion of `alternative`. `rank` counts from 1, the best.
///
/// `None` only where the path is not of this library.
pub fn finish(
    library: &Library,
    assembler: &Assembler<'_>,
    character: &CharacterProblem,
    alternative: &Alternative,
    rank: u32,
) -> Option<Finished> {
    let Alternative { path, judgement, .. } = alternative;
    let (graph, clips) = (&library.graph, &library.clips);
    let pieces = path.pieces(graph);
    let targets = targets(character, judgement.n_frames);
    let plan = Plan {
        pieces: &pieces,
        start: judgement.world_from_start,
        targets: &targets,
        hard_frames: &[],
    };
    let made = assembler.assemble(&plan, Policies::BEST).ok()?;
    let seams = path.cuts.iter().zip(made.starts.iter().skip(1)).map(|(&cut, start)| SeamReport {
        frame: start.0,
        level: graph.forest.level(cut),
        leaf: graph.forest.is_leaf(cut),
        cost: digits_of(graph.forest.edge(cut).cost),
        bridge: graph.forest.is_bridge(cut),
    });
    let sources = pieces.iter().map(|piece| piece.clip);
    let source_slide = source_foot_slide_cm_per_s(clips, sources);
    let pieces = pieces.iter().map(|piece| PieceReport {
        clip: clips.clip(piece.clip).id.clone(),
        from: piece.from.0,
        to: piece.to.0,
    });
    let support = Support::of_assembled(&made, assembler.soles());
    let quality = measure(clips.skeleton(), &made.motion, Some(&support));
    let mut quality = quality_report(&quality);
    quality.source_foot_slide_cm_per_s = source_slide;
    let terms = judgement.terms;
    let report = AlternativeReport {
        rank,
        score: digits_of(terms.total()),
        terms: Terms {
            continuity: digits_of(terms.continuity),
            length: digits_of(terms.length),
            body: digits_of(terms.body),
            environment: digits_of(terms.environment),
            ..Terms::default()
        },
        frames: judgement.n_frames,
        pieces: pieces.collect(),
        seams: seams.collect(),
        raw: constraint_reports(character, &judgement.body),
        final_: constraint_reports(character, &final_errors(character, &made)),
        quality: Some(quality),
        found_at_s: Some(alternative.found_at_s),
        files: Vec::new(),
    };
    Some(Finished { motion: made.motion, report })
}

/// The number as people write it: 0.1, where f64 would show what f32 makes of it
/// (0.10000000149).
pub(crate) fn digits_of(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

/// The frame at which the body constraint `nth` is read in a motion of `n_frames`: its own, but
/// the last one's is the motion's last.
pub(crate) fn read_at(character: &CharacterProblem, nth: usize, n_frames: u32) -> u32 {
    let body = &character.problem.wishes.body;
    let is_last = nth > 0 && nth + 1 == body.len();
    if is_last { n_frames - 1 } else { body[nth].frame }
}

/// Body constraints as targets. A motion may end just where an inner constraint stands; the last
/// one then has the frame to itself.
fn targets(character: &CharacterProblem, n_frames: u32) -> Vec<BodyTarget> {
    let body = &character.problem.wishes.body;
    let mut targets: Vec<BodyTarget> = Vec::with_capacity(body.len());
    for (nth, constraint) in body.iter().enumerate() {
        let frame = FrameIdx(read_at(character, nth, n_frames));
        targets.retain(|target| target.frame < frame);
        targets.push(BodyTarget {
            frame,
            world_from_torso: constraint.world_from_torso(),
            height: constraint.height_m.is_some(),
        });
    }
    targets
}

fn final_errors(character: &CharacterProblem, made: &Assembled) -> Vec<BodyError> {
    let track = GroundTrack::new(&made.motion, &made.levels_m, made.contacts.clone());
    let n_frames = made.motion.n_frames() as u32;
    let body = &character.problem.wishes.body;
    body.iter()
        .enumerate()
        .map(|(nth, constraint)| {
            let frame = read_at(character, nth, n_frames);
            let at = track.world_from_torso[frame as usize];
            constraint.error(at, frame as i32 - constraint.frame as i32)
        })
        .collect()
}

pub(crate) fn constraint_reports(
    character: &CharacterProblem,
    errors: &[BodyError],
) -> Vec<ConstraintReport> {
    character
        .body_ids
        .iter()
        .zip(errors)
        .map(|(id, error)| ConstraintReport {
            constraint: id.clone(),
            kind: "body".to_owned(),
            position_error_m: Some(digits_of(error.position_m)),
            heading_error_deg: Some(digits_of(error.heading_rad.to_degrees())),
            frame_error: Some(i64::from(error.frames)),
        })
        .collect()
}
