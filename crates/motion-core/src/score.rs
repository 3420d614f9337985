//! What makes one motion better than another (AF02 equation 1), by a plain walk over its pieces.
//!
//! This is the slow, obvious twin of what the search computes incrementally, and what reports
//! print.

use crate::clip::ClipSet;
use crate::constraint::{BodyConstraint, BodyError, LengthWish, SupportCost};
use crate::graph::MotionGraph;
use crate::path::{Path, Piece};
use crate::planar::PlanarTransform;

/// Factors of the terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// A cut of cost τ counts this much.
    pub continuity: f32,
    /// Of the length error.
    pub length: f32,
    /// Of the body constraints' errors.
    pub body: f32,
    /// Of the environment: feet planted on nothing.
    pub environment: f32,
}

impl Default for Weights {
    fn default() -> Self {
        Self { continuity: 1.0, length: 1.0, body: 1.0, environment: 1.0 }
    }
}

/// The terms of a score, weighted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScoreTerms {
    /// Costs of the cuts in units of τ.
    pub continuity: f32,
    /// Length error.
    pub length: f32,
    /// Body constraints.
    pub body: f32,
    /// Feet planted on nothing.
    pub environment: f32,
}

impl ScoreTerms {
    /// Their sum: the score. Lower is better.
    pub fn total(&self) -> f32 {
        self.continuity + self.length + self.body + self.environment
    }
}

/// What is asked of one character's motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Wishes {
    /// The length, if one is wished.
    pub length: Option<LengthWish>,
    /// Checkpoints in the order of their frames.
    pub body: Vec<BodyConstraint>,
    /// Factors.
    pub weights: Weights,
}

/// A path laid into the world and judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The terms.
    pub terms: ScoreTerms,
    /// Error of each body constraint, in their order.
    pub body: Vec<BodyError>,
    /// Frames in all.
    pub n_frames: u32,
    /// Where the first frame's torso stands in the world.
    pub world_from_start: PlanarTransform,
}

impl Judgement {
    /// Whether the length and every constraint lie within one tolerance before correction.
    pub fn is_acceptable(&self, wishes: &Wishes) -> bool {
        let length_ok = wishes.length.is_none_or(|wish| {
            let one = LengthWish { weight: 1.0, ..wish };
            one.cost(self.n_frames) <= 1.0
        });
        length_ok && self.body.iter().all(BodyError::is_within_tolerance)
    }
}

/// Torso frames of every frame of `pieces` laid end to end; the first is at the identity.
pub fn lay_end_to_end(clips: &ClipSet, pieces: &[Piece]) -> Vec<PlanarTransform> {
    let mut torsos = Vec::new();
    let mut next = PlanarTransform::IDENTITY;
    for piece in pieces {
        let track = &clips.clip(piece.clip).track.world_from_torso;
        let start_from_world = track[piece.from.idx()].inverse();
        let world_from_clip = next * start_from_world;
        torsos
            .extend(track[piece.from.idx()..=piece.to.idx()].iter().map(|&t| world_from_clip * t));
        // The frame that is not shown any more: the next piece's first frame is laid on it.
        let beyond = (piece.to.idx() + 1).min(track.len() - 1);
        next = world_from_clip * track[beyond];
    }
    torsos
}

/// Judges `path` from scratch; `None` when it is too short to reach an inner constraint.
pub fn judge(
    graph: &MotionGraph,
    clips: &ClipSet,
    wishes: &Wishes,
    path: &Path,
) -> Option<Judgement> {
    let pieces = path.pieces(graph);
    let local = lay_end_to_end(clips, &pieces);
    let n_frames = local.len() as u32;
    let last_frame = n_frames - 1;
    let mut world_from_start = PlanarTransform::IDENTITY;
    if let Some(first) = wishes.body.first() {
        let at = *local.get(first.frame as usize)?;
        world_from_start = first.world_from_torso() * at.inverse();
    }
    let mut terms = ScoreTerms::default();
    let mut body = Vec::with_capacity(wishes.body.len());
    for (nth, constraint) in wishes.body.iter().enumerate() {
        let is_last = nth > 0 && nth + 1 == wishes.body.len();
        let read_at = if is_last { last_frame } else { constraint.frame };
        let at = world_from_start * *local.get(read_at as usize)?;
        let error = constraint.error(at, read_at as i32 - constraint.frame as i32);
        terms.body += wishes.weights.body * constraint.weight * error.squared();
        body.push(error);
    }
    for &cut in &path.cuts {
        let cost = f64::from(graph.forest.edge(cut).cost) / graph.tau;
        terms.continuity += wishes.weights.continuity * cost as f32;
    }
    terms.length = wishes.weights.length * wishes.length.map_or(0.0, |wish| wish.cost(n_frames));
    // On platforms that a constraint asks for, something is meant to be under the feet.
    let on_the_floor = wishes.body.iter().all(|c| c.height_m.unwrap_or(0.0) == 0.0);
    if on_the_floor {
        let frame_secs = clips.fps().frame_secs() as f32;
        let mut frame = 0;
        for piece in &pieces {
            let clip = clips.clip(piece.clip);
            let own = clip.track.world_from_torso[piece.from.idx()].level_m;
            let level = (world_from_start * local[frame]).level_m - own;
            let sums = SupportCost::new(clip).between(piece.from.0, piece.to.0 + 1);
            terms.environment += wishes.weights.environment * sums.cost_at(level, frame_secs);
            frame += piece.n_frames();
        }
    }
    Some(Judgement { terms, body, n_frames, world_from_start })
}
