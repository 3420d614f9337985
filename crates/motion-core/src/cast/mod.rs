//! Several characters: each with what is asked of it alone, together at shared hard poses, and out
//! of each other's way in between (AF02 figure 9; `docs/search.md`, Several characters).
//!
//! AF02 selects the poses, positions and orientations at which figures interact and finds each
//! figure's motion independently. Here only the poses, their frame and their places **relative to
//! each other** are given. Where in the world that is, is found: every character is searched on its
//! own for a number of rounds, then all hear of each other (an **exchange**): motions known so far
//! are put together in all ways, the least-squares place of each interaction in the best
//! combination is where everybody looks for it from then on, and one character after the other
//! keeps clear of where that combination has the others go. So the sum of all scores is brought
//! down in turns, over motions and over places.
//!
//! Exchanges happen in rounds that are fixed, so the outcome depends on the seed and the
//! number of rounds alone. A cast of one without interactions is exactly a [`Search`].
//!
//! [`Search`]: crate::search::Search

mod fit;
mod interaction;
mod laid;
mod nearness;
mod problem;
mod solution;
mod stage;
mod start;
mod track;
mod world;

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use interaction::{Interaction, Member};
pub use problem::{CastError, CastProblem, TOGETHER_SECS};
pub use solution::CastSolution;

use crate::cancel::CancelToken;
use crate::search::{Progress, SearchLibrary};
use world::World;

/// At first everybody hears of the others after so many rounds,
const EXCHANGE_EVERY: u64 = 8;
/// up to this round; from then on motions and places change little,
const OFTEN_UP_TO: u64 = 64;
/// and it is after so many.
const LATER_EVERY: u64 = 32;

/// Hypotheses of where interactions are have so many rounds to prove themselves; then the best goes
/// on, with what was found under the others.
const TRIAL_ROUNDS: u64 = 16;

/// The search of a cast under way. Stop calling [`Cast::step`] at any time; go on later.
#[derive(Clone, Debug)]
pub struct Cast {
    problem: CastProblem,
    /// Hypotheses, the best first. At least one.
    worlds: Vec<World>,
    round: u64,
    first_acceptable: Vec<Option<u64>>,
}

impl Cast {
    /// A search for `problem` on the library of each character. Nothing is computed yet.
    ///
    /// Equal seeds make equal searches; a character's own seed is `seed` plus its index.
    pub fn new(
        libraries: &[Arc<SearchLibrary>],
        problem: CastProblem,
        seed: u64,
    ) -> Result<Self, CastError> {
        let characters = problem.characters.len();
        if libraries.len() != characters || characters == 0 {
            return Err(CastError::Libraries { libraries: libraries.len(), characters });
        }
        problem.check()?;
        let frame_secs = libraries[0].clips().fps().frame_secs() as f32;
        let worlds = start::hypotheses(&problem, frame_secs)
            .into_iter()
            .map(|places| World::new(libraries, &problem, seed, places))
            .collect::<Result<_, _>>()?;
        Ok(Self { problem, worlds, round: 0, first_acceptable: vec![None; characters] })
    }

    /// One round: every character's search takes one, and in some rounds they hear of each other.
    /// Returns `false` if cancelled before the round was complete; searches that have done theirs
    /// then wait for the others.
    pub fn step(&mut self, cancel: &CancelToken) -> bool {
        let round = self.round + 1;
        if !self.worlds.iter_mut().all(|world| world.step(cancel, round)) {
            return false;
        }
        self.round = round;
        if is_exchange(round) {
            let mut scored: Vec<(f32, World)> = std::mem::take(&mut self.worlds)
                .into_iter()
                .map(|mut world| (world.exchange(&self.problem), world))
                .collect();
            scored.sort_by(|a, b| a.0.total_cmp(&b.0));
            self.worlds = scored.into_iter().map(|(_, world)| world).collect();
        }
        if round >= TRIAL_ROUNDS {
            let others = self.worlds.split_off(1);
            others.iter().for_each(|other| self.worlds[0].take_in(other));
        }
        for (first, search) in self.first_acceptable.iter_mut().zip(&self.worlds[0].searches) {
            if search.progress().first_acceptable.is_some() {
                first.get_or_insert(round);
            }
        }
        true
    }

    /// Rounds done.
    pub fn iteration(&self) -> u64 {
        self.round
    }

    /// Where each character's search stands.
    pub fn progress(&self) -> Vec<Progress> {
        let searches = self.worlds[0].searches.iter().zip(&self.first_acceptable);
        searches
            .map(|(search, &first_acceptable)| Progress { first_acceptable, ..search.progress() })
            .collect()
    }

    /// Motions that belong together, at most `n_max`, best first; in each, at least one motion is
    /// in none before it. Empty as long as somebody has no motion.
    pub fn alternatives(&self, n_max: usize) -> Vec<CastSolution> {
        solution::solutions(&self.worlds[0], &self.problem, n_max)
    }

    /// What is asked.
    pub fn problem(&self) -> &CastProblem {
        &self.problem
    }
}

/// Whether everybody hears of the others after this round.
fn is_exchange(round: u64) -> bool {
    round.is_multiple_of(if round <= OFTEN_UP_TO { EXCHANGE_EVERY } else { LATER_EVERY })
}
