//! The best few candidates of a scan, and how many were looked at.

use super::mutation::{Mutation, StructureKey};
use crate::graph::Forest;

/// How many candidates were looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScoreCounts {
    /// Candidates whose whole score was computed.
    pub scored: u64,
    /// Candidates shown to be no better by a part of their score.
    pub pruned: u64,
}

impl ScoreCounts {
    pub(crate) fn add(&mut self, other: Self) {
        self.scored += other.scored;
        self.pruned += other.pruned;
    }
}

/// A mutation and the score that it leads to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) mutation: Mutation,
    pub(crate) score: f32,
}

/// The best few candidates, one per structure.
#[derive(Clone, Debug)]
pub(crate) struct Best {
    kept: Vec<(StructureKey, Candidate)>,
    n_max: usize,
    ceiling: f32,
    least: f32,
}

impl Best {
    pub(crate) fn new(n_max: usize, ceiling: f32) -> Self {
        Self { kept: Vec::with_capacity(n_max + 1), n_max, ceiling, least: f32::INFINITY }
    }

    /// Remembers the least score alone, so that no candidate is ever dropped for being no better.
    pub(crate) fn of_all() -> Self {
        Self::new(0, f32::INFINITY)
    }

    /// Candidates that do not score below this are of no interest.
    #[inline]
    pub(crate) fn limit(&self) -> f32 {
        if self.kept.len() < self.n_max {
            return self.ceiling;
        }
        self.kept.last().map_or(self.ceiling, |(_, c)| c.score)
    }

    pub(super) fn offer(&mut self, forest: &Forest, candidate: Candidate) {
        self.least = self.least.min(candidate.score);
        if self.n_max == 0 {
            return;
        }
        let key = candidate.mutation.structure(forest);
        if let Some(same) = self.kept.iter().position(|(k, _)| *k == key) {
            if self.kept[same].1.score <= candidate.score {
                return;
            }
            self.kept.remove(same);
        }
        let at = self.kept.partition_point(|(_, c)| c.score <= candidate.score);
        self.kept.insert(at, (key, candidate));
        self.kept.truncate(self.n_max);
    }

    /// The best score offered.
    pub(crate) fn least(&self) -> Option<f32> {
        self.least.is_finite().then_some(self.least)
    }

    /// The candidates, best first.
    pub(crate) fn candidates(&self) -> impl Iterator<Item = Candidate> + '_ {
        self.kept.iter().map(|(_, c)| *c)
    }
}
