//! A search that goes on from known paths: after what is asked has changed, or from a file.
//!
//! Known paths are laid out and scored anew, which is cheap, and are alternatives at once with
//! their true scores. Then lines go on from them, the best first, each to the local minimum below
//! it; that takes the place of what it came from.

use rayon::prelude::*;

use super::alternatives::Alternatives;
use super::line::{Line, descend};
use super::rng::stream;
use super::route::Route;
use super::sketch::Sketch;
use super::target::Target;
use super::{
    FEW_ALTERNATIVES, MAX_ALTERNATIVES, N_LINES, Problem, ProblemError, Search, SearchLibrary,
    Solution,
};
use crate::cancel::CancelToken;
use crate::constraint::LengthMode;
use crate::path::Path;
use crate::score::Wishes;
use std::sync::Arc;

/// While a length that is exact cannot be had at once, missing it counts so many times as much.
const EXACT_AS_WEIGHT: f32 = 100.0;

/// Of the known paths so many, the best, are gone on from; worse ones lead to the same minima.
const MAX_BEGUN_AT: usize = 32;

impl Search {
    /// A search for `problem` that begins with known paths of the same library.
    ///
    /// Paths that are not valid, too short for a checkpoint, of another length than an exact one or
    /// made of clips or bridges that may not be used are left out. The outcome depends on the
    /// arguments alone, the order of the paths only where scores are equal.
    pub fn with_paths(
        library: Arc<SearchLibrary>,
        problem: Problem,
        seed: u64,
        paths: &[Path],
    ) -> Result<Self, ProblemError> {
        let mut search = Self::new(library, problem, seed)?;
        search.go_on_from(paths);
        Ok(search)
    }

    /// The same search with something else asked: everything that it knows, and `more` that was
    /// known before, is scored anew, and it goes on from there.
    pub fn rescored(&self, problem: Problem, more: &[Path]) -> Result<Self, ProblemError> {
        let mut search = Self::sharing(Arc::clone(&self.library), problem, self.seed, Some(self))?;
        // Rounds count on, so that the random streams are not those of before.
        search.progress.iteration = self.progress.iteration;
        search.progress.counts = self.progress.counts;
        search.progress.n_minima = self.progress.n_minima;
        let mut paths = self.paths();
        paths.extend_from_slice(more);
        search.go_on_from(&paths);
        Ok(search)
    }

    /// Every path that the search knows, each once: alternatives, the best, lines under way, and
    /// what waits.
    pub fn paths(&self) -> Vec<Path> {
        let kept = self.alternatives.kept().iter().map(|kept| &kept.route);
        let best = self.best.iter().map(|(route, _)| route);
        let lines = self.lines.iter().filter_map(Line::route);
        let mut paths: Vec<Path> = Vec::new();
        for route in kept.chain(best).chain(lines).chain(&self.waiting) {
            if !paths.contains(&route.path) {
                paths.push(route.path.clone());
            }
        }
        paths
    }

    /// Every line begins anew in the next round, some of them from new seeds. Alternatives stay.
    pub fn shake(&mut self) {
        if self.alternatives.kept().len() < FEW_ALTERNATIVES {
            self.alternatives = self.with_lines();
        }
        self.lines.iter_mut().for_each(Line::forget);
        self.waiting.clear();
    }

    /// Chance begins from another seed in the next round; what was found stays.
    pub fn reseed(&mut self, seed: u64) {
        self.seed = seed;
    }

    /// Makes a path an alternative, if no better one is the same motion. Returns whether it is one
    /// now.
    pub fn offer(&mut self, path: &Path, improves: Option<Path>) -> bool {
        let round = self.progress.iteration;
        let Some(route) = usable_route(self, path) else { return false };
        let taken = self.alternatives.offer(&self.library, &route, round, improves);
        self.note_best([route]);
        taken
    }

    /// The path after one step downhill from `path`, or `None` at a local minimum.
    ///
    /// A path that cannot be what is asked at all (too short for a checkpoint, another length than
    /// the exact one) is brought nearer to it; the solution's score is infinite as long as it is
    /// not there. Each call with equal arguments in one round gives the same.
    pub fn improve(&self, path: &Path, cancel: &CancelToken) -> Option<Solution> {
        if cancel.is_cancelled() {
            return None;
        }
        let (library, target) = (&*self.library, &self.target);
        let solution = |route: Route, score| {
            let iteration = self.progress.iteration;
            Solution { path: route.path, score, iteration, improves: Some(path.clone()) }
        };
        if let Some(route) = Route::new(library, target, path.clone()) {
            let better = self.descend_once(target, &route)?;
            let score = better.score;
            return Some(solution(better, score));
        }
        let n_frames: usize = path.pieces(library.graph()).iter().map(|p| p.n_frames()).sum();
        let relaxed =
            Target::new(&self.library, &within_reach(&self.problem.wishes, n_frames as u32));
        let route = Route::new(library, &relaxed, path.clone())?;
        let nearer = self.descend_once(&relaxed, &route)?;
        let there = Route::new(library, target, nearer.path.clone());
        Some(solution(nearer, there.map_or(f32::INFINITY, |route| route.score)))
    }

    fn descend_once(&self, target: &Target, route: &Route) -> Option<Route> {
        let mut rng = stream(self.seed, self.progress.iteration, N_LINES);
        let scope = (self.problem.allowed_clips.as_slice(), self.problem.bridges);
        descend(
            &self.library,
            target,
            scope,
            route,
            f32::INFINITY,
            &mut rng,
            &mut Default::default(),
        )
    }

    fn go_on_from(&mut self, paths: &[Path]) {
        let laid_out = |path| {
            let route = usable_route(self, path)?;
            let sketch = Sketch::of(&self.library, &route);
            Some((route, sketch))
        };
        let mut known: Vec<(Route, Sketch)> = paths.par_iter().filter_map(laid_out).collect();
        known.sort_by(|(a, _), (b, _)| a.score.total_cmp(&b.score));
        self.alternatives = Alternatives::new(MAX_ALTERNATIVES);
        let round = self.progress.iteration;
        let mut routes = Vec::with_capacity(known.len());
        for (route, sketch) in known {
            self.alternatives.offer_sketched(&route, sketch, round, None);
            routes.push(route);
        }
        self.note_best(routes.first().cloned());
        routes.dedup_by(|a, b| a.path == b.path);
        routes.truncate(MAX_BEGUN_AT);
        routes.reverse();
        self.waiting = routes;
        // Every fourth line looks for new motions; the others go on from what is known.
        for nth in (0..self.lines.len()).filter(|nth| nth % 4 != 0) {
            let Some(route) = self.waiting.pop() else { break };
            self.lines[nth].begin_at(route);
        }
        self.progress.first_acceptable = None;
        if let Some(route) = self.acceptable_line() {
            self.note_accepted(route);
        }
    }

    fn note_best(&mut self, routes: impl IntoIterator<Item = Route>) {
        for route in routes {
            let better = self.best.as_ref().is_none_or(|(best, _)| route.score < best.score);
            if better {
                self.progress.best = route.score;
                self.best = Some((route, self.progress.iteration));
            }
        }
        self.progress.n_alternatives = self.alternatives.kept().len();
    }
}

/// Lays the path out, if it may be used for what `search` is asked.
pub(super) fn usable_route(search: &Search, path: &Path) -> Option<Route> {
    let graph = search.library.graph();
    let allowed = |route: &Route| {
        route.spans.iter().all(|span| search.problem.allowed_clips[span.clip.idx()])
            && (search.problem.bridges
                || !route.path.cuts.iter().any(|&cut| graph.forest.is_bridge(cut)))
    };
    let valid = path.is_valid(graph);
    let route = valid.then(|| Route::new(&search.library, &search.target, path.clone()))?;
    route.filter(allowed)
}

/// What is asked, as far as a motion of `n_frames` can be judged by it: without checkpoints that it
/// does not reach, and with an exact length as one that is much preferred.
fn within_reach(wishes: &Wishes, n_frames: u32) -> Wishes {
    let mut wishes = wishes.clone();
    let n = wishes.body.len();
    let mut nth = 0;
    wishes.body.retain(|constraint| {
        nth += 1;
        let is_inner = nth > 1 && nth < n;
        !is_inner || constraint.frame < n_frames
    });
    wishes.joints.retain(|constraint| constraint.frame < n_frames);
    // What is hard is shown or not; a path that does not show it comes nearer without it.
    wishes.poses.clear();
    wishes.locks.clear();
    if let Some(length) = wishes.length.as_mut().filter(|l| l.mode == LengthMode::Exact) {
        length.mode = LengthMode::Preferred;
        length.weight = length.weight.max(1.0) * EXACT_AS_WEIGHT;
    }
    wishes
}

#[cfg(test)]
mod tests;
