//! What is nearest to some of the frames: for sets whose pairs are too many to look at all.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use rayon::prelude::*;

use super::features::FeatureSet;
use super::product::row_products;
use crate::cancel::{CancelToken, Cancelled};
use crate::ids::ClipId;

/// Rows of a block of products, either way.
const BLOCK: usize = 512;

/// The nearest row to one of the rows that were asked about, within one clip.
pub(crate) struct InClip {
    /// Which of the rows that were asked about.
    pub(crate) nth: usize,
    /// The other clip.
    pub(crate) clip: ClipId,
    /// The row in it.
    pub(crate) row: usize,
    /// The f32 cost: off by less than 1e-5 of the squared lengths of the two vectors.
    pub(crate) cost: f32,
}

/// Tells `hear` of the nearest row to each of `rows` in every clip that `wants` of the row's clip,
/// or in a stretch of it: the least of what is heard of a clip is the nearest. From any thread.
pub(crate) fn nearest_in_clips(
    features: &FeatureSet,
    rows: &[usize],
    wants: &(dyn Fn(ClipId, ClipId) -> bool + Sync),
    hear: &(dyn Fn(InClip) + Sync),
    cancel: &CancelToken,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<(), Cancelled> {
    let (k, n_rows) = (features.n_dims, features.n_rows());
    let asked: Vec<f32> = rows.iter().flat_map(|&row| features.row(row).iter().copied()).collect();
    let norm = |row: usize| features.row(row).iter().map(|x| x * x).sum::<f32>();
    let asked_norms: Vec<f32> = rows.iter().map(|&row| norm(row)).collect();
    let asked_clips: Vec<ClipId> = rows.iter().map(|&row| features.clip_of_row(row).0).collect();
    let n_blocks = n_rows.div_ceil(BLOCK);
    let n_done = AtomicUsize::new(0);
    (0..n_blocks).into_par_iter().with_max_len(1).for_each_init(Vec::new, |products, block| {
        if cancel.is_cancelled() {
            return;
        }
        let columns = block * BLOCK..((block + 1) * BLOCK).min(n_rows);
        let norms: Vec<f32> = columns.clone().map(norm).collect();
        for start in (0..rows.len()).step_by(BLOCK) {
            let nths = start..(start + BLOCK).min(rows.len());
            products.resize(nths.len() * columns.len(), 0.0);
            let a = &asked[nths.start * k..nths.end * k];
            row_products(a, &features.rows[columns.start * k..columns.end * k], k, products);
            let mut at = columns.start;
            while at < columns.end {
                let (clip, _) = features.clip_of_row(at);
                let run = at..features.frame_starts[clip.idx() + 1].min(columns.end);
                at = run.end;
                let local = run.start - columns.start..run.end - columns.start;
                for nth in nths.clone() {
                    if !wants(asked_clips[nth], clip) {
                        continue;
                    }
                    let line = &products[(nth - start) * columns.len()..][local.clone()];
                    let pairs = line.iter().zip(&norms[local.clone()]);
                    let least =
                        pairs.map(|(dot, norm)| norm - 2.0 * dot).fold(f32::INFINITY, f32::min);
                    let mut pairs = line.iter().zip(&norms[local.clone()]);
                    let there = pairs.position(|(dot, norm)| norm - 2.0 * dot == least);
                    hear(InClip {
                        nth,
                        clip,
                        row: run.start + there.unwrap_or(0),
                        cost: (least + asked_norms[nth]).max(0.0),
                    });
                }
            }
        }
        let n_done = n_done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(n_done as f32 / n_blocks as f32);
    });
    if cancel.is_cancelled() { Err(Cancelled) } else { Ok(()) }
}

/// For each of `rows`, the least cost to a row of a clip of another family (`∞` without one).
pub(crate) fn nearest_of_other_families(
    features: &FeatureSet,
    rows: &[usize],
    cancel: &CancelToken,
    progress: &(dyn Fn(f32) + Sync),
) -> Result<Vec<f64>, Cancelled> {
    let best: Vec<AtomicU64> = rows.iter().map(|_| AtomicU64::new(u64::MAX)).collect();
    let families = &features.families;
    let wants = |a: ClipId, b: ClipId| families.family(a) != families.family(b);
    // Cost and row in one number: least is least whoever comes first.
    let hear = |found: InClip| {
        let packed = (u64::from(found.cost.to_bits()) << 32) | found.row as u64;
        best[found.nth].fetch_min(packed, Ordering::Relaxed);
    };
    nearest_in_clips(features, rows, &wants, &hear, cancel, progress)?;
    let exact = |(best, &row): (AtomicU64, &usize)| match best.into_inner() {
        u64::MAX => f64::INFINITY,
        packed => features.cost(row, (packed & u64::from(u32::MAX)) as usize),
    };
    Ok(best.into_iter().zip(rows).map(exact).collect())
}

#[cfg(test)]
mod tests {
    use super::super::brute::random_walks;
    use super::*;

    #[test]
    fn they_are_those_of_a_double_loop() {
        let features = random_walks(&[BLOCK + 30, 200, 77], 18, 2);
        let rows: Vec<usize> = (0..features.n_rows()).step_by(3).collect();
        let found = nearest_of_other_families(&features, &rows, &CancelToken::new(), &|_| ())
            .expect("not cancelled");
        for (&row, found) in rows.iter().zip(found) {
            let clip = features.clip_of_row(row).0;
            let others = (0..features.n_rows()).filter(|&b| features.clip_of_row(b).0 != clip);
            let least = others.map(|b| features.cost(row, b)).fold(f64::INFINITY, f64::min);
            assert!((found - least).abs() <= 1e-4 * least + 1e-5, "row {row}: {found}, {least}");
        }
    }
}
