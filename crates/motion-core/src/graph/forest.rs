//! All edges of all levels: binary trees in one array.

use std::ops::Range;

use rayon::prelude::*;

use super::bridges::Bridge;
use crate::ids::ClipId;
use crate::units::FrameIdx;

/// A node of the [`Forest`]: an edge of some level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EdgeId(pub u32);

impl EdgeId {
    #[inline]
    fn idx(self) -> usize {
        self.0 as usize
    }
}

/// A cut: instead of frame `from_frame` of one clip, frame `to_frame` of the other is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The frame that is not shown any more.
    pub from_frame: FrameIdx,
    /// The frame that is shown in its place.
    pub to_frame: FrameIdx,
    /// `C` of the two frames; for an inner node the mean over its leaves.
    pub cost: f32,
}

/// The edges from one clip to another: a run of nodes, trees under τ first, then bridges.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipPair {
    /// The clip that is left.
    pub from: ClipId,
    /// The clip that is entered.
    pub to: ClipId,
    /// First node of the pair.
    pub first_node: u32,
    /// First node that is a bridge: a single leaf that joins parts that τ leaves apart.
    pub first_bridge: u32,
    /// One past the pair's last node.
    pub end_node: u32,
}

impl ClipPair {
    /// Nodes of trees under τ.
    pub fn tau_nodes(&self) -> Range<u32> {
        self.first_node..self.first_bridge
    }

    /// Nodes that are bridges.
    pub fn bridge_nodes(&self) -> Range<u32> {
        self.first_bridge..self.end_node
    }
}

/// Trees of edges, pair after pair, each tree in depth-first order.
///
/// A tree with `n` leaves takes `2n − 1` nodes; the left child of an inner node follows it, the
/// right child follows the left subtree. So a node needs no pointers, only its leaf count.
///
/// Invariants, checked by [`Forest::from_parts`]:
/// 1. All node arrays have the same length; pairs are ordered by `(from, to)`, without repeats,
///    and their node runs follow each other and cover all nodes.
/// 2. Each run splits into whole trees, and bridges are single leaves.
/// 3. Frames lie within their clips and costs are finite and not negative.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forest {
    from_frames: Vec<u32>,
    to_frames: Vec<u32>,
    costs: Vec<f32>,
    n_leaves: Vec<u32>,
    pairs: Vec<ClipPair>,
    pair_starts: Vec<u32>,
}

/// The columns of a [`Forest`], as files keep them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForestParts {
    /// Frame left, per node.
    pub from_frames: Vec<u32>,
    /// Frame entered, per node.
    pub to_frames: Vec<u32>,
    /// Cost, per node.
    pub costs: Vec<f32>,
    /// Leaves under it, per node (1 for a leaf).
    pub n_leaves: Vec<u32>,
    /// The pairs, in order.
    pub pairs: Vec<ClipPair>,
}

/// Old nodes and the new ones that follow them.
pub(super) struct Run {
    pub(super) old: Range<u32>,
    pub(super) new: Range<usize>,
}

fn interleaved<T: Copy>(old: &[T], new: &[T], runs: &[Run]) -> Vec<T> {
    let mut column = Vec::with_capacity(old.len() + new.len());
    for run in runs {
        column.extend_from_slice(&old[run.old.start as usize..run.old.end as usize]);
        column.extend_from_slice(&new[run.new.clone()]);
    }
    column
}

/// Which rule of [`Forest`] is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the edges break rule {0} of a forest")]
pub struct ForestError(pub u8);

impl Forest {
    /// A forest from its columns, for clips of `clip_frames` frames.
    pub fn from_parts(parts: ForestParts, clip_frames: &[u32]) -> Result<Self, ForestError> {
        let ForestParts { from_frames, to_frames, costs, n_leaves, pairs } = parts;
        let n_nodes = from_frames.len();
        let same = to_frames.len() == n_nodes && costs.len() == n_nodes;
        if !same || n_leaves.len() != n_nodes || u32::try_from(n_nodes).is_err() {
            return Err(ForestError(1));
        }
        let mut next = 0u32;
        let mut before: Option<(ClipId, ClipId)> = None;
        for pair in &pairs {
            let key = (pair.from, pair.to);
            let in_order = before.is_none_or(|before| before < key);
            let clips = pair.from.idx().max(pair.to.idx()) < clip_frames.len();
            let run = pair.first_node == next
                && pair.first_node <= pair.first_bridge
                && pair.first_bridge <= pair.end_node
                && pair.end_node as usize <= n_nodes;
            if !(in_order && clips && run) {
                return Err(ForestError(1));
            }
            next = pair.end_node;
            before = Some(key);
        }
        if next as usize != n_nodes {
            return Err(ForestError(1));
        }
        let broken = pairs.par_iter().find_map_first(|pair| {
            let (n_from, n_to) = (clip_frames[pair.from.idx()], clip_frames[pair.to.idx()]);
            let nodes = pair.first_node as usize..pair.end_node as usize;
            let frames_ok = from_frames[nodes.clone()].iter().all(|&frame| frame < n_from)
                && to_frames[nodes.clone()].iter().all(|&frame| frame < n_to);
            let costs_ok = costs[nodes].iter().all(|cost| cost.is_finite() && *cost >= 0.0);
            if !frames_ok || !costs_ok {
                return Some(ForestError(3));
            }
            (!trees_are_whole(&n_leaves, pair)).then_some(ForestError(2))
        });
        if let Some(broken) = broken {
            return Err(broken);
        }
        let mut pair_starts = vec![0u32; clip_frames.len() + 1];
        for pair in &pairs {
            pair_starts[pair.from.idx() + 1] += 1;
        }
        for clip in 0..clip_frames.len() {
            pair_starts[clip + 1] += pair_starts[clip];
        }
        Ok(Self { from_frames, to_frames, costs, n_leaves, pairs, pair_starts })
    }

    /// The forest with bridges inserted: for each of the new `pairs` a run of old nodes, then new
    /// ones. Column by column, since that is tens of megabytes of copying.
    pub(super) fn with_inserted(
        &self,
        bridges: &[Bridge],
        runs: &[Run],
        pairs: Vec<ClipPair>,
        clip_frames: &[u32],
    ) -> Result<Self, ForestError> {
        let new = |value: fn(&Edge) -> u32| bridges.iter().map(|b| value(&b.edge)).collect();
        let (new_from, new_to): (Vec<u32>, Vec<u32>) =
            (new(|edge| edge.from_frame.0), new(|edge| edge.to_frame.0));
        let new_costs: Vec<f32> = bridges.iter().map(|b| b.edge.cost).collect();
        let new_leaves = vec![1u32; bridges.len()];
        let ((from_frames, to_frames), (costs, n_leaves)) = rayon::join(
            || {
                let from_frames = interleaved(&self.from_frames, &new_from, runs);
                (from_frames, interleaved(&self.to_frames, &new_to, runs))
            },
            || {
                let costs = interleaved(&self.costs, &new_costs, runs);
                (costs, interleaved(&self.n_leaves, &new_leaves, runs))
            },
        );
        let parts = ForestParts { from_frames, to_frames, costs, n_leaves, pairs };
        Self::from_parts(parts, clip_frames)
    }

    /// The columns, for a file.
    pub fn to_parts(&self) -> ForestParts {
        ForestParts {
            from_frames: self.from_frames.clone(),
            to_frames: self.to_frames.clone(),
            costs: self.costs.clone(),
            n_leaves: self.n_leaves.clone(),
            pairs: self.pairs.clone(),
        }
    }

    /// How many nodes there are on all levels.
    pub fn n_nodes(&self) -> usize {
        self.costs.len()
    }

    /// All pairs of clips with an edge, ordered by `(from, to)`.
    pub fn pairs(&self) -> &[ClipPair] {
        &self.pairs
    }

    /// The pairs that leave from `clip`, ordered by where they lead.
    pub fn pairs_from(&self, clip: ClipId) -> &[ClipPair] {
        let (from, to) = (self.pair_starts[clip.idx()], self.pair_starts[clip.idx() + 1]);
        &self.pairs[from as usize..to as usize]
    }

    /// The edge of a node.
    #[inline]
    pub fn edge(&self, id: EdgeId) -> Edge {
        Edge {
            from_frame: FrameIdx(self.from_frames[id.idx()]),
            to_frame: FrameIdx(self.to_frames[id.idx()]),
            cost: self.costs[id.idx()],
        }
    }

    /// How many leaves stand under a node; 1 for a leaf.
    #[inline]
    pub fn n_leaves(&self, id: EdgeId) -> u32 {
        self.n_leaves[id.idx()]
    }

    /// Whether a node is an edge of the finest level.
    #[inline]
    pub fn is_leaf(&self, id: EdgeId) -> bool {
        self.n_leaves[id.idx()] == 1
    }

    /// The two halves of an inner node.
    #[inline]
    pub fn children(&self, id: EdgeId) -> Option<[EdgeId; 2]> {
        if self.is_leaf(id) {
            return None;
        }
        let left = EdgeId(id.0 + 1);
        let right = EdgeId(left.0 + 2 * self.n_leaves(left) - 1);
        Some([left, right])
    }

    /// The roots of the trees in a run of nodes: the coarsest edges.
    pub fn roots(&self, nodes: Range<u32>) -> impl Iterator<Item = EdgeId> + '_ {
        let mut next = nodes.start;
        std::iter::from_fn(move || {
            if next >= nodes.end {
                return None;
            }
            let root = EdgeId(next);
            next += 2 * self.n_leaves(root) - 1;
            Some(root)
        })
    }

    /// The cheapest leaf under a node, the first of equals.
    pub fn cheapest_leaf(&self, id: EdgeId) -> Option<EdgeId> {
        let subtree = id.0..id.0 + 2 * self.n_leaves(id) - 1;
        let leaves = subtree.map(EdgeId).filter(|&node| self.is_leaf(node));
        leaves.min_by(|&a, &b| self.costs[a.idx()].total_cmp(&self.costs[b.idx()]))
    }

    /// The pair that a node belongs to.
    pub fn pair_of(&self, id: EdgeId) -> &ClipPair {
        let after = self.pairs.partition_point(|pair| pair.first_node <= id.0);
        &self.pairs[after - 1]
    }

    /// Whether a node is a bridge.
    pub fn is_bridge(&self, id: EdgeId) -> bool {
        id.0 >= self.pair_of(id).first_bridge
    }

    /// How deep a node lies in its tree: 0 for a root.
    pub fn level(&self, id: EdgeId) -> u32 {
        let pair = self.pair_of(id);
        let nodes = pair.first_node..pair.end_node;
        let holds = |root: &EdgeId| id.0 < root.0 + 2 * self.n_leaves(*root) - 1;
        let Some(mut node) = self.roots(nodes).find(holds) else { return 0 };
        let mut level = 0;
        while node != id {
            let Some([left, right]) = self.children(node) else { return level };
            node = if id < right { left } else { right };
            level += 1;
        }
        level
    }

    /// How many edges are in use when the search looks no deeper than each level: entry `l`
    /// counts the nodes at depth `l` and the leaves above it. The first entry is the coarsest
    /// graph, the last all leaf edges.
    pub fn edges_per_level(&self) -> Vec<usize> {
        let mut per_depth: Vec<(usize, usize)> = Vec::new();
        let mut stack: Vec<(EdgeId, usize)> = Vec::new();
        for pair in &self.pairs {
            stack.extend(self.roots(pair.first_node..pair.end_node).map(|root| (root, 0)));
            while let Some((node, depth)) = stack.pop() {
                if per_depth.len() <= depth {
                    per_depth.resize(depth + 1, (0, 0));
                }
                per_depth[depth].0 += 1;
                match self.children(node) {
                    None => per_depth[depth].1 += 1,
                    Some(children) => stack.extend(children.map(|child| (child, depth + 1))),
                }
            }
        }
        let mut leaves_above = 0;
        per_depth
            .into_iter()
            .map(|(nodes, leaves)| {
                let in_use = nodes + leaves_above;
                leaves_above += leaves;
                in_use
            })
            .collect()
    }
}

/// Rule 2: the run of `pair` is whole trees, each node's children adding up to it.
fn trees_are_whole(n_leaves: &[u32], pair: &ClipPair) -> bool {
    let bridges = pair.first_bridge as usize..pair.end_node as usize;
    if n_leaves[bridges].iter().any(|&n| n != 1) {
        return false;
    }
    let end = u64::from(pair.first_bridge);
    let mut next = u64::from(pair.first_node);
    while next < end {
        // A subtree to check: where it starts and where it must end.
        let root = next;
        let Some(size) = subtree_size(n_leaves, root) else { return false };
        if root + size > end {
            return false;
        }
        for node in root..root + size {
            let leaves = n_leaves[node as usize];
            if leaves == 1 {
                continue;
            }
            let left = node + 1;
            let Some(left_size) = subtree_size(n_leaves, left) else { return false };
            let right = left + left_size;
            if right >= root + size {
                return false;
            }
            let sum = u64::from(n_leaves[left as usize]) + u64::from(n_leaves[right as usize]);
            if sum != u64::from(leaves) {
                return false;
            }
        }
        next += size;
    }
    true
}

fn subtree_size(n_leaves: &[u32], node: u64) -> Option<u64> {
    let leaves = *n_leaves.get(usize::try_from(node).ok()?)?;
    (leaves > 0).then(|| 2 * u64::from(leaves) - 1)
}
