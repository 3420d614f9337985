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

    /// Where each row's edges begin, with one more entry at the end; the rows they lead to; their
    /// costs. For a file.
    pub fn columns(&self) -> (&[u32], &[u32], &[f32]) {
        (&self.starts, &self.to, &self.costs)
    }

    /// The edges of [`DirectedEdges::columns`]; `None` where they are not of one shape, lead to
    /// rows that there are not, are out of order, or cost what cannot be.
    pub fn from_columns(starts: Vec<u32>, to: Vec<u32>, costs: Vec<f32>) -> Option<Self> {
        let n_rows = starts.len().checked_sub(1)?;
        let ends = (starts[0], starts[n_rows] as usize);
        let is_shape = ends == (0, to.len()) && to.len() == costs.len() && starts.is_sorted();
        let are_costs = costs.iter().all(|cost| cost.is_finite() && *cost >= 0.0);
        let is_in_order = |run: &[u32]| {
            let own = &to[run[0] as usize..run[1] as usize];
            own.is_sorted_by(|a, b| a < b) && own.last().is_none_or(|&to| (to as usize) < n_rows)
        };
        let is_whole = is_shape && are_costs && starts.windows(2).all(is_in_order);
        is_whole.then_some(Self { starts, to, costs })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_are_listed_in_order() {
        let pair = |a, b, cost| NearPair { a, b, cost };
        let pairs = [pair(0, 2, 0.5), pair(0, 3, 0.25), pair(1, 2, 0.75), pair(2, 3, 0.1)];
        let edges = DirectedEdges::both_ways(4, &pairs);
        assert_eq!(edges.of(2).collect::<Vec<_>>(), [(0, 0.5), (1, 0.75), (3, 0.1)]);
        assert_eq!(edges.len(), 8);
        let collected = DirectedEdges::collect(4, |row, list| {
            list.extend(edges.of(row));
            list.reverse();
        });
        assert_eq!(collected, edges, "in any order");
    }

    #[test]
    fn columns_come_back_and_broken_ones_are_refused() {
        let check = |starts: &[u32], to: &[u32], costs: &[f32]| {
            DirectedEdges::from_columns(starts.to_vec(), to.to_vec(), costs.to_vec()).is_some()
        };
        assert!(check(&[0, 2, 2], &[0, 1], &[0.5, 0.0]));
        assert!(!check(&[], &[], &[]), "no rows are one entry");
        assert!(!check(&[0, 1, 2], &[0, 2], &[0.5, 0.5]), "no such row");
        assert!(!check(&[0, 2, 2], &[1, 0], &[0.5, 0.5]), "out of order");
        assert!(!check(&[0, 2, 1], &[0, 1], &[0.5, 0.5]), "backwards");
        assert!(!check(&[0, 2, 2], &[0, 1], &[0.5, f32::NAN]), "no cost");
        assert!(!check(&[0, 2, 3], &[0, 1], &[0.5, 0.5]), "too long");
    }
}
