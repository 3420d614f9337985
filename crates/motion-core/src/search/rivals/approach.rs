//! From anywhere to what is hard, at its very frame: a graph search on the coarse level.
//!
//! AF02 section 4.2: seeds grow from one hard frame to the next, and “since the path is sampled at
//! the coarse level, a graph search can also be performed between the constraint nodes”. It goes
//! backwards in time once, so that growing a seed is a walk among cuts that are known to lead there.

use super::coarse::CoarseGraph;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::path::Piece;
use crate::search::hard::HardStretch;
use crate::search::library::{Cut, SearchLibrary};
use crate::search::target::Target;

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
    /// Where each clip's frames begin, counted through all clips.
    clip_starts: Vec<u32>,
    /// Entry `t · frames + f`: whether it can be shown exactly `t` frames after frame `f` was entered.
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
            let joins = |cut: &&Cut| cut.from == pair[0].to.0 + 1 && cut.to == pair[1].from.0;
            leaves.iter().find(joins).map(|cut| cut.id)
        });
        let n_clips = library.graph().n_clips();
        let mut clip_starts = vec![0u32];
        for clip in (0..n_clips).map(ClipId::from_idx) {
            clip_starts.push(clip_starts[clip.idx()] + library.n_frames(clip));
        }
        let mut new = Self {
            first: hard.first,
            last: hard.last,
            clip,
            clip_frame: from.0,
            inner: inner.collect::<Option<_>>()?,
            ends_with: *hard.pieces.last()?,
            clip_starts,
            leads: Vec::new(),
        };
        new.search(library, graph, n_frames_before.min(HORIZON));
        Some(new)
    }

    /// Backwards in time: from a frame just entered the next one follows; before one that a piece has
    /// come to, there may be a cut.
    fn search(&mut self, library: &SearchLibrary, graph: &CoarseGraph, horizon: u32) {
        let clips = || (0..library.graph().n_clips()).map(ClipId::from_idx);
        let n_frames = self.n_frames();
        // Whether it can be shown by a piece that goes on to this frame, `left` later; a frame behind
        // a clip's last leads nowhere.
        let mut goes_on_before = vec![false; n_frames];
        for left in 0..=horizon {
            let mut enters = vec![false; n_frames];
            for clip in clips() {
                let start = self.clip_starts[clip.idx()] as usize;
                for frame in 0..library.n_frames(clip) {
                    let at = start + frame as usize;
                    let is_last = frame + 1 == library.n_frames(clip);
                    let next = !is_last && goes_on_before[at + 1];
                    enters[at] = self.stays(clip, frame, left) || (left > 0 && next);
                }
            }
            let mut goes_on = enters.clone();
            for clip in clips() {
                let start = self.clip_starts[clip.idx()] as usize;
                for nth in graph.out(clip, 0..u32::MAX) {
                    let (to, cut) = graph.cut(nth);
                    if enters[self.clip_starts[to.idx()] as usize + cut.to as usize] {
                        goes_on[start + cut.from as usize] = true;
                    }
                }
            }
            self.leads.extend(&enters);
            goes_on_before = goes_on;
        }
    }

    fn n_frames(&self) -> usize {
        self.clip_starts[self.clip_starts.len() - 1] as usize
    }

    /// Whether staying in `clip` from `entered` on shows it after `left` frames.
    #[inline]
    pub(crate) fn stays(&self, clip: ClipId, entered: u32, left: u32) -> bool {
        clip == self.clip && entered + left == self.clip_frame
    }

    /// Whether entering a clip at a frame, `left` frames before it, may lead to it.
    #[inline]
    pub(crate) fn leads(&self, (clip, frame): (ClipId, u32), left: u32) -> bool {
        let at = self.clip_starts[clip.idx()] as usize + frame as usize;
        left > HORIZON || self.leads.get(left as usize * self.n_frames() + at) == Some(&true)
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
