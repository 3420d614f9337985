//! Other starts and other ends.

use super::evaluate::{Evaluator, Head};
use super::mutation::Mutation;
use super::stretch::Stretch;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;
use crate::units::FrameIdx;

impl Evaluator<'_> {
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
        for resume in self.window.clone() {
            let tail = &tables.spans[resume];
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
                    let stretch =
                        Stretch { clip, world_from_clip, from: start, to: cut.from, starts_at: 0 };
                    let head = self.through(&nothing, &stretch, &cut);
                    let mutation =
                        Mutation::NewStart { resume, start: FrameIdx(start), cut: cut.id };
                    let target = self.target;
                    self.consider_tail(head, tail, cut.to, mutation, stretch.starts_at, |budget| {
                        stretch.cost(library, target, budget)
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
        for keep in self.window.clone() {
            let head = &tables.spans[keep];
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
        let (library, target) = (self.library, self.target);
        let stretch = Stretch { clip, world_from_clip, from, to: end + 1, starts_at: head.frames };
        if !target.keeps_hard(head.frames, u32::MAX, 0) {
            return;
        }
        let mut cost = head.cost + target.frames_cost(stretch.ends_at());
        if cost >= limit {
            self.counts.pruned += 1;
            return;
        }
        if head.frames <= target.anchor_frame && target.anchor_frame > 0 {
            self.consider_whole(mutation);
            return;
        }
        if let Some(wish) = &target.last {
            cost += wish.cost(library, world_from_clip, clip, end);
            if cost >= limit {
                self.counts.pruned += 1;
                return;
            }
        }
        cost += stretch.cost(library, target, limit - cost);
        if self.tables.uses_support {
            let sums = stretch.support(library);
            cost += target.weights.environment * sums.cost_at(0.0, self.tables.frame_secs);
        }
        self.keep(mutation, cost);
    }
}
