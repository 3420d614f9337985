//! The costs between all frames as a surface over pairs of frames: which of them are its minima.

use super::features::FeatureSet;
use super::rough_cost::{rough_cost, rounding};
use crate::ids::ClipId;

/// The surface of a set of frames.
pub(super) struct Surface<'a> {
    features: &'a FeatureSet,
    min_jump: u32,
    clip_of_row: Vec<u32>,
    rounding: f32,
}

impl<'a> Surface<'a> {
    /// The surface; what shows the same moment within `min_jump` frames is no part of it.
    pub(super) fn new(features: &'a FeatureSet, min_jump: u32) -> Self {
        let mut clip_of_row = Vec::with_capacity(features.n_rows());
        for (clip, bounds) in features.frame_starts.windows(2).enumerate() {
            clip_of_row.resize(bounds[1], clip as u32);
        }
        Self { features, min_jump, clip_of_row, rounding: rounding(features.n_dims) }
    }

    /// Whether two rows show the same moment, so that there is no cut between them.
    #[inline]
    pub(super) fn is_same_moment(&self, a: u32, b: u32) -> bool {
        let clips = [a, b].map(|row| ClipId(self.clip_of_row[row as usize]));
        let families = &self.features.families;
        if families.hand(clips[0]) != families.hand(clips[1]) {
            return false;
        }
        let frame = |row: u32, clip: ClipId| row - self.features.frame_starts[clip.idx()] as u32;
        let [a, b] = [(clips[0], frame(a, clips[0])), (clips[1], frame(b, clips[1]))];
        families.is_same_moment(a, b, self.min_jump)
    }

    /// The row `by` frames on in the same clip.
    #[inline]
    fn beside(&self, row: u32, by: i32) -> Option<u32> {
        let other = row.checked_add_signed(by)?;
        let clip = self.clip_of_row.get(other as usize)?;
        (*clip == self.clip_of_row[row as usize]).then_some(other)
    }

    /// The f32 cost between two rows, and how far it may lie from the true one.
    #[inline]
    fn rough_cost(&self, a: u32, b: u32) -> (f32, f32) {
        let cost = rough_cost(self.features.row(a as usize), self.features.row(b as usize));
        (cost, self.rounding * cost)
    }

    /// Whether neither neighbour along both clips is surely cheaper than `cost`, which is right to
    /// within `slack`. Most pairs of frames are no minima because of one of these two.
    #[inline]
    pub(super) fn is_below_diagonal(&self, a: u32, b: u32, cost: f32, slack: f32) -> bool {
        [1, -1].into_iter().all(|by| {
            let (Some(x), Some(y)) = (self.beside(a, by), self.beside(b, by)) else { return true };
            let (rough, own_slack) = self.rough_cost(x, y);
            rough + own_slack + slack >= cost || self.is_same_moment(x, y)
        })
    }

    /// Whether none of the eight edges beside that between two rows, which costs `cost`, is
    /// cheaper.
    pub(super) fn is_minimum(&self, a: u32, b: u32, cost: f64) -> bool {
        const AROUND: [(i32, i32); 8] =
            [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)];
        AROUND.into_iter().all(|(by_a, by_b)| {
            let (Some(x), Some(y)) = (self.beside(a, by_a), self.beside(b, by_b)) else {
                return true;
            };
            let (rough, slack) = self.rough_cost(x, y);
            let is_cheaper = if (rough - cost as f32).abs() <= slack {
                self.features.cost(x as usize, y as usize) < cost
            } else {
                rough < cost as f32
            };
            !is_cheaper || self.is_same_moment(x, y)
        })
    }
}
