//! Suggestions after a search under a budget.

use std::sync::Arc;
use std::time::Instant;

use motion_core::cancel::CancelToken;
use motion_core::path::Path;
use motion_core::search::{Search, SearchLibrary};

use super::{Case, Effort, Ground, Suggester, Suggestion};
use crate::budget::Budget;
use crate::problem::CharacterProblem;
use crate::solve_job::Found;

/// Of a budget of time so much is spent on suggestions at most, beside the search's own.
const TIME_SHARE: f64 = 0.15;
/// Of a budget of rounds each change is tried with this share of rounds, within [`ROUNDS`].
const ROUNDS_SHARE: u64 = 16;
/// Fewest and most rounds that a change is tried with.
const ROUNDS: (u64, u64) = (3, 12);

/// The smallest changes with which what `found` misses would be met; none where it misses nothing.
/// The outcome depends on the arguments alone where the budget is in rounds.
pub(crate) fn suggest(
    ground: &Ground<'_>,
    asked: &CharacterProblem,
    (library, seed): (&Arc<SearchLibrary>, u64),
    found: &Found,
    budget: Budget,
    cancel: &CancelToken,
) -> Vec<Suggestion> {
    let Some(best) = found.alternatives.first() else { return Vec::new() };
    let of = (ground.document, ground.character);
    let case = Case::new(of, asked, ground.library, &best.path, &best.judgement);
    let Some(case) = case else { return Vec::new() };
    let mut suggester = Suggester::new(&case);
    let paths: Vec<Path> = found.alternatives.iter().map(|known| known.path.clone()).collect();
    let problem = asked.problem.clone();
    let search = Search::with_paths(Arc::clone(library), problem, seed, &paths);
    let Ok(search) = search else { return Vec::new() };
    let start = Instant::now();
    while suggester.n_waiting() > 0 && !cancel.is_cancelled() {
        let effort = match budget {
            Budget::Iterations(n) => Effort::Rounds((n / ROUNDS_SHARE).clamp(ROUNDS.0, ROUNDS.1)),
            Budget::Time(all) => {
                let left = all.mul_f64(TIME_SHARE).saturating_sub(start.elapsed());
                if left.is_zero() {
                    break;
                }
                Effort::Time(left / suggester.n_waiting() as u32)
            }
        };
        suggester.try_next(ground, &search, effort, cancel);
    }
    suggester.suggestions()
}
