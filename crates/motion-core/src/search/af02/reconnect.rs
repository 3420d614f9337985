//! AF02's first mutation: a portion of the path deleted and replaced by 0 or 1 hops of G′.

use crate::search::evaluate::Evaluator;
use crate::search::mutation::Mutation;
use crate::search::rivals::CoarseGraph;
use crate::search::stretch::Stretch;

impl Evaluator<'_> {
    /// Every two edges of the path with all between them deleted, the pieces reconnected by every
    /// edge and every two edges of the coarsest graph.
    ///
    /// The path's first and last pieces stay, as in the paper. Hard frames do too: the scoring rejects
    /// what deletes them.
    pub(crate) fn reconnect_coarse(&mut self, graph: &CoarseGraph) {
        let (tables, library) = (self.tables, self.library);
        let continuity = self.target.weights.continuity;
        for keep in 0..tables.spans.len() {
            let head = &tables.spans[keep];
            let clip = head.span.clip;
            // 0 hops: one edge.
            for resume in keep..tables.spans.len() {
                let tail = &tables.spans[resume];
                let present = (resume == keep + 1).then(|| self.route.path.cuts[keep]);
                for cut in graph.pair(clip, tail.span.clip) {
                    let fits = cut.from > head.span.from && cut.to < tail.span.to;
                    if fits && Some(cut.id) != present {
                        let mutation = Mutation::Reconnect { keep, resume, cut: cut.id };
                        let at_cut = self.head(head, &cut);
                        self.consider_tail(at_cut, tail, cut.to, mutation, at_cut.frames, |_| 0.0);
                    }
                }
            }
            // 1 hop: two edges through another clip.
            for nth in graph.out(clip, head.span.from + 1..u32::MAX) {
                let (middle, out) = graph.cut(nth);
                let so_far = head.head_cost[out.from as usize] + continuity * out.cost;
                if so_far >= self.best.limit() {
                    self.counts.pruned += 1;
                    continue;
                }
                let at_out = self.head(head, &out);
                let world_from_clip =
                    at_out.torso * library.torsos(middle)[out.to as usize].inverse();
                for resume in keep..tables.spans.len() {
                    let tail = &tables.spans[resume];
                    for back in graph.pair(middle, tail.span.clip) {
                        if back.from <= out.to || back.to >= tail.span.to {
                            continue;
                        }
                        // The cheap terms first.
                        let frames = i64::from(at_out.frames) + back.shift() - i64::from(out.to)
                            + tail.frames_from_zero;
                        let cost = so_far
                            + continuity * (back.cost + tail.cuts_after)
                            + self.target.frames_cost(frames.max(0) as u32);
                        if cost >= self.best.limit() {
                            self.counts.pruned += 1;
                            continue;
                        }
                        let (from, to) = (out.to, back.from);
                        let starts_at = at_out.frames;
                        let stretch =
                            Stretch { clip: middle, world_from_clip, from, to, starts_at };
                        let through = self.through(&at_out, &stretch, &back);
                        let mutation =
                            Mutation::Detour { keep, resume, out: out.id, back: back.id };
                        let target = self.target;
                        self.consider_tail(
                            through,
                            tail,
                            back.to,
                            mutation,
                            stretch.starts_at,
                            |budget| stretch.cost(library, target, budget),
                        );
                    }
                }
            }
        }
    }
}
