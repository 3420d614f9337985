//! From anywhere to what is hard, at its very frame: a graph search on the coarse level.
//!
//! AF02 section 4.2: seeds grow from one hard frame to the next, and “since the path is sampled at
//! the coarse level, a graph search can also be performed between the constraint nodes”. It goes
//! backwards in time once, so that growing a seed is a walk among cuts that are known to lead there.

use crate::ids::ClipId;
use crate::path::Piece;
use crate::search::hard::HardStretch;
use crate::search::library::SearchLibrary;
use crate::search::target::Target;

use super::coarse::CoarseGraph;
use crate::graph::EdgeId;

/// The last so many frames before something hard are searched; before them a walk is free.
const HORIZON: u32 = 240;

/// The ways to one hard stretch.
#[derive(Clone, Debug)]
pub(crate) struct Approach {
    /// The motion's frame that shows its first frame.
    pub(crate) first: u32,
    /// The motion's last frame that it speaks of.
    pub(crate) last: u32,
    /// What is shown at `first`.
    clip: ClipId,
    clip_frame: u32,
    /// The pieces' own cuts.
    pub(crate) inner: Vec<EdgeId>,
    /// The last piece.
    pub(crate) ends_with: Piece,
    n_cuts: usize,
    /// Entry `t · n_cuts + c`: whether it can be shown exactly `t` frames after cut `c` was taken.
    leads: Vec<bool>,
}

impl Approach {
    /// `None` where the stretch has a cut that the library has not.
    fn new(
        library: &SearchLibrary,
        graph: &CoarseGraph,
        hard: &HardStretch,
        n_frames_before: u32,
    ) -> Option<Self> {
        let Piece { clip, from, .. } = *hard.pieces.first()?;
        let inner = hard.pieces.windows(2).map(|pair| {
            let leaves = library.pair(pair[0].clip, pair[1].clip)?.leaves;
            let joins = |cut: &&crate::search::library::Cut| {
                cut.from == pair[0].to.0 + 1 && cut.to == pair[1].from.0
            };
            leaves.iter().find(joins).map(|cut| cut.id)
        });
        let n_cuts = graph.n_cuts();
        let mut new = Self {
            first: hard.first,
            last: hard.last,
            clip,
            clip_frame: from.0,
            inner: inner.collect::<Option<_>>()?,
            ends_with: *hard.pieces.last()?,
            n_cuts,
            leads: Vec::new(),
        };
        for left in 0..=n_frames_before.min(HORIZON) {
            let mut row = vec![false; n_cuts];
            for (nth, leads) in row.iter_mut().enumerate() {
                let (entered, cut) = graph.cut(nth);
                // By another cut soon, or by staying.
                *leads = new.stays(entered, cut.to, left)
                    || graph.out(entered, cut.to + 1..cut.to + left + 1).any(|next| {
                        let later = left - (graph.cut(next).1.from - cut.to);
                        new.leads[later as usize * n_cuts + next]
                    });
            }
            new.leads.extend(row);
        }
        Some(new)
    }

    /// Whether staying in `clip` from `entered` on shows it after `left` frames.
    #[inline]
    pub(crate) fn stays(&self, clip: ClipId, entered: u32, left: u32) -> bool {
        clip == self.clip && entered + left == self.clip_frame
    }

    /// Whether a cut, taken `left` frames before it, may lead to it.
    #[inline]
    pub(crate) fn leads(&self, cut: usize, left: u32) -> bool {
        left > HORIZON || self.leads.get(left as usize * self.n_cuts + cut).is_some_and(|&l| l)
    }
}

/// The ways to everything hard, in the order of time.
#[derive(Clone, Debug)]
pub(crate) struct Approaches {
    all: Vec<Approach>,
    /// Whether something hard is shaped so that no path can show it.
    is_hopeless: bool,
}

impl Approaches {
    pub(crate) fn new(library: &SearchLibrary, graph: &CoarseGraph, target: &Target) -> Self {
        let mut before = 0;
        let mut all = Vec::new();
        for hard in &target.hard {
            let gap = hard.first.saturating_sub(before);
            all.extend(Approach::new(library, graph, hard, gap));
            before = hard.last;
        }
        let is_hopeless = all.len() != target.hard.len();
        Self { all, is_hopeless }
    }

    /// What is to be shown next by a motion that has shown `n_shown` hard stretches; `Err` where
    /// nothing can.
    #[inline]
    pub(crate) fn next(&self, n_shown: usize) -> Result<Option<&Approach>, NoWay> {
        if self.is_hopeless { Err(NoWay) } else { Ok(self.all.get(n_shown)) }
    }
}

/// Something hard cannot be shown by any path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoWay;
