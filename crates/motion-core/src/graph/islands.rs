//! Connected groups of edges in the (from, to) plane of one pair of clips.

use super::forest::Edge;

/// Cuts `edges`, ordered by `(from, to)`, into islands: groups in which each edge has another
/// whose two frames both differ by at most 1 (8-connectivity).
///
/// Islands come in the order of their first edge, and keep the order of edges within.
pub(super) fn islands(edges: &[Edge]) -> Vec<Vec<Edge>> {
    let mut sets = DisjointSets::new(edges.len());
    // `row_start` is where the current from-frame begins; `above` walks the row before it.
    let (mut row_start, mut row_above) = (0, 0);
    let mut above = 0;
    for at in 0..edges.len() {
        let edge = edges[at];
        if at > 0 && edges[at - 1].from_frame != edge.from_frame {
            row_above = row_start;
            row_start = at;
            above = row_above;
        }
        if at > row_start && edges[at - 1].to_frame.0 + 1 == edge.to_frame.0 {
            sets.join(at - 1, at);
        }
        let adjacent =
            row_above < row_start && edges[row_above].from_frame.0 + 1 == edge.from_frame.0;
        if adjacent {
            while above < row_start && edges[above].to_frame.0 + 1 < edge.to_frame.0 {
                above += 1;
            }
            let mut touching = above;
            while touching < row_start && edges[touching].to_frame.0 <= edge.to_frame.0 + 1 {
                sets.join(touching, at);
                touching += 1;
            }
        }
    }
    let mut island_of_root = vec![usize::MAX; edges.len()];
    let mut islands: Vec<Vec<Edge>> = Vec::new();
    for (at, &edge) in edges.iter().enumerate() {
        let root = sets.root(at);
        if island_of_root[root] == usize::MAX {
            island_of_root[root] = islands.len();
            islands.push(Vec::new());
        }
        islands[island_of_root[root]].push(edge);
    }
    islands
}

struct DisjointSets {
    parents: Vec<usize>,
}

impl DisjointSets {
    fn new(n: usize) -> Self {
        Self { parents: (0..n).collect() }
    }

    fn root(&mut self, mut at: usize) -> usize {
        while self.parents[at] != at {
            self.parents[at] = self.parents[self.parents[at]];
            at = self.parents[at];
        }
        at
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::units::FrameIdx;

    fn edges_at(cells: &[(u32, u32)]) -> Vec<Edge> {
        let edge =
            |&(from, to)| Edge { from_frame: FrameIdx(from), to_frame: FrameIdx(to), cost: 1.0 };
        cells.iter().map(edge).collect()
    }

    /// The twin: flood fill over all pairs of edges.
    fn flood_fill(edges: &[Edge]) -> Vec<Vec<Edge>> {
        let mut label = vec![usize::MAX; edges.len()];
        let mut islands = Vec::new();
        for seed in 0..edges.len() {
            if label[seed] != usize::MAX {
                continue;
            }
            let mut members = vec![seed];
            label[seed] = islands.len();
            let mut next = 0;
            while next < members.len() {
                let a = edges[members[next]];
                for (b, other) in edges.iter().enumerate() {
                    let near = a.from_frame.0.abs_diff(other.from_frame.0) <= 1
                        && a.to_frame.0.abs_diff(other.to_frame.0) <= 1;
                    if near && label[b] == usize::MAX {
                        label[b] = islands.len();
                        members.push(b);
                    }
                }
                next += 1;
            }
            members.sort_unstable();
            islands.push(members.into_iter().map(|at| edges[at]).collect());
        }
        islands
    }

    proptest! {
        #[test]
        fn islands_are_those_of_a_flood_fill(
            cells in prop::collection::btree_set((0u32..24, 0u32..24), 0..200)
        ) {
            let edges = edges_at(&cells.into_iter().collect::<Vec<_>>());
            prop_assert_eq!(islands(&edges), flood_fill(&edges));
        }
    }

    #[test]
    fn a_corner_joins_and_a_gap_parts() {
        assert_eq!(islands(&edges_at(&[(1, 1), (2, 2), (3, 1)])).len(), 1, "corners touch");
        assert_eq!(islands(&edges_at(&[(1, 1), (3, 1)])).len(), 2, "a row lies between");
        assert_eq!(islands(&edges_at(&[(1, 1), (1, 3)])).len(), 2, "a column lies between");
    }
}
