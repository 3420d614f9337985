//! Anytime weighted A* over the coarse graph, after Safonova & Hodgins 2007 (*Construction and Optimal
//! Search of Interpolated Motion Graphs*): a strong rival of the randomized search.
//!
//! A state is a clip, its frame, a place on the ground and a time, the last three rounded. The order in
//! which states are looked into is `g + w · h`: `g` is what has been shown (cuts, and everything that is
//! read on the way), `h` what is expected of the rest (`expectation`). Each **lane** begins with a high
//! weight `w`, which finds some motion soon, and lowers it from one search to the next. As in Richter,
//! Thayer & Ruml 2010 (*The Joy of Forgetting*), a search with a new weight begins anew rather than with
//! the old open list, here from other random first frames too.
//!
//! What it finds is coarse. So it is then taken downhill by the same mutations as ours, to a local
//! minimum, which is recorded: the comparison is one of where good starts come from.

mod expectation;
mod frontier;

use rayon::prelude::*;

use super::best::ScoreCounts;
use super::library::SearchLibrary;
use super::line::descend;
use super::rivals::{Approaches, CoarseGraph, Ground, Round};
use super::rng::stream;
use super::route::Route;
use super::target::Target;
use crate::cancel::CancelToken;
use expectation::Expectation;
use frontier::{Frontier, Outcome};

/// Searches side by side.
const N_LANES: u64 = 8;

/// Weights of a lane's searches, one after the other, over and over.
const WEIGHTS: [f32; 4] = [8.0, 4.0, 2.0, 1.0];

/// States that a lane looks into in a round.
const N_EXPANDED: usize = 128;

/// What the search knows beforehand.
#[derive(Clone, Debug)]
struct Ways {
    graph: CoarseGraph,
    approaches: Approaches,
    expectation: Expectation,
}

/// A* searches side by side.
#[derive(Clone, Debug)]
pub(super) struct AStar {
    ways: Ways,
    lanes: Vec<Lane>,
}

#[derive(Clone, Debug)]
struct Lane {
    number: u64,
    /// Searches done.
    n_done: usize,
    state: State,
}

#[derive(Clone, Debug)]
enum State {
    Idle,
    Searching(Box<Frontier>),
    Descending(Route),
}

impl AStar {
    pub(super) fn new(library: &SearchLibrary, target: &Target, scope: (&[bool], bool)) -> Self {
        let graph = CoarseGraph::of_chosen(library, scope);
        let approaches = Approaches::new(library, &graph, target);
        let expectation = Expectation::new(library, &graph, target);
        let ways = Ways { graph, approaches, expectation };
        let lane = |number| Lane { number, n_done: 0, state: State::Idle };
        Self { ways, lanes: (0..N_LANES).map(lane).collect() }
    }

    /// A round; `None`, with nothing changed, if cancelled before it began.
    pub(super) fn step(&mut self, ground: Ground<'_>, cancel: &CancelToken) -> Option<Round> {
        if cancel.is_cancelled() {
            return None;
        }
        let ways = &self.ways;
        let stepped: Vec<(Option<Route>, ScoreCounts)> =
            self.lanes.par_iter_mut().with_max_len(1).map(|lane| lane.step(ways, ground)).collect();
        let mut round = Round::default();
        for (lane, (minimum, counts)) in self.lanes.iter().zip(stepped) {
            round.counts.add(counts);
            round.minima.extend(minimum);
            if let State::Descending(route) = &lane.state {
                round.under_way.push(route.clone());
            }
        }
        Some(round)
    }
}

impl Lane {
    /// Goes on; gives the local minimum that it has reached.
    fn step(&mut self, ways: &Ways, ground: Ground<'_>) -> (Option<Route>, ScoreCounts) {
        let Ground { library, target, scope, .. } = ground;
        let mut counts = ScoreCounts::default();
        let mut minimum = None;
        if let State::Idle = self.state {
            let mut rng = stream(ground.seed, ground.round, self.number);
            let weight = WEIGHTS[self.n_done % WEIGHTS.len()];
            let frontier = Frontier::new(ways, ground, (weight, self.n_done), &mut rng);
            self.n_done += 1;
            self.state = State::Searching(Box::new(frontier));
        }
        match &mut self.state {
            State::Idle => {}
            State::Searching(frontier) => {
                let outcome = frontier.expand(ways, ground, N_EXPANDED);
                counts.scored += frontier.take_n_scored();
                match outcome {
                    Outcome::Open => {}
                    Outcome::Failed => self.state = State::Idle,
                    Outcome::Found(path) => {
                        let route = Route::new(library, target, path);
                        self.state = route.map_or(State::Idle, State::Descending);
                    }
                }
            }
            State::Descending(route) => {
                let mut rng = stream(ground.seed, ground.round, self.number);
                let limit = f32::INFINITY;
                let next = descend(library, target, scope, route, limit, &mut rng, &mut counts);
                match next {
                    Some(next) => *route = next,
                    None => {
                        minimum = Some(route.clone());
                        self.state = State::Idle;
                    }
                }
            }
        }
        (minimum, counts)
    }
}
