//! Islands, clusters and trees of every pair of clips: from edges between frames to a forest.

use rayon::prelude::*;

use super::build::BuildError;
use super::cluster::{Moments, clusters, split_in_two};
use super::forest::{ClipPair, Edge, Forest, ForestParts};
use super::islands::islands;
use crate::cancel::{CancelToken, Cancelled};
use crate::ids::ClipId;
use crate::similarity::DirectedEdges;
use crate::units::FrameIdx;

/// Frames whose edges are grown at once: enough for all threads, and what is in between takes
/// little memory beside the outcome.
const FRAMES_AT_ONCE: u32 = 1 << 16;

/// The forest over `edges`, whose rows are the frames of clips of `clip_frames` frames, one clip
/// after the other.
pub(super) fn grow_forest(
    edges: DirectedEdges,
    clip_frames: &[u32],
    cancel: &CancelToken,
) -> Result<Forest, BuildError> {
    let mut starts = vec![0u32];
    for &n in clip_frames {
        starts.push(starts[starts.len() - 1] + n);
    }
    let mut all = ForestParts::default();
    let mut next = 0;
    while next < clip_frames.len() {
        let until = starts[next].saturating_add(FRAMES_AT_ONCE);
        let end = starts.partition_point(|&start| start < until).clamp(next + 1, clip_frames.len());
        let grown: Vec<ForestParts> = (next..end)
            .into_par_iter()
            .with_max_len(1)
            .map(|clip| {
                if cancel.is_cancelled() {
                    ForestParts::default()
                } else {
                    trees_from(&edges, clip, &starts)
                }
            })
            .collect();
        for parts in grown {
            append(&mut all, parts);
        }
        next = end;
    }
    if cancel.is_cancelled() {
        return Err(Cancelled.into());
    }
    drop(edges);
    Ok(Forest::from_parts(all, clip_frames)?)
}

/// Appends trees with their pairs behind those that are there.
fn append(all: &mut ForestParts, parts: ForestParts) {
    let first = all.costs.len() as u32;
    all.from_frames.extend_from_slice(&parts.from_frames);
    all.to_frames.extend_from_slice(&parts.to_frames);
    all.costs.extend_from_slice(&parts.costs);
    all.n_leaves.extend_from_slice(&parts.n_leaves);
    all.pairs.extend(parts.pairs.into_iter().map(|pair| ClipPair {
        first_node: pair.first_node + first,
        first_bridge: pair.first_bridge + first,
        end_node: pair.end_node + first,
        ..pair
    }));
}

/// The trees of all pairs that leave `clip`.
fn trees_from(edges: &DirectedEdges, clip: usize, starts: &[u32]) -> ForestParts {
    let mut of_clip: Vec<(u32, Edge)> = Vec::new();
    for row in starts[clip]..starts[clip + 1] {
        // A row's edges are in order, so that the clip entered is that before or a later one.
        let mut to_clip = 0;
        for (to, cost) in edges.of(row as usize) {
            if to >= starts[to_clip + 1] {
                to_clip += starts[to_clip + 1..].partition_point(|&start| start <= to);
            }
            let edge = Edge {
                from_frame: FrameIdx(row - starts[clip]),
                to_frame: FrameIdx(to - starts[to_clip]),
                cost,
            };
            of_clip.push((to_clip as u32, edge));
        }
    }
    // Within a clip that is entered they stay in the order of the frames.
    of_clip.sort_by_key(|&(to, _)| to);
    let room = 2 * of_clip.len();
    let mut parts = ForestParts {
        from_frames: Vec::with_capacity(room),
        to_frames: Vec::with_capacity(room),
        costs: Vec::with_capacity(room),
        n_leaves: Vec::with_capacity(room),
        pairs: Vec::new(),
    };
    let (mut pair_edges, mut scratch) = (Vec::new(), Vec::new());
    for run in of_clip.chunk_by(|a, b| a.0 == b.0) {
        let first_node = parts.costs.len() as u32;
        pair_edges.clear();
        pair_edges.extend(run.iter().map(|&(_, edge)| edge));
        grow_pair(&mut pair_edges, &mut parts, &mut scratch);
        let end_node = parts.costs.len() as u32;
        let (from, to) = (ClipId::from_idx(clip), ClipId(run[0].0));
        parts.pairs.push(ClipPair { from, to, first_node, first_bridge: end_node, end_node });
    }
    parts
}

/// Appends the trees over the edges of one pair, which are ordered by `(from, to)`.
fn grow_pair(edges: &mut [Edge], parts: &mut ForestParts, scratch: &mut Vec<Edge>) {
    // In large sets most pairs have an edge or two, and no use for islands.
    if edges.len() == 1 {
        return grow_tree(edges, parts, scratch);
    }
    for mut island in islands(edges) {
        if island.len() == 1 {
            grow_tree(&mut island, parts, scratch);
            continue;
        }
        for mut cluster in clusters(&island) {
            grow_tree(&mut cluster, parts, scratch);
        }
    }
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
