//! The score of every mutation of a route, each in O(1) of the motion's length.
//!
//! A candidate is a head (a stretch of the route up to a frame of one of its pieces, or a new
//! start), perhaps a stretch of another clip, and a tail (the route from a frame of one of its
//! pieces, or a new end). With the sums of [`Tables`], its whole score `S` takes a few products
//! of planar transforms; the cheap terms come first, and a candidate is dropped as soon as they
//! alone are no better than what is kept. Only what depends on the whole body along the way,
//! obstacles and other bodies, is looked at frame by frame, and last. `brute` holds the twin
//! that lays every path out.

use super::angle::heading_rad;
use super::best::{Best, Candidate, ScoreCounts};
use super::library::{Cut, PairView, SearchLibrary};
use super::mutation::Mutation;
use super::route::Route;
use super::stretch::Stretch;
use super::tables::{SpanTable, Tables};
use super::target::Target;
use crate::constraint::environment::Sums;
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
    /// The pieces that may be left and come back to: all, or a window of a long motion.
    pub(super) window: std::ops::Range<usize>,
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
        let window = 0..tables.spans.len();
        let counts = ScoreCounts::default();
        Self { library, target, allowed, bridges, route, tables, window, best, counts }
    }

    /// Looks at changes within these pieces only.
    pub(crate) fn within(mut self, window: std::ops::Range<usize>) -> Self {
        self.window = window;
        self
    }

    #[inline]
    pub(super) fn usable(&self, pair: &PairView<'_>, cut: &Cut) -> bool {
        self.bridges || cut.id.0 < pair.first_bridge
    }

    /// The numbers of frames worth a look of motions whose head is left no later than at `left_at`:
    /// where something hard is still to come then, only the route's own.
    #[inline]
    pub(super) fn frames_window(&self, left_at: u32, budget: f32) -> (i64, i64) {
        let window = self.target.frames_window(budget);
        if self.target.is_hard_after(left_at) {
            let n_frames = i64::from(self.route.n_frames);
            return (window.0.max(n_frames), window.1.min(n_frames));
        }
        window
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

    /// The head after a stretch of another clip; the cost of `back` is in it, that of what is read
    /// within the stretch is not.
    #[inline]
    pub(super) fn through(&self, head: &Head, stretch: &Stretch, back: &Cut) -> Head {
        let torsos = self.library.torsos(stretch.clip);
        Head {
            torso: stretch.world_from_clip * torsos[back.from as usize],
            frames: stretch.ends_at(),
            cost: head.cost + self.target.weights.continuity * back.cost,
            support: self.tables.uses_support.then(|| stretch.support(self.library)),
        }
    }

    /// Scores `head` followed by the route from frame `entered` of `tail` and keeps it if good.
    ///
    /// The route itself is left at `left_at`; what is shown from there to the head's end costs `between(budget)`,
    /// or at least the budget where it is that much, beside what is in the head's cost.
    #[inline]
    pub(super) fn consider_tail(
        &mut self,
        head: Head,
        tail: &SpanTable,
        entered: u32,
        mutation: Mutation,
        left_at: u32,
        between: impl FnOnce(f32) -> f32,
    ) {
        let limit = self.best.limit();
        let n_frames = i64::from(head.frames) + tail.frames_from_zero - i64::from(entered);
        if n_frames > i64::from(u32::MAX) {
            return;
        }
        let (library, target) = (self.library, self.target);
        let late = n_frames - i64::from(self.route.n_frames);
        if !target.keeps_hard(left_at, head.frames, late) {
            return;
        }
        let weights = target.weights;
        let mut cost =
            head.cost + weights.continuity * tail.cuts_after + target.frames_cost(n_frames as u32);
        // `head.cost` may be infinite where a piece cannot be left; `>=` drops that too.
        if cost >= limit {
            self.counts.pruned += 1;
            return;
        }
        if left_at <= target.anchor_frame && target.anchor_frame > 0 {
            // What places the motion is itself changed.
            self.consider_whole(mutation);
            return;
        }
        let moved = head.torso * tail.torso[entered as usize].inverse();
        // What is read in the piece before the route shows it; then what the sums know.
        let first = target.first_reading_from(head.frames);
        let shown_from = i64::from(tail.span.starts_at) + late;
        let mut known = first;
        if entered < tail.span.from {
            while known < target.readings.len()
                && i64::from(target.readings[known].frame) < shown_from
            {
                known += 1;
            }
        }
        match self.tables.moments(library, target, self.route, (known, late)) {
            Some(sums) => {
                cost += sums.place_cost(moved);
                if sums.has_turn() {
                    // The bound first: it needs no arc tangent.
                    if cost + sums.turn_cost_at_least(moved) >= limit {
                        self.counts.pruned += 1;
                        return;
                    }
                    cost += match sums.turn_cost(heading_rad(moved)) {
                        Some(turn) => turn,
                        None => self.tail_cost_slowly(moved, known, late) - sums.place_cost(moved),
                    };
                }
            }
            None => cost += self.tail_cost_slowly(moved, known, late),
        }
        let in_tail = moved * tail.span.world_from_clip;
        for reading in &target.readings[first..known] {
            let clip_frame = entered + (reading.frame - head.frames);
            cost += reading.cost(library, in_tail, tail.span.clip, clip_frame);
        }
        cost += between(limit - cost);
        if !target.styles.is_empty() {
            cost += self.tables.tail_styles_cost(target, tail, entered, head.frames);
        }
        if self.tables.uses_support {
            let raise = moved.level_m;
            let own = library.support(tail.span.clip).between(entered, tail.span.to);
            let own = own.raised(tail.span.world_from_clip.level_m + raise);
            let sums = own.plus(&tail.support_after.raised(raise));
            let sums = head.support.map_or(sums, |between| sums.plus(&between));
            cost += weights.environment * sums.cost_at(0.0, self.tables.frame_secs);
        }
        if target.has_surroundings() && cost < limit {
            cost += self.tables.tail_surroundings_cost(
                library,
                target,
                (tail, entered, head.frames),
                (moved, late),
                limit - cost,
            );
        }
        self.keep(mutation, cost);
    }

    /// The cost of the readings from the `first`-th on and of the last checkpoint, one by one.
    fn tail_cost_slowly(&self, moved: PlanarTransform, first: usize, late: i64) -> f32 {
        let (library, target, route) = (self.library, self.target, self.route);
        let mut cost = 0.0;
        for reading in &target.readings[first..] {
            let old = i64::from(reading.frame) - late;
            if (0..i64::from(route.n_frames)).contains(&old) {
                let span = route.span_at(old as u32);
                let clip_frame = span.from + old as u32 - span.starts_at;
                cost += reading.cost(library, moved * span.world_from_clip, span.clip, clip_frame);
            }
        }
        if let Some(wish) = &target.last {
            let last = route.spans[route.spans.len() - 1];
            cost += wish.cost(library, moved * last.world_from_clip, last.clip, last.to - 1);
        }
        cost
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
