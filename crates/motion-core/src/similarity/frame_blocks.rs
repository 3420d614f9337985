//! All frames in blocks of frames that are alike, each block with a box around it.
//!
//! Frames are taken one by one, whatever clips they are of: a few neighbouring frames of one clip
//! already lie farther apart than most frames and their nearest ones. The set is halved where
//! it varies most in the [`Projection`] until blocks are full. So blocks that follow each other are
//! near each other too, and a run of them shares a box: most far blocks are left out by the run.

use rayon::prelude::*;

use super::close_pairs::NOWHERE;
use super::features::FeatureSet;
use super::projection::{N_COORDS, Projection};

/// Frames of a block, but for the last ones of a set.
pub(super) const BLOCK_ROWS: usize = 64;

/// Blocks of a run.
const RUN_BLOCKS: usize = 16;

/// Coordinates of a block's frames, axis by axis; [`NOWHERE`] in places that there are not.
pub(super) type Lanes = [[f32; BLOCK_ROWS]; N_COORDS];

/// The smallest and the largest projected coordinates of a block, a little widened.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f32; N_COORDS],
    pub(super) high: [f32; N_COORDS],
}

impl Bounds {
    /// Around nothing.
    const NONE: Self = Self { low: [f32::INFINITY; N_COORDS], high: [f32::NEG_INFINITY; N_COORDS] };

    /// Around both.
    fn and(mut self, other: &Self) -> Self {
        for axis in 0..N_COORDS {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self
    }

    /// What no two frames within the two cost less than.
    #[inline]
    fn least_cost(&self, other: &Self) -> f32 {
        let mut sum = 0.0;
        for axis in 0..N_COORDS {
            let gaps = (self.low[axis] - other.high[axis], other.low[axis] - self.high[axis]);
            let gap = if gaps.0 > gaps.1 { gaps.0 } else { gaps.1 };
            let gap = if gap > 0.0 { gap } else { 0.0 };
            sum += gap * gap;
        }
        // The sum's own rounding; the coordinates' is in the bounds.
        sum * (1.0 - 1e-5)
    }
}

/// Two blocks that are near each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub(super) a: u32,
    pub(super) b: u32,
    /// What no two frames of the two cost less than.
    pub(super) least_cost: f32,
}

/// A set's frames, block by block.
pub(super) struct FrameBlocks {
    /// The row at each place.
    order: Vec<u32>,
    /// First place of each block, and one more entry at the end.
    starts: Vec<u32>,
    bounds: Vec<Bounds>,
    /// Of every [`RUN_BLOCKS`] blocks together.
    run_bounds: Vec<Bounds>,
    lanes: Vec<Lanes>,
    /// How far a coordinate may be off, widely.
    slack: f32,
    /// Feature vectors in the order of the places.
    values: Vec<f32>,
    n_dims: usize,
    /// Blocks before it hold rows before the one that was named.
    pub(super) first_new: usize,
}

impl FrameBlocks {
    /// The blocks of `features`. Rows before `first_new_row` share no block with those behind,
    /// and come first.
    pub(super) fn new(features: &FeatureSet, first_new_row: usize) -> Self {
        let projection = Projection::of(features);
        let projected: Vec<[f32; N_COORDS]> = (0..features.n_rows())
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
        let (bounds, lanes): (Vec<Bounds>, Vec<Lanes>) = starts
            .par_windows(2)
            .map(|block| {
                let (mut bounds, mut lanes) = (Bounds::NONE, [[NOWHERE; BLOCK_ROWS]; N_COORDS]);
                let rows = &order[block[0] as usize..block[1] as usize];
                for (place, &row) in rows.iter().enumerate() {
                    let at = &projected[row as usize];
                    let [low, high] = [-slack, slack].map(|by| at.map(|value| value + by));
                    bounds = bounds.and(&Bounds { low, high });
                    for (lane, &value) in lanes.iter_mut().zip(at) {
                        lane[place] = value;
                    }
                }
                (bounds, lanes)
            })
            .unzip();
        drop(projected);
        let together = |run: &[Bounds]| run.iter().fold(Bounds::NONE, Bounds::and);
        let run_bounds = bounds.chunks(RUN_BLOCKS).map(together).collect();
        let n_dims = features.n_dims;
        let mut values = vec![0.0; features.rows.len()];
        if n_dims > 0 {
            values.par_chunks_exact_mut(n_dims).zip(&order).for_each(|(values, &row)| {
                values.copy_from_slice(features.row(row as usize));
            });
        }
        Self { order, starts, bounds, run_bounds, lanes, slack, values, n_dims, first_new }
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

    /// A block's feature vectors, one after the other.
    pub(super) fn values(&self, block: usize) -> &[f32] {
        let places = self.places(block);
        &self.values[places.start * self.n_dims..places.end * self.n_dims]
    }

    /// A block's frames in the projection.
    #[inline]
    pub(super) fn lanes(&self, block: usize) -> (&Lanes, &Bounds) {
        (&self.lanes[block], &self.bounds[block])
    }

    /// Squared projected distance, as it is computed, within which all are that cost no more than
    /// `cost`; negative where that is.
    pub(super) fn reach(&self, cost: f32) -> f32 {
        if cost < 0.0 {
            return -1.0;
        }
        let farthest = cost.sqrt() + 2.0 * (N_COORDS as f32).sqrt() * self.slack;
        farthest * farthest * (1.0 + 2e-5)
    }

    /// Appends the blocks from `first` on that may hold frames which cost `at_most` from some of
    /// block `a`.
    pub(super) fn near(&self, a: usize, first: usize, at_most: f32, near: &mut Vec<Near>) {
        let bounds = &self.bounds[a];
        for run in first / RUN_BLOCKS..self.run_bounds.len() {
            if bounds.least_cost(&self.run_bounds[run]) > at_most {
                continue;
            }
            let blocks = run * RUN_BLOCKS..((run + 1) * RUN_BLOCKS).min(self.n_blocks());
            for b in blocks.start.max(first)..blocks.end {
                let least_cost = bounds.least_cost(&self.bounds[b]);
                if least_cost <= at_most {
                    near.push(Near { a: a as u32, b: b as u32, least_cost });
                }
            }
        }
    }
}

/// Orders rows so that every run of a block's length lies together.
fn halve(projected: &[[f32; N_COORDS]], rows: &mut [u32]) {
    let n_blocks = rows.len().div_ceil(BLOCK_ROWS);
    if n_blocks < 2 {
        return;
    }
    let (mut sums, mut squares) = ([0.0f64; N_COORDS], [0.0f64; N_COORDS]);
    for &row in &*rows {
        for (axis, &value) in projected[row as usize].iter().enumerate() {
            sums[axis] += f64::from(value);
            squares[axis] += f64::from(value) * f64::from(value);
        }
    }
    let n = rows.len() as f64;
    let variance = |axis: &usize| squares[*axis] / n - (sums[*axis] / n).powi(2);
    let by_variance = |a: &usize, b: &usize| variance(a).total_cmp(&variance(b));
    let axis = (0..N_COORDS).max_by(by_variance).unwrap_or(0);
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
    use std::collections::HashMap;

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
                assert!(rows.len() <= BLOCK_ROWS && blocks.values(block).len() == 18 * rows.len());
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
            let mut near = Vec::new();
            let mut bounds = HashMap::new();
            for a in 0..blocks.n_blocks() {
                near.clear();
                blocks.near(a, 0, f32::INFINITY, &mut near);
                assert_eq!(near.len(), blocks.n_blocks(), "nothing is farther than everything");
                bounds.extend(near.iter().map(|near| ((near.a, near.b), near.least_cost)));
                blocks.near(a, 0, 0.5, &mut near);
                let all =
                    bounds.iter().filter(|((of, _), least)| *of == a as u32 && **least <= 0.5);
                assert_eq!(near.len() - blocks.n_blocks(), all.count(), "runs hide nothing");
            }
            for a in (0..features.n_rows()).step_by(5) {
                for b in (0..features.n_rows()).step_by(3) {
                    let blocks = [a, b].map(|row| block_of_row[row] as u32);
                    let bound = f64::from(bounds[&(blocks[0], blocks[1])]);
                    let cost = features.cost(a, b);
                    assert!(bound <= cost + 1e-9, "{bound} is above {cost}");
                }
            }
        }
    }
}
