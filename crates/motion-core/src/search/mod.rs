//! The search: randomized, anytime, resumable (AF02 section 5; `docs/search.md`).
//!
//! A search keeps a number of **lines**. A line starts from a seed and in every round moves to
//! the best mutation of its path; when no mutation is better it has reached a **local minimum**,
//! which is recorded as an alternative, and the line starts anew. When what is asked changes, the search
//! goes on from the paths that it has (`resume`). Lines do not know of each
//! other within a round and each draws from its own random stream, so the outcome depends on the
//! seed and the number of rounds alone, not on threads.

mod af02;
mod alternatives;
mod angle;
mod astar;
mod best;
mod circles;
mod detour;
mod ends;
mod evaluate;
mod hard;
mod kind;
mod landing;
mod library;
mod line;
mod moments;
mod mutation;
mod neighbourhood;
mod press;
mod problem;
mod reach;
mod reading;
mod reconnect;
mod refine;
mod resume;
mod rivals;
mod rng;
mod route;
mod seeds;
mod sketch;
mod stretch;
mod tables;
mod target;
mod tracks;
mod unrolled;
mod vary;

#[cfg(test)]
mod brute;

use std::sync::Arc;

use rayon::prelude::*;

pub use alternatives::DISTINCT_M;
pub use best::ScoreCounts;
pub use hard::HardWish;
pub use kind::SearchKind;
pub use library::SearchLibrary;
pub use neighbourhood::Neighbourhood;
pub use problem::{Problem, ProblemError};

use crate::cancel::CancelToken;
use crate::path::Path;
use crate::score::{Judgement, judge};
use alternatives::Alternatives;
use line::{Line, Pace};
use reach::anchors_of;
use route::Route;
use seeds::Anchors;
use target::Target;

/// Lines that run side by side. Fixed, since it takes part in the outcome.
const N_LINES: u64 = 16;

/// Alternatives that are kept while searching; callers show fewer.
const MAX_ALTERNATIVES: usize = 24;

/// With fewer local minima than this, lines under way are alternatives too.
const FEW_ALTERNATIVES: usize = 12;

/// A motion that the search has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// How it is cut together.
    pub path: Path,
    /// What it scores; lower is better.
    pub score: f32,
    /// The round that found it, counted from 1.
    pub iteration: u64,
    /// The path that it came from or took the place of, where that was known as a solution itself.
    pub improves: Option<Path>,
}

/// What a round has brought.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Rounds done.
    pub iteration: u64,
    /// The best score so far, of local minima and lines under way; infinite before the first.
    pub best: f32,
    /// Distinct local minima known.
    pub n_alternatives: usize,
    /// The round in which a path first met every wish within tolerance.
    pub first_acceptable: Option<u64>,
    /// Candidates looked at so far.
    pub counts: ScoreCounts,
    /// Local minima reached so far, the same ones counted again.
    pub n_minima: u64,
}

/// A search under way. Stop calling [`Search::step`] at any time; go on later.
#[derive(Clone, Debug)]
pub struct Search {
    library: Arc<SearchLibrary>,
    problem: Problem,
    target: Target,
    anchors: Anchors,
    seed: u64,
    lines: Vec<Line>,
    /// Kept paths that no line has gone on from yet, the best last.
    waiting: Vec<Route>,
    alternatives: Alternatives,
    best: Option<(Route, u64)>,
    /// The best motion within every tolerance that was passed on the way.
    accepted: Option<(Route, u64)>,
    /// Lines held to what they miss, while nothing that is kept is acceptable.
    pressed: Vec<Option<press::Pressed>>,
    progress: Progress,
    /// The other search that it is instead, if it is one.
    rival: Option<rivals::Rival>,
}

impl Search {
    /// A search for `problem` on `library`. Nothing is computed yet.
    ///
    /// Equal seeds make equal searches.
    pub fn new(
        library: Arc<SearchLibrary>,
        problem: Problem,
        seed: u64,
    ) -> Result<Self, ProblemError> {
        Self::sharing(library, problem, seed, None)
    }

    /// [`Self::new`], with what seeds come through taken from a search that asks for the same there.
    fn sharing(
        library: Arc<SearchLibrary>,
        problem: Problem,
        seed: u64,
        known: Option<&Self>,
    ) -> Result<Self, ProblemError> {
        problem.check()?;
        let target = Target::new(&library, &problem.wishes);
        let known = known.filter(|known| known.problem.asks_for_the_same_frames(&problem));
        let anchors = match known {
            Some(known) => known.anchors.clone(),
            None => anchors_of(&library, &target, &problem)?,
        };
        let lines = (0..N_LINES).map(Line::new).collect();
        let progress = Progress { best: f32::INFINITY, ..Progress::default() };
        let alternatives = Alternatives::new(MAX_ALTERNATIVES);
        let (waiting, best, rival) = (Vec::new(), None, None);
        let (accepted, pressed) = (None, Vec::new());
        Ok(Self {
            library,
            problem,
            target,
            anchors,
            seed,
            lines,
            waiting,
            alternatives,
            best,
            accepted,
            pressed,
            progress,
            rival,
        })
    }

    /// One round: every line takes a step. Returns `false`, with nothing changed, if cancelled
    /// before the round was complete.
    pub fn step(&mut self, cancel: &CancelToken) -> bool {
        if let Some(rival) = self.rival.take() {
            return self.step_rival(rival, cancel);
        }
        let round = self.progress.iteration + 1;
        let elite: Vec<Route> =
            self.alternatives.kept().iter().map(|kept| kept.route.clone()).collect();
        let pace = Pace { seed: self.seed, round, elite: &elite, anchors: &self.anchors };
        let scope = (self.problem.allowed_clips.as_slice(), self.problem.bridges);
        let (library, target) = (&self.library, &self.target);
        let stepped: Vec<Option<line::Stepped>> = self
            .lines
            .par_iter()
            .with_max_len(1)
            .map(|line| (!cancel.is_cancelled()).then(|| line.step(library, target, scope, &pace)))
            .collect();
        if stepped.iter().any(Option::is_none) {
            return false;
        }
        let Some(pressed) = self.press(round, cancel) else { return false };
        self.progress.iteration = round;
        self.progress.counts.add(pressed.counts);
        self.pressed = pressed.lines;
        if let Some(route) = pressed.accepted {
            self.note_accepted(route);
        }
        for (line, stepped) in self.lines.iter_mut().zip(stepped.into_iter().flatten()) {
            self.progress.counts.add(stepped.counts);
            if let Some(minimum) = &stepped.minimum {
                self.progress.n_minima += 1;
                // What it came from is no minimum, so it makes room.
                let origin = stepped.minimum_of.filter(|origin| *origin != minimum.path);
                if let Some(origin) = &origin {
                    self.alternatives.drop_path(origin);
                }
                self.alternatives.offer(&self.library, minimum, round, origin);
            }
            let is_fresh = stepped.next_is_fresh;
            *line = stepped.line;
            if is_fresh && let Some(kept) = self.waiting.pop() {
                line.begin_at(kept);
            }
            if let Some(route) = line.route() {
                let better = self.best.as_ref().is_none_or(|(best, _)| route.score < best.score);
                if better {
                    self.best = Some((route.clone(), round));
                }
            }
        }
        self.progress.best = self.best.as_ref().map_or(f32::INFINITY, |(best, _)| best.score);
        self.progress.n_alternatives = self.alternatives.kept().len();
        if self.accepted.is_none()
            && let Some(route) = self.acceptable_line()
        {
            self.note_accepted(route);
        }
        true
    }

    /// Where the search stands.
    pub fn progress(&self) -> Progress {
        self.progress
    }

    /// The best motion so far, local minimum or not.
    pub fn best(&self) -> Option<Solution> {
        let (route, iteration) = self.best.as_ref()?;
        let (path, score) = (route.path.clone(), route.score);
        Some(Solution { path, score, iteration: *iteration, improves: None })
    }

    /// Distinct local minima, best first: those within every tolerance, then the others. While there are few, good
    /// motions that lines are still working on as well; the best so far in any case, and where no other
    /// is acceptable, the best that was.
    pub fn alternatives(&self) -> Vec<Solution> {
        let mut all = self.alternatives.clone();
        if all.kept().len() < FEW_ALTERNATIVES {
            all = self.with_lines();
        } else if let Some((route, round)) = &self.best {
            // A line under way may have overtaken every minimum: it is shown too, in its place.
            all.offer(&self.library, route, *round, None);
        }
        let solution = |route: &Route, iteration, improves| {
            let (path, score) = (route.path.clone(), route.score);
            Solution { path, score, iteration, improves }
        };
        let of_kept = |kept: &&alternatives::Kept| {
            solution(&kept.route, kept.found_in, kept.improves.clone())
        };
        let (well, others): (Vec<_>, Vec<_>) =
            all.kept().iter().partition(|kept| self.is_kept_acceptable(kept));
        let mut found: Vec<Solution> = well.iter().map(of_kept).collect();
        if found.is_empty()
            && let Some((route, round)) = &self.accepted
        {
            found.push(solution(route, *round, None));
        }
        found.extend(others.iter().map(of_kept));
        found
    }

    /// Judges a path by the problem's wishes, from scratch.
    pub fn judge(&self, path: &Path) -> Option<Judgement> {
        judge(self.library.graph(), self.library.clips(), &self.problem.wishes, path)
    }

    /// The library that is searched.
    pub fn library(&self) -> &Arc<SearchLibrary> {
        &self.library
    }

    /// What is asked.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The alternatives and good motions under way: a long motion is good long before it is at its
    /// minimum.
    fn with_lines(&self) -> Alternatives {
        let mut all = self.alternatives.clone();
        let round = self.progress.iteration;
        for route in self.lines.iter().filter_map(Line::route) {
            if route.score <= self.target.most_when_acceptable(route.cuts_cost) {
                all.offer(&self.library, route, round, None);
            }
        }
        if let Some((route, round)) = &self.best {
            all.offer(&self.library, route, *round, None);
        }
        all
    }

    /// The best line's motion within every tolerance.
    fn acceptable_line(&self) -> Option<Route> {
        let routes = self.lines.iter().filter_map(Line::route);
        let acceptable = routes.filter(|route| self.is_acceptable(route));
        acceptable.min_by(|a, b| a.score.total_cmp(&b.score)).cloned()
    }

    /// Keeps the best motion within every tolerance, so that it is not lost where others score better.
    fn note_accepted(&mut self, route: Route) {
        let round = self.progress.iteration.max(1);
        self.progress.first_acceptable.get_or_insert(round);
        if self.accepted.as_ref().is_none_or(|(known, _)| route.score < known.score) {
            self.accepted = Some((route, round));
        }
    }

    fn is_kept_acceptable(&self, kept: &alternatives::Kept) -> bool {
        *kept.acceptable.get_or_init(|| self.is_acceptable(&kept.route))
    }

    fn is_acceptable(&self, route: &Route) -> bool {
        // Scores first: judging lays every frame out.
        route.score <= self.target.most_when_acceptable(route.cuts_cost)
            && route.is_clear(&self.library, &self.target)
            && self
                .judge(&route.path)
                .is_some_and(|judged| judged.is_acceptable(&self.problem.wishes))
    }
}
