//! Paths near a known one: a stretch of it replaced by chance, for somebody who likes the rest.

use super::resume::usable_route;
use super::rng::stream;
use super::{N_LINES, Search, Solution, seeds};
use crate::path::Path;

impl Search {
    /// `path` with a random stretch replaced through another clip; `nth` says which draw. `None`
    /// where the draw does not fit, or the path may not be used for what is asked.
    ///
    /// It is no local minimum: [`Search::improve`] leads downhill from it. It depends on the seed,
    /// the path and `nth` alone, not on how far the search is.
    pub fn varied(&self, path: &Path, nth: u64) -> Option<Solution> {
        let route = usable_route(self, path)?;
        let scope = (self.problem.allowed_clips.as_slice(), self.problem.bridges);
        // Lines and improvements have the items up to N_LINES; these come after them.
        let mut rng = stream(self.seed, nth, N_LINES + 1);
        let varied = seeds::perturb(&self.library, &self.target, scope, &route, &mut rng)?;
        let (path, improves) = (varied.path, Some(path.clone()));
        let iteration = self.progress.iteration;
        Some(Solution { path, score: varied.score, iteration, improves })
    }
}
