//! All frames in blocks of frames that are alike, each block with a box around it.
//!
//! Frames are taken one by one, whatever clips they are of: a few neighbouring frames of one clip
//! already lie farther apart than most frames and their nearest ones. The set is halved where
//! it varies most in the [`Projection`] until blocks are full.

use rayon::prelude::*;

use super::features::FeatureSet;
use super::projection::{N_AXES, Projection};

/// Frames of a block, but for the last ones of a set.
pub(super) const BLOCK_ROWS: usize = 64;

/// The smallest and the largest projected coordinates of a block, a little widened.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: [f32; N_AXES],
    high: [f32; N_AXES],
}

/// A set's frames, block by block.
pub(super) struct FrameBlocks {
    /// The row at each place.
    order: Vec<u32>,
    /// First place of each block, and one more entry at the end.
    starts: Vec<u32>,
    bounds: Vec<Bounds>,
    /// Feature vectors in the order of the places.
    values: Vec<f32>,
    /// Their squared lengths.
    norms: Vec<f32>,
    n_dims: usize,
    /// Blocks before it hold rows before the one that was named.
    pub(super) first_new: usize,
}

impl FrameBlocks {
    /// The blocks of `features`. Rows before `first_new_row` share no block with those behind,
    /// and come first.
    pub(super) fn new(features: &FeatureSet, first_new_row: usize) -> Self {
        let projection = Projection::of(features);
        let projected: Vec<[f32; N_AXES]> = (0..features.n_rows())
            .into_par_iter()
            .map(|row| projection.project(features.row(row)))
            .collect();
        let mut order: Vec<u32> = (0..features.n_rows() as u32).collect();
        let (old, new) = order.split_at_mut(first_new_row);
        rayon::join(|| halve(&projected, old), || halve(&projected, new));

        let mut starts: Vec<u32> = Vec::new();
        for range in [0..first_new_row, first_new_row..order.len()] {
            starts.extend(range.step_by(BLOCK_ROWS).map(|at| at as u32));
        }
        let first_new = starts.partition_point(|&start| (start as usize) < first_new_row);
        starts.push(order.len() as u32);

        let largest = projected.iter().flatten().fold(0.0f32, |most, x| most.max(x.abs()));
        let slack = 2e-6 * largest;
        let bounds = starts
            .par_windows(2)
            .map(|block| {
                let mut bounds =
                    Bounds { low: [f32::INFINITY; N_AXES], high: [f32::NEG_INFINITY; N_AXES] };
                for &row in &order[block[0] as usize..block[1] as usize] {
                    for (axis, &value) in projected[row as usize].iter().enumerate() {
                        bounds.low[axis] = bounds.low[axis].min(value - slack);
                        bounds.high[axis] = bounds.high[axis].max(value + slack);
                    }
                }
                bounds
            })
            .collect();
        drop(projected);
        let n_dims = features.n_dims;
        let mut values = vec![0.0; features.rows.len()];
        if n_dims > 0 {
            values.par_chunks_exact_mut(n_dims).zip(&order).for_each(|(values, &row)| {
                values.copy_from_slice(features.row(row as usize));
            });
        }
        let norm = |&row: &u32| features.row(row as usize).iter().map(|x| x * x).sum();
        let norms = order.par_iter().map(norm).collect();
        Self { order, starts, bounds, values, norms, n_dims, first_new }
    }

    pub(super) fn n_blocks(&self) -> usize {
        self.starts.len() - 1
    }

    fn places(&self, block: usize) -> std::ops::Range<usize> {
        self.starts[block] as usize..self.starts[block + 1] as usize
    }

    /// The rows of a block.
    pub(super) fn rows(&self, block: usize) -> &[u32] {
        &self.order[self.places(block)]
    }

    /// Squared lengths of a block's feature vectors.
    pub(super) fn norms(&self, block: usize) -> &[f32] {
        &self.norms[self.places(block)]
    }

    /// A block's feature vectors, one after the other.
    pub(super) fn values(&self, block: usize) -> &[f32] {
        let places = self.places(block);
        &self.values[places.start * self.n_dims..places.end * self.n_dims]
    }

    /// What no two frames of the two blocks cost less than.
    #[inline]
    pub(super) fn least_cost(&self, a: usize, b: usize) -> f32 {
        let (a, b) = (&self.bounds[a], &self.bounds[b]);
        let mut sum = 0.0;
        for axis in 0..N_AXES {
            let gap = (a.low[axis] - b.high[axis]).max(b.low[axis] - a.high[axis]).max(0.0);
            sum += gap * gap;
        }
        // The sum's own rounding; the coordinates' is in the bounds.
        sum * (1.0 - 1e-5)
    }
}

/// Orders rows so that every run of a block's length lies together.
fn halve(projected: &[[f32; N_AXES]], rows: &mut [u32]) {
    let n_blocks = rows.len().div_ceil(BLOCK_ROWS);
    if n_blocks < 2 {
        return;
    }
    let (mut sums, mut squares) = ([0.0f64; N_AXES], [0.0f64; N_AXES]);
    for &row in &*rows {
        for (axis, &value) in projected[row as usize].iter().enumerate() {
            sums[axis] += f64::from(value);
            squares[axis] += f64::from(value) * f64::from(value);
        }
    }
    let n = rows.len() as f64;
    let variance = |axis: &usize| squares[*axis] / n - (sums[*axis] / n).powi(2);
    let by_variance = |a: &usize, b: &usize| variance(a).total_cmp(&variance(b));
    let axis = (0..N_AXES).max_by(by_variance).unwrap_or(0);
    let cut = n_blocks.div_ceil(2) * BLOCK_ROWS;
    rows.select_nth_unstable_by(cut - 1, |&a, &b| {
        let at = |row: u32| projected[row as usize][axis];
        at(a).total_cmp(&at(b)).then(a.cmp(&b))
    });
    let (near, far) = rows.split_at_mut(cut);
    if near.len() > 1 << 14 {
        rayon::join(|| halve(projected, near), || halve(projected, far));
    } else {
        halve(projected, near);
        halve(projected, far);
    }
}

#[cfg(test)]
mod tests {
    use super::super::brute::random_walks;
    use super::*;

    #[test]
    fn every_frame_is_in_one_block_and_bounds_hold() {
        let features = random_walks(&[300, 1, 17, 200], 18, 3);
        for first_new_row in [0, 301, 518] {
            let blocks = FrameBlocks::new(&features, first_new_row);
            let mut block_of_row = vec![usize::MAX; features.n_rows()];
            for block in 0..blocks.n_blocks() {
                let rows = blocks.rows(block);
                assert!(rows.len() <= BLOCK_ROWS && blocks.norms(block).len() == rows.len());
                for (place, &row) in rows.iter().enumerate() {
                    let row = row as usize;
                    assert_eq!(block_of_row[row], usize::MAX, "row {row} twice");
                    block_of_row[row] = block;
                    assert_eq!(row >= first_new_row, block >= blocks.first_new);
                    let values = &blocks.values(block)[place * 18..(place + 1) * 18];
                    assert_eq!(values, features.row(row));
                }
            }
            assert!(!block_of_row.contains(&usize::MAX), "every row");
            for a in (0..features.n_rows()).step_by(5) {
                for b in (0..features.n_rows()).step_by(3) {
                    let bound = f64::from(blocks.least_cost(block_of_row[a], block_of_row[b]));
                    let cost = features.cost(a, b);
                    assert!(bound <= cost + 1e-9, "{bound} is above {cost}");
                }
            }
        }
    }
}
