//! A library laid out for the search: cuts of each pair of clips by cost, joints by frame.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::circles::ClipCircles;
use super::tracks::Extent;
use crate::bodies::Bodies;
use crate::clip::{Clip, ClipSet};
use crate::constraint::SupportCost;
use crate::graph::{ClipPair, EdgeId, MotionGraph};
use crate::ids::ClipId;
use crate::planar::PlanarTransform;

/// An edge of some level as the search scans it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    pub(crate) from: u32,
    pub(crate) to: u32,
    /// In units of τ.
    pub(crate) cost: f32,
    pub(crate) id: EdgeId,
}

impl Cut {
    /// Frames that the motion grows longer by against a cut between equal frame numbers: two
    /// cuts of one pair with the same shift make motions of the same length.
    #[inline]
    pub(crate) fn shift(&self) -> i64 {
        i64::from(self.from) - i64::from(self.to)
    }
}

/// A pair's cuts, as ranges into the two lists.
#[derive(Clone, Debug)]
struct PairCuts {
    to: ClipId,
    first_bridge: u32,
    leaves: Range<u32>,
    /// `None` where every tree is a single leaf, so that all leaves are chosen: in large
    /// libraries most pairs.
    chosen: Option<Range<u32>>,
    cheapest: f32,
}

/// Pairs of clips whose cuts are arranged at once: enough for all threads.
const PAIRS_AT_ONCE: usize = 1024;

/// The clips and their graph, arranged so that all cuts of a pair lie together, by the length
/// that they make and then by cost.
///
/// Beside all leaf edges there is a short list, the **chosen** cuts: the cheapest leaf under each
/// root. A root stands for its cluster by means, and a mean cost is twice that of the best leaf;
/// next to a path of leaves it would never look like an improvement.
///
/// Made once per library (some tens of milliseconds) and shared by all searches on it.
#[derive(Debug)]
pub struct SearchLibrary {
    clips: Arc<ClipSet>,
    graph: Arc<MotionGraph>,
    leaves: Vec<Cut>,
    chosen: Vec<Cut>,
    pairs: Vec<PairCuts>,
    pair_starts: Vec<u32>,
    /// For each clip, the clips it is entered from and where their pair stands in `pairs`.
    pairs_into: Vec<Vec<(ClipId, u32)>>,
    /// Roots of trees (the graph G′) that leave each clip, by the frame left. `None` where all
    /// are leaves, and so the chosen cuts.
    coarse_out: Vec<Option<Vec<(ClipId, Cut)>>>,
    /// Chosen cuts that leave each clip, by the frame left: `(entered clip, cut)`.
    out: Vec<Vec<(ClipId, Cut)>>,
    /// Chosen cuts that enter each clip, cheapest first: `(left clip, cut)`.
    into: Vec<Vec<(ClipId, Cut)>>,
    /// Joint positions in the torso frame, per clip.
    bodies: Vec<Bodies>,
    /// How far the joints of every frame reach, per clip.
    extents: Vec<Vec<Extent>>,
    /// Where bodies are, roughly, per clip.
    circles: Vec<ClipCircles>,
    support: Vec<SupportCost>,
    leaves_the_floor: bool,
}

impl SearchLibrary {
    /// Arranges `clips` and the `graph` that was built from them.
    pub fn new(clips: Arc<ClipSet>, graph: Arc<MotionGraph>) -> Self {
        let forest = &graph.forest;
        let per_tau = (1.0 / graph.tau) as f32;
        let cut = |id: EdgeId| {
            let edge = forest.edge(id);
            Cut { from: edge.from_frame.0, to: edge.to_frame.0, cost: edge.cost * per_tau, id }
        };
        let in_order = |cuts: &mut Vec<Cut>| {
            cuts.sort_unstable_by(|a, b| {
                let by_cost = a.cost.total_cmp(&b.cost).then(a.id.cmp(&b.id));
                a.shift().cmp(&b.shift()).then(by_cost)
            });
        };
        let cuts_of = |pair: &ClipPair| {
            let nodes = pair.first_node..pair.end_node;
            let all = nodes.clone().map(EdgeId);
            let mut leaves: Vec<Cut> = all.filter(|&id| forest.is_leaf(id)).map(cut).collect();
            let coarse: Vec<Cut> = forest.roots(nodes.clone()).map(cut).collect();
            let mut chosen: Vec<Cut> = forest
                .roots(nodes)
                .filter_map(|root| forest.cheapest_leaf(root))
                .map(cut)
                .collect();
            in_order(&mut leaves);
            in_order(&mut chosen);
            (leaves, chosen, coarse)
        };
        let all = 0..forest.n_nodes() as u32;
        let n_leaves = all.into_par_iter().filter(|&id| forest.is_leaf(EdgeId(id))).count();
        let n_joints = clips.skeleton().n_joints();
        let in_torso = clips.clips().par_iter().map(|clip| joints_in_torso(&clips, clip));
        let (bodies, extents): (Vec<Bodies>, Vec<Vec<Extent>>) = in_torso
            .map(|joints| {
                let extents = joints.chunks(n_joints).map(Extent::of).collect();
                (Bodies::new(&joints, n_joints), extents)
            })
            .unzip();
        let tracks = clips.clips().par_iter().map(|clip| &clip.track.world_from_torso);
        let circles = tracks
            .zip(&extents)
            .map(|(torsos, extents)| ClipCircles::new(torsos, extents))
            .collect();
        let mut library = Self {
            leaves: Vec::with_capacity(n_leaves),
            chosen: Vec::new(),
            pairs: Vec::with_capacity(forest.pairs().len()),
            pair_starts: vec![0; graph.n_clips() + 1],
            pairs_into: vec![Vec::new(); graph.n_clips()],
            coarse_out: vec![None; graph.n_clips()],
            out: vec![Vec::new(); graph.n_clips()],
            into: vec![Vec::new(); graph.n_clips()],
            bodies,
            extents,
            circles,
            support: clips.clips().iter().map(SupportCost::new).collect(),
            leaves_the_floor: false,
            clips,
            graph: Arc::clone(&graph),
        };
        library.leaves_the_floor = library.support.iter().any(SupportCost::leaves_the_floor);
        // Lists that are needed beside the chosen cuts: those in which a root is no leaf.
        for pair in forest.pairs() {
            let nodes = pair.first_node..pair.end_node;
            if nodes.map(EdgeId).any(|id| !forest.is_leaf(id)) {
                library.coarse_out[pair.from.idx()] = Some(Vec::new());
            }
        }
        // All lists at once would take as much memory as what is made of them.
        for batch in forest.pairs().chunks(PAIRS_AT_ONCE) {
            let lists: Vec<(Vec<Cut>, Vec<Cut>, Vec<Cut>)> =
                batch.par_iter().map(cuts_of).collect();
            for (pair, (leaves, chosen, coarse)) in batch.iter().zip(lists) {
                library.pair_starts[pair.from.idx() + 1] += 1;
                if let Some(out) = &mut library.coarse_out[pair.from.idx()] {
                    out.extend(coarse.iter().map(|&cut| (pair.to, cut)));
                }
                library.into[pair.to.idx()].extend(chosen.iter().map(|&cut| (pair.from, cut)));
                library.out[pair.from.idx()].extend(chosen.iter().map(|&cut| (pair.to, cut)));
                let first_leaf = library.leaves.len() as u32;
                let first_chosen = library.chosen.len() as u32;
                let cheapest = chosen.iter().map(|cut| cut.cost).fold(f32::INFINITY, f32::min);
                let is_flat = leaves.len() == chosen.len();
                library.leaves.extend(leaves);
                if !is_flat {
                    library.chosen.extend(chosen);
                }
                library.pairs_into[pair.to.idx()].push((pair.from, library.pairs.len() as u32));
                library.pairs.push(PairCuts {
                    to: pair.to,
                    first_bridge: pair.first_bridge,
                    leaves: first_leaf..library.leaves.len() as u32,
                    chosen: (!is_flat).then_some(first_chosen..library.chosen.len() as u32),
                    cheapest,
                });
            }
        }
        for clip in 0..graph.n_clips() {
            library.pair_starts[clip + 1] += library.pair_starts[clip];
        }
        let coarse_out = library.coarse_out.par_iter_mut().flatten();
        library.out.par_iter_mut().chain(coarse_out).for_each(|out| {
            out.sort_unstable_by_key(|(to, cut)| (cut.from, *to, cut.id));
            out.shrink_to_fit();
        });
        library.into.par_iter_mut().for_each(|into| {
            into.sort_unstable_by(|(_, a), (_, b)| a.cost.total_cmp(&b.cost).then(a.id.cmp(&b.id)));
            into.shrink_to_fit();
        });
        library.chosen.shrink_to_fit();
        library
    }

    /// The clips.
    pub fn clips(&self) -> &Arc<ClipSet> {
        &self.clips
    }

    /// The graph.
    pub fn graph(&self) -> &Arc<MotionGraph> {
        &self.graph
    }

    #[inline]
    pub(crate) fn torsos(&self, clip: ClipId) -> &[PlanarTransform] {
        &self.clips.clip(clip).track.world_from_torso
    }

    #[inline]
    pub(crate) fn n_frames(&self, clip: ClipId) -> u32 {
        self.graph.clip_frames[clip.idx()]
    }

    #[inline]
    pub(crate) fn support(&self, clip: ClipId) -> &SupportCost {
        &self.support[clip.idx()]
    }

    /// Whether any clip leaves the floor's level, so that the environment term can matter.
    #[inline]
    pub(crate) fn leaves_the_floor(&self) -> bool {
        self.leaves_the_floor
    }

    /// Joint positions of a clip.
    #[inline]
    pub(crate) fn bodies(&self, clip: ClipId) -> &Bodies {
        &self.bodies[clip.idx()]
    }

    /// How far the joints of a frame reach.
    #[inline]
    pub(crate) fn extent(&self, clip: ClipId, frame: u32) -> Extent {
        self.extents[clip.idx()][frame as usize]
    }

    /// How far the joints reach, frame by frame.
    #[inline]
    pub(crate) fn extents(&self, clip: ClipId) -> &[Extent] {
        &self.extents[clip.idx()]
    }

    /// Where the body of a clip is, roughly.
    #[inline]
    pub(crate) fn circles(&self, clip: ClipId) -> &ClipCircles {
        &self.circles[clip.idx()]
    }

    /// Edges of the coarsest graph that leave `clip`, ordered by the frame left.
    #[inline]
    pub(crate) fn coarse_out(&self, clip: ClipId) -> &[(ClipId, Cut)] {
        self.coarse_out[clip.idx()].as_ref().unwrap_or(&self.out[clip.idx()])
    }

    /// Chosen cuts that leave `clip`, ordered by the frame left.
    #[inline]
    pub(crate) fn out(&self, clip: ClipId) -> &[(ClipId, Cut)] {
        &self.out[clip.idx()]
    }

    /// Chosen cuts that enter `clip`, cheapest first.
    #[inline]
    pub(crate) fn into(&self, clip: ClipId) -> &[(ClipId, Cut)] {
        &self.into[clip.idx()]
    }

    /// The pairs that enter `clip`, each with the clip left, in the clips' order.
    pub(crate) fn pairs_into(&self, clip: ClipId) -> impl Iterator<Item = (ClipId, PairView<'_>)> {
        let pairs = self.pairs_into[clip.idx()].iter();
        pairs.map(|&(from, pair)| (from, self.view(&self.pairs[pair as usize])))
    }

    /// How many leaf edges there are.
    pub(crate) fn n_leaves(&self) -> usize {
        self.leaves.len()
    }

    /// The pair `from → to`.
    #[inline]
    pub(crate) fn pair(&self, from: ClipId, to: ClipId) -> Option<PairView<'_>> {
        let range = self.pair_starts[from.idx()]..self.pair_starts[from.idx() + 1];
        let pairs = &self.pairs[range.start as usize..range.end as usize];
        let at = pairs.binary_search_by_key(&to, |pair| pair.to).ok()?;
        Some(self.view(&pairs[at]))
    }

    #[inline]
    fn view(&self, pair: &PairCuts) -> PairView<'_> {
        let range = |r: &Range<u32>| r.start as usize..r.end as usize;
        PairView {
            first_bridge: pair.first_bridge,
            leaves: &self.leaves[range(&pair.leaves)],
            chosen: match &pair.chosen {
                Some(chosen) => &self.chosen[range(chosen)],
                None => &self.leaves[range(&pair.leaves)],
            },
            cheapest: pair.cheapest,
        }
    }
}

/// The cuts of one pair of clips, each list by shift, then cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairView<'a> {
    pub(crate) first_bridge: u32,
    pub(crate) leaves: &'a [Cut],
    /// The cheapest leaf of each tree.
    pub(crate) chosen: &'a [Cut],
    /// The least cost of any.
    pub(crate) cheapest: f32,
}

/// Walks the cuts with a shift within `shifts`, shift by shift, cheapest first, for as long as
/// `visit` wants more of a shift. Returns how many were left out.
#[inline]
pub(crate) fn walk_shifts(
    cuts: &[Cut],
    shifts: (i64, i64),
    mut visit: impl FnMut(&Cut) -> bool,
) -> u64 {
    let first = cuts.partition_point(|cut| cut.shift() < shifts.0);
    let mut at = first;
    let mut n_visited = 0;
    while at < cuts.len() && cuts[at].shift() <= shifts.1 {
        n_visited += 1;
        if visit(&cuts[at]) {
            at += 1;
            continue;
        }
        // Gallop to the next shift.
        let shift = cuts[at].shift();
        let mut step = 1;
        while at + step < cuts.len() && cuts[at + step].shift() == shift {
            step *= 2;
        }
        let end = (at + step).min(cuts.len());
        let from = at + step / 2;
        at = from + cuts[from..end].partition_point(|cut| cut.shift() == shift);
    }
    cuts.len() as u64 - n_visited
}

/// Joint positions in the torso frame, frame-major, metres.
fn joints_in_torso(clips: &ClipSet, clip: &Clip) -> Vec<Vec3> {
    let n_joints = clips.skeleton().n_joints();
    let mut positions = clip.motion.joint_positions_m(clips.skeleton());
    for (frame, torso) in clip.track.world_from_torso.iter().enumerate() {
        let torso_from_world = torso.inverse();
        for p in &mut positions[frame * n_joints..(frame + 1) * n_joints] {
            *p = torso_from_world.apply(*p);
        }
    }
    positions
}
