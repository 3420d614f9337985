//! Edges from frame to frame, listed by the frame that is left.

use rayon::prelude::*;

use super::distance_grid::NearPair;

/// The row that an edge leads to, and its cost.
pub type Kept = (u32, f32);

/// For each row the rows that edges lead to, in order, with their costs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectedEdges {
    /// Where each row's edges begin; one more entry at the end.
    starts: Vec<u32>,
    to: Vec<u32>,
    costs: Vec<f32>,
}

/// Rows that are collected at once.
const ROWS_AT_ONCE: usize = 1 << 16;

impl DirectedEdges {
    /// The edges that `list` appends for each of `n_rows` rows, in any order.
    pub fn collect(n_rows: usize, list: impl Fn(usize, &mut Vec<Kept>) + Sync) -> Self {
        let mut all = Self { starts: Vec::with_capacity(n_rows + 1), to: vec![], costs: vec![] };
        all.starts.push(0);
        let n_runs = n_rows.div_ceil(ROWS_AT_ONCE);
        let run = |nth: usize| nth * ROWS_AT_ONCE..((nth + 1) * ROWS_AT_ONCE).min(n_rows);
        // A few runs side by side: all at once would take as much memory as the outcome.
        for first in (0..n_runs).step_by(4) {
            let found: Vec<(Vec<u32>, Vec<Kept>)> = (first..(first + 4).min(n_runs))
                .into_par_iter()
                .map(|nth| {
                    let (mut counts, mut edges, mut own) = (Vec::new(), Vec::new(), Vec::new());
                    for row in run(nth) {
                        own.clear();
                        list(row, &mut own);
                        own.sort_unstable_by_key(|&(to, _)| to);
                        counts.push(own.len() as u32);
                        edges.extend_from_slice(&own);
                    }
                    (counts, edges)
                })
                .collect();
            for (counts, edges) in found {
                for count in counts {
                    all.starts.push(all.starts[all.starts.len() - 1] + count);
                }
                all.to.extend(edges.iter().map(|&(to, _)| to));
                all.costs.extend(edges.iter().map(|&(_, cost)| cost));
            }
        }
        all
    }

    /// Both directions of each of `pairs`, which are ordered by `(a, b)`.
    pub fn both_ways(n_rows: usize, pairs: &[NearPair]) -> Self {
        let mut starts = vec![0u32; n_rows + 1];
        for pair in pairs {
            starts[pair.a as usize + 1] += 1;
            starts[pair.b as usize + 1] += 1;
        }
        for row in 0..n_rows {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let n = starts[n_rows] as usize;
        let (mut to, mut costs) = (vec![0u32; n], vec![0f32; n]);
        let mut put = |from: u32, into: u32, cost: f32| {
            let at = &mut next[from as usize];
            to[*at as usize] = into;
            costs[*at as usize] = cost;
            *at += 1;
        };
        // Smaller rows first, then larger ones: each list is in order without sorting.
        pairs.iter().for_each(|pair| put(pair.b, pair.a, pair.cost));
        pairs.iter().for_each(|pair| put(pair.a, pair.b, pair.cost));
        Self { starts, to, costs }
    }

    /// How many rows there are.
    pub fn n_rows(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// How many edges there are.
    pub fn len(&self) -> usize {
        self.to.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.to.is_empty()
    }

    /// The edges that leave a row, by the row that they lead to.
    pub fn of(&self, row: usize) -> impl Iterator<Item = Kept> + '_ {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        self.to[range.clone()].iter().copied().zip(self.costs[range].iter().copied())
    }
}
