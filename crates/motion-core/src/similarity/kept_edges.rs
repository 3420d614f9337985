//! At most so many edges for each frame, out of any number under τ: what large sets keep.
//!
//! For each frame the local minima of the cost come first, then the cheapest others
//! ([`BestEdges`]). An edge is a local minimum when none of the eight beside it in its pair of
//! clips, one frame on or back in either, is cheaper; what is no cut does not count.
//!
//! Blocks of frames whose boxes are too far apart for anything that could still come in are
//! skipped; near blocks go first, so that later ones find lists full of cheap edges. Of two near
//! blocks only those pairs of frames are looked at that the projection does not keep apart
//! ([`close_pairs`]). Their cost in f32 tells what may matter, and that is decided in f64. So what is
//! kept does not depend on the order or the number of threads, and is that of a double loop
//! (`brute.rs`).

use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::best_edges::{BestEdges, Key, Limits};
use super::close_pairs::{ClosePair, Side, close_pairs};
use super::directed::{DirectedEdges, Kept};
use super::features::FeatureSet;
use super::frame_blocks::{BLOCK_ROWS, FrameBlocks, Near};
use super::rough_cost::rounding;
use super::shard::Shard;
use super::surface::Surface;
use crate::cancel::{CancelToken, Cancelled};

/// Shares of τ: blocks that are nearer than the first go first, and so on.
const BANDS: [f32; 5] = [0.0, 0.03, 0.12, 0.4, 1.0];

/// Blocks that follow each other, and so need much the same others, are worked on together.
const TEAM_BLOCKS: usize = 4;

/// What is asked of [`kept_edges`].
pub(crate) struct KeptQuery<'a> {
    /// Edges cost less than this.
    pub(crate) tau: f64,
    /// Frames that show the same moment within this are no cut.
    pub(crate) min_jump: u32,
    /// Edges of a frame.
    pub(crate) n_kept: usize,
    /// The frames whose edges are wanted.
    pub(crate) shard: Shard,
    /// Clips before this one have been compared with each other: what came of it.
    pub(crate) known: Option<(&'a DirectedEdges, usize)>,
}

/// The best edges of every frame of the shard, listed by frame; of other frames none.
pub(crate) fn kept_edges(
    features: &FeatureSet,
    query: &KeptQuery<'_>,
    cancel: &CancelToken,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<DirectedEdges, Cancelled> {
    let first_new_row = query.known.map_or(0, |(_, n_old)| features.frame_starts[n_old]);
    let blocks = FrameBlocks::new(features, first_new_row);
    let join = Join::new(features, &blocks, query);
    let n_blocks = blocks.n_blocks();
    let n_teams = n_blocks.div_ceil(TEAM_BLOCKS);
    let n_all = (BANDS.len() - 1) * n_teams;
    let n_done = AtomicUsize::new(0);
    for band in BANDS.windows(2) {
        let (from, to) = (join.tau * band[0], join.tau * band[1]);
        let all = (0..n_teams).into_par_iter().with_max_len(1);
        all.for_each_init(Scratch::default, |scratch, team| {
            let team = team * TEAM_BLOCKS..((team + 1) * TEAM_BLOCKS).min(n_blocks);
            let mut near = std::mem::take(&mut scratch.near);
            near.clear();
            for a in team {
                blocks.near(a, a.max(blocks.first_new), to, &mut near);
            }
            // One after the other what needs the same block, which then is at hand.
            near.sort_unstable_by_key(|near| (near.b, near.a));
            for &Near { a, b, least_cost } in &near {
                let (a, b) = (a as usize, b as usize);
                let in_band = least_cost > from || from == 0.0;
                let limit = join.limit(a).max(join.limit(b));
                if in_band && least_cost <= limit && join.is_wanted(a, b) {
                    if cancel.is_cancelled() {
                        return;
                    }
                    join.tile(a, b, scratch);
                }
            }
            scratch.near = near;
            let n_done = n_done.fetch_add(1, Ordering::Relaxed) + 1;
            if n_done.is_multiple_of(16) {
                progress(n_done as f32 / n_all as f32);
            }
        });
        if cancel.is_cancelled() {
            return Err(Cancelled);
        }
    }
    Ok(join.finish())
}

/// Memory of one thread.
#[derive(Default)]
struct Scratch {
    near: Vec<Near>,
    pairs: Vec<ClosePair>,
    found: Vec<Found>,
}

/// An edge between two places of two blocks, both ways.
struct Found {
    a: u8,
    b: u8,
    is_minimum: bool,
    cost: f32,
}

/// What each row of a block can still take.
#[derive(Clone)]
struct Looks {
    limits: [Limits; BLOCK_ROWS],
    /// The higher of the two limits.
    highest: [f32; BLOCK_ROWS],
    /// The same as squared distances in the projection.
    reaches: [f32; BLOCK_ROWS],
}

impl Looks {
    const NONE: Self = Self {
        limits: [Limits { minima: f32::NEG_INFINITY, others: f32::NEG_INFINITY }; BLOCK_ROWS],
        highest: [f32::NEG_INFINITY; BLOCK_ROWS],
        reaches: [-1.0; BLOCK_ROWS],
    };

    fn set(&mut self, place: usize, limits: Limits, blocks: &FrameBlocks) {
        self.limits[place] = limits;
        self.highest[place] = limits.minima.max(limits.others);
        self.reaches[place] = blocks.reach(self.highest[place]);
    }

    /// The highest cost that any row can still take.
    fn most(&self) -> f32 {
        self.highest.iter().fold(f32::NEG_INFINITY, |most, &limit| most.max(limit))
    }
}

struct BlockBest {
    best: BestEdges,
    looks: Looks,
}

struct Join<'a> {
    features: &'a FeatureSet,
    blocks: &'a FrameBlocks,
    query: &'a KeptQuery<'a>,
    tau: f32,
    rounding: f32,
    surface: Surface<'a>,
    best: Vec<Mutex<BlockBest>>,
    /// For each block the highest cost that any of its rows can still take (bits of an f32).
    limits: Vec<AtomicU32>,
}

impl<'a> Join<'a> {
    fn new(features: &'a FeatureSet, blocks: &'a FrameBlocks, query: &'a KeptQuery<'a>) -> Self {
        let tau = (query.tau * 1.001) as f32;
        let surface = Surface::new(features, query.min_jump);
        let start = |block: usize| {
            let rows = blocks.rows(block);
            let is_wanted = query.shard.has(block);
            let mut best = BestEdges::new(rows.len(), if is_wanted { query.n_kept } else { 0 });
            if let Some((known, _)) = query.known
                && is_wanted
                && block < blocks.first_new
            {
                for (nth, &row) in rows.iter().enumerate() {
                    for (to, cost) in known.of(row as usize) {
                        let exact = features.cost(row as usize, to as usize);
                        let is_minimum = surface.is_minimum(row, to, exact);
                        best.offer(nth, Key::new(is_minimum, cost, to));
                    }
                }
            }
            let mut looks = Looks::NONE;
            for place in 0..rows.len() {
                looks.set(place, best.limits(place, tau), blocks);
            }
            Mutex::new(BlockBest { best, looks })
        };
        let best: Vec<Mutex<BlockBest>> =
            (0..blocks.n_blocks()).into_par_iter().map(start).collect();
        let most = |best| AtomicU32::new(locked(best).looks.most().to_bits());
        let limits = best.iter().map(most).collect();
        let rounding = rounding(features.n_dims);
        Self { features, blocks, query, tau, rounding, surface, best, limits }
    }

    fn is_wanted(&self, a: usize, b: usize) -> bool {
        self.query.shard.has(a) || self.query.shard.has(b)
    }

    fn limit(&self, block: usize) -> f32 {
        f32::from_bits(self.limits[block].load(Ordering::Relaxed))
    }

    /// Looks at the pairs of frames of two blocks.
    fn tile(&self, a: usize, b: usize, scratch: &mut Scratch) {
        let blocks = self.blocks;
        let looks = [a, b].map(|block| locked(&self.best[block]).looks.clone());
        let [side_a, side_b] = [(a, &looks[0]), (b, &looks[1])].map(|(block, looks)| {
            let (lanes, bounds) = blocks.lanes(block);
            let values = blocks.values(block);
            Side { lanes, bounds, values, limits: &looks.highest, reaches: &looks.reaches }
        });
        let Scratch { pairs, found, .. } = scratch;
        pairs.clear();
        close_pairs(&side_a, &side_b, self.features.n_dims, a == b, pairs);
        let (rows_a, rows_b) = (blocks.rows(a), blocks.rows(b));
        found.clear();
        for &ClosePair { a, b, cost } in &*pairs {
            let (at_a, at_b) = (usize::from(a), usize::from(b));
            let of_rows = [looks[0].limits[at_a], looks[1].limits[at_b]];
            let edge = self.look_at(rows_a[at_a], rows_b[at_b], cost, of_rows);
            found.extend(edge.map(|(is_minimum, cost)| Found { a, b, is_minimum, cost }));
        }
        if !found.is_empty() {
            self.keep(a, found.iter().map(|f| (f.a, f.b, f)), b);
            self.keep(b, found.iter().map(|f| (f.b, f.a, f)), a);
        }
    }

    /// Decides about a pair of frames that costs about `cost`: whether it is a minimum, and its true
    /// cost.
    #[inline]
    fn look_at(&self, a: u32, b: u32, cost: f32, limits: [Limits; 2]) -> Option<(bool, f32)> {
        let slack = self.rounding * cost;
        let at_least = cost - slack;
        let as_minimum = at_least <= limits[0].minima.max(limits[1].minima);
        let as_other = at_least <= limits[0].others.max(limits[1].others);
        if !as_minimum && !as_other || self.surface.is_same_moment(a, b) {
            return None;
        }
        let is_below = self.surface.is_below_diagonal(a, b, cost, slack);
        if !is_below && !as_other {
            return None;
        }
        let exact = self.features.cost(a as usize, b as usize);
        let is_cheap = exact < self.query.tau;
        is_cheap.then(|| {
            let is_minimum = is_below && self.surface.is_minimum(a, b, exact);
            (is_minimum, exact as f32)
        })
    }

    /// Offers edges from places of block `from` to places of block `to`.
    fn keep<'f>(&self, from: usize, found: impl Iterator<Item = (u8, u8, &'f Found)>, to: usize) {
        if !self.query.shard.has(from) {
            return;
        }
        let rows = self.blocks.rows(to);
        let BlockBest { best, looks } = &mut *locked(&self.best[from]);
        for (here, there, found) in found {
            let here = usize::from(here);
            best.offer(here, Key::new(found.is_minimum, found.cost, rows[usize::from(there)]));
            looks.set(here, best.limits(here, self.tau), self.blocks);
        }
        self.limits[from].store(looks.most().to_bits(), Ordering::Relaxed);
    }

    fn finish(self) -> DirectedEdges {
        let mut place_of_row = vec![(0u32, 0u32); self.features.n_rows()];
        for block in 0..self.blocks.n_blocks() {
            for (nth, &row) in self.blocks.rows(block).iter().enumerate() {
                place_of_row[row as usize] = (block as u32, nth as u32);
            }
        }
        let best: Vec<BestEdges> = self
            .best
            .into_iter()
            .map(|best| best.into_inner().unwrap_or_else(PoisonError::into_inner).best)
            .collect();
        DirectedEdges::collect(self.features.n_rows(), |row, edges: &mut Vec<Kept>| {
            let (block, nth) = place_of_row[row];
            let keys = best[block as usize].of(nth as usize);
            edges.extend(keys.iter().map(|key| (key.row(), key.cost())));
        })
    }
}

fn locked(best: &Mutex<BlockBest>) -> std::sync::MutexGuard<'_, BlockBest> {
    best.lock().unwrap_or_else(PoisonError::into_inner)
}
