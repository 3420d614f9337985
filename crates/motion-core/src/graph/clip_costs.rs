//! The least cost of a cut between clips: which pairs of clips bridges are looked for in.

use std::sync::atomic::{AtomicU32, Ordering};

use super::components::Connectivity;
use crate::cancel::{CancelToken, Cancelled};
use crate::ids::ClipId;
use crate::similarity::FeatureSet;
use crate::similarity::sampled_nearest::nearest_in_clips;

/// Frames that are compared with all others where there are too many to compare all.
const N_SAMPLES: usize = 8192;

/// Least costs between clips, of all pairs of clips or of those in which one is not in the main
/// part.
#[derive(Clone, Debug)]
pub(super) struct ClipCosts {
    n_clips: usize,
    /// For each clip the row of its costs; `None` for a clip without one.
    row_of_clip: Vec<Option<u32>>,
    /// `costs[row · n_clips + other]`; `∞` where there is no cut.
    costs: Vec<f32>,
    /// Parts that each part is linked with, beside the main one.
    pub(super) nearest_parts: usize,
}

impl ClipCosts {
    /// Of all pairs of `n_clips` clips: `costs[a · n_clips + b]`, symmetric.
    pub(super) fn of_all(n_clips: usize, costs: Vec<f32>) -> Self {
        let row_of_clip = (0..n_clips as u32).map(Some).collect();
        Self { n_clips, row_of_clip, costs, nearest_parts: 24 }
    }

    /// Of clips outside the main part with all clips, from a sample of their frames: every clip
    /// has the same number of them, evenly spread.
    pub(super) fn of_some(
        features: &FeatureSet,
        connectivity: &Connectivity,
        cancel: &CancelToken,
    ) -> Result<Self, Cancelled> {
        let n_clips = features.frame_starts.len() - 1;
        let asked: Vec<usize> =
            (0..n_clips).filter(|&clip| connectivity.part_of_clip[clip] != 0).collect();
        let mut row_of_clip = vec![None; n_clips];
        for (row, &clip) in asked.iter().enumerate() {
            row_of_clip[clip] = Some(row as u32);
        }
        let per_clip = (N_SAMPLES / asked.len().max(1)).clamp(2, 32);
        let mut rows = Vec::new();
        let mut clip_rows = Vec::new();
        for (row, &clip) in asked.iter().enumerate() {
            let (start, end) = (features.frame_starts[clip], features.frame_starts[clip + 1]);
            let n = per_clip.min(end - start);
            rows.extend((0..n).map(|nth| start + (2 * nth + 1) * (end - start) / (2 * n)));
            clip_rows.resize(rows.len(), row);
        }
        let costs: Vec<AtomicU32> =
            (0..asked.len() * n_clips).map(|_| AtomicU32::new(f32::INFINITY.to_bits())).collect();
        let families = &features.families;
        // Copies of one hand are nearest where they show the same moment, which is no cut.
        let wants = |a: ClipId, b: ClipId| families.hand(a) != families.hand(b);
        nearest_in_clips(
            features,
            &rows,
            &wants,
            &|found| {
                let slot = clip_rows[found.nth] * n_clips + found.clip.idx();
                costs[slot].fetch_min(found.cost.to_bits(), Ordering::Relaxed);
            },
            cancel,
            &|_| (),
        )?;
        let costs = costs.into_iter().map(|bits| f32::from_bits(bits.into_inner())).collect();
        Ok(Self { n_clips, row_of_clip, costs, nearest_parts: 3 })
    }

    /// The least cost between two clips, `∞` where none is known.
    pub(super) fn between(&self, a: usize, b: usize) -> f32 {
        let from = |a: usize, b: usize| {
            let row = self.row_of_clip[a].map(|row| row as usize * self.n_clips);
            row.map_or(f32::INFINITY, |row| self.costs[row + b])
        };
        from(a, b).min(from(b, a))
    }
}
