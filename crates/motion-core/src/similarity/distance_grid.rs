//! All pairs of frames, in blocks: nearest neighbours, and every pair under a threshold.
//!
//! Costs are screened by one matrix product per block in f32 (`‖x‖² + ‖y‖² − 2 x·y`) with a
//! slack that covers its rounding, and what survives is recomputed in f64 by
//! [`FeatureSet::cost`]. So the pairs found are exactly those of a double loop.
//!
//! Memory: a block of [`BLOCK`]² products per thread, and the pairs that are kept.

use std::sync::atomic::{AtomicU32, AtomicU64, AtomicUsize, Ordering};

use rayon::prelude::*;

use super::features::FeatureSet;
use super::product::row_products;
use super::shard::Shard;
use crate::cancel::{CancelToken, Cancelled};
use crate::ids::ClipId;

/// Rows and columns of a block of products: 1 MiB of f32, which stays in a core's cache.
pub const BLOCK: usize = 512;

/// Screening bound: how far an f32 cost may lie above the true one, as a share of the two
/// squared norms. The products of a few hundred f32 numbers err by far less.
const ROUNDING: f32 = 4e-6;

/// A pair of rows with its cost. `a < b` always: the cost is symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearPair {
    /// The smaller row.
    pub a: u32,
    /// The larger row.
    pub b: u32,
    /// `C`, in f64 rounded to f32.
    pub cost: f32,
}

/// The nearest rows between clips.
#[derive(Clone, Debug)]
pub struct Nearest {
    /// For each row, the least cost to a row of a clip of another family (`∞` without one).
    pub other_family: Vec<f64>,
    /// For clips `a`, `b` the least cost of a cut between their rows, at `a · n_clips + b`
    /// (symmetric). What shows the same moment is no cut.
    pub clip_pair: Vec<f32>,
}

struct Blocks<'a> {
    features: &'a FeatureSet,
    norms: Vec<f32>,
    clip_of_row: Vec<u32>,
}

impl<'a> Blocks<'a> {
    fn new(features: &'a FeatureSet) -> Self {
        let norms = (0..features.n_rows())
            .map(|row| features.row(row).iter().map(|x| x * x).sum())
            .collect();
        let mut clip_of_row = Vec::with_capacity(features.n_rows());
        for (clip, bounds) in features.frame_starts.windows(2).enumerate() {
            clip_of_row.resize(bounds[1], clip as u32);
        }
        Self { features, norms, clip_of_row }
    }

    fn n_blocks(&self) -> usize {
        self.features.n_rows().div_ceil(BLOCK)
    }

    fn range(&self, block: usize) -> std::ops::Range<usize> {
        block * BLOCK..((block + 1) * BLOCK).min(self.features.n_rows())
    }

    fn is_same_moment(&self, a: usize, b: usize, min_jump: u32) -> bool {
        let frame = |row: usize| {
            let clip = self.clip_of_row[row] as usize;
            (ClipId::from_idx(clip), (row - self.features.frame_starts[clip]) as u32)
        };
        self.features.families.is_same_moment(frame(a), frame(b), min_jump)
    }

    /// Products of the rows of block `a` with those of block `b`, row-major.
    fn products(&self, a: usize, b: usize, out: &mut Vec<f32>) {
        let (rows_a, rows_b) = (self.range(a), self.range(b));
        out.resize(rows_a.len() * rows_b.len(), 0.0);
        let k = self.features.n_dims;
        row_products(
            &self.features.rows[rows_a.start * k..rows_a.end * k],
            &self.features.rows[rows_b.start * k..rows_b.end * k],
            k,
            out,
        );
    }
}

/// A cost and the row that it leads to in one number: least is least whoever writes first, so
/// threads may share it without a result depending on them.
fn packed(cost: f32, row: usize) -> u64 {
    (u64::from(cost.max(0.0).to_bits()) << 32) | row as u64
}

/// The nearest row of another family for each row, and the nearest pair for each two clips.
///
/// Costs of [`Nearest::other_family`] are recomputed in f64 for the pair that the f32 screen found
/// nearest; those of [`Nearest::clip_pair`] are the screen's own, within 1e-4 of τ-sized costs.
/// `progress` hears the share of all pairs that is done, from any thread.
pub fn nearest(
    features: &FeatureSet,
    min_jump: u32,
    cancel: &CancelToken,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<Nearest, Cancelled> {
    let blocks = Blocks::new(features);
    let n_blocks = blocks.n_blocks();
    let (n_all, n_done) = (n_blocks * (n_blocks + 1) / 2, AtomicUsize::new(0));
    let n_clips = features.frame_starts.len() - 1;
    let nothing = packed(f32::INFINITY, u32::MAX as usize);
    let best: Vec<AtomicU64> = (0..features.n_rows()).map(|_| AtomicU64::new(nothing)).collect();
    let clip_pair: Vec<AtomicU32> =
        (0..n_clips * n_clips).map(|_| AtomicU32::new(f32::INFINITY.to_bits())).collect();
    // The products are symmetric: a block serves its rows and its columns.
    (0..blocks.n_blocks()).into_par_iter().with_max_len(1).for_each(|a| {
        let mut products = Vec::new();
        for b in a..blocks.n_blocks() {
            if cancel.is_cancelled() {
                break;
            }
            blocks.products(a, b, &mut products);
            nearest_in_block(&blocks, (a, b), &products, min_jump, &best, &clip_pair);
        }
        // A block row is long enough that hearing of each costs nothing.
        let n_row = n_blocks - a;
        let n_done = n_done.fetch_add(n_row, Ordering::Relaxed) + n_row;
        progress(n_done as f32 / n_all as f32);
    });
    if cancel.is_cancelled() {
        return Err(Cancelled);
    }
    let other_family = best
        .par_iter()
        .enumerate()
        .map(|(row, best)| match best.load(Ordering::Relaxed) {
            best if best == nothing => f64::INFINITY,
            best => features.cost(row, (best & u64::from(u32::MAX)) as usize),
        })
        .collect();
    let clip_pair = clip_pair.into_iter().map(|bits| f32::from_bits(bits.into_inner())).collect();
    Ok(Nearest { other_family, clip_pair })
}

fn nearest_in_block(
    blocks: &Blocks<'_>,
    (a, b): (usize, usize),
    products: &[f32],
    min_jump: u32,
    best: &[AtomicU64],
    clip_pair: &[AtomicU32],
) {
    let (frame_starts, families) = (&blocks.features.frame_starts, &blocks.features.families);
    let n_clips = frame_starts.len() - 1;
    let columns = blocks.range(b);
    let mut column_best = vec![f32::INFINITY; columns.len()];
    let mut column_row = vec![0u32; columns.len()];
    for (i, row) in blocks.range(a).enumerate() {
        let line = &products[i * columns.len()..(i + 1) * columns.len()];
        let clip = blocks.clip_of_row[row] as usize;
        let norm = blocks.norms[row];
        let mut row_best = (f32::INFINITY, 0);
        let mut at = columns.start;
        // Runs of columns of one clip: a branch-free minimum within each.
        while at < columns.end {
            let other = blocks.clip_of_row[at] as usize;
            let run = at..frame_starts[other + 1].min(columns.end);
            at = run.end;
            if other == clip {
                continue;
            }
            let local = run.start - columns.start..run.end - columns.start;
            let (dots, norms) = (&line[local.clone()], &blocks.norms[run.clone()]);
            let ids = [clip, other].map(ClipId::from_idx);
            let least = if families.hand(ids[0]) == families.hand(ids[1]) {
                let frame = |row: usize, clip: usize| (row - frame_starts[clip]) as u32;
                let here = (ids[0], frame(row, clip));
                let first = frame(run.start, other);
                let cuts = (first..).zip(dots.iter().zip(norms)).filter(|&(there, _)| {
                    !families.is_same_moment(here, (ids[1], there), min_jump)
                });
                cuts.map(|(_, (d, n))| n - 2.0 * d).fold(f32::INFINITY, f32::min)
            } else {
                least_shifted(dots, norms)
            };
            let cost = (least + norm).max(0.0);
            for slot in [clip * n_clips + other, other * n_clips + clip] {
                clip_pair[slot].fetch_min(cost.to_bits(), Ordering::Relaxed);
            }
            if families.family(ids[0]) == families.family(ids[1]) {
                continue;
            }
            if cost < row_best.0 {
                let there = dots.iter().zip(norms).position(|(d, n)| n - 2.0 * d == least);
                row_best = (cost, run.start + there.unwrap_or(0));
            }
            let column_best = &mut column_best[local.clone()];
            let column_row = &mut column_row[local];
            for ((best, of), &dot) in column_best.iter_mut().zip(column_row).zip(dots) {
                let shifted = norm - 2.0 * dot;
                let closer = shifted < *best;
                *best = if closer { shifted } else { *best };
                *of = if closer { row as u32 } else { *of };
            }
        }
        if row_best.0.is_finite() {
            best[row].fetch_min(packed(row_best.0, row_best.1), Ordering::Relaxed);
        }
    }
    for (local, column) in columns.enumerate() {
        if column_best[local].is_finite() {
            let cost = column_best[local] + blocks.norms[column];
            let found = packed(cost, column_row[local] as usize);
            best[column].fetch_min(found, Ordering::Relaxed);
        }
    }
}

/// The least `norm − 2 · dot`, in eight lanes so that the compiler can use vector registers.
fn least_shifted(dots: &[f32], norms: &[f32]) -> f32 {
    let mut lanes = [f32::INFINITY; 8];
    let (d, n) = (dots.chunks_exact(8), norms.chunks_exact(8));
    let rest = d.remainder().iter().zip(n.remainder());
    let mut least = rest.map(|(d, n)| n - 2.0 * d).fold(f32::INFINITY, f32::min);
    for (d, n) in d.zip(n) {
        for lane in 0..8 {
            lanes[lane] = lanes[lane].min(n[lane] - 2.0 * d[lane]);
        }
    }
    for lane in lanes {
        least = least.min(lane);
    }
    least
}

/// Every pair of rows with a cost under a threshold, and the threshold that was used.
#[derive(Clone, Debug)]
pub struct NearPairs {
    /// The pairs, ordered by `(a, b)`.
    pub pairs: Vec<NearPair>,
    /// τ: as asked, or lower where `max_pairs` would have been exceeded.
    pub tau: f64,
}

/// What is asked of [`pairs_below`].
#[derive(Clone, Copy, Debug)]
pub struct PairQuery {
    /// Pairs cost less than this.
    pub tau: f64,
    /// Frames that show the same moment within this are no pair.
    pub min_jump: u32,
    /// About how many are kept.
    pub max_pairs: usize,
    /// Only pairs whose larger row is this or more: smaller ones are known.
    pub first_new_row: usize,
    /// Which block rows are looked at.
    pub shard: Shard,
}

impl PairQuery {
    /// All pairs under `tau`.
    pub fn all(tau: f64, min_jump: u32) -> Self {
        Self { tau, min_jump, max_pairs: usize::MAX, first_new_row: 0, shard: Shard::WHOLE }
    }
}

/// Every pair `a < b` with `cost < tau`, but for pairs that show the same moment.
///
/// Never keeps more than about `max_pairs`: where there are more, the threshold is lowered to
/// the cost at which that many remain, and returned. Block rows are taken in batches in a fixed
/// order, so the outcome does not depend on the number of threads.
pub fn pairs_below(
    features: &FeatureSet,
    query: &PairQuery,
    cancel: &CancelToken,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<NearPairs, Cancelled> {
    const BATCH: usize = 16;
    let blocks = Blocks::new(features);
    let n_blocks = blocks.n_blocks();
    let PairQuery { mut tau, max_pairs, shard, .. } = *query;
    let mut pairs: Vec<NearPair> = Vec::new();
    for batch in (0..n_blocks).step_by(BATCH) {
        let found: Vec<Vec<NearPair>> = (batch..(batch + BATCH).min(n_blocks))
            .into_par_iter()
            .filter(|&a| shard.has(a))
            .map(|a| block_row_below(&blocks, a, &PairQuery { tau, ..*query }, cancel))
            .collect();
        if cancel.is_cancelled() {
            return Err(Cancelled);
        }
        for found in found {
            pairs.extend(found);
        }
        keep_cheapest(&mut pairs, &mut tau, max_pairs);
        // Rows of the triangle become shorter; the share is that of its area.
        let n_left = n_blocks - (batch + BATCH).min(n_blocks);
        let n_all = n_blocks * (n_blocks + 1);
        progress(1.0 - (n_left * (n_left + 1)) as f32 / n_all as f32);
    }
    pairs.par_sort_unstable_by_key(|pair| (pair.a, pair.b));
    Ok(NearPairs { pairs, tau })
}

/// Lowers `tau` to the cost at which no more than `max_pairs` remain, and drops the others.
///
/// What remains is the same whether pairs come at once or in parts that were cut down before.
pub fn keep_cheapest(pairs: &mut Vec<NearPair>, tau: &mut f64, max_pairs: usize) {
    if pairs.len() > max_pairs {
        let cheaper = |a: &NearPair, b: &NearPair| a.cost.total_cmp(&b.cost);
        let (_, &mut pivot, _) = pairs.select_nth_unstable_by(max_pairs, cheaper);
        *tau = f64::from(pivot.cost);
        pairs.retain(|pair| f64::from(pair.cost) < *tau);
    }
}

fn block_row_below(
    blocks: &Blocks<'_>,
    a: usize,
    query: &PairQuery,
    cancel: &CancelToken,
) -> Vec<NearPair> {
    let features = blocks.features;
    let PairQuery { tau, min_jump, first_new_row, .. } = *query;
    let mut found = Vec::new();
    let mut products = Vec::new();
    let screen = tau as f32 * 1.001;
    for b in a.max(first_new_row / BLOCK)..blocks.n_blocks() {
        if cancel.is_cancelled() {
            return Vec::new();
        }
        blocks.products(a, b, &mut products);
        let columns = blocks.range(b);
        for (i, row) in blocks.range(a).enumerate() {
            let line = &products[i * columns.len()..(i + 1) * columns.len()];
            let first = if a == b { i + 1 } else { 0 };
            let norm = blocks.norms[row] * (1.0 - ROUNDING) - screen;
            let norms = &blocks.norms[columns.clone()];
            for chunk in (first..line.len()).step_by(32) {
                let chunk = chunk..(chunk + 32).min(line.len());
                let (dots, norms) = (&line[chunk.clone()], &norms[chunk.clone()]);
                let shift = norm;
                let near = |d: f32, n: f32| n * (1.0 - ROUNDING) - 2.0 * d + shift < 0.0;
                // Almost every chunk has no near pair: look at the whole first.
                if !dots.iter().zip(norms).fold(false, |any, (&d, &n)| any | near(d, n)) {
                    continue;
                }
                for (offset, (&d, &n)) in dots.iter().zip(norms).enumerate() {
                    if !near(d, n) {
                        continue;
                    }
                    let column = columns.start + chunk.start + offset;
                    if column < first_new_row || blocks.is_same_moment(row, column, min_jump) {
                        continue;
                    }
                    let cost = features.cost(row, column);
                    if cost < tau {
                        let (a, b) = (row as u32, column as u32);
                        found.push(NearPair { a, b, cost: cost as f32 });
                    }
                }
            }
        }
    }
    found
}
