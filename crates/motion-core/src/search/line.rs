//! One line of the search: from a seed downhill to a local minimum.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::best::{Best, ScoreCounts};
use super::evaluate::Evaluator;
use super::library::SearchLibrary;
use super::rng::stream;
use super::route::Route;
use super::seeds;
use super::tables::Tables;
use super::target::Target;
use crate::path::Path;

/// Mutations of a path that are laid out, best first, before a step is taken.
const N_BEST: usize = 2;

/// A mutation must improve the score by this share to count: a line shall not crawl.
const LEAST_GAIN: f32 = 1e-4;

/// A step that gains this share is taken without looking at the many two-hop mutations.
const GOOD_GAIN: f32 = 0.05;

/// Seeds drawn for one start; the best is taken.
const SEEDS_PER_START: usize = 16;

/// Frames beside the wished length that new starts and ends are tried with: none, since other
/// ends are tried in the next step.
const SLACK: &[i64] = &[0];

/// One in so many pieces to come back to, and of ways out, is drawn when detours are sampled.
const DETOUR_SAMPLE: u32 = 3;

/// Above this score a path has so many improvements that half the sample finds one.
const ROUGH_SCORE: f32 = 3.0;

/// Once so many alternatives are known, a line that has become slow above the last of them is
/// given up instead of being followed to its minimum.
const N_TO_BEAT: usize = 10;

/// What a round tells its lines.
pub(super) struct Pace<'a> {
    pub(super) seed: u64,
    pub(super) round: u64,
    /// Local minima known when the round began.
    pub(super) elite: &'a [Route],
}

/// A line: where it is, if it has started.
#[derive(Clone, Debug)]
pub(super) struct Line {
    number: u64,
    route: Option<Route>,
    /// The kept path that it began at, if it began at one.
    origin: Option<Path>,
}

/// What became of a line in a round.
pub(super) struct Stepped {
    pub(super) line: Line,
    /// The local minimum that it had reached.
    pub(super) minimum: Option<Route>,
    /// The kept path that the minimum was reached from.
    pub(super) minimum_of: Option<Path>,
    /// Whether the line has begun anew.
    pub(super) next_is_fresh: bool,
    pub(super) counts: ScoreCounts,
}

impl Line {
    pub(super) fn new(number: u64) -> Self {
        Self { number, route: None, origin: None }
    }

    /// Goes on from a path that is kept.
    pub(super) fn begin_at(&mut self, kept: Route) {
        self.origin = Some(kept.path.clone());
        self.route = Some(kept);
    }

    /// Begins anew in the next round.
    pub(super) fn forget(&mut self) {
        (self.route, self.origin) = (None, None);
    }

    pub(super) fn route(&self) -> Option<&Route> {
        self.route.as_ref()
    }

    /// One step downhill; a line at a local minimum hands it over and starts anew.
    pub(super) fn step(
        &self,
        library: &SearchLibrary,
        target: &Target,
        scope: (&[bool], bool),
        pace: &Pace<'_>,
    ) -> Stepped {
        let mut rng = stream(pace.seed, pace.round, self.number);
        let mut counts = ScoreCounts::default();
        let to_beat = pace.elite.get(N_TO_BEAT - 1).map_or(f32::INFINITY, |known| known.score);
        let next = match &self.route {
            Some(route) => descend(library, target, scope, route, to_beat, &mut rng, &mut counts),
            None => None,
        };
        let minimum = match next {
            None => self.route.clone().filter(|route| route.score <= to_beat),
            Some(_) => None,
        };
        let next_is_fresh = next.is_none();
        let (route, origin, minimum_of) = match next {
            Some(route) => (Some(route), self.origin.clone(), None),
            None => {
                let fresh = self.start(library, target, scope, pace, &mut rng);
                (fresh, None, self.origin.clone())
            }
        };
        let line = Self { number: self.number, route, origin };
        Stepped { line, minimum, minimum_of, next_is_fresh, counts }
    }

    /// A fresh start: a quarter of the lines from seeds, the others from known minima with a stretch
    /// replaced, once there are any.
    fn start(
        &self,
        library: &SearchLibrary,
        target: &Target,
        scope: (&[bool], bool),
        pace: &Pace<'_>,
        rng: &mut Pcg64Mcg,
    ) -> Option<Route> {
        let near_elite = !self.number.is_multiple_of(4) && !pace.elite.is_empty();
        let mut best: Option<Route> = None;
        for _ in 0..SEEDS_PER_START {
            let seed = if near_elite {
                // Better minima more often: the rank is the smaller of two draws.
                let n = pace.elite.len();
                let rank = rng.random_range(0..n).min(rng.random_range(0..n));
                seeds::perturb(library, target, scope, &pace.elite[rank], rng)
            } else {
                seeds::grow(library, target, scope, rng)
            };
            let better = |s: &Route| best.as_ref().is_none_or(|b| s.score < b.score);
            if let Some(seed) = seed.filter(better) {
                best = Some(seed);
            }
        }
        best
    }
}

/// The best change of `route`, or `None` when nothing is better: a local minimum.
///
/// A route above `to_beat` for which nothing better is found among the simple mutations and a
/// sample of the others counts as given up; the caller can tell by its score.
pub(super) fn descend(
    library: &SearchLibrary,
    target: &Target,
    scope: (&[bool], bool),
    route: &Route,
    to_beat: f32,
    rng: &mut Pcg64Mcg,
    counts: &mut ScoreCounts,
) -> Option<Route> {
    let tables = Tables::new(library, target, route);
    let ceiling = route.score - LEAST_GAIN * route.score.abs().max(1e-3);
    let best = Best::new(N_BEST, ceiling);
    let mut evaluator = Evaluator::new(library, target, scope, route, &tables, best);
    // The many joint mutations only when the simple ones bring little. Of the detours a sample
    // first; when nothing at all is better, every one of them, so that a minimum is one.
    let brings_little = |evaluator: &Evaluator<'_>| {
        evaluator.best.least().is_none_or(|least| least > route.score * (1.0 - GOOD_GAIN))
    };
    evaluator.reconnect();
    evaluator.move_ends();
    evaluator.refine();
    if brings_little(&evaluator) {
        evaluator.rejoin();
    }
    if brings_little(&evaluator) {
        evaluator.new_starts(SLACK);
        evaluator.new_ends(SLACK);
    }
    if brings_little(&evaluator) {
        let one_in = if route.score > ROUGH_SCORE { 2 * DETOUR_SAMPLE } else { DETOUR_SAMPLE };
        evaluator.detours(|| rng.random_range(0..one_in) == 0);
    }
    let hopeless = route.score > to_beat;
    if evaluator.best.least().is_none() && !hopeless {
        evaluator.detours(|| true);
    }
    counts.add(evaluator.counts);
    let forest = &library.graph().forest;
    let candidates: Vec<_> = evaluator.best.candidates().collect();
    let laid_out = candidates
        .into_iter()
        .filter_map(|c| Route::new(library, target, c.mutation.apply(&route.path, forest)));
    laid_out.filter(|new| new.score < ceiling).min_by(|a, b| a.score.total_cmp(&b.score))
}
