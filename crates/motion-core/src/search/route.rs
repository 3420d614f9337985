//! A path with everything that scoring a change of it needs.

use super::library::SearchLibrary;
use super::problem::Target;
use crate::constraint::environment::Sums;
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
}

/// A path laid out: its pieces placed end to end from the anchor, and its score.
///
/// Placement starts with the first frame's torso at the anchor. When the first checkpoint is at
/// a later frame, everything is moved once more when it is read ([`Target::anchor_frame`]).
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
    /// Lays out and scores a path; `None` when it is not valid or too short for a checkpoint.
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
        let last = spans[spans.len() - 1];
        let end = last.world_from_clip * library.torsos(last.clip)[last.to as usize - 1];
        let mut route = Self { path, spans, n_frames: starts_at, cuts_cost, end, score: 0.0 };
        route.score = route.total(library, target);
        route.score.is_finite().then_some(route)
    }

    /// The span that shows frame `frame` of the motion.
    #[inline]
    pub(crate) fn span_at(&self, frame: u32) -> &Span {
        let after = self.spans.partition_point(|span| span.starts_at <= frame);
        &self.spans[after - 1]
    }

    /// The torso at a frame of the motion, before the move to the anchor frame.
    #[inline]
    pub(crate) fn torso(&self, library: &SearchLibrary, frame: u32) -> PlanarTransform {
        let span = self.span_at(frame);
        let clip_frame = span.from + frame - span.starts_at;
        span.world_from_clip * library.torsos(span.clip)[clip_frame as usize]
    }

    /// The move that brings the anchor frame's torso onto the anchor.
    pub(crate) fn world_from_laid(
        &self,
        library: &SearchLibrary,
        target: &Target,
    ) -> PlanarTransform {
        if target.anchor_frame == 0 || target.anchor_frame >= self.n_frames {
            return PlanarTransform::IDENTITY;
        }
        target.anchor * self.torso(library, target.anchor_frame).inverse()
    }

    /// Support sums of a span with heights as they are in the motion's world.
    pub(crate) fn support(&self, library: &SearchLibrary, span: &Span) -> Sums {
        let sums = library.support(span.clip).between(span.from, span.to);
        sums.raised(span.world_from_clip.level_m)
    }

    fn total(&self, library: &SearchLibrary, target: &Target) -> f32 {
        let mut score = target.weights.continuity * self.cuts_cost;
        score += target.frames_cost(self.n_frames);
        if !score.is_finite() {
            return f32::INFINITY;
        }
        let moved = self.world_from_laid(library, target);
        let mut body = 0.0;
        for inner in &target.inner {
            body += inner.cost(moved * self.torso(library, inner.frame));
        }
        if let Some(last) = &target.last {
            body += last.cost(moved * self.end);
        }
        score += target.weights.body * body;
        if target.on_the_floor && library.leaves_the_floor() {
            let frame_secs = library.clips().fps().frame_secs() as f32;
            let sums = self
                .spans
                .iter()
                .fold(Sums::default(), |sum, span| sum.plus(&self.support(library, span)));
            score += target.weights.environment * sums.cost_at(moved.level_m, frame_secs);
        }
        score
    }
}
