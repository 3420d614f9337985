//! From clips to a graph: features, τ, edges under it, islands, clusters, trees, bridges.
//!
//! At once ([`build`]), by several machines ([`build_part`], then [`merge`]), or onto a graph
//! that is there ([`extend`]).

use super::bridges::{ClipCosts, add_bridges};
use super::components::connectivity;
use super::forest::ForestError;
use super::grow::grow_forest;
use super::{Edge, MotionGraph};
use crate::cancel::{CancelToken, Cancelled};
use crate::clip::ClipSet;
use crate::similarity::distance_grid::{NearPair, PairQuery, keep_cheapest, nearest, pairs_below};
use crate::similarity::kept_edges::{KeptQuery, kept_edges};
use crate::similarity::projection::spread_rows;
use crate::similarity::sampled_nearest::nearest_of_other_families;
use crate::similarity::{DirectedEdges, FeatureSet, Shard, metric_columns};

/// How the threshold is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TauRule {
    /// The cost under which this share of all frames has a neighbour in a clip of another
    /// family ([`crate::similarity::families`]).
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
    /// Above so many frames a frame keeps its best edges only.
    pub all_edges_until_frames: usize,
    /// How many edges may leave a frame then: local minima of the cost first, then the cheapest.
    pub edges_per_frame: usize,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self {
            tau: TauRule::default(),
            bridges: true,
            min_jump_secs: 0.3,
            edge_budget_bytes: 2 << 30,
            all_edges_until_frames: 50_000,
            edges_per_frame: 32,
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
    /// The build would take more memory than it may.
    #[error(
        "building this library takes about {} of memory and may take {}; allow more (--memory of `gaitway \
         library build`) or leave clips out",
        gib(*needed_bytes), gib(*allowed_bytes)
    )]
    Memory {
        /// About what it would take.
        needed_bytes: u64,
        /// What it may take.
        allowed_bytes: u64,
    },
    /// The part of this number (from 0) does not belong to the clips or to the other parts.
    #[error(
        "a part is not of the same build as the others; build all parts from the same clips with \
         the same options"
    )]
    Part(usize),
    /// Somebody cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A bug in this module.
    #[error(transparent)]
    Forest(#[from] ForestError),
}

/// Bytes for people.
fn gib(bytes: u64) -> String {
    format!("{:.2} GiB", bytes as f64 / f64::from(1u32 << 30))
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

/// Frames that τ is found from where there are too many to ask all. The share of frames with a
/// neighbour is then right to within 0.8 % (one standard error).
const TAU_SAMPLES: usize = 4096;

/// What all parts of a build have in common, and what is found on the way to it.
struct Ground {
    features: FeatureSet,
    clip_frames: Vec<u32>,
    min_jump: u32,
    tau: f64,
    clip_costs: Option<ClipCosts>,
    /// Whether pairs of frames may not be looked at once more.
    is_extension: bool,
}

/// The edges that one share of a build found.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphPart {
    /// Which share of how many.
    pub shard: Shard,
    /// The threshold as it was chosen.
    pub tau: f64,
    /// The threshold after it was lowered for want of memory.
    pub tau_used: f64,
    /// What identifies the frames and how they were compared: equal in all parts of a build.
    pub fingerprint: u64,
    /// The edges, by frame of all clips one after the other.
    pub edges: DirectedEdges,
}

/// Builds the graph of `clips`. The result does not depend on the number of threads.
pub fn build(
    clips: &ClipSet,
    options: &BuildOptions,
    cancel: &CancelToken,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<MotionGraph, BuildError> {
    let ground = Ground::new(clips, options, cancel, progress)?;
    let (edges, tau) = ground.find_edges(options, Shard::WHOLE, None, cancel, progress)?;
    ground.finish(edges, tau, options, cancel, progress)
}

/// The share of [`build`] that finds the edges of every n-th run of frames: most of its time.
pub fn build_part(
    clips: &ClipSet,
    options: &BuildOptions,
    shard: Shard,
    cancel: &CancelToken,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<GraphPart, BuildError> {
    let ground = Ground::new(clips, options, cancel, progress)?;
    let (edges, tau_used) = ground.find_edges(options, shard, None, cancel, progress)?;
    let fingerprint = ground.fingerprint(options);
    Ok(GraphPart { shard, tau: ground.tau, tau_used, fingerprint, edges })
}

/// The graph that [`build`] makes of `clips`, from all parts of it in any order.
pub fn merge(
    clips: &ClipSet,
    options: &BuildOptions,
    parts: Vec<GraphPart>,
    cancel: &CancelToken,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<MotionGraph, BuildError> {
    let Some(tau) = parts.first().map(|part| part.tau) else { return Err(BuildError::Part(0)) };
    progress(Stage::Features);
    check_clips(clips)?;
    let features = FeatureSet::new(clips, metric_columns(clips.skeleton()));
    let ground = Ground::of(clips, features, options, tau, None);
    let fingerprint = ground.fingerprint(options);
    for (nth, part) in parts.iter().enumerate() {
        let is_of_build = part.fingerprint == fingerprint
            && part.tau.to_bits() == tau.to_bits()
            && part.edges.n_rows() == ground.features.n_rows()
            && part.shard.n() as usize == parts.len()
            && parts[..nth].iter().all(|other| other.shard != part.shard);
        if !is_of_build {
            return Err(BuildError::Part(nth));
        }
    }
    let tau_used = parts.iter().map(|part| part.tau_used).fold(tau, f64::min);
    let lists: Vec<DirectedEdges> = parts.into_iter().map(|part| part.edges).collect();
    let (edges, tau_used) = if ground.keeps_all(options) {
        let mut pairs = near_pairs(&lists);
        drop(lists);
        let mut tau_used = tau_used;
        if tau_used < tau {
            pairs.retain(|pair| f64::from(pair.cost) < tau_used);
        }
        keep_cheapest(&mut pairs, &mut tau_used, max_pairs(options));
        pairs.sort_unstable_by_key(|pair| (pair.a, pair.b));
        (DirectedEdges::both_ways(ground.features.n_rows(), &pairs), tau_used)
    } else {
        let all = |row: usize, kept: &mut Vec<_>| {
            lists.iter().for_each(|list| kept.extend(list.of(row)));
        };
        (DirectedEdges::collect(ground.features.n_rows(), all), tau_used)
    };
    ground.finish(edges, tau_used, options, cancel, progress)
}

/// The graph of `clips`, of which `old` is the graph of the first: those are not compared with
/// each other again. The metric and τ stay those of `old`.
pub fn extend(
    clips: &ClipSet,
    old: &MotionGraph,
    options: &BuildOptions,
    cancel: &CancelToken,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<MotionGraph, BuildError> {
    check_clips(clips)?;
    let n_old = old.n_clips();
    let frames = clips.clips().iter().map(|clip| clip.n_frames() as u32);
    if n_old > clips.clips().len() || !frames.zip(&old.clip_frames).all(|(n, &old)| n == old) {
        return Err(BuildError::Part(0));
    }
    progress(Stage::Features);
    let features = FeatureSet::by_metric(clips, old.metric.clone(), n_old);
    let mut ground = Ground::of(clips, features, options, old.tau, None);
    ground.min_jump = old.min_jump;
    ground.is_extension = true;
    let known = known_edges(old, ground.features.n_rows());
    let (edges, tau) =
        ground.find_edges(options, Shard::WHOLE, Some((&known, n_old)), cancel, progress)?;
    drop(known);
    ground.finish(edges, tau, options, cancel, progress)
}

fn check_clips(clips: &ClipSet) -> Result<(), BuildError> {
    if clips.clips().is_empty() { Err(BuildError::NoClips) } else { Ok(()) }
}

fn max_pairs(options: &BuildOptions) -> usize {
    (options.edge_budget_bytes / BYTES_PER_PAIR).max(1)
}

impl Ground {
    fn new(
        clips: &ClipSet,
        options: &BuildOptions,
        cancel: &CancelToken,
        progress: &(dyn Fn(Stage) + Sync),
    ) -> Result<Self, BuildError> {
        check_clips(clips)?;
        if let TauRule::Fixed(tau) = options.tau
            && !(tau > 0.0 && tau.is_finite())
        {
            return Err(BuildError::BadTau(tau));
        }
        progress(Stage::Features);
        let features = FeatureSet::new(clips, metric_columns(clips.skeleton()));
        let mut ground = Self::of(clips, features, options, 1.0, None);
        progress(Stage::Neighbours(0.0));
        let on_neighbours = |share: f32| progress(Stage::Neighbours(share));
        ground.tau = match options.tau {
            TauRule::Fixed(tau) => tau,
            TauRule::NeighbourQuantile(share) if ground.keeps_all(options) => {
                let nearest = nearest(&ground.features, ground.min_jump, cancel, &on_neighbours)?;
                ground.clip_costs =
                    Some(ClipCosts::of_all(ground.clip_frames.len(), nearest.clip_pair));
                quantile(&nearest.other_family, share)
            }
            TauRule::NeighbourQuantile(share) => {
                let rows = spread_rows(ground.features.n_rows(), TAU_SAMPLES);
                let features = &ground.features;
                quantile(
                    &nearest_of_other_families(features, &rows, cancel, &on_neighbours)?,
                    share,
                )
            }
        };
        Ok(ground)
    }

    fn of(
        clips: &ClipSet,
        features: FeatureSet,
        options: &BuildOptions,
        tau: f64,
        clip_costs: Option<ClipCosts>,
    ) -> Self {
        let clip_frames = clips.clips().iter().map(|clip| clip.n_frames() as u32).collect();
        let min_jump = clips.fps().frames_in_secs(options.min_jump_secs).max(1) as u32;
        Self { features, clip_frames, min_jump, tau, clip_costs, is_extension: false }
    }

    /// Whether every edge under τ is kept.
    fn keeps_all(&self, options: &BuildOptions) -> bool {
        self.features.n_rows() <= options.all_edges_until_frames
    }

    /// The edges of a share and the τ that was used; edges of `known` clips are taken over.
    fn find_edges(
        &self,
        options: &BuildOptions,
        shard: Shard,
        known: Option<(&DirectedEdges, usize)>,
        cancel: &CancelToken,
        progress: &(dyn Fn(Stage) + Sync),
    ) -> Result<(DirectedEdges, f64), BuildError> {
        let (features, tau, min_jump) = (&self.features, self.tau, self.min_jump);
        let on_edges = |share: f32| progress(Stage::Edges(share));
        if !self.keeps_all(options) {
            let n_kept = options.edges_per_frame;
            let query = KeptQuery { tau, min_jump, n_kept, shard, known };
            return Ok((kept_edges(features, &query, cancel, &on_edges)?, tau));
        }
        let first_new_row = known.map_or(0, |(_, n_old)| features.frame_starts[n_old]);
        let max_pairs = max_pairs(options);
        let query = PairQuery { tau, min_jump, max_pairs, first_new_row, shard };
        let mut near = pairs_below(features, &query, cancel, &on_edges)?;
        if let Some((known, _)) = known {
            near.pairs.extend(near_pairs(std::slice::from_ref(known)));
            if near.tau < tau {
                near.pairs.retain(|pair| f64::from(pair.cost) < near.tau);
            }
            keep_cheapest(&mut near.pairs, &mut near.tau, max_pairs);
            near.pairs.sort_unstable_by_key(|pair| (pair.a, pair.b));
        }
        Ok((DirectedEdges::both_ways(features.n_rows(), &near.pairs), near.tau))
    }

    /// Levels, components and bridges over `edges`.
    fn finish(
        self,
        edges: DirectedEdges,
        tau: f64,
        options: &BuildOptions,
        cancel: &CancelToken,
        progress: &(dyn Fn(Stage) + Sync),
    ) -> Result<MotionGraph, BuildError> {
        progress(Stage::Hierarchy);
        let of_all = self.keeps_all(options) && !self.is_extension;
        let Self { features, clip_frames, min_jump, clip_costs, .. } = self;
        let mut forest = grow_forest(edges, &clip_frames, cancel)?;
        progress(Stage::Bridges);
        let by_tau = connectivity(&forest, &clip_frames, false);
        let mut with_bridges = by_tau.clone();
        if options.bridges {
            let clip_costs = match clip_costs {
                Some(costs) => costs,
                None if by_tau.is_whole() => ClipCosts::of_all(0, Vec::new()),
                None if of_all => {
                    let nearest = nearest(&features, min_jump, cancel, &|_| ())?;
                    ClipCosts::of_all(clip_frames.len(), nearest.clip_pair)
                }
                None => ClipCosts::of_some(&features, &by_tau, cancel)?,
            };
            (forest, with_bridges) = add_bridges(
                forest,
                &by_tau,
                &features,
                &clip_costs,
                &clip_frames,
                min_jump,
                cancel,
            )?;
        }
        Ok(MotionGraph {
            metric: features.metric,
            tau,
            min_jump,
            clip_frames,
            forest,
            by_tau,
            with_bridges,
        })
    }

    /// See [`GraphPart::fingerprint`].
    fn fingerprint(&self, options: &BuildOptions) -> u64 {
        // FNV-1a over words; parts are told apart, not defended.
        let step = |hash: u64, word: u64| (hash ^ word).wrapping_mul(0x0000_0100_0000_01B3);
        let values = self.features.rows.iter().map(|x| u64::from(x.to_bits()));
        let budget = if self.keeps_all(options) {
            options.edge_budget_bytes as u64
        } else {
            options.edges_per_frame as u64
        };
        let rest = [u64::from(self.min_jump), u64::from(self.keeps_all(options)), budget];
        let frames = self.clip_frames.iter().map(|&n| u64::from(n));
        frames.chain(rest).chain(values).fold(0xCBF2_9CE4_8422_2325, step)
    }
}

/// The edges of `lists` that go to a later row, as pairs in any order. A cost just under τ may be
/// rounded to above it, so they are not compared with τ again unless that was lowered.
fn near_pairs(lists: &[DirectedEdges]) -> Vec<NearPair> {
    let mut pairs = Vec::new();
    for list in lists {
        for row in 0..list.n_rows() {
            let later = list.of(row).filter(|&(to, _)| to > row as u32);
            pairs.extend(later.map(|(b, cost)| NearPair { a: row as u32, b, cost }));
        }
    }
    pairs
}

/// The leaf edges of a graph by row, bridges left out; rows behind its own have none.
fn known_edges(graph: &MotionGraph, n_rows: usize) -> DirectedEdges {
    let mut starts = vec![0u32];
    for &n in &graph.clip_frames {
        starts.push(starts[starts.len() - 1] + n);
    }
    let mut by_clip: Vec<Vec<(u32, u32, f32)>> = Vec::new();
    for clip in 0..graph.n_clips() {
        let mut edges = Vec::new();
        for pair in graph.pairs_from(crate::ids::ClipId::from_idx(clip)) {
            let to = starts[pair.to.idx()];
            let leaf = |edge: Edge| (edge.from_frame.0, to + edge.to_frame.0, edge.cost);
            edges.extend(graph.leaves_in(pair.tau_nodes()).into_iter().map(leaf));
        }
        edges.sort_unstable_by_key(|&(from, to, _)| (from, to));
        by_clip.push(edges);
    }
    DirectedEdges::collect(n_rows, |row, kept| {
        let clip = starts.partition_point(|&start| start as usize <= row) - 1;
        let Some(edges) = by_clip.get(clip) else { return };
        let frame = row as u32 - starts[clip];
        let first = edges.partition_point(|&(from, ..)| from < frame);
        let own = edges[first..].iter().take_while(|&&(from, ..)| from == frame);
        kept.extend(own.map(|&(_, to, cost)| (to, cost)));
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
