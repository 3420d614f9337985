//! The search of Arikan & Forsyth 2002, section 4.2, as the paper has it.
//!
//! 1. Random valid seed paths in the coarsest graph G′.
//! 2. Every path and every possible mutation of it is scored: all edges between two edges of the path
//!    deleted and the pieces reconnected by one or two edges of G′ (`reconnect`), or two edges at once
//!    replaced by children of theirs ([`Evaluator::refine`]).
//! 3. Of the mutations of a path the best few are laid out, and the best takes the path's place.
//! 4. A path that no mutation improves is a local minimum: it is recorded.
//! 5. A few new seeds join in every round.
//!
//! Where the paper leaves a choice, the one that serves it better is taken: seeds have the wished
//! length from the start, and the first and last frames, which there are those of a first and a last
//! edge, may be any. Scores are computed from the same tables as ours.

mod reconnect;
mod seed;

use rayon::prelude::*;

use super::best::{Best, ScoreCounts};
use super::evaluate::Evaluator;
use super::library::SearchLibrary;
use super::rivals::{Approaches, CoarseGraph, Ground, Round};
use super::rng::stream;
use super::route::Route;
use super::tables::Tables;
use super::target::Target;
use crate::cancel::CancelToken;

/// Paths that the search begins with, n in the paper, which does not say how many. Few, so that the
/// first local minima come soon.
const N_PATHS: usize = 4;

/// New seeds of every round beside those that take the places of recorded minima.
const N_NEW_SEEDS: usize = 1;

/// With so many paths no more seeds join.
const MAX_PATHS: usize = 8;

/// Seeds drawn for each that joins, the best: they cost next to nothing beside mutations.
const N_DRAWN: usize = 16;

/// Mutations that are laid out: the best few.
const N_BEST: usize = 4;

/// A mutation that gains less than this share is none.
const LEAST_GAIN: f32 = 1e-4;

/// Draws for one seed before it is given up for the round.
const N_TRIES: usize = 64;

/// The paths of the paper's search.
#[derive(Clone, Debug)]
pub(super) struct Af02 {
    graph: CoarseGraph,
    approaches: Approaches,
    paths: Vec<Route>,
}

/// What became of a path.
enum Outcome {
    Better(Route),
    Minimum,
}

impl Af02 {
    pub(super) fn new(library: &SearchLibrary, target: &Target, scope: (&[bool], bool)) -> Self {
        let graph = CoarseGraph::of_roots(library, scope);
        let approaches = Approaches::new(library, &graph, target);
        Self { graph, approaches, paths: Vec::new() }
    }

    /// A round; `None`, with nothing changed, if cancelled before it was complete.
    pub(super) fn step(&mut self, ground: Ground<'_>, cancel: &CancelToken) -> Option<Round> {
        let n_seeds = N_PATHS.saturating_sub(self.paths.len()).max(N_NEW_SEEDS);
        let n_seeds = n_seeds.min(MAX_PATHS.saturating_sub(self.paths.len()));
        let mut seeds: Vec<Route> = (0..n_seeds * N_DRAWN)
            .into_par_iter()
            .with_max_len(1)
            .filter_map(|nth| {
                let mut rng = stream(ground.seed, ground.round, nth as u64);
                (0..N_TRIES).find_map(|_| {
                    if cancel.is_cancelled() {
                        return None;
                    }
                    seed::grow(&self.graph, &self.approaches, ground, &mut rng)
                })
            })
            .collect();
        seeds.sort_by(|a, b| a.score.total_cmp(&b.score));
        seeds.truncate(n_seeds);
        let all: Vec<&Route> = self.paths.iter().chain(&seeds).collect();
        let outcomes: Vec<Option<(Outcome, ScoreCounts)>> = all
            .par_iter()
            .with_max_len(1)
            .map(|route| (!cancel.is_cancelled()).then(|| self.improve(ground, route)))
            .collect();
        if cancel.is_cancelled() {
            return None;
        }
        let mut round = Round::default();
        for (route, outcome) in all.into_iter().zip(outcomes) {
            let (outcome, counts) = outcome?;
            round.counts.add(counts);
            match outcome {
                Outcome::Minimum => round.minima.push(route.clone()),
                // Paths that have met go on as one.
                Outcome::Better(new) if round.under_way.iter().any(|r| r.path == new.path) => {}
                Outcome::Better(new) => round.under_way.push(new),
            }
        }
        self.paths.clone_from(&round.under_way);
        Some(round)
    }

    /// The best of all mutations of a path.
    fn improve(&self, ground: Ground<'_>, route: &Route) -> (Outcome, ScoreCounts) {
        let Ground { library, target, scope, .. } = ground;
        let tables = Tables::new(library, target, route);
        let ceiling = route.score - LEAST_GAIN * route.score.abs().max(1e-3);
        let best = Best::new(N_BEST, ceiling);
        let mut evaluator = Evaluator::new(library, target, scope, route, &tables, best);
        evaluator.reconnect_coarse(&self.graph);
        evaluator.refine();
        evaluator.move_ends();
        let forest = &library.graph().forest;
        let laid_out = evaluator
            .best
            .candidates()
            .filter_map(|c| Route::new(library, target, c.mutation.apply(&route.path, forest)));
        let better = laid_out
            .filter(|new| new.score < ceiling)
            .min_by(|a, b| a.score.total_cmp(&b.score))
            .map_or(Outcome::Minimum, Outcome::Better);
        (better, evaluator.counts)
    }
}
