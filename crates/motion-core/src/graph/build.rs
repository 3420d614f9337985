//! From clips to a graph: features, τ, all edges under it, islands, clusters, trees, bridges.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::MotionGraph;
use super::bridges::{find_bridges, with_bridges};
use super::cluster::{Moments, clusters, split_in_two};
use super::components::connectivity;
use super::entrances::find_entrances;
use super::forest::{ClipPair, Edge, Forest, ForestError, ForestParts};
use super::islands::islands;
use crate::cancel::{CancelToken, Cancelled};
use crate::clip::ClipSet;
use crate::ids::ClipId;
use crate::similarity::distance_grid::{NearPair, nearest, pairs_below};
use crate::similarity::{FeatureSet, metric_columns};
use crate::units::FrameIdx;

/// How the threshold is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TauRule {
    /// The cost under which this share of all frames has a neighbour in another clip.
    NeighbourQuantile(f64),
    /// This cost.
    Fixed(f64),
}

impl Default for TauRule {
    fn default() -> Self {
        Self::NeighbourQuantile(0.6)
    }
}

/// What a build may be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildOptions {
    /// The threshold.
    pub tau: TauRule,
    /// Whether parts that τ leaves apart are joined.
    pub bridges: bool,
    /// Edges within one clip that would jump for less than this are no cut.
    pub min_jump_secs: f64,
    /// Bytes that the edges may take; τ is lowered where they would take more.
    pub edge_budget_bytes: usize,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self {
            tau: TauRule::default(),
            bridges: true,
            min_jump_secs: 0.3,
            edge_budget_bytes: 2 << 30,
        }
    }
}

/// What one pair of frames costs at the height of a build: the pair itself twice while it is
/// sorted, and two directed edges with their inner nodes, once in pieces and once joined.
const BYTES_PER_PAIR: usize = 2 * 12 + 2 * 2 * 2 * 16;

/// Why a graph could not be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// There is nothing to build from.
    #[error("a graph needs at least one clip")]
    NoClips,
    /// The threshold is no cost.
    #[error("τ must be a positive number and is {0}; leave it out for the default")]
    BadTau(f64),
    /// Somebody cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A bug in this module.
    #[error(transparent)]
    Forest(#[from] ForestError),
}

/// What a build is doing; the share of that stage that is done, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// Feature vectors.
    Features,
    /// Nearest neighbours, from which τ follows.
    Neighbours(f32),
    /// All pairs under τ.
    Edges(f32),
    /// Islands, clusters and trees.
    Hierarchy,
    /// Components and bridges.
    Bridges,
}

/// Builds the graph of `clips`. The result does not depend on the number of threads.
pub fn build(
    clips: &ClipSet,
    options: &BuildOptions,
    cancel: &CancelToken,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<MotionGraph, BuildError> {
    if clips.clips().is_empty() {
        return Err(BuildError::NoClips);
    }
    if let TauRule::Fixed(tau) = options.tau
        && !(tau > 0.0 && tau.is_finite())
    {
        return Err(BuildError::BadTau(tau));
    }
    progress(Stage::Features);
    let features = FeatureSet::new(clips, metric_columns(clips.skeleton()));
    progress(Stage::Neighbours(0.0));
    let on_neighbours = |share: f32| progress(Stage::Neighbours(share));
    let nearest = nearest(&features, cancel, &on_neighbours)?;
    let tau = match options.tau {
        TauRule::Fixed(tau) => tau,
        TauRule::NeighbourQuantile(share) => quantile(&nearest.other_clip, share),
    };
    let clip_frames: Vec<u32> = clips.clips().iter().map(|clip| clip.n_frames() as u32).collect();
    let min_jump = clips.fps().frames_in_secs(options.min_jump_secs).max(1);
    let max_pairs = (options.edge_budget_bytes / BYTES_PER_PAIR).max(1);
    let on_edges = |share: f32| progress(Stage::Edges(share));
    let near = pairs_below(&features, tau, min_jump, max_pairs, cancel, &on_edges)?;
    progress(Stage::Hierarchy);
    let mut forest = grow_forest(&features, near.pairs, &clip_frames, cancel)?;
    progress(Stage::Bridges);
    let by_tau = connectivity(&forest, &clip_frames, false);
    let mut with_all = by_tau.clone();
    if options.bridges {
        // A second round joins what frame order still kept apart after the first.
        for _ in 0..4 {
            if with_all.is_whole() {
                break;
            }
            if cancel.is_cancelled() {
                return Err(Cancelled.into());
            }
            let costs = &nearest.clip_pair;
            let bridges = find_bridges(&features, costs, &forest, &with_all, &clip_frames);
            if bridges.is_empty() {
                break;
            }
            forest = with_bridges(&forest, &bridges, &clip_frames)?;
            with_all = connectivity(&forest, &clip_frames, true);
        }
        let entrances = find_entrances(&features, &with_all, &clip_frames);
        if !entrances.is_empty() {
            forest = with_bridges(&forest, &entrances, &clip_frames)?;
            with_all = connectivity(&forest, &clip_frames, true);
        }
    }
    Ok(MotionGraph {
        metric: features.metric,
        tau: near.tau,
        min_jump: min_jump as u32,
        clip_frames,
        forest,
        by_tau,
        with_bridges: with_all,
    })
}

/// The value under which `share` of the finite `values` lie (nearest rank); 1 without any.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut values: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return 1.0;
    }
    let rank = ((share * values.len() as f64).ceil() as usize).clamp(1, values.len());
    let (_, &mut value, _) = values.select_nth_unstable_by(rank - 1, f64::total_cmp);
    // τ is exclusive (`C < τ`) and the frame at the rank itself shall have its neighbour.
    value.max(1e-9) * (1.0 + 1e-9)
}

/// Islands, clusters and trees of every pair of clips.
fn grow_forest(
    features: &FeatureSet,
    near: Vec<NearPair>,
    clip_frames: &[u32],
    cancel: &CancelToken,
) -> Result<Forest, BuildError> {
    let by_pair = directed_edges(features, &near);
    drop(near);
    let trees: Vec<(ClipId, ClipId, ForestParts)> = by_pair
        .into_par_iter()
        .map(|ClipPairEdges { from, to, edges }| {
            // Most trees are small, so there are nearly twice as many nodes as leaves.
            let room = 2 * edges.len();
            let mut parts = ForestParts {
                from_frames: Vec::with_capacity(room),
                to_frames: Vec::with_capacity(room),
                costs: Vec::with_capacity(room),
                n_leaves: Vec::with_capacity(room),
                pairs: Vec::new(),
            };
            let mut scratch = Vec::new();
            if !cancel.is_cancelled() {
                for island in islands(&edges) {
                    for mut cluster in clusters(&island) {
                        grow_tree(&mut cluster, &mut parts, &mut scratch);
                    }
                }
            }
            (from, to, parts)
        })
        .collect();
    if cancel.is_cancelled() {
        return Err(Cancelled.into());
    }
    let n_nodes = trees.iter().map(|(_, _, parts)| parts.costs.len()).sum();
    let mut all = ForestParts {
        from_frames: Vec::with_capacity(n_nodes),
        to_frames: Vec::with_capacity(n_nodes),
        costs: Vec::with_capacity(n_nodes),
        n_leaves: Vec::with_capacity(n_nodes),
        pairs: Vec::with_capacity(trees.len()),
    };
    for (from, to, parts) in trees {
        let first_node = all.costs.len() as u32;
        all.from_frames.extend_from_slice(&parts.from_frames);
        all.to_frames.extend_from_slice(&parts.to_frames);
        all.costs.extend_from_slice(&parts.costs);
        all.n_leaves.extend_from_slice(&parts.n_leaves);
        let end_node = all.costs.len() as u32;
        all.pairs.push(ClipPair { from, to, first_node, first_bridge: end_node, end_node });
    }
    Ok(Forest::from_parts(all, clip_frames)?)
}

/// Both directions of each near pair, grouped by clips and ordered by `(from, to)`.
///
/// Near pairs are ordered by their smaller row, so all edges between two clips come from the
/// rows of the earlier one: clips can be taken side by side.
fn directed_edges(features: &FeatureSet, near: &[NearPair]) -> Vec<ClipPairEdges> {
    let starts = &features.frame_starts;
    let mut grouped: Vec<ClipPairEdges> = (0..starts.len() - 1)
        .into_par_iter()
        .flat_map_iter(|clip| {
            let first = near.partition_point(|pair| (pair.a as usize) < starts[clip]);
            let end = near.partition_point(|pair| (pair.a as usize) < starts[clip + 1]);
            edges_of_clip(features, clip, &near[first..end])
        })
        .collect();
    grouped.sort_unstable_by_key(|pair| (pair.from, pair.to));
    grouped
}

/// The edges of one ordered pair of clips.
struct ClipPairEdges {
    from: ClipId,
    to: ClipId,
    edges: Vec<Edge>,
}

/// The edges between `clip` and itself or later clips, both ways.
fn edges_of_clip(features: &FeatureSet, clip: usize, near: &[NearPair]) -> Vec<ClipPairEdges> {
    let starts = &features.frame_starts;
    let mut by_other: BTreeMap<usize, Vec<(u32, u32, f32)>> = BTreeMap::new();
    let mut next = 0;
    while next < near.len() {
        // Near pairs of one row come clip by clip.
        let other = features.clip_of_row(near[next].b as usize).0.idx();
        let end = next
            + near[next..].partition_point(|pair| {
                pair.a == near[next].a && (pair.b as usize) < starts[other + 1]
            });
        let frames = near[next..end]
            .iter()
            .map(|pair| (pair.a - starts[clip] as u32, pair.b - starts[other] as u32, pair.cost));
        by_other.entry(other).or_default().extend(frames);
        next = end;
    }
    let edge = |from: u32, to: u32, cost: f32| Edge {
        from_frame: FrameIdx(from),
        to_frame: FrameIdx(to),
        cost,
    };
    let mut pairs = Vec::new();
    for (other, frames) in by_other {
        let there = frames.iter().map(|&(i, j, cost)| edge(i, j, cost));
        let back = frames.iter().map(|&(i, j, cost)| edge(j, i, cost));
        let (clip, other) = (ClipId::from_idx(clip), ClipId::from_idx(other));
        if clip == other {
            pairs.push(ClipPairEdges { from: clip, to: clip, edges: there.chain(back).collect() });
        } else {
            pairs.push(ClipPairEdges { from: clip, to: other, edges: there.collect() });
            pairs.push(ClipPairEdges { from: other, to: clip, edges: back.collect() });
        }
    }
    for pair in &mut pairs {
        pair.edges.sort_unstable_by_key(|edge| (edge.from_frame, edge.to_frame));
    }
    pairs
}

/// Appends the tree over `edges` in depth-first order.
fn grow_tree(edges: &mut [Edge], parts: &mut ForestParts, scratch: &mut Vec<Edge>) {
    let mut push = |edge: Edge, n_leaves: usize| {
        parts.from_frames.push(edge.from_frame.0);
        parts.to_frames.push(edge.to_frame.0);
        parts.costs.push(edge.cost);
        parts.n_leaves.push(n_leaves as u32);
    };
    if let [leaf] = edges {
        push(*leaf, 1);
        return;
    }
    let moments = Moments::of(edges);
    push(moments.mean_edge(), edges.len());
    let second = split_in_two(edges, &moments, scratch);
    let (first, second) = edges.split_at_mut(second);
    grow_tree(first, parts, scratch);
    grow_tree(second, parts, scratch);
}
