//! Other searches of the same problem, to be compared with: the paper's, and a heuristic one.
//!
//! They share the library's tables, the score and the list of alternatives with the search proper,
//! so that a comparison is one of methods. They are chosen for a fresh search
//! ([`Search::of_kind`]); going on from known paths after a change is left to the search proper.

mod approach;
mod coarse;

pub(super) use approach::{Approach, Approaches};
pub(super) use coarse::CoarseGraph;

use std::sync::Arc;

use super::af02::Af02;
use super::astar::AStar;
use super::best::ScoreCounts;
use super::library::SearchLibrary;
use super::problem::{Problem, ProblemError};
use super::route::Route;
use super::target::Target;
use super::{Search, SearchKind};
use crate::cancel::CancelToken;

/// The state of another search.
#[derive(Clone, Debug)]
pub(super) enum Rival {
    Af02(Box<Af02>),
    AStar(Box<AStar>),
}

/// What a rival works on.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub(super) library: &'a SearchLibrary,
    pub(super) target: &'a Target,
    /// The clips that may be used, and whether bridges may be.
    pub(super) scope: (&'a [bool], bool),
    pub(super) seed: u64,
    /// The round, counted from 1.
    pub(super) round: u64,
}

/// What a rival's round has brought.
#[derive(Debug, Default)]
pub(super) struct Round {
    /// Paths under way.
    pub(super) under_way: Vec<Route>,
    /// Paths that are finished: local minima.
    pub(super) minima: Vec<Route>,
    pub(super) counts: ScoreCounts,
}

impl Search {
    /// A search of another kind; [`Search::new`] makes one of [`SearchKind::Gaitway`].
    pub fn of_kind(
        library: Arc<SearchLibrary>,
        problem: Problem,
        seed: u64,
        kind: SearchKind,
    ) -> Result<Self, ProblemError> {
        let mut search = Self::new(library, problem, seed)?;
        let bridges = search.problem.bridges;
        let scope = (search.problem.allowed_clips.as_slice(), bridges);
        let rival = match kind {
            SearchKind::Gaitway => None,
            SearchKind::Af02 => {
                let af02 = Af02::new(&search.library, &search.target, scope);
                Some(Rival::Af02(Box::new(af02)))
            }
            SearchKind::AStar => {
                let astar = AStar::new(&search.library, &search.target, scope);
                Some(Rival::AStar(Box::new(astar)))
            }
        };
        search.rival = rival;
        Ok(search)
    }

    /// A round of `rival`. Returns `false`, with nothing changed, if cancelled before it was complete.
    pub(super) fn step_rival(&mut self, mut rival: Rival, cancel: &CancelToken) -> bool {
        let round = self.progress.iteration + 1;
        let ground = Ground {
            library: &self.library,
            target: &self.target,
            scope: (self.problem.allowed_clips.as_slice(), self.problem.bridges),
            seed: self.seed,
            round,
        };
        let brought = match &mut rival {
            Rival::Af02(af02) => af02.step(ground, cancel),
            Rival::AStar(astar) => astar.step(ground, cancel),
        };
        self.rival = Some(rival);
        let Some(Round { under_way, minima, counts }) = brought else { return false };
        self.progress.iteration = round;
        self.progress.counts.add(counts);
        self.progress.n_minima += minima.len() as u64;
        for minimum in &minima {
            self.alternatives.offer(&self.library, minimum, round, None);
        }
        for route in minima.iter().chain(&under_way) {
            let better = self.best.as_ref().is_none_or(|(best, _)| route.score < best.score);
            if better {
                self.best = Some((route.clone(), round));
            }
        }
        self.progress.best = self.best.as_ref().map_or(f32::INFINITY, |(best, _)| best.score);
        self.progress.n_alternatives = self.alternatives.kept().len();
        if self.accepted.is_none() {
            let acceptable = minima.into_iter().chain(under_way).find(|r| self.is_acceptable(r));
            acceptable.into_iter().for_each(|route| self.note_accepted(route));
        }
        true
    }
}

#[cfg(test)]
mod tests;
