//! All joint mutations of one path, none of them bounded: what the speed of scoring is measured on.

use super::Search;
use super::best::{Best, ScoreCounts};
use super::evaluate::Evaluator;
use super::route::Route;
use super::tables::Tables;
use crate::path::Path;

/// What scoring every reconnection and detour of a path has shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbourhood {
    /// Candidates whose whole score was computed; left out are those that are no motion at all
    /// (too short for a checkpoint, or of another length than an exact one).
    pub counts: ScoreCounts,
    /// The best score among them; infinite where there is none.
    pub least: f32,
}

impl Search {
    /// Scores every reconnection and every detour of `path`, with no limit under which a candidate
    /// is dropped, on the calling thread. `None` for a path that is not valid for the problem.
    ///
    /// It is the search's own code on the search's own tables, so candidates per second are what
    /// a line reaches that can bound nothing. Searching itself bounds most candidates.
    pub fn score_neighbourhood(&self, path: &Path) -> Option<Neighbourhood> {
        let (library, target) = (&self.library, &self.target);
        if !path.is_valid(library.graph()) {
            return None;
        }
        let route = Route::new(library, target, path.clone())?;
        let tables = Tables::new(library, target, &route);
        let scope = (self.problem.allowed_clips.as_slice(), self.problem.bridges);
        let best = Best::of_all();
        let mut evaluator = Evaluator::new(library, target, scope, &route, &tables, best);
        evaluator.reconnect();
        evaluator.detours(|| true);
        let least = evaluator.best.least().unwrap_or(f32::INFINITY);
        Some(Neighbourhood { counts: evaluator.counts, least })
    }
}
