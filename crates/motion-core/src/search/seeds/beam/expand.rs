//! Which cuts a path of a beam goes on by.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::node::Node;
use super::{Beam, cost_to};
use crate::ids::ClipId;
use crate::search::library::Cut;
use crate::search::stretch::Stretch;

/// Pieces of a seed are left no later than so many frames after they may be, unless they go on to
/// the end or to an anchor.
const MAX_PIECE: u32 = 120;

/// Ways straight to an anchor that are looked at from one piece.
const DIRECT_PER_NODE: usize = 3;

impl Beam<'_> {
    /// Offers what can follow a node: ends, ways straight to the next anchor, and cuts.
    pub(super) fn expand(&mut self, idx: u32, node: Node, rng: &mut Pcg64Mcg) {
        self.try_ends(idx, &node);
        self.go_straight(idx, &node, rng);
        let library = self.library;
        let out = library.out(node.clip);
        let last_at = match self.anchors.get(node.next_anchor) {
            Some(anchor) => anchor.first,
            None => self.n_frames - 1,
        };
        let last = node.entered + last_at.saturating_sub(node.at);
        let last = last.min(node.may_leave() + MAX_PIECE);
        let first = out.partition_point(|(_, cut)| cut.from < node.may_leave());
        let end = out.partition_point(|(_, cut)| cut.from <= last);
        if first >= end {
            return;
        }
        // With an anchor ahead only cuts count from which it is reached in time.
        let pending = self.anchors.get(node.next_anchor);
        let leads_on = |&(to, cut): &(ClipId, Cut)| {
            let at = node.at + cut.from - node.entered;
            self.usable(to, cut.id)
                && pending.is_none_or(|anchor| cost_to(anchor, to, cut.to, at).is_some())
        };
        let all = &out[first..end];
        let cuts: Vec<(ClipId, Cut)> = if pending.is_some() {
            let fits: Vec<_> = all.iter().filter(|cut| leads_on(cut)).copied().collect();
            sample(&fits, self.n_cuts, rng).collect()
        } else {
            sample(all, self.n_cuts, rng).filter(leads_on).collect()
        };
        let mut shown_to = node.entered;
        let mut cost = node.cost;
        for (to, cut) in cuts {
            let stretch = self.stretch_of(&node, shown_to, cut.from);
            cost += self.stretch_cost(&stretch);
            shown_to = cut.from;
            self.enter(idx, &node, (to, cut), cost, rng);
        }
    }

    pub(super) fn stretch_of(&self, node: &Node, from: u32, to: u32) -> Stretch {
        let starts_at = node.at + from - node.entered;
        Stretch { clip: node.clip, world_from_clip: node.world_from_clip, from, to, starts_at }
    }

    fn enter(
        &mut self,
        idx: u32,
        node: &Node,
        (to, cut): (ClipId, Cut),
        cost: f32,
        rng: &mut Pcg64Mcg,
    ) {
        let torso = node.world_from_clip * self.library.torsos(node.clip)[cut.from as usize];
        let world_from_clip = torso * self.library.torsos(to)[cut.to as usize].inverse();
        let child = Node {
            clip: to,
            entered: cut.to,
            at: node.at + cut.from - node.entered,
            world_from_clip,
            cost: cost + self.target.weights.continuity * cut.cost,
            before: Some((idx, cut.id)),
            next_anchor: node.next_anchor,
            must_show: cut.to + 1,
        };
        self.offer(child, 0.0, rng);
    }

    /// The cheapest cuts that lead straight to the next anchor at its time: those with one shift.
    fn go_straight(&mut self, idx: u32, node: &Node, rng: &mut Pcg64Mcg) {
        let Some(anchor) = self.anchors.get(node.next_anchor) else { return };
        let piece = anchor.piece();
        let Some(pair) = self.library.pair(node.clip, piece.clip) else { return };
        let shift = i64::from(anchor.first) - i64::from(node.at) + i64::from(node.entered)
            - i64::from(piece.from.0);
        let first = pair.leaves.partition_point(|cut| cut.shift() < shift);
        let leaves = pair.leaves[first..].iter().take_while(|cut| cut.shift() == shift);
        let fits = |cut: &&Cut| {
            cut.from >= node.must_show && cut.to <= piece.from.0 && self.usable(piece.clip, cut.id)
        };
        let cuts: Vec<Cut> = leaves.filter(fits).take(DIRECT_PER_NODE).copied().collect();
        for cut in cuts {
            let cost =
                node.cost + self.stretch_cost(&self.stretch_of(node, node.entered, cut.from));
            self.enter(idx, node, (piece.clip, cut), cost, rng);
        }
    }
}

/// About `n` of `all` in their order, every so-manieth from a random one on.
fn sample<'a, T: Copy>(
    all: &'a [T],
    n: usize,
    rng: &mut Pcg64Mcg,
) -> impl Iterator<Item = T> + use<'a, T> {
    let stride = (all.len() as f32 / n as f32).max(1.0);
    let first = rng.random_range(0.0..stride);
    (0..).map_while(move |nth| all.get((first + nth as f32 * stride) as usize).copied())
}
