//! AF02's reconnection by 1 hop: through a stretch of another clip. And the same for the clip
//! that is there already, with both cuts chosen anew.

use std::cell::RefCell;

use super::evaluate::{Evaluator, Head};
use super::landing::{Landings, Scan};
use super::library::{Cut, PairView, walk_shifts};
use super::mutation::Mutation;
use super::stretch::Stretch;
use super::unrolled::Unrolled;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;

/// How far, in frames, the two cuts of a piece are moved together.
const REJOIN_REACH: u32 = 10;

/// The same where each candidate that nothing else rules out is walked along: what is farther is reached in
/// more than one step.
const REJOIN_REACH_AROUND: u32 = 5;

/// A way out of the route into another clip.
struct Way<'a> {
    keep: usize,
    out: &'a Cut,
    clip: ClipId,
    world_from_clip: PlanarTransform,
    /// What was shown before, the cost of `out` counted.
    head: Head,
    /// What the clip costs from the entry on.
    through: RefCell<Unrolled>,
}

impl<'a> Way<'a> {
    fn new(keep: usize, out: &'a Cut, middle: (ClipId, &[PlanarTransform]), head: Head) -> Self {
        let (clip, torsos) = middle;
        let world_from_clip = head.torso * torsos[out.to as usize].inverse();
        let (from, to, starts_at) = (out.to, out.to, head.frames);
        let through = Unrolled::new(Stretch { clip, world_from_clip, from, to, starts_at });
        Self { keep, out, clip, world_from_clip, head, through: RefCell::new(through) }
    }
}

impl Evaluator<'_> {
    /// Through a stretch of another clip: two chosen cuts, AF02's reconnection by 1 hop.
    ///
    /// Of the pieces to come back to and of the ways out only those that `pick` draws are looked
    /// at; of these, every candidate is scored or bounded.
    pub(crate) fn detours(&mut self, mut pick: impl FnMut() -> bool) {
        let (tables, library) = (self.tables, self.library);
        let forest = &library.graph().forest;
        let bridges = self.bridges;
        let usable = |pair: &PairView<'_>, id: EdgeId| bridges || id.0 < pair.first_bridge;
        let window = self.window.clone();
        let landings = Landings::new(library, tables, window, self.allowed.len(), usable);
        for keep in self.window.clone() {
            let head = &tables.spans[keep];
            // The pieces to come back to, each with the numbers of frames that may still do.
            let continuity = self.target.weights.continuity;
            let latest = head.span.frame_of(head.torso.len() as u32);
            let resumes: Vec<(usize, (i64, i64))> = self
                .window
                .clone()
                .filter(|_| pick())
                .map(|resume| {
                    let cuts = head.span.cuts_before + tables.spans[resume].cuts_after;
                    let budget = self.best.limit() - continuity * cuts;
                    (resume, self.frames_window(latest, budget))
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
                let way = Way::new(keep, &cut, (middle, torsos), at_out);
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
            limit: self.best.limit() * 1.0001,
            n_frames_now: i64::from(self.route.n_frames),
            left_at: way.head.frames,
            entered: way.out.to,
            resumes_at: tail.span.starts_at,
        };
        let sums = |first: usize, late: i64| {
            self.tables.moments(self.library, self.target, self.route, (first, late))
        };
        let mut hits = Vec::new();
        let left_out =
            landings.scan(self.target, (way.clip, resume), &scan, sums, |back| hits.push(back));
        for back in hits {
            if back.from > way.out.to {
                self.consider_detour(way, resume, &back);
            }
        }
        self.counts.pruned += left_out;
    }

    #[inline]
    fn consider_detour(&mut self, way: &Way<'_>, resume: usize, back: &Cut) {
        let stretch = Stretch {
            clip: way.clip,
            world_from_clip: way.world_from_clip,
            from: way.out.to,
            to: back.from,
            starts_at: way.head.frames,
        };
        let head = self.through(&way.head, &stretch, back);
        let mutation = Mutation::Detour { keep: way.keep, resume, out: way.out.id, back: back.id };
        let tail = &self.tables.spans[resume];
        let (library, target, limit) = (self.library, self.target, self.best.limit());
        self.consider_tail(head, tail, back.to, mutation, way.head.frames, |_| {
            way.through.borrow_mut().cost_to(library, target, back.from, limit)
        });
    }

    /// Both cuts of each inner piece chosen anew among the leaves near them: a detour through
    /// the clip that is there already.
    pub(crate) fn rejoin(&mut self) {
        let (tables, library) = (self.tables, self.library);
        for keep in self.window.start..self.window.end.saturating_sub(2) {
            let resume = keep + 2;
            let (head, tail) = (&tables.spans[keep], &tables.spans[resume]);
            let middle = tables.spans[keep + 1].span;
            let (Some(out), Some(back)) = (
                library.pair(head.span.clip, middle.clip),
                library.pair(middle.clip, tail.span.clip),
            ) else {
                continue;
            };
            let around = self.target.has_surroundings();
            let reach = if around { REJOIN_REACH_AROUND } else { REJOIN_REACH };
            let near = |cuts: &[Cut], from: u32, to: u32| -> Vec<Cut> {
                let is_near =
                    |cut: &&Cut| cut.from.abs_diff(from) <= reach && cut.to.abs_diff(to) <= reach;
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
                let way = Way::new(keep, cut, (middle.clip, torsos), at_out);
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
        let window = self.frames_window(left_at, limit - base);
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
}
