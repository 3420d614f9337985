//! All characters' search under a budget, with the clock that the core must not have.

use std::sync::Arc;
use std::time::Instant;

use motion_core::cancel::CancelToken;
use motion_core::cast::{Cast, CastError, CastProblem, CastSolution};
use motion_core::planar::PlanarTransform;
use motion_core::search::{Problem, Progress, SearchLibrary};

use crate::budget::{Budget, with_deadline};
use crate::solve_job::{Alternative, Found, TracePoint};

/// A search of a cast to be run.
#[derive(Clone, Debug)]
pub struct CastRequest {
    /// Where each character's clips come from.
    pub libraries: Vec<Arc<SearchLibrary>>,
    /// What is asked.
    pub problem: CastProblem,
    /// Start of all chance.
    pub seed: u64,
    /// When to end: rounds of each character, or the time of all together.
    pub budget: Budget,
    /// At most so many alternatives.
    pub n_alternatives: usize,
}

/// What was found for a cast.
#[derive(Clone, Debug, Default)]
pub struct CastFound {
    /// What was found for each character; motions of one rank belong together.
    pub characters: Vec<Found>,
    /// Each rank's motions together.
    pub together: Vec<Together>,
    /// Seconds in all.
    pub seconds: f64,
}

/// Motions of one rank together.
#[derive(Clone, Debug)]
pub struct Together {
    /// The sum of their scores.
    pub score: f32,
    /// What each character's motion is judged by and corrected onto.
    pub problems: Vec<Problem>,
    /// Where each interaction is: `world_from_interaction`.
    pub places: Vec<PlanarTransform>,
}

/// What is noted of one character while it goes on.
#[derive(Default)]
struct Noted {
    trace: Vec<TracePoint>,
    first_acceptable_s: Option<f64>,
}

impl Noted {
    fn note(&mut self, progress: &Progress, s: f64) {
        let Progress { iteration, best, n_alternatives, first_acceptable, .. } = *progress;
        if first_acceptable.is_some() {
            self.first_acceptable_s.get_or_insert(s);
        }
        // After the characters have heard of each other, the best may score worse than before.
        let news = self
            .trace
            .last()
            .is_none_or(|last| best != last.best || n_alternatives != last.n_alternatives);
        if news && best.is_finite() {
            self.trace.push(TracePoint { s, iteration, best, n_alternatives });
        }
    }
}

/// Searches until the budget is used up or `cancel` is raised; what was found until then counts
/// in both cases. `on_progress` hears the share of the budget that is used up.
pub fn solve_cast(
    request: CastRequest,
    cancel: &CancelToken,
    on_progress: &mut dyn FnMut(f64),
) -> Result<CastFound, CastError> {
    let CastRequest { libraries, problem, seed, budget, n_alternatives } = request;
    let start = Instant::now();
    let mut cast = Cast::new(&libraries, problem, seed)?;
    let limit = match budget {
        Budget::Time(limit) => Some(limit),
        Budget::Iterations(_) => None,
    };
    let mut round_ends_s = Vec::new();
    let mut noted: Vec<Noted> = libraries.iter().map(|_| Noted::default()).collect();
    with_deadline(cancel, limit, |deadline| {
        // The first round is not cut short by the clock: some motion is better than none.
        let mut token = cancel;
        while cast.step(token) {
            token = deadline;
            let s = start.elapsed().as_secs_f64();
            round_ends_s.push(s);
            for (noted, progress) in noted.iter_mut().zip(cast.progress()) {
                noted.note(&progress, s);
            }
            let share = match budget {
                Budget::Iterations(n) => cast.iteration() as f64 / n as f64,
                Budget::Time(limit) => s / limit.as_secs_f64(),
            };
            on_progress(share);
            if matches!(budget, Budget::Iterations(n) if cast.iteration() >= n) {
                break;
            }
        }
    });
    let solutions = cast.alternatives(n_alternatives);
    let seconds = start.elapsed().as_secs_f64();
    let characters = noted.into_iter().zip(cast.progress()).enumerate();
    let characters = characters.map(|(nth, (noted, progress))| Found {
        alternatives: solutions.iter().map(|s| alternative(s, nth, &round_ends_s)).collect(),
        progress,
        first_acceptable_s: noted.first_acceptable_s,
        trace: noted.trace,
        seconds,
    });
    let characters = characters.collect();
    let together = solutions.into_iter().map(|solution| Together {
        score: solution.score,
        problems: solution.problems,
        places: solution.places,
    });
    Ok(CastFound { characters, together: together.collect(), seconds })
}

fn alternative(solution: &CastSolution, character: usize, round_ends_s: &[f64]) -> Alternative {
    let iteration = solution.iterations[character];
    let round = usize::try_from(iteration.saturating_sub(1)).unwrap_or(usize::MAX);
    Alternative {
        path: solution.paths[character].clone(),
        judgement: solution.judgements[character].clone(),
        iteration,
        found_at_s: round_ends_s.get(round).copied().unwrap_or_default(),
    }
}
