//! One list of cuts of the library as a graph: those that leave a clip, those between two clips.

use std::ops::Range;

use crate::ids::ClipId;
use crate::search::library::{Cut, SearchLibrary};

/// Cuts that may be used, each with a number of its own.
#[derive(Clone, Debug)]
pub(crate) struct CoarseGraph {
    /// By the clip left, then the frame left.
    cuts: Vec<(ClipId, Cut)>,
    /// Where each clip's cuts begin.
    starts: Vec<u32>,
    /// Cuts by pair of clips, for each clip by the clip entered: indices into `cuts`.
    by_pair: Vec<u32>,
    /// Where pair `(from, to)` begins in `by_pair`: entry `from · n_clips + to`.
    pair_starts: Vec<u32>,
}

impl CoarseGraph {
    /// The roots of the edges' trees: the graph G′ of AF02, with mean frames and mean costs.
    pub(crate) fn of_roots(library: &SearchLibrary, scope: (&[bool], bool)) -> Self {
        Self::new(library, scope, |clip| library.coarse_out(clip))
    }

    /// The cheapest leaf under each root: the coarse graph as cuts that can be shown as they are.
    pub(crate) fn of_chosen(library: &SearchLibrary, scope: (&[bool], bool)) -> Self {
        Self::new(library, scope, |clip| library.out(clip))
    }

    fn new<'a>(
        library: &SearchLibrary,
        (allowed, bridges): (&[bool], bool),
        out: impl Fn(ClipId) -> &'a [(ClipId, Cut)],
    ) -> Self {
        let n_clips = library.graph().n_clips();
        let forest = &library.graph().forest;
        let mut new = Self {
            cuts: Vec::new(),
            starts: vec![0],
            by_pair: Vec::new(),
            pair_starts: vec![0; n_clips * n_clips + 1],
        };
        for left in (0..n_clips).map(ClipId::from_idx) {
            let usable = |(to, cut): &&(ClipId, Cut)| {
                allowed[left.idx()]
                    && allowed[to.idx()]
                    && (bridges || !forest.is_bridge(cut.id))
                    // A cut before the first frame leaves nothing to show.
                    && cut.from > 0
            };
            let first = new.cuts.len() as u32;
            new.cuts.extend(out(left).iter().filter(usable));
            let end = new.cuts.len() as u32;
            new.starts.push(end);
            let mut by_pair: Vec<u32> = (first..end).collect();
            by_pair.sort_by_key(|&nth| new.cuts[nth as usize].0);
            for &nth in &by_pair {
                let to = new.cuts[nth as usize].0;
                new.pair_starts[left.idx() * n_clips + to.idx() + 1] += 1;
            }
            new.by_pair.extend(by_pair);
        }
        for pair in 0..n_clips * n_clips {
            new.pair_starts[pair + 1] += new.pair_starts[pair];
        }
        new
    }

    /// Cuts in all.
    pub(crate) fn n_cuts(&self) -> usize {
        self.cuts.len()
    }

    fn n_clips(&self) -> usize {
        self.starts.len() - 1
    }

    /// A cut by its number, with the clip that it enters.
    #[inline]
    pub(crate) fn cut(&self, nth: usize) -> (ClipId, Cut) {
        self.cuts[nth]
    }

    /// Numbers of the cuts that leave `clip` within `frames`, by the frame left.
    #[inline]
    pub(crate) fn out(&self, clip: ClipId, frames: Range<u32>) -> Range<usize> {
        let (start, end) = (self.starts[clip.idx()] as usize, self.starts[clip.idx() + 1] as usize);
        let cuts = &self.cuts[start..end];
        let first = cuts.partition_point(|(_, cut)| cut.from < frames.start);
        let last = cuts.partition_point(|(_, cut)| cut.from < frames.end);
        start + first..start + last.max(first)
    }

    /// The cuts from a clip to another, by the frame left.
    #[inline]
    pub(crate) fn pair(&self, from: ClipId, to: ClipId) -> impl Iterator<Item = Cut> + '_ {
        let pair = from.idx() * self.n_clips() + to.idx();
        let range = self.pair_starts[pair] as usize..self.pair_starts[pair + 1] as usize;
        self.by_pair[range].iter().map(|&nth| self.cuts[nth as usize].1)
    }
}
