//! Motion graphs: where one clip may be cut to another (AF02 section 3; `docs/method.md`, A3).
//!
//! Nodes of the graph are clips; an edge says "when you would show frame `from` of this clip,
//! show frame `to` of that one instead". The edges of each ordered pair of clips form islands in
//! the (from, to) plane; each island is cut into clusters, and each cluster is the root of a
//! binary tree whose leaves are the edges under it. Every node of every tree is a usable edge:
//! an inner one stands for its cluster by the rounded mean of its frames and its mean cost.

pub mod bridges;
#[cfg(test)]
mod brute;
pub mod build;
mod clip_costs;
mod cluster;
pub mod components;
pub mod entrances;
pub mod forest;
mod grow;
mod islands;
pub mod memory;

use std::ops::Range;

use crate::ids::ClipId;
use crate::similarity::Metric;
pub use build::{BuildError, BuildOptions, GraphPart, TauRule, build, build_part, extend, merge};
pub use components::Connectivity;
pub use forest::{ClipPair, Edge, EdgeId, Forest};

/// A library's graph: all edges of all levels, and what they were made with.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionGraph {
    /// Columns, weights and normalisers of the cost.
    pub metric: Metric,
    /// Edges under this cost are in the graph; costs are counted in it.
    pub tau: f64,
    /// Edges within one clip that would jump fewer frames than this are left out.
    pub min_jump: u32,
    /// Frames of each clip.
    pub clip_frames: Vec<u32>,
    /// The edges.
    pub forest: Forest,
    /// Which clips can reach which by edges under τ alone.
    pub by_tau: Connectivity,
    /// The same with bridges.
    pub with_bridges: Connectivity,
}

impl MotionGraph {
    /// How many clips there are.
    pub fn n_clips(&self) -> usize {
        self.clip_frames.len()
    }

    /// The clip pairs that leave from `clip`.
    pub fn pairs_from(&self, clip: ClipId) -> &[ClipPair] {
        self.forest.pairs_from(clip)
    }

    /// The pair `from → to`, if there is an edge between them.
    pub fn pair(&self, from: ClipId, to: ClipId) -> Option<&ClipPair> {
        let pairs = self.pairs_from(from);
        pairs.binary_search_by_key(&to, |pair| pair.to).ok().map(|at| &pairs[at])
    }

    /// Every leaf edge of the pair `from → to`, bridges left out, ordered by `(from, to)`.
    pub fn leaf_edges(&self, from: ClipId, to: ClipId) -> Vec<Edge> {
        let Some(pair) = self.pair(from, to) else { return Vec::new() };
        self.leaves_in(pair.tau_nodes())
    }

    /// The bridges of the pair `from → to`, ordered by `(from, to)`.
    pub fn bridges(&self, from: ClipId, to: ClipId) -> Vec<Edge> {
        let Some(pair) = self.pair(from, to) else { return Vec::new() };
        self.leaves_in(pair.bridge_nodes())
    }

    fn leaves_in(&self, nodes: Range<u32>) -> Vec<Edge> {
        let mut edges: Vec<Edge> = nodes
            .map(EdgeId)
            .filter(|&id| self.forest.is_leaf(id))
            .map(|id| self.forest.edge(id))
            .collect();
        edges.sort_by_key(|edge| (edge.from_frame, edge.to_frame));
        edges
    }
}
