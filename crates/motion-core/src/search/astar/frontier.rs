//! One weighted A* search: states, the open list, and what follows a state.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::Ways;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::path::Path;
use crate::planar::PlanarTransform;
use crate::search::rivals::Ground;
use crate::search::stretch::Stretch;
use crate::units::FrameIdx;

/// First frames drawn for a search.
const N_STARTS: usize = 512;

/// Pieces show at least this many frames; shorter ones are left to the mutations.
const MIN_PIECE: u32 = 6;

/// The rest of a motion is judged from so many frames after a cut: at the cut itself all clips that
/// could be entered stand alike.
const LOOK_AHEAD: u32 = 20;

/// After so many states a lane's first search is over: the best end that was seen is what it has
/// found. Each search after it may look into twice as many, up to [`MAX_EXPANDED`].
const FIRST_EXPANDED: usize = 256;
const MAX_EXPANDED: usize = 4096;

/// Lengths drawn where nothing says how long the motion should be.
const FREE_FRAMES: std::ops::Range<u32> = 60..300;

/// Ends are tried so many frames to either side of the wished length.
const END_SLACK: u32 = 10;

/// States are the same when no further apart: frames, metres, radians.
const SAME_FRAMES: u32 = 4;
const SAME_M: f32 = 0.2;
const SAME_RAD: f32 = 0.17;

/// How a state was reached from the one before.
#[derive(Clone, Copy, Debug)]
enum Step {
    Start,
    Cut(EdgeId),
    /// By staying until the next hard stretch was shown.
    Shown,
    /// By staying until this frame of the clip, the last.
    End(u32),
}

/// Being in a clip from some frame on.
#[derive(Clone, Copy, Debug)]
struct Node {
    clip: ClipId,
    /// The clip's frame that is shown at `frame`.
    entered: u32,
    frame: u32,
    /// The clip is not left before this frame of it.
    free_from: u32,
    n_shown: usize,
    world_from_clip: PlanarTransform,
    /// What has been shown costs so much.
    cost: f32,
    parent: u32,
    step: Step,
}

/// The open list's order: the least first, then the newest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rank {
    total: f32,
    node: u32,
}

impl Eq for Rank {}

impl Ord for Rank {
    fn cmp(&self, other: &Self) -> Ordering {
        other.total.total_cmp(&self.total).then(self.node.cmp(&other.node))
    }
}

impl PartialOrd for Rank {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What looking into states has come to.
pub(super) enum Outcome {
    /// There is more to look into.
    Open,
    /// The best motion that was seen.
    Found(Path),
    /// None was seen.
    Failed,
}

/// A search under way.
#[derive(Clone, Debug)]
pub(super) struct Frontier {
    weight: f32,
    max_expanded: usize,
    n_frames: u32,
    nodes: Vec<Node>,
    open: BinaryHeap<Rank>,
    /// The least cost at which each rounded state was reached.
    reached: HashMap<[i32; 6], f32>,
    /// The end that costs least, and its cost.
    best_end: Option<(f32, u32)>,
    n_expanded: usize,
    n_scored: u64,
}

impl Frontier {
    pub(super) fn new(
        ways: &Ways,
        ground: Ground<'_>,
        (weight, n_done): (f32, usize),
        rng: &mut Pcg64Mcg,
    ) -> Self {
        let Ground { library, target, .. } = ground;
        let n_frames = target.frames.unwrap_or_else(|| rng.random_range(FREE_FRAMES));
        let n_frames = n_frames.max(target.needed() + 1).max(1);
        let mut new = Self {
            weight,
            max_expanded: MAX_EXPANDED.min(FIRST_EXPANDED << n_done.min(8)),
            n_frames,
            nodes: Vec::new(),
            open: BinaryHeap::new(),
            reached: HashMap::new(),
            best_end: None,
            n_expanded: 0,
            n_scored: 0,
        };
        let Ok(next) = ways.approaches.next(0) else { return new };
        let leads = |&nth: &usize| {
            let (clip, cut) = ways.graph.cut(nth);
            next.is_none_or(|hard| hard.leads((clip, cut.to), hard.first))
        };
        let starts: Vec<usize> = (0..ways.graph.n_cuts()).filter(leads).collect();
        if starts.is_empty() {
            return new;
        }
        for _ in 0..N_STARTS {
            let (clip, cut) = ways.graph.cut(starts[rng.random_range(0..starts.len())]);
            let world_from_clip = target.anchor * library.torsos(clip)[cut.to as usize].inverse();
            new.push(
                ways,
                ground,
                Node {
                    clip,
                    entered: cut.to,
                    frame: 0,
                    free_from: cut.to + MIN_PIECE,
                    n_shown: 0,
                    world_from_clip,
                    cost: 0.0,
                    parent: u32::MAX,
                    step: Step::Start,
                },
            );
        }
        new
    }

    /// Candidates scored since the last call.
    pub(super) fn take_n_scored(&mut self) -> u64 {
        std::mem::take(&mut self.n_scored)
    }

    /// Looks into up to `n` states.
    pub(super) fn expand(&mut self, ways: &Ways, ground: Ground<'_>, n: usize) -> Outcome {
        for _ in 0..n {
            let rank = self.open.pop();
            let next = rank.filter(|rank| {
                let is_end = matches!(self.nodes[rank.node as usize].step, Step::End(_));
                !is_end && self.n_expanded < self.max_expanded
            });
            let Some(Rank { node, .. }) = next else {
                let end = self.best_end.map(|(_, end)| self.path(ways, end));
                return end.map_or(Outcome::Failed, Outcome::Found);
            };
            let at = self.nodes[node as usize];
            self.n_expanded += 1;
            self.follow(ways, ground, node, &at);
        }
        Outcome::Open
    }

    /// Everything that may follow a state.
    fn follow(&mut self, ways: &Ways, ground: Ground<'_>, parent: u32, at: &Node) {
        let Ground { library, target, .. } = ground;
        let Ok(next) = ways.approaches.next(at.n_shown) else { return };
        let last = next.map_or(self.n_frames - 1, |hard| hard.first);
        let Some(left) = last.checked_sub(at.frame) else { return };
        let n_frames = library.n_frames(at.clip);
        let farthest = (at.entered + left + END_SLACK + 1).min(n_frames);
        let shown = costs_until(ground, at, farthest);
        let until = |clip_frame: u32| {
            shown.get((clip_frame - at.entered) as usize).copied().unwrap_or_default()
        };
        let torsos = library.torsos(at.clip);
        let continuity = target.weights.continuity;
        for nth in ways.graph.out(at.clip, at.free_from..at.entered + left + 1) {
            let (to, cut) = ways.graph.cut(nth);
            let frame = at.frame + cut.from - at.entered;
            if next.is_some_and(|hard| !hard.leads((to, cut.to), hard.first - frame)) {
                continue;
            }
            let torso = at.world_from_clip * torsos[cut.from as usize];
            let node = Node {
                clip: to,
                entered: cut.to,
                frame,
                free_from: cut.to + MIN_PIECE.min(self.n_frames.saturating_sub(frame)).max(1),
                n_shown: at.n_shown,
                world_from_clip: torso * library.torsos(to)[cut.to as usize].inverse(),
                cost: at.cost + until(cut.from) + continuity * cut.cost,
                parent,
                step: Step::Cut(cut.id),
            };
            self.push(ways, ground, node);
        }
        match next {
            Some(hard) if hard.stays(at.clip, at.entered, left) => {
                let forest = &library.graph().forest;
                let per_tau = (1.0 / library.graph().tau) as f32;
                let (mut clip, mut world_from_clip) = (at.clip, at.world_from_clip);
                let mut cost = at.cost + until((at.entered + left).min(n_frames - 1));
                for &inner in &hard.inner {
                    let edge = forest.edge(inner);
                    let torso = world_from_clip * library.torsos(clip)[edge.from_frame.idx()];
                    clip = forest.pair_of(inner).to;
                    world_from_clip = torso * library.torsos(clip)[edge.to_frame.idx()].inverse();
                    cost += continuity * edge.cost * per_tau;
                }
                let entered = hard.ends_with.to.0;
                let (frame, n_shown) = (hard.last, at.n_shown + 1);
                let free_from = entered + 1;
                let step = Step::Shown;
                let node = Node {
                    clip,
                    entered,
                    frame,
                    free_from,
                    n_shown,
                    world_from_clip,
                    cost,
                    parent,
                    step,
                };
                self.push(ways, ground, node);
            }
            Some(_) => {}
            None => self.end(ground, parent, at, &until),
        }
    }

    /// The best end within the clip.
    fn end(&mut self, ground: Ground<'_>, parent: u32, at: &Node, until: &impl Fn(u32) -> f32) {
        let Ground { library, target, .. } = ground;
        let wished = at.entered + (self.n_frames - 1 - at.frame);
        let first = wished.saturating_sub(END_SLACK).max(at.entered);
        let last = (wished + END_SLACK).min(library.n_frames(at.clip) - 1);
        let mut best: Option<(f32, u32)> = None;
        for end in first..=last {
            let n_frames = at.frame + end - at.entered + 1;
            let mut cost = at.cost + until(end) + target.frames_cost(n_frames);
            if let Some(wish) = &target.last {
                cost += wish.cost(library, at.world_from_clip, at.clip, end);
            }
            self.n_scored += 1;
            if cost.is_finite() && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, end));
            }
        }
        if let Some((cost, end)) = best {
            let node = self.nodes.len() as u32;
            self.nodes.push(Node { cost, parent, step: Step::End(end), ..*at });
            self.open.push(Rank { total: cost, node });
            if self.best_end.is_none_or(|(least, _)| cost < least) {
                self.best_end = Some((cost, node));
            }
        }
    }

    /// Puts a state on the open list unless one like it was reached at no more cost.
    fn push(&mut self, ways: &Ways, ground: Ground<'_>, node: Node) {
        let library = ground.library;
        let torsos = library.torsos(node.clip);
        self.n_scored += 1;
        let torso = node.world_from_clip * torsos[node.entered as usize];
        let place = torso.ground_m() / SAME_M;
        let key = [
            node.clip.idx() as i32,
            (node.entered / SAME_FRAMES) as i32,
            (node.frame / SAME_FRAMES) as i32,
            place.x.round() as i32,
            place.y.round() as i32,
            (torso.heading_rad() / SAME_RAD).round() as i32,
        ];
        let reached = self.reached.entry(key).or_insert(f32::INFINITY);
        if node.cost >= *reached {
            return;
        }
        *reached = node.cost;
        let next = ways.expectation.next_frame(node.frame, self.n_frames);
        let ahead = LOOK_AHEAD.min(next.saturating_sub(node.frame));
        let ahead = ahead.min(torsos.len() as u32 - 1 - node.entered);
        let there = node.world_from_clip * torsos[(node.entered + ahead) as usize];
        let rest = ways.expectation.of(node.frame + ahead, there, self.n_frames);
        let total = node.cost + self.weight * rest;
        let nth = self.nodes.len() as u32;
        self.nodes.push(node);
        self.open.push(Rank { total, node: nth });
    }

    /// The path that leads to an end.
    fn path(&self, ways: &Ways, end: u32) -> Path {
        let mut steps = Vec::new();
        let mut at = end;
        while let Some(node) = self.nodes.get(at as usize) {
            steps.push(node);
            at = node.parent;
        }
        let first = steps[steps.len() - 1];
        let mut path = Path {
            first_clip: first.clip,
            start: FrameIdx(first.entered),
            cuts: vec![],
            end: FrameIdx(first.entered),
        };
        for node in steps.into_iter().rev() {
            match node.step {
                Step::Start => {}
                Step::Cut(cut) => path.cuts.push(cut),
                Step::Shown => {
                    if let Ok(Some(hard)) = ways.approaches.next(node.n_shown - 1) {
                        path.cuts.extend(&hard.inner);
                    }
                }
                Step::End(end) => path.end = FrameIdx(end),
            }
        }
        path
    }
}

/// Entry `i`: what showing the clip until `i` frames after its entry costs, the frame then not
/// shown. Empty where nothing is read on the way.
fn costs_until(ground: Ground<'_>, at: &Node, farthest: u32) -> Vec<f32> {
    let Ground { library, target, .. } = ground;
    let Node { clip, world_from_clip, entered, frame, .. } = *at;
    if target.readings.is_empty() && target.styles.is_empty() && !target.has_surroundings() {
        return Vec::new();
    }
    let mut sum = 0.0;
    let mut sums = vec![0.0];
    for from in entered..farthest {
        let starts_at = frame + from - entered;
        let one = Stretch { clip, world_from_clip, from, to: from + 1, starts_at };
        sum += one.cost(library, target, f32::INFINITY);
        sums.push(sum);
    }
    sums
}
