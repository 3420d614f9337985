//! Bridges: the cheapest cuts between parts of a library that τ alone leaves apart.
//!
//! With a strict τ real libraries fall into islands: the runs of one person cannot be reached
//! from his walks. For each ordered pair of parts without a link, the [`PER_LINK`] cheapest
//! well-separated cuts are added at their true cost, until every clip is in the main component.

use rayon::prelude::*;

use super::build::BuildError;
pub(super) use super::clip_costs::ClipCosts;
use super::components::{Connectivity, connectivity};
use super::entrances::find_entrances;
use super::forest::{ClipPair, Edge, EdgeId, Forest, ForestError, Run};
use crate::cancel::{CancelToken, Cancelled};
use crate::ids::ClipId;
use crate::similarity::FeatureSet;
use crate::units::FrameIdx;

/// Cuts per link.
pub const PER_LINK: usize = 16;

/// Two cuts of one clip pair are well separated when they are at least this many frames apart
/// in the frame left or in the frame entered.
pub const SEPARATION: u32 = 10;

/// Clip pairs that are looked at for one link, cheapest first.
const CLIP_PAIRS_PER_LINK: usize = 12;

/// A cut between two clips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bridge {
    /// The clip that is left.
    pub from: ClipId,
    /// The clip that is entered.
    pub to: ClipId,
    /// The cut.
    pub edge: Edge,
}

/// The frames by which a clip may be left and entered by a bridge, so that what enters it can
/// leave again: `leave_from..` and `..=enter_until`.
struct Gate {
    leave_from: u32,
    enter_until: u32,
}

fn gate(connectivity: &Connectivity, clip: usize, n_frames: u32) -> Option<Gate> {
    if n_frames < 2 {
        return None;
    }
    let gate = match connectivity.core[clip] {
        // Node `f` of a cycle has been shown: one enters a frame earlier.
        Some((first, last)) => Gate { leave_from: first.max(1), enter_until: last.max(1) - 1 },
        // A clip of its own: enter it early, leave it late, so that most of it can be used.
        None => Gate {
            leave_from: (n_frames * 3 / 5).max(1),
            enter_until: (n_frames * 2 / 5).min(n_frames - 2),
        },
    };
    Some(gate)
}

/// What bridges are looked for in.
struct Ground<'a> {
    features: &'a FeatureSet,
    clip_frames: &'a [u32],
    min_jump: u32,
    gates: Vec<Option<Gate>>,
}

/// The forest with bridges, and what can be reached with them, after as many rounds as it takes to
/// make it whole, at most four; then the entrances of clips.
pub(super) fn add_bridges(
    mut forest: Forest,
    by_tau: &Connectivity,
    features: &FeatureSet,
    clip_costs: &ClipCosts,
    clip_frames: &[u32],
    min_jump: u32,
    cancel: &CancelToken,
) -> Result<(Forest, Connectivity), BuildError> {
    let mut with_all = by_tau.clone();
    // A second round joins what frame order still kept apart after the first.
    for _ in 0..4 {
        if with_all.is_whole() {
            break;
        }
        if cancel.is_cancelled() {
            return Err(Cancelled.into());
        }
        let bridges = find_bridges(features, clip_costs, &forest, &with_all, clip_frames, min_jump);
        if bridges.is_empty() {
            break;
        }
        forest = with_bridges(&forest, &bridges, clip_frames)?;
        with_all = connectivity(&forest, clip_frames, true);
    }
    let entrances = find_entrances(features, &with_all, clip_frames);
    if !entrances.is_empty() {
        forest = with_bridges(&forest, &entrances, clip_frames)?;
        with_all = connectivity(&forest, clip_frames, true);
    }
    Ok((forest, with_all))
}

/// Bridges for every ordered pair of parts that has no usable link yet.
///
/// `clip_costs` choose which clip pairs are looked at in full.
fn find_bridges(
    features: &FeatureSet,
    clip_costs: &ClipCosts,
    forest: &Forest,
    connectivity: &Connectivity,
    clip_frames: &[u32],
    min_jump: u32,
) -> Vec<Bridge> {
    let n_parts = connectivity.n_parts as usize;
    let n_clips = clip_frames.len();
    let gates: Vec<Option<Gate>> =
        (0..n_clips).map(|clip| gate(connectivity, clip, clip_frames[clip])).collect();
    let mut clips_of_part: Vec<Vec<usize>> = vec![Vec::new(); n_parts];
    for (clip, &part) in connectivity.part_of_clip.iter().enumerate() {
        if gates[clip].is_some() {
            clips_of_part[part as usize].push(clip);
        }
    }
    let linked = usable_links(forest, connectivity, &gates, n_parts);
    let cost_between = |a: usize, b: usize| clip_costs.between(a, b);
    // Least cost between parts; decides who is near when there are many.
    let part_cost = |a: usize, b: usize| {
        let pairs =
            clips_of_part[a].iter().flat_map(|&x| clips_of_part[b].iter().map(move |&y| (x, y)));
        pairs.map(|(x, y)| cost_between(x, y)).fold(f32::INFINITY, f32::min)
    };
    let mut links: Vec<(usize, usize)> = Vec::new();
    for a in 0..n_parts {
        let mut others: Vec<(f32, usize)> =
            (0..n_parts).filter(|&b| b != a).map(|b| (part_cost(a, b), b)).collect();
        others.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        for (rank, &(cost, b)) in others.iter().enumerate() {
            // The main part is always linked, whatever its rank: that makes the graph whole.
            if cost.is_finite() && (rank < clip_costs.nearest_parts || b == 0) {
                links.push((a, b));
                links.push((b, a));
            }
        }
    }
    links.sort_unstable();
    links.dedup();
    links.retain(|&(a, b)| !linked[a * n_parts + b]);
    let ground = Ground { features, clip_frames, min_jump, gates };
    let found: Vec<Vec<Bridge>> = links
        .into_par_iter()
        .map(|(a, b)| {
            let mut pairs: Vec<(f32, usize, usize)> = clips_of_part[a]
                .iter()
                .flat_map(|&x| clips_of_part[b].iter().map(move |&y| (cost_between(x, y), x, y)))
                .collect();
            pairs.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
            pairs.truncate(CLIP_PAIRS_PER_LINK);
            let mut cuts: Vec<Bridge> =
                pairs.into_iter().flat_map(|(_, x, y)| cuts_between(&ground, x, y)).collect();
            cuts.sort_by(|x, y| {
                let key = |b: &Bridge| (b.from, b.to, b.edge.from_frame, b.edge.to_frame);
                x.edge.cost.total_cmp(&y.edge.cost).then(key(x).cmp(&key(y)))
            });
            well_separated(cuts)
        })
        .collect();
    found.concat()
}

/// Which ordered pairs of parts have an edge by which one can really pass.
fn usable_links(
    forest: &Forest,
    connectivity: &Connectivity,
    gates: &[Option<Gate>],
    n_parts: usize,
) -> Vec<bool> {
    let mut linked = vec![false; n_parts * n_parts];
    for pair in forest.pairs() {
        let part = |clip: ClipId| connectivity.part_of_clip[clip.idx()] as usize;
        let slot = part(pair.from) * n_parts + part(pair.to);
        if linked[slot] || part(pair.from) == part(pair.to) {
            continue;
        }
        let (Some(leave), Some(enter)) = (&gates[pair.from.idx()], &gates[pair.to.idx()]) else {
            continue;
        };
        linked[slot] = (pair.first_node..pair.end_node).map(EdgeId).any(|id| {
            let edge = forest.edge(id);
            forest.is_leaf(id)
                && edge.from_frame.0 >= leave.leave_from
                && edge.to_frame.0 <= enter.enter_until
        });
    }
    linked
}

/// Local minima of the cost between two clips, within their gates.
fn cuts_between(ground: &Ground<'_>, from: usize, to: usize) -> Vec<Bridge> {
    let Ground { features, clip_frames, min_jump, gates } = ground;
    let (Some(leave), Some(enter)) = (&gates[from], &gates[to]) else { return Vec::new() };
    let rows: Vec<u32> = (leave.leave_from..clip_frames[from]).collect();
    let columns: Vec<u32> = (0..=enter.enter_until.min(clip_frames[to] - 1)).collect();
    let start = |clip: usize, frame: u32| features.frame_starts[clip] + frame as usize;
    // Every third frame finds each valley of a smooth cost; its bottom is then walked to.
    let ids = [from, to].map(ClipId::from_idx);
    let is_family = features.families.hand(ids[0]) == features.families.hand(ids[1]);
    let cost = |i: usize, j: usize| {
        let (i, j) = (rows[i], columns[j]);
        if is_family && features.families.is_same_moment((ids[0], i), (ids[1], j), *min_jump) {
            return f64::INFINITY;
        }
        features.cost(start(from, i), start(to, j))
    };
    let (n, m) = (rows.len(), columns.len());
    let mut cuts = Vec::new();
    if n == 0 || m == 0 {
        return cuts;
    }
    const STEP: usize = 3;
    let (n_coarse, m_coarse) = (n.div_ceil(STEP), m.div_ceil(STEP));
    let coarse: Vec<f64> = (0..n_coarse * m_coarse)
        .map(|at| cost(at / m_coarse * STEP, at % m_coarse * STEP))
        .collect();
    for i in 0..n_coarse {
        for j in 0..m_coarse {
            let here = coarse[i * m_coarse + j];
            let lowest = (i.saturating_sub(1)..(i + 2).min(n_coarse)).all(|a| {
                (j.saturating_sub(1)..(j + 2).min(m_coarse))
                    .all(|b| coarse[a * m_coarse + b] >= here)
            });
            if !lowest || here.is_infinite() {
                continue;
            }
            let (mut at, mut least) = ((i * STEP, j * STEP), here);
            loop {
                let before = at;
                for a in before.0.saturating_sub(1)..(before.0 + 2).min(n) {
                    for b in before.1.saturating_sub(1)..(before.1 + 2).min(m) {
                        let value = cost(a, b);
                        if value < least {
                            (at, least) = ((a, b), value);
                        }
                    }
                }
                if at == before {
                    break;
                }
            }
            cuts.push(Bridge {
                from: ClipId::from_idx(from),
                to: ClipId::from_idx(to),
                edge: Edge {
                    from_frame: FrameIdx(rows[at.0]),
                    to_frame: FrameIdx(columns[at.1]),
                    cost: least as f32,
                },
            });
        }
    }
    cuts
}

/// The first [`PER_LINK`] of `cuts` that are well separated from those before them.
pub(super) fn well_separated(cuts: Vec<Bridge>) -> Vec<Bridge> {
    let mut kept: Vec<Bridge> = Vec::new();
    for cut in cuts {
        let near = |other: &Bridge| {
            (other.from, other.to) == (cut.from, cut.to)
                && other.edge.from_frame.0.abs_diff(cut.edge.from_frame.0) < SEPARATION
                && other.edge.to_frame.0.abs_diff(cut.edge.to_frame.0) < SEPARATION
        };
        if kept.len() < PER_LINK && !kept.iter().any(near) {
            kept.push(cut);
        }
    }
    kept
}

/// `forest` with `bridges` added to its pairs; a bridge that is there already is left out.
pub fn with_bridges(
    forest: &Forest,
    bridges: &[Bridge],
    clip_frames: &[u32],
) -> Result<Forest, ForestError> {
    let mut bridges = bridges.to_vec();
    bridges.sort_by_key(|b| (b.from, b.to, b.edge.from_frame, b.edge.to_frame));
    let known = |b: &Bridge| {
        let mut pairs = forest.pairs_from(b.from).iter().filter(|pair| pair.to == b.to);
        let mut there = pairs.next().into_iter().flat_map(ClipPair::bridge_nodes).map(EdgeId);
        there.any(|id| {
            let edge = forest.edge(id);
            (edge.from_frame, edge.to_frame) == (b.edge.from_frame, b.edge.to_frame)
        })
    };
    bridges.retain(|bridge| !known(bridge));
    let label = |b: &Bridge| (b.from, b.to, b.edge.from_frame, b.edge.to_frame);
    bridges.dedup_by_key(|bridge| label(bridge));

    let mut keys: Vec<(ClipId, ClipId)> = forest.pairs().iter().map(|p| (p.from, p.to)).collect();
    keys.extend(bridges.iter().map(|b| (b.from, b.to)));
    keys.sort_unstable();
    keys.dedup();
    let mut old_pairs = forest.pairs().iter().peekable();
    let mut n_nodes = 0u32;
    let (mut next_old, mut next_new) = (0u32, 0usize);
    let mut pairs = Vec::with_capacity(keys.len());
    let mut runs = Vec::with_capacity(keys.len());
    for (from, to) in keys {
        let first_node = n_nodes;
        let mut first_bridge = first_node;
        let old_start = next_old;
        if let Some(pair) = old_pairs.next_if(|pair| (pair.from, pair.to) == (from, to)) {
            first_bridge += pair.first_bridge - pair.first_node;
            next_old = pair.end_node;
        }
        let new_start = next_new;
        next_new += bridges[new_start..].partition_point(|b| (b.from, b.to) <= (from, to));
        runs.push(Run { old: old_start..next_old, new: new_start..next_new });
        n_nodes += next_old - old_start + (next_new - new_start) as u32;
        pairs.push(ClipPair { from, to, first_node, first_bridge, end_node: n_nodes });
    }
    forest.with_inserted(&bridges, &runs, pairs, clip_frames)
}
