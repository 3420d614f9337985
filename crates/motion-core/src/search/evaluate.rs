//! The score of every mutation of a route, each in O(1) of the motion's length.
//!
//! A candidate is a head (a stretch of the route up to a frame of one of its pieces, or a new
//! start), perhaps a stretch of another clip, and a tail (the route from a frame of one of its
//! pieces, or a new end). With the sums of [`Tables`], its whole score `S` takes two products
//! of planar transforms; the cheap terms come first, and a candidate is dropped as soon as they
//! alone are no better than what is kept. `brute` holds the twin that lays every path out.

use super::best::{Best, Candidate, ScoreCounts};
use super::library::{Cut, PairView, SearchLibrary};
use super::mutation::Mutation;
use super::problem::Target;
use super::route::Route;
use super::tables::{SpanTable, Tables};
use crate::constraint::environment::Sums;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;

/// What has been shown when a cut is made: its cost, its frames, and the torso at the cut.
#[derive(Clone, Copy)]
pub(super) struct Head {
    pub(super) torso: PlanarTransform,
    pub(super) frames: u32,
    pub(super) cost: f32,
    pub(super) support: Option<Sums>,
}

/// Scores mutations of one route.
pub(crate) struct Evaluator<'a> {
    pub(super) library: &'a SearchLibrary,
    pub(super) target: &'a Target,
    pub(super) allowed: &'a [bool],
    pub(super) bridges: bool,
    pub(super) route: &'a Route,
    pub(super) tables: &'a Tables,
    /// The route can be scored by its parts only when it is anchored at its first frame.
    pub(super) by_parts: bool,
    pub(crate) best: Best,
    pub(crate) counts: ScoreCounts,
}

impl<'a> Evaluator<'a> {
    pub(crate) fn new(
        library: &'a SearchLibrary,
        target: &'a Target,
        (allowed, bridges): (&'a [bool], bool),
        route: &'a Route,
        tables: &'a Tables,
        best: Best,
    ) -> Self {
        let by_parts = target.anchor_frame == 0;
        let counts = ScoreCounts::default();
        Self { library, target, allowed, bridges, route, tables, by_parts, best, counts }
    }

    #[inline]
    pub(super) fn usable(&self, pair: &PairView<'_>, cut: &Cut) -> bool {
        self.bridges || cut.id.0 < pair.first_bridge
    }

    /// The head that leaves a piece by `cut`; the cost of the cut is in it.
    #[inline]
    pub(super) fn head(&self, table: &SpanTable, cut: &Cut) -> Head {
        let from = cut.from as usize;
        Head {
            torso: table.torso[from],
            frames: table.span.frame_of(cut.from),
            cost: table.head_cost[from] + self.target.weights.continuity * cut.cost,
            support: None,
        }
    }

    /// The head after frames `entered..back.from` of `clip`; the cost of `back` is in it, that
    /// of checkpoints within the stretch is not.
    #[inline]
    pub(super) fn through(
        &self,
        head: &Head,
        world_from_clip: PlanarTransform,
        clip: ClipId,
        entered: u32,
        back: &Cut,
    ) -> Head {
        let torsos = self.library.torsos(clip);
        Head {
            torso: world_from_clip * torsos[back.from as usize],
            frames: head.frames + back.from - entered,
            cost: head.cost + self.target.weights.continuity * back.cost,
            support: self.tables.uses_support.then(|| {
                let sums = self.library.support(clip).between(entered, back.from);
                sums.raised(world_from_clip.level_m)
            }),
        }
    }

    /// `cost` with that of ending at `end` added; `None`, and counted, when that is no better than
    /// what is kept.
    #[inline]
    pub(super) fn with_end(&mut self, cost: f32, end: PlanarTransform) -> Option<f32> {
        let Some(last) = &self.target.last else { return Some(cost) };
        let body = self.target.weights.body;
        let cost = cost + body * last.place_cost(end);
        // The bound first: it needs no arc tangent.
        if cost + body * last.heading_cost_at_least(end) >= self.best.limit() {
            self.counts.pruned += 1;
            return None;
        }
        Some(cost + body * last.heading_cost(end))
    }

    /// Scores `head` followed by the route from frame `entered` of `tail` and keeps it if good.
    ///
    /// `between(frame)` gives torsos at frames of a stretch between the head's last cost and
    /// `head.frames` whose checkpoints have not been counted yet.
    #[inline]
    pub(super) fn consider_tail(
        &mut self,
        head: Head,
        tail: &SpanTable,
        entered: u32,
        mutation: Mutation,
        between: impl Fn(u32) -> Option<PlanarTransform>,
    ) {
        let limit = self.best.limit();
        let n_frames = i64::from(head.frames) + tail.frames_from_zero - i64::from(entered);
        if n_frames > i64::from(u32::MAX) {
            return;
        }
        let target = self.target;
        let weights = target.weights;
        let cost =
            head.cost + weights.continuity * tail.cuts_after + target.frames_cost(n_frames as u32);
        // `head.cost` may be infinite where a piece cannot be left; `>=` drops that too.
        if cost >= limit {
            self.counts.pruned += 1;
            return;
        }
        if !self.by_parts {
            self.consider_whole(mutation);
            return;
        }
        let end = head.torso * tail.end_from_torso[entered as usize];
        let Some(mut cost) = self.with_end(cost, end) else { return };
        for inner in target.inner.iter().rev() {
            let at = if inner.frame >= head.frames {
                let clip_frame = entered + (inner.frame - head.frames);
                let old = if clip_frame < tail.span.to {
                    tail.torso[clip_frame as usize]
                } else {
                    self.route.torso(self.library, tail.span.frame_of(clip_frame))
                };
                head.torso * tail.torso[entered as usize].inverse() * old
            } else {
                match between(inner.frame) {
                    Some(torso) => torso,
                    // All that come before are in the head's cost.
                    None => break,
                }
            };
            cost += weights.body * inner.cost(at);
        }
        if self.tables.uses_support {
            let raise = head.torso.level_m - tail.torso[entered as usize].level_m;
            let own = self.library.support(tail.span.clip).between(entered, tail.span.to);
            let own = own.raised(tail.span.world_from_clip.level_m + raise);
            let sums = own.plus(&tail.support_after.raised(raise));
            let sums = head.support.map_or(sums, |between| sums.plus(&between));
            cost += weights.environment * sums.cost_at(0.0, self.tables.frame_secs);
        }
        self.keep(mutation, cost);
    }

    #[inline]
    pub(super) fn keep(&mut self, mutation: Mutation, score: f32) {
        self.counts.scored += 1;
        if score < self.best.limit() {
            self.best.offer(&self.library.graph().forest, Candidate { mutation, score });
        }
    }

    /// Scores a mutation by laying the changed path out.
    pub(super) fn consider_whole(&mut self, mutation: Mutation) {
        let path = mutation.apply(&self.route.path, &self.library.graph().forest);
        match Route::new(self.library, self.target, path) {
            Some(route) => self.keep(mutation, route.score),
            None => self.counts.pruned += 1,
        }
    }
}
