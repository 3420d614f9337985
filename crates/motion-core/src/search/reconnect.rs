//! AF02's reconnection by 0 hops: one edge from any piece to any piece.

use super::evaluate::Evaluator;
use super::library::walk_shifts;
use super::mutation::Mutation;
use super::tables::SpanTable;

impl Evaluator<'_> {
    /// Every leaf edge that joins any piece to any piece: AF02's reconnection by 0 hops.
    pub(crate) fn reconnect(&mut self) {
        for keep in self.window.clone() {
            for resume in self.window.clone() {
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
        let window = self.frames_window(latest_exit(head), self.best.limit() - base);
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
                self.consider_tail(at_cut, tail, cut.to, mutation, at_cut.frames, |_| 0.0);
            }
            true
        });
        self.counts.pruned += left_out;
    }
}

/// The last frame of the motion at which a piece could be left.
fn latest_exit(head: &SpanTable) -> u32 {
    head.span.frame_of(head.torso.len() as u32)
}
