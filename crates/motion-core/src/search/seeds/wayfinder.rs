//! How soon, and how cheaply, a frame of a clip can be reached from every frame of the library: a
//! search backwards over the coarse graph.

use super::super::library::SearchLibrary;
use crate::ids::ClipId;

/// Cuts on the way that are looked for at most, when only the likely ways are …
const LIKELY_HOPS: usize = 6;
/// … and when all are.
const MAX_HOPS: usize = 24;

/// For every frame of every clip, what it takes to get to one frame of one clip.
///
/// Entries speak of the moment before a frame is shown: it may be shown, or another be cut to.
#[derive(Clone, Debug)]
pub(crate) struct Wayfinder {
    to: (ClipId, u32),
    /// The least number of frames; `u32::MAX` where there is no way.
    frames: Vec<Vec<u32>>,
    /// The least cost of cuts, in τ; infinite where there is no way.
    cost: Vec<Vec<f32>>,
}

impl Wayfinder {
    /// The ways to frame `frame` of `clip` by chosen cuts, and by any leaf into `clip` itself.
    ///
    /// Least frames are those of chosen cuts: other leaves may be a few frames quicker.
    pub(crate) fn new(library: &SearchLibrary, scope: (&[bool], bool), to: (ClipId, u32)) -> Self {
        Self::search(library, scope, to, false)
    }

    /// The ways by every leaf: slower, and exact.
    pub(crate) fn by_every_cut(
        library: &SearchLibrary,
        scope: (&[bool], bool),
        to: (ClipId, u32),
    ) -> Self {
        Self::search(library, scope, to, true)
    }

    fn search(
        library: &SearchLibrary,
        (allowed, bridges): (&[bool], bool),
        (clip, frame): (ClipId, u32),
        every_cut: bool,
    ) -> Self {
        let n_clips = library.graph().n_clips();
        let lengths = (0..n_clips).map(|c| library.n_frames(ClipId::from_idx(c)) as usize);
        let mut frames: Vec<Vec<u32>> = lengths.map(|n| vec![u32::MAX; n]).collect();
        let mut cost: Vec<Vec<f32>> =
            frames.iter().map(|frames| vec![f32::INFINITY; frames.len()]).collect();
        for f in 0..=frame {
            frames[clip.idx()][f as usize] = frame - f;
            cost[clip.idx()][f as usize] = 0.0;
        }
        let forest = &library.graph().forest;
        let mut fresh = vec![false; n_clips];
        fresh[clip.idx()] = true;
        for hop in 0..if every_cut { MAX_HOPS } else { LIKELY_HOPS } {
            let mut changed = vec![false; n_clips];
            for to in (0..n_clips).filter(|&to| fresh[to]).map(ClipId::from_idx) {
                for (from, pair) in library.pairs_into(to) {
                    if !allowed[from.idx()] {
                        continue;
                    }
                    // The last hop may be by any cut; those before by chosen ones.
                    let cuts = if hop == 0 || every_cut { pair.leaves } else { pair.chosen };
                    for cut in cuts.iter().filter(|cut| bridges || !forest.is_bridge(cut.id)) {
                        // What is entered is shown for a frame at least.
                        let then = match frames[to.idx()].get(cut.to as usize + 1) {
                            _ if (to, cut.to) == (clip, frame) => 0,
                            Some(after) => after.saturating_add(1),
                            None => u32::MAX,
                        };
                        let there = &mut frames[from.idx()][cut.from as usize];
                        if then < *there {
                            *there = then;
                            changed[from.idx()] = true;
                        }
                        let total = match cost[to.idx()].get(cut.to as usize + 1) {
                            _ if (to, cut.to) == (clip, frame) => cut.cost,
                            Some(after) => cut.cost + after,
                            None => f32::INFINITY,
                        };
                        let there = &mut cost[from.idx()][cut.from as usize];
                        if total < *there {
                            *there = total;
                            changed[from.idx()] = true;
                        }
                    }
                }
            }
            for from in (0..n_clips).filter(|&from| changed[from]) {
                // Earlier frames get there by playing on.
                let (frames, cost) = (&mut frames[from], &mut cost[from]);
                for f in (0..frames.len().saturating_sub(1)).rev() {
                    frames[f] = frames[f].min(frames[f + 1].saturating_add(1));
                    cost[f] = cost[f].min(cost[f + 1]);
                }
            }
            fresh = changed;
            if !fresh.contains(&true) {
                break;
            }
        }
        Self { to: (clip, frame), frames, cost }
    }

    /// The least number of frames from when `frame` of `clip` is shown; `u32::MAX` where there is no
    /// way.
    #[inline]
    pub(crate) fn least_frames(&self, clip: ClipId, frame: u32) -> u32 {
        if self.to == (clip, frame) {
            return 0;
        }
        let after = self.frames[clip.idx()].get(frame as usize + 1);
        after.map_or(u32::MAX, |frames| frames.saturating_add(1))
    }

    /// The least cost of the cuts on a way from there, in τ.
    #[inline]
    pub(crate) fn least_cost(&self, clip: ClipId, frame: u32) -> f32 {
        if self.to == (clip, frame) {
            return 0.0;
        }
        self.cost[clip.idx()].get(frame as usize + 1).copied().unwrap_or(f32::INFINITY)
    }
}
