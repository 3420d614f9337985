//! Which cells of a grid the surface may cross, block by block: blocks that the field says are far
//! from it are left, others halved until they are small.

use super::field::Field;
use super::surface::Net;

/// Blocks are halved until they are this small.
const LEAF_CELLS: usize = 2;
/// The cells along a side of a whole block.
pub(super) const BLOCK_CELLS: usize = 16;

/// How much longer a way may be than the field says; see `shape.rs`.
const SLACK: f32 = 1.5;

/// What a block's search found.
#[derive(Default)]
pub(super) struct Found {
    /// The field at corners that were asked, by their number.
    pub(super) corners: Vec<(usize, f32)>,
    /// Low corners of cells.
    pub(super) cells: Vec<[usize; 3]>,
}

/// The search for cells in one block of the grid.
pub(super) struct Search<'a> {
    net: &'a Net<'a>,
    low: [usize; 3],
    found: Found,
    /// Which corners of the block were asked; empty before the first.
    known: Vec<bool>,
}

impl<'a> Search<'a> {
    /// What is found in the block between two corners.
    pub(super) fn run(
        net: &'a Net<'a>,
        field: &Field<'_>,
        low: [usize; 3],
        high: [usize; 3],
    ) -> Found {
        let mut search = Self { net, low, found: Found::default(), known: Vec::new() };
        search.block(field, low, high);
        search.found
    }

    fn ask(&mut self, field: &Field<'_>, at: [usize; 3]) {
        const SIDE: usize = BLOCK_CELLS + 1;
        if self.known.is_empty() {
            self.known = vec![false; SIDE * SIDE * SIDE];
        }
        let [x, y, z]: [usize; 3] = std::array::from_fn(|i| at[i] - self.low[i]);
        if !std::mem::replace(&mut self.known[(z * SIDE + y) * SIDE + x], true) {
            self.found.corners.push((self.net.corner_idx(at), self.net.value(field, at)));
        }
    }

    fn block(&mut self, field: &Field<'_>, low: [usize; 3], high: [usize; 3]) {
        let (a, b) = (self.net.grid.corner_m(low), self.net.grid.corner_m(high));
        let (center, radius_m) = (0.5 * (a + b), 0.5 * a.distance(b));
        let d_m = field.distance_m(center);
        if d_m.abs() > SLACK * radius_m {
            return;
        }
        let longest = (0..3).map(|i| high[i] - low[i]).max().unwrap_or(0);
        if longest <= LEAF_CELLS {
            for z in low[2]..=high[2] {
                for y in low[1]..=high[1] {
                    for x in low[0]..=high[0] {
                        self.ask(field, [x, y, z]);
                        if x < high[0] && y < high[1] && z < high[2] {
                            self.found.cells.push([x, y, z]);
                        }
                    }
                }
            }
            return;
        }
        let near = field.within(center, radius_m, d_m);
        let cuts: [Vec<usize>; 3] = std::array::from_fn(|i| {
            let (from, to) = (low[i], high[i]);
            let is_small = to - from <= LEAF_CELLS;
            if is_small { vec![from, to] } else { vec![from, from + (to - from) / 2, to] }
        });
        for z in cuts[2].windows(2) {
            for y in cuts[1].windows(2) {
                for x in cuts[0].windows(2) {
                    self.block(&near, [x[0], y[0], z[0]], [x[1], y[1], z[1]]);
                }
            }
        }
    }
}
