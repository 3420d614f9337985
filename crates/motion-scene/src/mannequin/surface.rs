//! The field's zero as triangles: surface nets (Gibson 1998) on a grid of which only the
//! neighbourhood of the surface is ever looked at.
//!
//! A cell whose corners are on both sides gets one vertex, an edge whose ends are on both sides a
//! quadrilateral of its four cells. That is a closed 2-manifold as long as no cell's surface is in
//! two pieces; corners are filled until none is (Latecki 1995, "well-composed" pictures).

use glam::Vec3;
use rayon::prelude::*;

use super::field::Field;
use super::grid::Grid;
use super::search::{BLOCK_CELLS, Found, Search};

/// Triangles and nothing else.
#[derive(Clone, Debug, Default)]
pub(super) struct RawMesh {
    pub(super) positions_m: Vec<Vec3>,
    /// Counter-clockwise from outside.
    pub(super) triangles: Vec<[u32; 3]>,
}

impl RawMesh {
    /// With its image in the plane x = `middle_m`, on which its border lies.
    pub(super) fn mirrored(mut self, middle_m: f32) -> Self {
        let n = self.positions_m.len();
        let mut image = Vec::with_capacity(n);
        for idx in 0..n {
            let p = self.positions_m[idx];
            if p.x == middle_m {
                image.push(idx as u32);
            } else {
                image.push(self.positions_m.len() as u32);
                self.positions_m.push(Vec3::new(2.0 * middle_m - p.x, p.y, p.z));
            }
        }
        let mirror = |t: [u32; 3]| [t[0], t[2], t[1]].map(|v| image[v as usize]);
        let images: Vec<[u32; 3]> = self.triangles.iter().map(|&t| mirror(t)).collect();
        self.triangles.extend(images);
        self
    }
}

const UNKNOWN: f32 = f32::NAN;
const NO_VERTEX: u32 = u32::MAX;

/// A surface being found.
pub(super) struct Net<'a> {
    field: Field<'a>,
    pub(super) grid: &'a Grid,
    size: [usize; 3],
    /// The field at corners that were asked.
    values: Vec<f32>,
    /// Low corners of cells near the surface, each once.
    cells: Vec<usize>,
    /// Whether a corner is among them.
    is_cell: Vec<bool>,
}

/// The surface of `field` on `grid`; its half at x ≥ the mirror's where there is one.
pub(super) fn polygonise(field: Field<'_>, grid: &Grid) -> RawMesh {
    let size = grid.size();
    let n_corners = size.iter().product();
    let (values, is_cell) = (vec![UNKNOWN; n_corners], vec![false; n_corners]);
    let mut net = Net { field, grid, size, values, cells: Vec::new(), is_cell };
    net.find_cells();
    net.follow_from(0);
    net.fill_until_manifold();
    net.cells.sort_unstable();
    net.mesh()
}

impl Net<'_> {
    pub(super) fn corner_idx(&self, at: [usize; 3]) -> usize {
        (at[2] * self.size[1] + at[1]) * self.size[0] + at[0]
    }

    fn corner_at(&self, idx: usize) -> [usize; 3] {
        let (row, x) = (idx / self.size[0], idx % self.size[0]);
        [x, row % self.size[1], row / self.size[1]]
    }

    /// How far corner indices lie apart along each axis.
    fn strides(&self) -> [usize; 3] {
        [1, self.size[0], self.size[0] * self.size[1]]
    }

    fn find_cells(&mut self) {
        let n: [usize; 3] = self.size.map(|corners| corners - 1);
        let mut blocks: Vec<[[usize; 3]; 2]> = Vec::new();
        for z in (0..n[2]).step_by(BLOCK_CELLS) {
            for y in (0..n[1]).step_by(BLOCK_CELLS) {
                for x in (0..n[0]).step_by(BLOCK_CELLS) {
                    let low = [x, y, z];
                    blocks.push([low, std::array::from_fn(|i| (low[i] + BLOCK_CELLS).min(n[i]))]);
                }
            }
        }
        let this = &*self;
        let found: Vec<Found> = blocks
            .par_iter()
            .map(|&[low, high]| Search::run(this, &this.field, low, high))
            .collect();
        // Corners on a block's side were asked from both; the first answer stays.
        for found in found {
            for (idx, value) in found.corners {
                if self.values[idx].is_nan() {
                    self.values[idx] = value;
                }
            }
            for at in found.cells {
                self.add_cell(at);
            }
        }
    }

    /// The field at a corner; the column before a mirror's is its image, and nothing leaves the
    /// grid.
    pub(super) fn value(&self, field: &Field<'_>, at: [usize; 3]) -> f32 {
        let is_image = self.grid.mirror_x_m.is_some() && at[0] == 0;
        let at = if is_image { [1, at[1], at[2]] } else { at };
        let d = field.distance_m(self.grid.corner_m(at));
        let is_outermost = (0..3).any(|i| at[i] == 0 || at[i] + 1 == self.size[i]);
        let least = if is_outermost { 1e-6 } else { f32::MIN };
        if d.is_finite() { d.max(least) } else { 1e9 }
    }

    fn ask(&mut self, field: &Field<'_>, at: [usize; 3]) -> f32 {
        let idx = self.corner_idx(at);
        if self.values[idx].is_nan() {
            self.values[idx] = self.value(field, at);
        }
        self.values[idx]
    }

    fn add_cell(&mut self, at: [usize; 3]) {
        let idx = self.corner_idx(at);
        if !std::mem::replace(&mut self.is_cell[idx], true) {
            self.cells.push(idx);
        }
    }

    /// Follows the surface from cell to cell, from the `first` of the list on, so that it closes
    /// even where the field promised too much room.
    fn follow_from(&mut self, first: usize) {
        let strides = self.strides();
        let offsets = corner_offsets(strides);
        let field = self.field.clone();
        let mut next = first;
        while next < self.cells.len() {
            let cell = self.cells[next];
            next += 1;
            let inside = offsets.map(|o| self.values[cell + o] < 0.0);
            let n_inside = inside.iter().filter(|&&inside| inside).count();
            if n_inside == 0 || n_inside == 8 {
                continue;
            }
            let at = self.corner_at(cell);
            for axis in 0..3 {
                for is_high in [false, true] {
                    let on_face = |i: &usize| (i & (1 << axis) != 0) == is_high;
                    let n_face = (0..8).filter(on_face).filter(|&i| inside[i]).count();
                    let is_at_end =
                        if is_high { at[axis] + 2 >= self.size[axis] } else { at[axis] == 0 };
                    if n_face == 0 || n_face == 4 || is_at_end {
                        continue;
                    }
                    let mut beyond = at;
                    beyond[axis] = if is_high { at[axis] + 1 } else { at[axis] - 1 };
                    if self.is_cell[self.corner_idx(beyond)] {
                        continue;
                    }
                    for i in 0..8 {
                        let bit = |axis: usize| (i >> axis) & 1;
                        self.ask(&field, std::array::from_fn(|axis| beyond[axis] + bit(axis)));
                    }
                    self.add_cell(beyond);
                }
            }
        }
    }

    /// Fills corners where a cell's surface would be in two pieces: two corners of one side that
    /// meet over a face's or the cell's diagonal alone.
    fn fill_until_manifold(&mut self) {
        let strides = self.strides();
        let all = self.field.clone();
        // Filling only ever adds, so it ends; the bound is for reading.
        for _ in 0..64 {
            let mut filled: Vec<usize> = Vec::new();
            for &cell in &self.cells {
                let corners = corner_offsets(strides).map(|o| cell + o);
                let inside = corners.map(|c| self.values[c] < 0.0);
                for diagonal in split_diagonals(&inside) {
                    filled.extend(diagonal.iter().map(|&i| corners[i]));
                }
            }
            if filled.is_empty() {
                return;
            }
            filled.sort_unstable();
            filled.dedup();
            let n_before = self.cells.len();
            for idx in filled {
                let at = self.corner_at(idx);
                self.fill(&all, at);
                if self.grid.mirror_x_m.is_some() && at[0] < 2 {
                    self.fill(&all, [1 - at[0], at[1], at[2]]);
                }
            }
            self.follow_from(n_before);
        }
    }

    fn fill(&mut self, field: &Field<'_>, at: [usize; 3]) {
        let idx = self.corner_idx(at);
        self.values[idx] = -1e-6;
        let low: [usize; 3] = at.map(|i| i.saturating_sub(1));
        let high: [usize; 3] = std::array::from_fn(|i| (at[i] + 1).min(self.size[i] - 1));
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    self.ask(field, [x, y, z]);
                    if x < high[0] && y < high[1] && z < high[2] {
                        self.add_cell([x, y, z]);
                    }
                }
            }
        }
    }

    fn mesh(&self) -> RawMesh {
        let strides = self.strides();
        let mut mesh = RawMesh::default();
        let mut vertex_of = vec![NO_VERTEX; self.values.len()];
        for &cell in &self.cells {
            if let Some(mut position) = self.vertex_m(cell, strides) {
                if let Some(middle) = self.grid.mirror_x_m
                    && self.corner_at(cell)[0] == 0
                {
                    position.x = middle;
                }
                vertex_of[cell] = mesh.positions_m.len() as u32;
                mesh.positions_m.push(position);
            }
        }
        for &cell in &self.cells {
            if vertex_of[cell] == NO_VERTEX {
                continue;
            }
            let at = self.corner_at(cell);
            if self.grid.mirror_x_m.is_some() && at[0] == 0 {
                continue; // the mirror's side
            }
            for axis in 0..3 {
                let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
                let starts_inside = self.values[cell] < 0.0;
                let ends_inside = self.values[cell + strides[axis]] < 0.0;
                if starts_inside == ends_inside || at[b] == 0 || at[c] == 0 {
                    continue;
                }
                let mut quad =
                    [cell, cell - strides[b], cell - strides[b] - strides[c], cell - strides[c]]
                        .map(|cell| vertex_of[cell]);
                if quad.contains(&NO_VERTEX) {
                    continue;
                }
                if !starts_inside {
                    quad.reverse();
                }
                mesh.triangles.extend(halves(&mesh.positions_m, quad));
            }
        }
        mesh
    }

    /// The middle of where the surface crosses a cell's edges.
    fn vertex_m(&self, cell: usize, strides: [usize; 3]) -> Option<Vec3> {
        let corners = corner_offsets(strides).map(|o| cell + o);
        let values = corners.map(|c| self.values[c]);
        let points = corners.map(|c| self.grid.corner_m(self.corner_at(c)));
        let (mut sum, mut n) = (Vec3::ZERO, 0.0);
        for a in 0..8 {
            for axis in 0..3 {
                let b = a | (1 << axis);
                if b != a && (values[a] < 0.0) != (values[b] < 0.0) {
                    // Kept off the corners, so that no triangle shrinks to a point.
                    let t = (values[a] / (values[a] - values[b])).clamp(0.02, 0.98);
                    sum += points[a].lerp(points[b], t);
                    n += 1.0;
                }
            }
        }
        (n > 0.0).then(|| sum / n)
    }
}

/// A quadrilateral cut along its shorter diagonal.
fn halves(positions_m: &[Vec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let at = |v: u32| positions_m[v as usize];
    if at(a).distance_squared(at(c)) <= at(b).distance_squared(at(d)) {
        [[a, b, c], [a, c, d]]
    } else {
        [[a, b, d], [b, c, d]]
    }
}

/// Corner i of a cell is at +x, +y, +z where bits 0, 1, 2 of i are set.
fn corner_offsets(strides: [usize; 3]) -> [usize; 8] {
    std::array::from_fn(|i| {
        (0..3).map(|axis| if i & (1 << axis) == 0 { 0 } else { strides[axis] }).sum()
    })
}

/// Pairs of outside corners that keep a cell's inside or outside in two pieces.
fn split_diagonals(inside: &[bool; 8]) -> Vec<[usize; 2]> {
    let mut found = Vec::new();
    let n_inside = inside.iter().filter(|&&inside| inside).count();
    if !(2..=6).contains(&n_inside) {
        return found;
    }
    for axis in 0..3 {
        let (b, c) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        for base in [0, 1 << axis] {
            let [p, q, r, s] = [base, base | b, base | b | c, base | c];
            if inside[p] == inside[r] && inside[q] == inside[s] && inside[p] != inside[q] {
                found.push(if inside[p] { [q, s] } else { [p, r] });
            }
        }
    }
    for a in 0..4 {
        let b = 7 - a;
        if inside[a] == inside[b] && (n_inside == 2 && inside[a] || n_inside == 6 && !inside[a]) {
            // Two lone corners across the cell: their neighbours join them.
            if inside[a] {
                found.push([a ^ 1, b ^ 1]);
            } else {
                found.push([a, b]);
            }
        }
    }
    found
}
