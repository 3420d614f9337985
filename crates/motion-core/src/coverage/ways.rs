//! Where clips lead: ways out, dead ends, and which clips hang together.

use std::collections::BTreeMap;

use crate::clip::ClipSet;
use crate::graph::{Connectivity, MotionGraph};

/// The strongly connected parts of a graph: within each, every clip can be had behind every other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Parts {
    /// How many clips each has, the main part first, then the larger first.
    pub sizes: Vec<usize>,
}

impl Parts {
    fn new(connectivity: &Connectivity) -> Self {
        let mut n_clips: BTreeMap<u32, usize> = BTreeMap::new();
        for &part in &connectivity.part_of_clip {
            *n_clips.entry(part).or_default() += 1;
        }
        let mut sizes: Vec<usize> = n_clips.into_values().collect();
        if let Some(others) = sizes.get_mut(1..) {
            others.sort_unstable_by(|a, b| b.cmp(a));
        }
        Self { sizes }
    }
}

/// Where one clip leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipWays {
    /// The clip.
    pub clip: String,
    /// How many frames it has.
    pub n_frames: u32,
    /// From this frame on the main part cannot be reached any more; `n_frames` where it always can.
    pub dead_from: u32,
    /// The same without bridges.
    pub dead_from_by_tau: u32,
    /// The first frame that the main part leads to; `n_frames` where it leads to none.
    pub reachable_from: u32,
    /// The same without bridges.
    pub reachable_from_by_tau: u32,
}

impl ClipWays {
    /// Frames that lead nowhere.
    pub fn n_dead(&self) -> u32 {
        self.n_frames - self.dead_from
    }

    /// Whether only bridges lead into it or out of it.
    pub fn hangs_on_bridges(&self) -> bool {
        let is_apart = |dead_from: u32, from: u32| dead_from == 0 || from >= self.n_frames;
        is_apart(self.dead_from_by_tau, self.reachable_from_by_tau)
            && !is_apart(self.dead_from, self.reachable_from)
    }

    /// Whether nothing leads into it, or out of it, at all.
    pub fn is_apart(&self) -> bool {
        self.dead_from == 0 || self.reachable_from >= self.n_frames
    }
}

/// Ways of the whole library.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ways {
    /// Parts by cuts under τ alone.
    pub by_tau: Parts,
    /// Parts with bridges.
    pub with_bridges: Parts,
    /// Every clip, in the library's order.
    pub clips: Vec<ClipWays>,
}

impl Ways {
    pub(super) fn new(clips: &ClipSet, graph: &MotionGraph) -> Self {
        let (tau, all) = (&graph.by_tau, &graph.with_bridges);
        let ways = clips.clips().iter().enumerate().map(|(idx, clip)| ClipWays {
            clip: clip.id.clone(),
            n_frames: graph.clip_frames[idx],
            dead_from: all.dead_from[idx],
            dead_from_by_tau: tau.dead_from[idx],
            reachable_from: all.reachable_from[idx],
            reachable_from_by_tau: tau.reachable_from[idx],
        });
        let clips = ways.collect();
        Self { by_tau: Parts::new(tau), with_bridges: Parts::new(all), clips }
    }

    /// Frames that lead nowhere, of all clips.
    pub fn n_dead(&self) -> u32 {
        self.clips.iter().map(ClipWays::n_dead).sum()
    }
}
