//! A path with everything that scoring a change of it needs.

use super::library::SearchLibrary;
use super::stretch::{self, Stretch};
use super::target::Target;
use crate::constraint::clearance::CLEARANCE_LIMIT_M;
use crate::constraint::environment::Sums;
use crate::constraint::obstacle::OBSTACLE_TOLERANCE_M;
use crate::ids::ClipId;
use crate::path::Path;
use crate::planar::PlanarTransform;

/// A piece of a route: frames `from..to` (the end not shown) of a clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    pub(crate) clip: ClipId,
    pub(crate) from: u32,
    pub(crate) to: u32,
    /// The motion's frame that shows `from`.
    pub(crate) starts_at: u32,
    /// Cost of the cuts before it, in τ.
    pub(crate) cuts_before: f32,
    /// Where the clip's world lies in the motion's.
    pub(crate) world_from_clip: PlanarTransform,
}

impl Span {
    #[inline]
    pub(crate) fn n_frames(&self) -> u32 {
        self.to - self.from
    }

    /// The motion's frame at which frame `clip_frame` of the clip is or would be shown.
    #[inline]
    pub(crate) fn frame_of(&self, clip_frame: u32) -> u32 {
        self.starts_at + clip_frame - self.from
    }

    /// What it shows.
    #[inline]
    pub(crate) fn stretch(&self) -> Stretch {
        let Self { clip, from, to, starts_at, world_from_clip, .. } = *self;
        Stretch { clip, world_from_clip, from, to, starts_at }
    }
}

/// A path laid out: its pieces placed end to end so that the anchor is met, and its score.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    pub(crate) path: Path,
    pub(crate) spans: Vec<Span>,
    pub(crate) n_frames: u32,
    pub(crate) cuts_cost: f32,
    /// Torso at the last frame.
    pub(crate) end: PlanarTransform,
    pub(crate) score: f32,
}

impl Route {
    /// Lays out and scores a path; `None` when it is not valid, too short for what must be read, or
    /// does not show what is hard.
    pub(crate) fn new(library: &SearchLibrary, target: &Target, path: Path) -> Option<Self> {
        let forest = &library.graph().forest;
        let per_tau = (1.0 / library.graph().tau) as f32;
        let mut spans: Vec<Span> = Vec::with_capacity(path.cuts.len() + 1);
        let (mut clip, mut from) = (path.first_clip, path.start.0);
        let (mut starts_at, mut cuts_cost) = (0u32, 0.0f32);
        let mut torso = target.anchor;
        for nth in 0..=path.cuts.len() {
            let cut = path.cuts.get(nth).map(|&id| (id, forest.edge(id)));
            let to = cut.map_or(path.end.0 + 1, |(_, edge)| edge.from_frame.0);
            if to <= from || to > library.n_frames(clip) {
                return None;
            }
            let torsos = library.torsos(clip);
            let world_from_clip = torso * torsos[from as usize].inverse();
            spans.push(Span { clip, from, to, starts_at, cuts_before: cuts_cost, world_from_clip });
            starts_at += to - from;
            if let Some((id, edge)) = cut {
                torso = world_from_clip * torsos[to as usize];
                cuts_cost += edge.cost * per_tau;
                clip = forest.pair_of(id).to;
                from = edge.to_frame.0;
            }
        }
        if !target.hard.iter().all(|hard| hard.is_shown(&spans)) {
            return None;
        }
        let end = PlanarTransform::IDENTITY;
        let mut route = Self { path, spans, n_frames: starts_at, cuts_cost, end, score: 0.0 };
        route.move_to_anchor(library, target);
        let last = route.spans[route.spans.len() - 1];
        route.end = last.world_from_clip * library.torsos(last.clip)[last.to as usize - 1];
        route.score = route.total(library, target);
        route.score.is_finite().then_some(route)
    }

    /// The span that shows frame `frame` of the motion.
    #[inline]
    pub(crate) fn span_at(&self, frame: u32) -> &Span {
        let after = self.spans.partition_point(|span| span.starts_at <= frame);
        &self.spans[after - 1]
    }

    /// The torso at a frame of the motion.
    #[inline]
    pub(crate) fn torso(&self, library: &SearchLibrary, frame: u32) -> PlanarTransform {
        let span = self.span_at(frame);
        let clip_frame = span.from + frame - span.starts_at;
        span.world_from_clip * library.torsos(span.clip)[clip_frame as usize]
    }

    /// Pieces are laid from the first frame on; where the anchor is read later, all are moved.
    fn move_to_anchor(&mut self, library: &SearchLibrary, target: &Target) {
        if target.anchor_frame == 0 || target.anchor_frame >= self.n_frames {
            return;
        }
        let moved = target.anchor * self.torso(library, target.anchor_frame).inverse();
        for span in &mut self.spans {
            span.world_from_clip = moved * span.world_from_clip;
        }
    }

    fn total(&self, library: &SearchLibrary, target: &Target) -> f32 {
        let mut score = target.weights.continuity * self.cuts_cost;
        score += target.frames_cost(self.n_frames);
        if !score.is_finite() {
            return f32::INFINITY;
        }
        let last = self.spans[self.spans.len() - 1];
        if let Some(wish) = &target.last {
            score += wish.cost(library, last.world_from_clip, last.clip, last.to - 1);
        }
        let mut support = Sums::default();
        for span in &self.spans {
            let stretch = span.stretch();
            score += stretch.cost(library, target, f32::INFINITY);
            support = support.plus(&stretch.support(library));
        }
        if target.on_the_floor && library.leaves_the_floor() {
            let frame_secs = library.clips().fps().frame_secs() as f32;
            score += target.weights.environment * support.cost_at(0.0, frame_secs);
        }
        score
    }

    /// Whether it keeps clear of everything by as much as counts as well.
    pub(crate) fn is_clear(&self, library: &SearchLibrary, target: &Target) -> bool {
        if !target.has_surroundings() {
            return true;
        }
        self.spans.iter().all(|span| {
            (span.from..span.to).all(|clip_frame| {
                let torso = span.world_from_clip * library.torsos(span.clip)[clip_frame as usize];
                let at = (span.clip, clip_frame);
                let near_m =
                    stretch::too_near_m(target, torso.ground_m(), span.frame_of(clip_frame));
                stretch::depth_m(library, target, torso, at) <= OBSTACLE_TOLERANCE_M
                    && near_m <= CLEARANCE_LIMIT_M
            })
        })
    }
}
