//! Pairs of frames of two blocks that the projection does not keep apart.
//!
//! First frames are held against the other block's box, then what is left against each other, sixteen
//! at a time. Of the pairs of two blocks that are near each other some hundredths remain, and only
//! those are compared at full width.

use super::frame_blocks::{BLOCK_ROWS, Bounds, Lanes};
use super::projection::N_COORDS;
use super::rough_cost::{rough_cost, rounding};

/// Frames that are compared with one at once.
const WIDTH: usize = 16;

/// Farther away than anything, and its square is still a number.
pub(super) const NOWHERE: f32 = 1e18;

/// A block of frames and how far each still looks.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) lanes: &'a Lanes,
    pub(super) bounds: &'a Bounds,
    /// Feature vectors, one after the other.
    pub(super) values: &'a [f32],
    /// Cost up to which a frame wants others; negative where it wants none.
    pub(super) limits: &'a [f32; BLOCK_ROWS],
    /// The same as squared projected distances.
    pub(super) reaches: &'a [f32; BLOCK_ROWS],
}

/// Two frames that are near each other, by their places, and about what they cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClosePair {
    pub(super) a: u8,
    pub(super) b: u8,
    /// Right to within [`rounding`] of itself.
    pub(super) cost: f32,
}

/// The larger of two numbers that are numbers.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Side<'_> {
    fn farthest(&self) -> f32 {
        self.reaches.iter().fold(-1.0, |most, &reach| larger(most, reach))
    }

    /// Places of frames near enough to the other side's box for them or for any of its frames.
    #[inline(always)]
    fn near_box<'p>(&self, other: &Side<'_>, places: &'p mut [u8; BLOCK_ROWS]) -> &'p [u8] {
        let mut sums = [0.0f32; BLOCK_ROWS];
        for axis in 0..N_COORDS {
            let (low, high) = (other.bounds.low[axis], other.bounds.high[axis]);
            for (sum, &at) in sums.iter_mut().zip(&self.lanes[axis]) {
                let gap = larger(larger(low - at, at - high), 0.0);
                *sum += gap * gap;
            }
        }
        let farthest = other.farthest();
        let mut n = 0;
        for (place, (&sum, &reach)) in sums.iter().zip(self.reaches).enumerate() {
            places[n] = place as u8;
            n += usize::from(sum <= larger(reach, farthest));
        }
        &places[..n]
    }
}

/// Appends all pairs of places that cost no more than the larger of their two limits, or a little
/// more; within a block (`is_same`) each pair once. Vectors have `n_dims` numbers.
pub(super) fn close_pairs(
    a: &Side<'_>,
    b: &Side<'_>,
    n_dims: usize,
    is_same: bool,
    pairs: &mut Vec<ClosePair>,
) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        #[expect(unsafe_code, reason = "eight numbers at once, where the processor can")]
        // SAFETY: it can, as was just asked.
        unsafe {
            wide(a, b, n_dims, is_same, pairs);
        }
        return;
    }
    find(a, b, n_dims, is_same, pairs);
}

/// [`find`] for processors that take eight numbers at once. The same operations, so the same pairs.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn wide(a: &Side<'_>, b: &Side<'_>, n_dims: usize, is_same: bool, pairs: &mut Vec<ClosePair>) {
    find(a, b, n_dims, is_same, pairs);
}

#[inline(always)]
fn find<'a>(a: &Side<'a>, b: &Side<'a>, n_dims: usize, is_same: bool, pairs: &mut Vec<ClosePair>) {
    let share = 1.0 - rounding(n_dims);
    let (mut room_a, mut room_b) = ([0; BLOCK_ROWS], [0; BLOCK_ROWS]);
    let near_a = a.near_box(b, &mut room_a);
    let near_b = b.near_box(a, &mut room_b);
    // The other block's frames that are left, sixteen by sixteen, axis by axis.
    let mut columns = [[[NOWHERE; WIDTH]; N_COORDS]; BLOCK_ROWS / WIDTH];
    let mut reaches = [[-1.0f32; WIDTH]; BLOCK_ROWS / WIDTH];
    let n_chunks = near_b.len().div_ceil(WIDTH);
    for (nth, &place) in near_b.iter().enumerate() {
        let (chunk, lane, place) = (nth / WIDTH, nth % WIDTH, usize::from(place));
        for (column, axis) in columns[chunk].iter_mut().zip(b.lanes) {
            column[lane] = axis[place];
        }
        reaches[chunk][lane] = b.reaches[place];
    }
    for &here in near_a {
        let place = usize::from(here);
        let reach = a.reaches[place];
        for chunk in 0..n_chunks {
            let mut sums = [0.0f32; WIDTH];
            for (axis, column) in columns[chunk].iter().enumerate() {
                let at = a.lanes[axis][place];
                for (sum, &other) in sums.iter_mut().zip(column) {
                    *sum += (at - other) * (at - other);
                }
            }
            let mut close = 0u32;
            for (lane, (&sum, &other)) in sums.iter().zip(&reaches[chunk]).enumerate() {
                close |= u32::from(sum <= larger(reach, other)) << lane;
            }
            while close != 0 {
                let there = near_b[chunk * WIDTH + close.trailing_zeros() as usize];
                close &= close - 1;
                if is_same && here >= there {
                    continue;
                }
                let value = |side: &Side<'a>, place: u8| {
                    let start = usize::from(place) * n_dims;
                    &side.values[start..start + n_dims]
                };
                let cost = rough_cost(value(a, here), value(b, there));
                let limit = larger(a.limits[place], b.limits[usize::from(there)]);
                if cost * share <= limit {
                    pairs.push(ClosePair { a: here, b: there, cost });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::brute::random_walks;
    use super::super::frame_blocks::FrameBlocks;
    use super::*;

    #[test]
    fn no_pair_within_a_limit_is_missed_with_wide_numbers_or_without() {
        let features = random_walks(&[150, 77, 1], 40, 9);
        let blocks = FrameBlocks::new(&features, 0);
        let (mut n_close, mut n_all) = (0, 0);
        for a in 0..blocks.n_blocks() {
            for b in a..blocks.n_blocks() {
                // Some want nothing, some little, some much.
                let limits = [a, b].map(|block| {
                    let mut limits = [f32::NEG_INFINITY; BLOCK_ROWS];
                    for place in 0..blocks.rows(block).len() {
                        limits[place] = [-1.0, 0.2, 0.6, 1.5][(place + block) % 4];
                    }
                    limits
                });
                let reaches = limits.map(|limits| limits.map(|limit| blocks.reach(limit)));
                let side = |nth: usize, block: usize| {
                    let (lanes, bounds) = blocks.lanes(block);
                    let values = blocks.values(block);
                    Side { lanes, bounds, values, limits: &limits[nth], reaches: &reaches[nth] }
                };
                let (mut found, mut plain) = (Vec::new(), Vec::new());
                close_pairs(&side(0, a), &side(1, b), 40, a == b, &mut found);
                find(&side(0, a), &side(1, b), 40, a == b, &mut plain);
                assert_eq!(found, plain, "the same pairs at the same costs");
                for (i, &row) in blocks.rows(a).iter().enumerate() {
                    let first = if a == b { i + 1 } else { 0 };
                    for (j, &other) in blocks.rows(b).iter().enumerate().skip(first) {
                        let cost = features.cost(row as usize, other as usize);
                        let is_there =
                            found.iter().any(|pair| (pair.a, pair.b) == (i as u8, j as u8));
                        let is_close = cost <= f64::from(limits[0][i].max(limits[1][j]));
                        assert!(is_there || !is_close, "{row} and {other} cost {cost}");
                        n_close += usize::from(is_there);
                        n_all += 1;
                    }
                }
            }
        }
        assert!(n_close > 100 && n_close < n_all / 2, "{n_close} of {n_all}");
    }
}
