//! One character's search under a budget, with the clock that the core must not have.

use std::sync::Arc;
use std::time::Instant;

use motion_core::cancel::CancelToken;
use motion_core::path::Path;
use motion_core::score::Judgement;
use motion_core::search::{Problem, ProblemError, Progress, Search, SearchKind, SearchLibrary};

use crate::budget::{Budget, with_deadline};

/// What a search has found and how it got there.
#[derive(Clone, Debug)]
pub struct Found {
    /// Distinct motions, best first.
    pub alternatives: Vec<Alternative>,
    /// Where the search stood at its end.
    pub progress: Progress,
    /// Seconds until a path first met every wish within tolerance.
    pub first_acceptable_s: Option<f64>,
    /// Rounds in which the best score fell or an alternative was added.
    pub trace: Vec<TracePoint>,
    /// Seconds in all.
    pub seconds: f64,
}

/// A motion that was found, not yet assembled.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// How it is cut together.
    pub path: Path,
    /// How well it meets the wishes before correction.
    pub judgement: Judgement,
    /// The round that found it.
    pub iteration: u64,
    /// When that round ended, seconds from the start.
    pub found_at_s: f64,
}

/// A moment of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracePoint {
    /// Seconds from the start.
    pub s: f64,
    /// Rounds done.
    pub iteration: u64,
    /// The best score so far.
    pub best: f32,
    /// Distinct alternatives so far.
    pub n_alternatives: usize,
}

/// A search to be run.
#[derive(Clone, Debug)]
pub struct SolveRequest {
    /// Where the clips come from.
    pub library: Arc<SearchLibrary>,
    /// What is asked.
    pub problem: Problem,
    /// Start of all chance.
    pub seed: u64,
    /// Which search is used.
    pub kind: SearchKind,
    /// When to end.
    pub budget: Budget,
    /// At most so many alternatives.
    pub n_alternatives: usize,
}

/// Searches until the budget is used up or `cancel` is raised; what was found until then counts
/// in both cases. `on_progress` hears the share of the budget that is used up.
pub fn solve(
    request: SolveRequest,
    cancel: &CancelToken,
    on_progress: &mut dyn FnMut(f64, Progress),
) -> Result<Found, ProblemError> {
    let SolveRequest { library, problem, seed, kind, budget, n_alternatives } = request;
    let start = Instant::now();
    let mut search = Search::of_kind(library, problem, seed, kind)?;
    let limit = match budget {
        Budget::Time(limit) => Some(limit),
        Budget::Iterations(_) => None,
    };
    let mut round_ends_s = Vec::new();
    let mut trace: Vec<TracePoint> = Vec::new();
    let mut first_acceptable_s = None;
    with_deadline(cancel, limit, |deadline| {
        // The first round is not cut short by the clock: some motion is better than none.
        let mut token = cancel;
        while search.step(token) {
            token = deadline;
            let s = start.elapsed().as_secs_f64();
            round_ends_s.push(s);
            let progress = search.progress();
            if progress.first_acceptable.is_some() {
                first_acceptable_s.get_or_insert(s);
            }
            let Progress { iteration, best, n_alternatives, .. } = progress;
            let news = trace
                .last()
                .is_none_or(|last| best < last.best || n_alternatives != last.n_alternatives);
            if news && best.is_finite() {
                trace.push(TracePoint { s, iteration, best, n_alternatives });
            }
            let share = match budget {
                Budget::Iterations(n) => iteration as f64 / n as f64,
                Budget::Time(limit) => s / limit.as_secs_f64(),
            };
            on_progress(share, progress);
            if matches!(budget, Budget::Iterations(n) if iteration >= n) {
                break;
            }
        }
    });
    let mut alternatives = Vec::new();
    for solution in search.alternatives() {
        if alternatives.len() == n_alternatives {
            break;
        }
        let Some(judgement) = search.judge(&solution.path) else { continue };
        let round = usize::try_from(solution.iteration.saturating_sub(1)).unwrap_or(usize::MAX);
        alternatives.push(Alternative {
            path: solution.path,
            judgement,
            iteration: solution.iteration,
            found_at_s: round_ends_s.get(round).copied().unwrap_or_default(),
        });
    }
    Ok(Found {
        alternatives,
        progress: search.progress(),
        first_acceptable_s,
        trace,
        seconds: start.elapsed().as_secs_f64(),
    })
}
