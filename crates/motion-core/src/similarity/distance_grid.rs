//! All pairs of frames, in blocks: nearest neighbours, and every pair under a threshold.
//!
//! Costs are screened by one matrix product per block in f32 (`‖x‖² + ‖y‖² − 2 x·y`) with a
//! slack that covers its rounding, and what survives is recomputed in f64 by
//! [`FeatureSet::cost`]. So the pairs found are exactly those of a double loop.
//!
//! Memory: a block of [`BLOCK`]² products per thread, and the pairs that are kept.

use rayon::prelude::*;

use super::features::FeatureSet;
use super::product::row_products;
use crate::cancel::{CancelToken, Cancelled};

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
    /// For each row, the least cost to a row of another clip (`∞` in a set of one clip).
    pub other_clip: Vec<f64>,
    /// For clips `a`, `b` the least cost between their rows, at `a · n_clips + b` (symmetric).
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

/// What one block row has found.
struct BlockNearest {
    /// For each of its rows, the nearest row of another clip; `u32::MAX` without any.
    rows: Vec<u32>,
    /// Clips and the least cost between them, of this block's rows.
    pairs: Vec<(u32, u32, f32)>,
}

/// The nearest row in another clip for each row, and the nearest pair for each two clips.
///
/// Costs of [`Nearest::other_clip`] are recomputed in f64 for the pair that the f32 screen found
/// nearest; those of [`Nearest::clip_pair`] are the screen's own, within 1e-4 of τ-sized costs.
pub fn nearest(features: &FeatureSet, cancel: &CancelToken) -> Result<Nearest, Cancelled> {
    let blocks = Blocks::new(features);
    let n_rows = features.n_rows();
    let n_clips = features.frame_starts.len() - 1;
    // One task per block row: it sees every column, so no merging of rows between tasks.
    let per_block: Vec<BlockNearest> = (0..blocks.n_blocks())
        .into_par_iter()
        .map(|a| {
            let rows = blocks.range(a);
            let mut best = vec![f32::INFINITY; rows.len()];
            let mut best_row = vec![u32::MAX; rows.len()];
            let first_clip = blocks.clip_of_row[rows.start] as usize;
            let last_clip = blocks.clip_of_row[rows.end - 1] as usize;
            let mut pair = vec![f32::INFINITY; (last_clip - first_clip + 1) * n_clips];
            let mut products = Vec::new();
            for b in 0..blocks.n_blocks() {
                if cancel.is_cancelled() {
                    break;
                }
                blocks.products(a, b, &mut products);
                let columns = blocks.range(b);
                for (i, row) in rows.clone().enumerate() {
                    let line = &products[i * columns.len()..(i + 1) * columns.len()];
                    let clip = blocks.clip_of_row[row];
                    let mut at = columns.start;
                    // Runs of columns of one clip: a branch-free minimum within each.
                    while at < columns.end {
                        let other = blocks.clip_of_row[at];
                        let end = features.frame_starts[other as usize + 1].min(columns.end);
                        let run = at..end;
                        at = end;
                        if other == clip {
                            continue;
                        }
                        let dots = &line[run.start - columns.start..run.end - columns.start];
                        let norms = &blocks.norms[run.clone()];
                        let least = least_shifted(dots, norms);
                        let cost = least + blocks.norms[row];
                        let slot =
                            &mut pair[(clip as usize - first_clip) * n_clips + other as usize];
                        *slot = slot.min(cost);
                        if cost < best[i] {
                            best[i] = cost;
                            let offset = dots
                                .iter()
                                .zip(norms)
                                .position(|(d, n)| n - 2.0 * d == least)
                                .unwrap_or(0);
                            best_row[i] = (run.start + offset) as u32;
                        }
                    }
                }
            }
            let mut pairs = Vec::new();
            for (slot, &cost) in pair.iter().enumerate() {
                if cost.is_finite() {
                    let clip = (first_clip + slot / n_clips) as u32;
                    pairs.push((clip, (slot % n_clips) as u32, cost.max(0.0)));
                }
            }
            BlockNearest { rows: best_row, pairs }
        })
        .collect();
    if cancel.is_cancelled() {
        return Err(Cancelled);
    }
    let mut clip_pair = vec![f32::INFINITY; n_clips * n_clips];
    let mut other_clip = Vec::with_capacity(n_rows);
    for BlockNearest { rows, pairs } in per_block {
        for row in rows {
            let this = other_clip.len();
            other_clip.push(if row == u32::MAX {
                f64::INFINITY
            } else {
                features.cost(this, row as usize)
            });
        }
        for (a, b, cost) in pairs {
            let slot = &mut clip_pair[a as usize * n_clips + b as usize];
            *slot = slot.min(cost);
        }
    }
    Ok(Nearest { other_clip, clip_pair })
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

/// Every pair `a < b` with `cost < tau`, but for pairs of one clip that are fewer than
/// `min_jump` frames apart.
///
/// Never keeps more than about `max_pairs`: where there are more, the threshold is lowered to
/// the cost at which that many remain, and returned. Block rows are taken in batches in a fixed
/// order, so the outcome does not depend on the number of threads.
pub fn pairs_below(
    features: &FeatureSet,
    tau: f64,
    min_jump: usize,
    max_pairs: usize,
    cancel: &CancelToken,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<NearPairs, Cancelled> {
    const BATCH: usize = 16;
    let blocks = Blocks::new(features);
    let n_blocks = blocks.n_blocks();
    let mut tau = tau;
    let mut pairs: Vec<NearPair> = Vec::new();
    for batch in (0..n_blocks).step_by(BATCH) {
        let found: Vec<Vec<NearPair>> = (batch..(batch + BATCH).min(n_blocks))
            .into_par_iter()
            .map(|a| block_row_below(&blocks, a, tau, min_jump, cancel))
            .collect();
        if cancel.is_cancelled() {
            return Err(Cancelled);
        }
        for found in found {
            pairs.extend(found);
        }
        if pairs.len() > max_pairs {
            let cheaper = |a: &NearPair, b: &NearPair| a.cost.total_cmp(&b.cost);
            let (_, &mut pivot, _) = pairs.select_nth_unstable_by(max_pairs, cheaper);
            tau = f64::from(pivot.cost);
            pairs.retain(|pair| f64::from(pair.cost) < tau);
        }
        progress((batch + BATCH).min(n_blocks) as f32 / n_blocks as f32);
    }
    pairs.par_sort_unstable_by_key(|pair| (pair.a, pair.b));
    Ok(NearPairs { pairs, tau })
}

fn block_row_below(
    blocks: &Blocks<'_>,
    a: usize,
    tau: f64,
    min_jump: usize,
    cancel: &CancelToken,
) -> Vec<NearPair> {
    let features = blocks.features;
    let mut found = Vec::new();
    let mut products = Vec::new();
    let screen = tau as f32 * 1.001;
    for b in a..blocks.n_blocks() {
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
                    let same_clip = blocks.clip_of_row[row] == blocks.clip_of_row[column];
                    if same_clip && column - row < min_jump {
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
