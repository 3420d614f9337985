//! Searches of all characters that agree on where their interactions are.

use std::sync::Arc;

use rayon::prelude::*;

use super::laid::Laid;
use super::problem::{CastError, CastProblem};
use super::stage::Stage;
use crate::cancel::CancelToken;
use crate::planar::PlanarTransform;
use crate::search::{Search, SearchLibrary};

/// Motions of each character that are looked at in an exchange.
const N_LOOKED_AT: usize = 8;
/// An interaction that would move less stays, metres and radians: searches need not begin anew.
const STAYS_M: f32 = 0.01;
const STAYS_RAD: f32 = 0.01;

/// One hypothesis of where interactions are, and what was found under it.
#[derive(Clone, Debug)]
pub(super) struct World {
    pub(super) searches: Vec<Search>,
    places: Vec<PlanarTransform>,
    n_exchanges: usize,
}

impl World {
    pub(super) fn new(
        libraries: &[Arc<SearchLibrary>],
        problem: &CastProblem,
        seed: u64,
        places: Vec<PlanarTransform>,
    ) -> Result<Self, CastError> {
        let search = |(character, library): (usize, &Arc<SearchLibrary>)| {
            let asked = problem.of_character(character, Some(&places), Vec::new());
            let seed = seed.wrapping_add(character as u64);
            Search::new(Arc::clone(library), asked, seed)
                .map_err(|error| CastError::Character { character, error })
        };
        let searches = libraries.iter().enumerate().map(search).collect::<Result<_, _>>()?;
        Ok(Self { searches, places, n_exchanges: 0 })
    }

    /// Brings every search to round `round`; those that are there already wait. Returns `false` if
    /// cancelled before.
    pub(super) fn step(&mut self, cancel: &CancelToken, round: u64) -> bool {
        let stepped = self
            .searches
            .par_iter_mut()
            .map(|search| search.progress().iteration >= round || search.step(cancel));
        // Not `all`: whether one is stepped must not depend on another.
        stepped.filter(|done| !done).count() == 0
    }

    /// The `n_max` best motions of every character, to be put together.
    pub(super) fn stage<'a>(&'a self, problem: &'a CastProblem, n_max: usize) -> Stage<'a> {
        let laid_of = |(character, search): (usize, &Search)| -> Vec<Laid> {
            let alone = problem.of_character(character, None, Vec::new());
            let solutions = search.alternatives().into_iter().take(n_max);
            solutions
                .filter_map(|found| {
                    Laid::new(search.library(), &alone, found.path, found.iteration)
                })
                .collect()
        };
        let laid = self.searches.par_iter().enumerate().map(laid_of).collect();
        Stage::new(problem, laid, &self.places, self.frame_secs())
    }

    /// Everybody hears of the others: interactions are where the best combination has them, and one
    /// character, each in its turn, keeps clear of where that has the others go. Were it all at
    /// once, two who meet would step aside together and back again together. Returns the best
    /// combination's score.
    pub(super) fn exchange(&mut self, problem: &CastProblem) -> f32 {
        if problem.characters.len() == 1 && problem.interactions.is_empty() {
            return self.searches[0].progress().best;
        }
        self.n_exchanges += 1;
        let in_turn = self.n_exchanges % self.searches.len();
        let stage = self.stage(problem, N_LOOKED_AT);
        let everybody: Vec<usize> = (0..self.searches.len()).collect();
        let Some(best) = stage.combinations(&everybody).into_iter().next() else {
            return f32::INFINITY;
        };
        let moved = self.places.iter().zip(&best.places);
        let moved: Vec<PlanarTransform> =
            moved.map(|(&old, &new)| if stays(old, new) { old } else { new }).collect();
        let mut searches = Vec::with_capacity(self.searches.len());
        for (character, search) in self.searches.iter().enumerate() {
            let n_own = problem.characters[character].wishes.others.len();
            let others = if character == in_turn {
                stage.others_of(&best, character)
            } else {
                search.problem().wishes.others[n_own..].to_vec()
            };
            let asked = problem.of_character(character, Some(&moved), others);
            let same = asked == *search.problem();
            // What is asked was checked when the search began; places and tracks are finite.
            let next = (!same).then(|| search.rescored(asked, &[]).ok()).flatten();
            searches.push(next);
        }
        for (search, next) in self.searches.iter_mut().zip(searches) {
            if let Some(next) = next {
                *search = next;
            }
        }
        self.places = moved;
        best.score
    }

    /// Takes in what was found elsewhere.
    pub(super) fn take_in(&mut self, other: &Self) {
        for (search, other) in self.searches.iter_mut().zip(&other.searches) {
            let next = search.rescored(search.problem().clone(), &other.paths());
            if let Ok(next) = next {
                *search = next;
            }
        }
    }

    fn frame_secs(&self) -> f32 {
        frame_secs(&self.searches[0])
    }
}

/// Seconds of a frame of what a search makes.
fn frame_secs(search: &Search) -> f32 {
    search.library().clips().fps().frame_secs() as f32
}

fn stays(old: PlanarTransform, new: PlanarTransform) -> bool {
    let turn = old.inverse() * new;
    old.ground_m().distance(new.ground_m()) < STAYS_M && turn.heading_rad().abs() < STAYS_RAD
}
