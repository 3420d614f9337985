//! A seed: a beam of paths that grow together through time, cut by cut, the best few of each moment
//! kept.
//!
//! What is kept is chosen by what a path has cost so far, how far it is from where it should be by
//! then, and what it must still cost to come to the next pose or lock. How many are kept, how much each
//! of these counts, which cuts are looked at and a little noise are drawn anew for every seed, so that
//! seeds differ.

mod ends;
mod expand;
mod node;

use glam::Vec2;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::anchors::{Anchor, Anchors};
use super::schedule::Schedule;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::search::library::SearchLibrary;
use crate::search::route::Route;
use crate::search::stretch::Stretch;
use crate::search::target::Target;
use ends::Final;
use node::Node;

/// Paths compete with those that are cut within so many frames of them.
const BUCKET_FRAMES: u32 = 6;

/// Lengths tried where nothing says how long the motion should be.
const FREE_FRAMES: std::ops::Range<u32> = 60..300;

/// Frames that a joint's guide keeps from what is hard.
const GUIDE_APART: u32 = 8;

/// How a seed is grown: all of it is drawn by the caller.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Growth {
    /// Paths kept at each moment.
    pub(crate) width: usize,
    /// Cuts out of a piece that are looked at: with few, a seed is rather a random walk.
    pub(crate) n_cuts: usize,
}

/// A node that waits for its moment.
struct Candidate {
    rank: f32,
    node: Node,
}

struct Beam<'a> {
    library: &'a SearchLibrary,
    target: &'a Target,
    allowed: &'a [bool],
    bridges: bool,
    anchors: Vec<Anchor>,
    /// Entry `i`: what cuts cost at least from the i-th anchor through all that follow, in τ.
    onward: Vec<f32>,
    schedule: Schedule,
    n_frames: u32,
    width: usize,
    look_ahead: u32,
    /// Cuts out of a piece that are looked at.
    n_cuts: usize,
    /// Factor of costs so far in ranks.
    past: f32,
    noise: f32,
    nodes: Vec<Node>,
    next_bucket: usize,
    buckets: Vec<Vec<Candidate>>,
    finals: Vec<Final>,
}

/// Grows one seed; `None` when every path ran into a dead end.
pub(crate) fn grow(
    library: &SearchLibrary,
    target: &Target,
    scope: (&[bool], bool),
    anchors: &Anchors,
    growth: Growth,
    rng: &mut Pcg64Mcg,
) -> Option<Route> {
    let n_frames = target.frames.unwrap_or_else(|| rng.random_range(FREE_FRAMES));
    let n_frames = n_frames.max(target.needed() + 1).max(1);
    let mut through = anchors.hard.clone();
    let mut places: Vec<(u32, Vec2)> = Vec::new();
    for joint in anchors.joints.iter().filter(|joint| joint.len() > 0) {
        // The better ones more often; now and then none, should they mislead.
        let nth = rng.random_range(0..joint.len()).min(rng.random_range(0..joint.len()));
        let anchor = joint.anchor(nth, library, scope);
        let free = |other: &Anchor| {
            let last: usize = other.pieces.iter().map(|piece| piece.n_frames()).sum();
            let (first, last) = (other.first, other.first + last as u32);
            !(first.saturating_sub(GUIDE_APART)..=last + GUIDE_APART).contains(&anchor.first)
        };
        if rng.random_range(0..8) > 0 && through.iter().all(free) {
            places.extend(anchor.ground_m.map(|ground_m| (anchor.first, ground_m)));
            through.push(anchor);
        }
    }
    through.sort_by_key(|anchor| anchor.first);
    let mut earliest = 0;
    for anchor in &mut through {
        let n_frames: usize = anchor.pieces.iter().map(|piece| piece.n_frames()).sum();
        let ends_at = anchor.first + n_frames as u32;
        *anchor = anchor.entered_by_chance(library, scope, earliest, rng);
        earliest = ends_at + 1;
    }
    let fps = library.clips().fps().get() as f32;
    let n_buckets = (n_frames / BUCKET_FRAMES) as usize + 2;
    let mut beam = Beam {
        library,
        target,
        allowed: scope.0,
        bridges: scope.1,
        onward: onward(&through),
        anchors: through,
        schedule: Schedule::new(target, n_frames, fps, &places),
        n_frames,
        width: growth.width,
        look_ahead: rng.random_range(15..45),
        n_cuts: growth.n_cuts,
        past: rng.random_range(0.3f32..1.2),
        noise: rng.random_range(0.0f32..0.5),
        nodes: Vec::new(),
        next_bucket: 0,
        buckets: (0..n_buckets).map(|_| Vec::new()).collect(),
        finals: Vec::new(),
    };
    beam.start(rng);
    for bucket in 0..n_buckets {
        beam.next_bucket = bucket + 1;
        let mut candidates = std::mem::take(&mut beam.buckets[bucket]);
        candidates.sort_unstable_by(|a, b| a.rank.total_cmp(&b.rank));
        beam.expand_best(&candidates, rng);
    }
    beam.best()
}

/// The least cost of cuts, in τ, from `frame` of `clip` at the motion's frame `at` to an anchor at its
/// time; `None` where there is no way that is known.
#[inline]
fn cost_to(anchor: &Anchor, clip: ClipId, frame: u32, at: u32) -> Option<f32> {
    let left = anchor.first.checked_sub(at)?;
    let exact = anchor.countdown.as_ref().and_then(|table| table.cost(clip, frame, left));
    match exact {
        Some(cost) => cost.is_finite().then_some(cost),
        None => {
            let in_time = anchor.ways.least_frames(clip, frame) <= left;
            in_time.then(|| anchor.ways.least_cost(clip, frame))
        }
    }
}

fn onward(anchors: &[Anchor]) -> Vec<f32> {
    let mut onward = vec![0.0f32; anchors.len()];
    for nth in (1..anchors.len()).rev() {
        let last = anchors[nth - 1].pieces[anchors[nth - 1].pieces.len() - 1];
        let shown: usize = anchors[nth - 1].pieces.iter().map(|piece| piece.n_frames()).sum();
        let at = anchors[nth - 1].first + shown as u32 - 1;
        let step = cost_to(&anchors[nth], last.clip, last.to.0, at).unwrap_or(0.0);
        // Guides of joints may lie where no way leads; the beam finds that out.
        onward[nth - 1] = onward[nth] + if step.is_finite() { step } else { 0.0 };
    }
    onward
}

impl Beam<'_> {
    /// Expands the best of a moment, no more than a few in one clip.
    ///
    /// Those that have come through more anchors have a place of their own: what is still ahead of
    /// the others is only known to cost at least so much, so they look better than they are.
    fn expand_best(&mut self, candidates: &[Candidate], rng: &mut Pcg64Mcg) {
        let per_clip = self.width.div_ceil(4).max(2);
        let mut n_kept = vec![0; self.anchors.len() + 1];
        let mut n_in_clip: Vec<((usize, ClipId), usize)> = Vec::new();
        for candidate in candidates {
            let node = candidate.node;
            if n_kept[node.next_anchor] == self.width {
                continue;
            }
            let key = (node.next_anchor, node.clip);
            match n_in_clip.iter_mut().find(|(known, _)| *known == key) {
                Some((_, n)) if *n >= per_clip => continue,
                Some((_, n)) => *n += 1,
                None => n_in_clip.push((key, 1)),
            }
            n_kept[node.next_anchor] += 1;
            let idx = self.nodes.len() as u32;
            self.nodes.push(node);
            self.expand(idx, node, rng);
        }
    }

    /// First pieces: by chance over the library, and those that play straight into the first anchor.
    fn start(&mut self, rng: &mut Pcg64Mcg) {
        let n_clips = self.library.graph().n_clips();
        let place = self.target.anchor_frame;
        let offer = |beam: &mut Self, clip: ClipId, start: u32, rng: &mut Pcg64Mcg| {
            let torsos = beam.library.torsos(clip);
            let Some(read) = torsos.get((start + place) as usize) else { return };
            let world_from_clip = beam.target.anchor * read.inverse();
            let node = Node {
                clip,
                entered: start,
                at: 0,
                world_from_clip,
                cost: 0.0,
                before: None,
                next_anchor: 0,
                must_show: start + place + 1,
            };
            beam.offer(node, 0.0, rng);
        };
        if let Some(anchor) = self.anchors.first() {
            let piece = anchor.piece();
            if let Some(start) = piece.from.0.checked_sub(anchor.first) {
                offer(self, piece.clip, start, rng);
            }
        }
        let (mut n_left, mut n_tries) = (4 * self.width + 16, 40 * (4 * self.width + 16));
        while n_left > 0 && n_tries > 0 {
            n_tries -= 1;
            let clip = ClipId::from_idx(rng.random_range(0..n_clips));
            let start = rng.random_range(0..self.library.n_frames(clip));
            let leads_on =
                self.anchors.first().is_none_or(|a| cost_to(a, clip, start, 0).is_some());
            if self.allowed[clip.idx()] && leads_on {
                n_left -= 1;
                offer(self, clip, start, rng);
            }
        }
    }

    /// Takes a new node in, ranked, unless it leads nowhere.
    fn offer(&mut self, mut node: Node, extra: f32, rng: &mut Pcg64Mcg) {
        let library = self.library;
        let n_in_clip = library.n_frames(node.clip);
        self.pass_anchor(&mut node);
        let mut ahead_cost = extra;
        if let Some(anchor) = self.anchors.get(node.next_anchor) {
            let Some(cuts) = cost_to(anchor, node.clip, node.entered, node.at) else { return };
            ahead_cost += self.target.weights.continuity * (cuts + self.onward[node.next_anchor]);
        }
        // A clip that ends before the motion does must have a way out.
        let ends_early = node.at + (n_in_clip - node.entered) < self.n_frames;
        let dead = library.graph().with_bridges.dead_from[node.clip.idx()];
        if ends_early && node.may_leave() >= dead {
            return;
        }
        let next = self.schedule.next_frame(node.at + 1).unwrap_or(self.n_frames - 1);
        let ahead = self.look_ahead.min(next.min(self.n_frames - 1).saturating_sub(node.at));
        let reach = (node.entered + ahead).min(n_in_clip - 1);
        let seen_at = node.at + reach - node.entered;
        let there = node.world_from_clip * library.torsos(node.clip)[reach as usize];
        let error = self.schedule.error(seen_at, there);
        let ahead = Stretch {
            clip: node.clip,
            world_from_clip: node.world_from_clip,
            from: node.entered,
            to: reach,
            starts_at: node.at,
        };
        ahead_cost += ahead.styles_cost(self.target);
        if self.target.has_surroundings() {
            ahead_cost += ahead.surroundings_cost(library, self.target, f32::INFINITY);
        }
        let rank = error + self.past * (node.cost + ahead_cost);
        let rank = rank * (1.0 + self.noise * rng.random_range(-1.0f32..1.0));
        // What is cut within the moment under way competes in the next.
        let bucket = ((node.at / BUCKET_FRAMES) as usize).max(self.next_bucket);
        if let Some(bucket) = self.buckets.get_mut(bucket) {
            bucket.push(Candidate { rank, node });
        }
    }

    /// Notes that a node that plays on shows the next anchor, and goes through a lock's pieces.
    fn pass_anchor(&mut self, node: &mut Node) {
        while let Some(anchor) = self.anchors.get(node.next_anchor) {
            let piece = anchor.piece();
            let shown = (node.entered + anchor.first).checked_sub(node.at);
            let on_track =
                node.clip == piece.clip && node.at <= anchor.first && shown == Some(piece.from.0);
            if !on_track {
                return;
            }
            node.next_anchor += 1;
            node.must_show = piece.to.0 + 1;
            let (pieces, cuts) = (anchor.pieces.clone(), anchor.cuts.clone());
            for (piece, cut) in pieces[1..].iter().zip(cuts) {
                let idx = self.nodes.len() as u32;
                self.nodes.push(*node);
                let left = node.must_show;
                let stretch = Stretch {
                    clip: node.clip,
                    world_from_clip: node.world_from_clip,
                    from: node.entered,
                    to: left,
                    starts_at: node.at,
                };
                let torso = node.world_from_clip * self.library.torsos(node.clip)[left as usize];
                let entry = self.library.torsos(piece.clip)[piece.from.idx()];
                let edge = self.library.graph().forest.edge(cut);
                let per_tau = (1.0 / self.library.graph().tau) as f32;
                node.cost += self.stretch_cost(&stretch)
                    + self.target.weights.continuity * edge.cost * per_tau;
                node.at = stretch.ends_at();
                node.clip = piece.clip;
                node.entered = piece.from.0;
                node.world_from_clip = torso * entry.inverse();
                node.before = Some((idx, cut));
                node.must_show = piece.to.0 + 1;
            }
        }
    }

    fn stretch_cost(&self, stretch: &Stretch) -> f32 {
        stretch.cost(self.library, self.target, f32::INFINITY)
    }

    fn usable(&self, to: ClipId, cut: EdgeId) -> bool {
        self.allowed[to.idx()] && (self.bridges || !self.library.graph().forest.is_bridge(cut))
    }
}
