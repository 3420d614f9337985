//! The score of every mutation of a route, each in O(1) of the motion's length.
//!
//! A candidate is a head (a stretch of the route up to a frame of one of its pieces, or a new
//! start), perhaps a stretch of another clip, and a tail (the route from a frame of one of its
//! pieces, or a new end). With the sums of [`Tables`], its whole score `S` takes two products
//! of planar transforms; the cheap terms come first, and a candidate is dropped as soon as they
//! alone are no better than what is kept. `brute` holds the twin that lays every path out.

use super::landing::{Landings, Scan};
use super::library::{Cut, PairView, SearchLibrary, walk_shifts};
use super::mutation::{Mutation, StructureKey};
use super::problem::Target;
use super::route::Route;
use super::tables::{SpanTable, Tables};
use crate::constraint::environment::Sums;
use crate::graph::{EdgeId, Forest};
use crate::ids::ClipId;
use crate::planar::PlanarTransform;
use crate::units::FrameIdx;

/// How far, in frames, the two cuts of a piece are moved together.
const REJOIN_REACH: u32 = 10;

/// How many candidates were looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScoreCounts {
    /// Candidates whose whole score was computed.
    pub scored: u64,
    /// Candidates shown to be no better by a part of their score.
    pub pruned: u64,
}

impl ScoreCounts {
    pub(crate) fn add(&mut self, other: Self) {
        self.scored += other.scored;
        self.pruned += other.pruned;
    }
}

/// A mutation and the score that it leads to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) mutation: Mutation,
    pub(crate) score: f32,
}

/// The best few candidates, one per structure.
#[derive(Clone, Debug)]
pub(crate) struct Best {
    kept: Vec<(StructureKey, Candidate)>,
    n_max: usize,
    ceiling: f32,
    least: f32,
}

impl Best {
    pub(crate) fn new(n_max: usize, ceiling: f32) -> Self {
        Self { kept: Vec::with_capacity(n_max + 1), n_max, ceiling, least: f32::INFINITY }
    }

    /// Remembers the least score alone, so that no candidate is ever dropped for being no better.
    pub(crate) fn of_all() -> Self {
        Self::new(0, f32::INFINITY)
    }

    /// Candidates that do not score below this are of no interest.
    #[inline]
    pub(crate) fn limit(&self) -> f32 {
        if self.kept.len() < self.n_max {
            return self.ceiling;
        }
        self.kept.last().map_or(self.ceiling, |(_, c)| c.score)
    }

    fn offer(&mut self, forest: &Forest, candidate: Candidate) {
        self.least = self.least.min(candidate.score);
        if self.n_max == 0 {
            return;
        }
        let key = candidate.mutation.structure(forest);
        if let Some(same) = self.kept.iter().position(|(k, _)| *k == key) {
            if self.kept[same].1.score <= candidate.score {
                return;
            }
            self.kept.remove(same);
        }
        let at = self.kept.partition_point(|(_, c)| c.score <= candidate.score);
        self.kept.insert(at, (key, candidate));
        self.kept.truncate(self.n_max);
    }

    /// The best score offered.
    pub(crate) fn least(&self) -> Option<f32> {
        self.least.is_finite().then_some(self.least)
    }

    /// The candidates, best first.
    pub(crate) fn candidates(&self) -> impl Iterator<Item = Candidate> + '_ {
        self.kept.iter().map(|(_, c)| *c)
    }
}

/// What has been shown when a cut is made: its cost, its frames, and the torso at the cut.
#[derive(Clone, Copy)]
struct Head {
    torso: PlanarTransform,
    frames: u32,
    cost: f32,
    support: Option<Sums>,
}

/// A way out of the route into another clip.
struct Way<'a> {
    keep: usize,
    out: &'a Cut,
    clip: ClipId,
    world_from_clip: PlanarTransform,
    /// What was shown before, the cost of `out` counted.
    head: Head,
}

/// Scores mutations of one route.
pub(crate) struct Evaluator<'a> {
    library: &'a SearchLibrary,
    target: &'a Target,
    allowed: &'a [bool],
    bridges: bool,
    route: &'a Route,
    tables: &'a Tables,
    /// The route can be scored by its parts only when it is anchored at its first frame.
    by_parts: bool,
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
    fn usable(&self, pair: &PairView<'_>, cut: &Cut) -> bool {
        self.bridges || cut.id.0 < pair.first_bridge
    }

    /// Every leaf edge that joins any piece to any piece: AF02's reconnection by 0 hops.
    pub(crate) fn reconnect(&mut self) {
        for keep in 0..self.tables.spans.len() {
            for resume in 0..self.tables.spans.len() {
                self.reconnect_pair(keep, resume);
            }
        }
    }

    fn reconnect_pair(&mut self, keep: usize, resume: usize) {
        let tables = self.tables;
        let (head, tail) = (&tables.spans[keep], &tables.spans[resume]);
        let Some(pair) = self.library.pair(head.span.clip, tail.span.clip) else { return };
        let continuity = self.target.weights.continuity;
        let base = continuity * (head.span.cuts_before + tail.cuts_after);
        let present = (resume == keep + 1).then(|| self.route.path.cuts[keep]);
        // The length of the motion is this and the cut's shift.
        let unshifted =
            i64::from(head.span.starts_at) - i64::from(head.span.from) + tail.frames_from_zero;
        let window = self.target.frames_window(self.best.limit() - base);
        let shifts = (window.0 - unshifted, window.1 - unshifted);
        let left_out = walk_shifts(pair.leaves, shifts, |cut| {
            let so_far = base
                + continuity * cut.cost
                + self.target.frames_cost((unshifted + cut.shift()) as u32);
            if so_far >= self.best.limit() {
                return false;
            }
            let within = cut.from > head.span.from && cut.to < tail.span.to;
            if within && Some(cut.id) != present && self.usable(&pair, cut) {
                let at_cut = self.head(head, cut);
                let mutation = Mutation::Reconnect { keep, resume, cut: cut.id };
                self.consider_tail(at_cut, tail, cut.to, mutation, |_| None);
            }
            true
        });
        self.counts.pruned += left_out;
    }

    /// The head that leaves a piece by `cut`; the cost of the cut is in it.
    #[inline]
    fn head(&self, table: &SpanTable, cut: &Cut) -> Head {
        let from = cut.from as usize;
        Head {
            torso: table.torso[from],
            frames: table.span.frame_of(cut.from),
            cost: table.head_cost[from] + self.target.weights.continuity * cut.cost,
            support: None,
        }
    }

    /// Through a stretch of another clip: two chosen cuts, AF02's reconnection by 1 hop.
    ///
    /// Of the pieces to come back to and of the ways out only those that `pick` draws are looked
    /// at; of these, every candidate is scored or bounded.
    pub(crate) fn detours(&mut self, mut pick: impl FnMut() -> bool) {
        let (tables, library) = (self.tables, self.library);
        let forest = &library.graph().forest;
        let bridges = self.bridges;
        let usable = |pair: &PairView<'_>, id: EdgeId| bridges || id.0 < pair.first_bridge;
        let landings = Landings::new(library, tables, self.allowed.len(), usable);
        for (keep, head) in tables.spans.iter().enumerate() {
            // The pieces to come back to, each with the numbers of frames that may still do.
            let continuity = self.target.weights.continuity;
            let resumes: Vec<(usize, (i64, i64))> = (0..tables.spans.len())
                .filter(|_| pick())
                .map(|resume| {
                    let cuts = head.span.cuts_before + tables.spans[resume].cuts_after;
                    let budget = self.best.limit() - continuity * cuts;
                    (resume, self.target.frames_window(budget))
                })
                .collect();
            if resumes.is_empty() {
                continue;
            }
            let out = library.out(head.span.clip);
            let first = out.partition_point(|(_, cut)| cut.from <= head.span.from);
            for &(middle, cut) in &out[first..] {
                let so_far = head.head_cost[cut.from as usize] + continuity * cut.cost;
                let usable = self.allowed[middle.idx()]
                    && so_far < self.best.limit()
                    && (bridges || !forest.is_bridge(cut.id));
                if !usable || !pick() {
                    continue;
                }
                let at_out = self.head(head, &cut);
                let torsos = library.torsos(middle);
                let way = Way {
                    keep,
                    out: &cut,
                    clip: middle,
                    world_from_clip: at_out.torso * torsos[cut.to as usize].inverse(),
                    head: at_out,
                };
                // At least a frame of the other clip is shown, at most the rest of it.
                let shortest = i64::from(at_out.frames) + 1;
                let longest = i64::from(at_out.frames) + torsos.len() as i64 - i64::from(cut.to);
                for &(resume, window) in &resumes {
                    let tail = &tables.spans[resume];
                    let rest = tail.frames_from_zero;
                    let within = shortest + rest - i64::from(tail.span.to) < window.1
                        && longest + rest >= window.0;
                    if within {
                        self.land(&landings, &way, resume);
                    }
                }
            }
        }
    }

    /// Every chosen way back from a detour into piece `resume`.
    fn land(&mut self, landings: &Landings, way: &Way<'_>, resume: usize) {
        let tail = &self.tables.spans[resume];
        let scan = Scan {
            world_from_clip: way.world_from_clip,
            base: way.head.cost + self.target.weights.continuity * tail.cuts_after,
            unshifted: i64::from(way.head.frames) - i64::from(way.out.to) + tail.frames_from_zero,
            // A little slack: the bound and the score round differently.
            limit: if self.by_parts { self.best.limit() * 1.0001 } else { f32::INFINITY },
        };
        let forest = &self.library.graph().forest;
        let per_tau = (1.0 / self.library.graph().tau) as f32;
        let left_out = landings.scan(self.target, (way.clip, resume), &scan, |id| {
            let edge = forest.edge(id);
            let (from, to) = (edge.from_frame.0, edge.to_frame.0);
            if from > way.out.to {
                let back = Cut { from, to, cost: edge.cost * per_tau, id };
                self.consider_detour(way, resume, &back);
            }
        });
        self.counts.pruned += left_out;
    }

    #[inline]
    fn consider_detour(&mut self, way: &Way<'_>, resume: usize, back: &Cut) {
        let (left_at, entered) = (way.head.frames, way.out.to);
        let torsos = self.library.torsos(way.clip);
        let head = self.through(&way.head, way.world_from_clip, way.clip, entered, back);
        let mutation = Mutation::Detour { keep: way.keep, resume, out: way.out.id, back: back.id };
        let tail = &self.tables.spans[resume];
        self.consider_tail(head, tail, back.to, mutation, |frame| {
            (frame >= left_at).then(|| {
                let shown = entered + (frame - left_at);
                way.world_from_clip * torsos[shown as usize]
            })
        });
    }

    /// Both cuts of each inner piece chosen anew among the leaves near them: a detour through
    /// the clip that is there already.
    pub(crate) fn rejoin(&mut self) {
        let (tables, library) = (self.tables, self.library);
        for keep in 0..tables.spans.len().saturating_sub(2) {
            let resume = keep + 2;
            let (head, tail) = (&tables.spans[keep], &tables.spans[resume]);
            let middle = tables.spans[keep + 1].span;
            let (Some(out), Some(back)) = (
                library.pair(head.span.clip, middle.clip),
                library.pair(middle.clip, tail.span.clip),
            ) else {
                continue;
            };
            let near = |cuts: &[Cut], from: u32, to: u32| -> Vec<Cut> {
                let is_near = |cut: &&Cut| {
                    cut.from.abs_diff(from) <= REJOIN_REACH && cut.to.abs_diff(to) <= REJOIN_REACH
                };
                cuts.iter().filter(is_near).copied().collect()
            };
            let out_cuts = near(out.leaves, head.span.to, middle.from);
            let back_cuts = near(back.leaves, middle.to, tail.span.from);
            let torsos = library.torsos(middle.clip);
            let base = head.span.cuts_before + tail.cuts_after;
            for cut in &out_cuts {
                let so_far = self.target.weights.continuity * (base + cut.cost + back.cheapest);
                let leaves = cut.from > head.span.from && self.usable(&out, cut);
                if !leaves || so_far >= self.best.limit() {
                    continue;
                }
                let at_out = self.head(head, cut);
                let way = Way {
                    keep,
                    out: cut,
                    clip: middle.clip,
                    world_from_clip: at_out.torso * torsos[cut.to as usize].inverse(),
                    head: at_out,
                };
                self.come_back(&way, resume, &back, &back_cuts);
            }
        }
    }

    /// Scores every way back from a stretch of another clip into piece `resume`.
    fn come_back(&mut self, way: &Way<'_>, resume: usize, back: &PairView<'_>, cuts: &[Cut]) {
        let tail = &self.tables.spans[resume];
        let continuity = self.target.weights.continuity;
        // The head's cost without that of checkpoints: a bound that is cheap to have.
        let base = way.head.cost + continuity * tail.cuts_after;
        let limit = self.best.limit();
        if base + continuity * back.cheapest >= limit {
            self.counts.pruned += cuts.len() as u64;
            return;
        }
        let (left_at, entered) = (way.head.frames, way.out.to);
        let unshifted = i64::from(left_at) - i64::from(entered) + tail.frames_from_zero;
        let window = self.target.frames_window(limit - base);
        let shifts = (window.0 - unshifted, window.1 - unshifted);
        let left_out = walk_shifts(cuts, shifts, |cut| {
            let so_far = base
                + continuity * cut.cost
                + self.target.frames_cost((unshifted + cut.shift()) as u32);
            if so_far >= self.best.limit() {
                return false;
            }
            if cut.from > entered && cut.to < tail.span.to && self.usable(back, cut) {
                self.consider_detour(way, resume, cut);
            }
            true
        });
        self.counts.pruned += left_out;
    }

    /// The head after frames `entered..back.from` of `clip`; the cost of `back` is in it, that
    /// of checkpoints within the stretch is not.
    #[inline]
    fn through(
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

    /// Scores `head` followed by the route from frame `entered` of `tail` and keeps it if good.
    ///
    /// `between(frame)` gives torsos at frames of a stretch between the head's last cost and
    /// `head.frames` whose checkpoints have not been counted yet.
    #[inline]
    fn consider_tail(
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
        let mut cost = cost;
        if let Some(last) = &target.last {
            let end = head.torso * tail.end_from_torso[entered as usize];
            cost += weights.body * last.place_cost(end);
            if cost + weights.body * last.heading_cost_at_least(end) >= limit {
                self.counts.pruned += 1;
                return;
            }
            cost += weights.body * last.heading_cost(end);
        }
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
    fn keep(&mut self, mutation: Mutation, score: f32) {
        self.counts.scored += 1;
        if score < self.best.limit() {
            self.best.offer(&self.library.graph().forest, Candidate { mutation, score });
        }
    }

    /// Scores a mutation by laying the changed path out.
    fn consider_whole(&mut self, mutation: Mutation) {
        let path = mutation.apply(&self.route.path, &self.library.graph().forest);
        match Route::new(self.library, self.target, path) {
            Some(route) => self.keep(mutation, route.score),
            None => self.counts.pruned += 1,
        }
    }

    /// Other first and last frames of the first and last clip.
    pub(crate) fn move_ends(&mut self) {
        let first = &self.route.spans[0];
        for start in 0..first.to {
            if start != first.from {
                let n_frames = self.route.n_frames + first.from - start;
                let mutation = Mutation::MoveStart { start: FrameIdx(start) };
                self.consider_moved_end(n_frames, mutation);
            }
        }
        let last = self.route.spans[self.route.spans.len() - 1];
        for end in last.from..self.library.n_frames(last.clip) {
            if end + 1 != last.to {
                let n_frames = self.route.n_frames + end + 1 - last.to;
                let mutation = Mutation::MoveEnd { end: FrameIdx(end) };
                self.consider_moved_end(n_frames, mutation);
            }
        }
    }

    fn consider_moved_end(&mut self, n_frames: u32, mutation: Mutation) {
        let continuity = self.target.weights.continuity * self.route.cuts_cost;
        if continuity + self.target.frames_cost(n_frames) >= self.best.limit() {
            self.counts.pruned += 1;
        } else {
            self.consider_whole(mutation);
        }
    }

    /// New starts: a chosen cut into any piece from any clip, entered so that the length comes
    /// out as wished or `slack` frames beside it.
    pub(crate) fn new_starts(&mut self, slack: &[i64]) {
        let Some(wished) = self.target.frames else { return };
        let (tables, library) = (self.tables, self.library);
        let continuity = self.target.weights.continuity;
        for (resume, tail) in tables.spans.iter().enumerate() {
            for (nth, &(clip, cut)) in library.into(tail.span.clip).iter().enumerate() {
                let so_far = continuity * (cut.cost + tail.cuts_after);
                if so_far >= self.best.limit() {
                    // Cheapest first: those that follow cost no less.
                    let left = library.into(tail.span.clip).len() - nth;
                    self.counts.pruned += (left * slack.len()) as u64;
                    break;
                }
                if cut.to >= tail.span.to
                    || !self.allowed[clip.idx()]
                    || (!self.bridges && library.graph().forest.is_bridge(cut.id))
                {
                    continue;
                }
                let rest = tail.frames_from_zero - i64::from(cut.to);
                for &slack in slack {
                    let shown = i64::from(wished) + slack - rest;
                    if shown < 1 || shown > i64::from(cut.from) {
                        continue;
                    }
                    let start = cut.from - shown as u32;
                    let torsos = library.torsos(clip);
                    let world_from_clip = self.target.anchor * torsos[start as usize].inverse();
                    let nothing =
                        Head { torso: self.target.anchor, frames: 0, cost: 0.0, support: None };
                    let head = self.through(&nothing, world_from_clip, clip, start, &cut);
                    let mutation =
                        Mutation::NewStart { resume, start: FrameIdx(start), cut: cut.id };
                    self.consider_tail(head, tail, cut.to, mutation, |frame| {
                        Some(world_from_clip * torsos[(start + frame) as usize])
                    });
                }
            }
        }
    }

    /// New ends: a chosen cut out of any piece, ended so that the length comes out as wished or
    /// `slack` frames beside it.
    pub(crate) fn new_ends(&mut self, slack: &[i64]) {
        let Some(wished) = self.target.frames else { return };
        let (tables, library) = (self.tables, self.library);
        let continuity = self.target.weights.continuity;
        for (keep, head) in tables.spans.iter().enumerate() {
            let out = library.out(head.span.clip);
            let first = out.partition_point(|(_, cut)| cut.from <= head.span.from);
            for &(clip, cut) in &out[first..] {
                let so_far = head.head_cost[cut.from as usize] + continuity * cut.cost;
                if so_far >= self.best.limit() {
                    self.counts.pruned += slack.len() as u64;
                    continue;
                }
                if !self.allowed[clip.idx()]
                    || (!self.bridges && library.graph().forest.is_bridge(cut.id))
                {
                    continue;
                }
                let at_cut = self.head(head, &cut);
                let torsos = library.torsos(clip);
                let world_from_clip = at_cut.torso * torsos[cut.to as usize].inverse();
                for &slack in slack {
                    let shown = i64::from(wished) + slack - i64::from(at_cut.frames);
                    let end = i64::from(cut.to) + shown - 1;
                    if shown < 1 || end >= torsos.len() as i64 {
                        continue;
                    }
                    let mutation =
                        Mutation::NewEnd { keep, cut: cut.id, end: FrameIdx(end as u32) };
                    self.consider_end(
                        &at_cut,
                        world_from_clip,
                        clip,
                        (cut.to, end as u32),
                        mutation,
                    );
                }
            }
        }
    }

    /// Scores `head` followed by frames `from..=end` of `clip`.
    #[inline]
    fn consider_end(
        &mut self,
        head: &Head,
        world_from_clip: PlanarTransform,
        clip: ClipId,
        (from, end): (u32, u32),
        mutation: Mutation,
    ) {
        let limit = self.best.limit();
        let target = self.target;
        let weights = target.weights;
        let n_frames = head.frames + (end + 1 - from);
        let mut cost = head.cost + target.frames_cost(n_frames);
        if cost >= limit {
            self.counts.pruned += 1;
            return;
        }
        if !self.by_parts {
            self.consider_whole(mutation);
            return;
        }
        let torsos = self.library.torsos(clip);
        if let Some(last) = &target.last {
            let at_end = world_from_clip * torsos[end as usize];
            cost += weights.body * last.place_cost(at_end);
            if cost + weights.body * last.heading_cost_at_least(at_end) >= limit {
                self.counts.pruned += 1;
                return;
            }
            cost += weights.body * last.heading_cost(at_end);
        }
        for inner in target.inner.iter().rev() {
            if inner.frame < head.frames {
                break;
            }
            let shown = from + (inner.frame - head.frames);
            cost += weights.body * inner.cost(world_from_clip * torsos[shown as usize]);
        }
        if self.tables.uses_support {
            let sums = self.library.support(clip).between(from, end + 1);
            cost +=
                weights.environment * sums.cost_at(world_from_clip.level_m, self.tables.frame_secs);
        }
        self.keep(mutation, cost);
    }

    /// Two cuts at once (and each alone) replaced by their children: AF02's refinement.
    ///
    /// These are few; what the cheap terms leave is scored by laying the path out.
    pub(crate) fn refine(&mut self) {
        let forest = &self.library.graph().forest;
        let cuts = &self.route.path.cuts;
        let options: Vec<Vec<EdgeId>> = cuts
            .iter()
            .map(|&cut| {
                let mut options = vec![cut];
                options.extend(forest.children(cut).into_iter().flatten());
                options
            })
            .collect();
        let per_tau = (1.0 / self.library.graph().tau) as f32;
        let cost_of = |id: EdgeId| forest.edge(id).cost * per_tau;
        for first in 0..cuts.len() {
            for second in first..cuts.len() {
                for &first_cut in &options[first] {
                    for &second_cut in &options[second] {
                        let changed = [first_cut != cuts[first], second_cut != cuts[second]];
                        let counts = if first == second {
                            changed[0] && first_cut == second_cut
                        } else {
                            // Single replacements are seen with `first == second`.
                            changed[0] && changed[1]
                        };
                        if !counts {
                            continue;
                        }
                        let mut sum =
                            self.route.cuts_cost + cost_of(first_cut) - cost_of(cuts[first]);
                        if first != second {
                            sum += cost_of(second_cut) - cost_of(cuts[second]);
                        }
                        if self.target.weights.continuity * sum >= self.best.limit() {
                            self.counts.pruned += 1;
                            continue;
                        }
                        let mutation = Mutation::Refine { first, first_cut, second, second_cut };
                        self.consider_whole(mutation);
                    }
                }
            }
        }
    }
}
