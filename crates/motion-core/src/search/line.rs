//! One line of the search: from a seed downhill to a local minimum.

use std::ops::Range;

use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;

use super::best::{Best, ScoreCounts};
use super::evaluate::Evaluator;
use super::library::SearchLibrary;
use super::rng::stream;
use super::route::Route;
use super::seeds::{self, Anchors, Growth};
use super::tables::Tables;
use super::target::Target;
use crate::path::Path;

/// Mutations of a path that are laid out, best first, before a step is taken.
const N_BEST: usize = 2;

/// A mutation must improve the score by this share to count: a line shall not crawl.
const LEAST_GAIN: f32 = 1e-4;

/// A step that gains this share is taken without looking at the many two-hop mutations.
const GOOD_GAIN: f32 = 0.05;

/// Known minima with a stretch replaced that are drawn for one start; the best is taken.
const DRAWS_PER_START: usize = 16;

/// Paths kept by the beams of seeds, from the first line's on: narrow ones are soon there.
const BEAM_WIDTHS: [usize; 5] = [2, 4, 8, 16, 32];

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

/// Cuts out of a piece that a beam looks at, at most.
const MAX_CUTS: usize = 64;

/// Pieces of a long motion that are changed together …
const WINDOW_PIECES: usize = 8;
/// … and how far it is from one such window to the next.
const WINDOW_STEP: usize = 5;

/// What a round tells its lines.
pub(super) struct Pace<'a> {
    pub(super) seed: u64,
    pub(super) round: u64,
    /// Local minima known when the round began.
    pub(super) elite: &'a [Route],
    /// What seeds come through.
    pub(super) anchors: &'a Anchors,
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
        if !near_elite && pace.elite.is_empty() {
            return first_seed(library, target, scope, pace.anchors, rng);
        }
        if !near_elite {
            // Over lines and rounds every width has its turn.
            let nth = (self.number / 4 + pace.round) as usize;
            let width = BEAM_WIDTHS[nth % BEAM_WIDTHS.len()];
            let growth = Growth { width, n_cuts: MAX_CUTS >> rng.random_range(0..5) };
            return seeds::grow(library, target, scope, pace.anchors, growth, rng);
        }
        let mut best: Option<Route> = None;
        for _ in 0..DRAWS_PER_START {
            // Better minima more often: the rank is the smaller of two draws.
            let n = pace.elite.len();
            let rank = rng.random_range(0..n).min(rng.random_range(0..n));
            let seed = seeds::perturb(library, target, scope, &pace.elite[rank], rng);
            let better = |s: &Route| best.as_ref().is_none_or(|b| s.score < b.score);
            if let Some(seed) = seed.filter(better) {
                best = Some(seed);
            }
        }
        best
    }
}

/// While nothing is known: ever wider beams until one brings a motion that may be acceptable.
fn first_seed(
    library: &SearchLibrary,
    target: &Target,
    scope: (&[bool], bool),
    anchors: &Anchors,
    rng: &mut Pcg64Mcg,
) -> Option<Route> {
    let mut best: Option<Route> = None;
    for width in BEAM_WIDTHS {
        let growth = Growth { width, n_cuts: MAX_CUTS };
        let seed = seeds::grow(library, target, scope, anchors, growth, rng);
        if let Some(seed) = seed {
            let wanted = seed.score <= target.most_when_acceptable(seed.cuts_cost);
            if best.as_ref().is_none_or(|best| seed.score < best.score) {
                best = Some(seed);
            }
            if wanted {
                break;
            }
        }
    }
    best
}

/// The best change of `route`, or `None` when nothing is better: a local minimum.
///
/// A long motion is changed window by window, each by its best change. A route above `to_beat` for
/// which nothing better is found among the simple mutations and a sample of the others counts as
/// given up; the caller can tell by its score.
pub(super) fn descend(
    library: &SearchLibrary,
    target: &Target,
    scope: (&[bool], bool),
    route: &Route,
    to_beat: f32,
    rng: &mut Pcg64Mcg,
    counts: &mut ScoreCounts,
) -> Option<Route> {
    let mut windows = windows(route.spans.len());
    if windows.len() == 1 {
        let whole = (route, 0..route.spans.len());
        return best_change(library, target, scope, whole, (to_beat, true), rng, counts);
    }
    windows.shuffle(rng);
    // Every window by what is soon seen; only when that gains nothing, each by everything.
    for thorough in [false, true] {
        let mut current: Option<Route> = None;
        for window in &windows {
            let here = current.as_ref().unwrap_or(route);
            // Windows are of the route as it was; it may have fewer pieces now.
            let n_spans = here.spans.len();
            let window = (here, window.start.min(n_spans)..window.end.min(n_spans));
            let pace = (to_beat, thorough);
            let better = best_change(library, target, scope, window, pace, rng, counts);
            current = better.or(current);
            if thorough && current.is_some() {
                break;
            }
        }
        if current.is_some() {
            return current;
        }
    }
    None
}

/// The pieces that are changed together: all of them, or overlapping stretches of a long motion.
fn windows(n_spans: usize) -> Vec<Range<usize>> {
    if n_spans <= WINDOW_PIECES + WINDOW_STEP {
        return std::iter::once(0..n_spans).collect();
    }
    let starts = (0..n_spans - WINDOW_PIECES).step_by(WINDOW_STEP);
    let mut windows: Vec<_> = starts.map(|start| start..start + WINDOW_PIECES).collect();
    windows.push(n_spans - WINDOW_PIECES..n_spans);
    windows
}

fn best_change(
    library: &SearchLibrary,
    target: &Target,
    scope: (&[bool], bool),
    (route, window): (&Route, Range<usize>),
    (to_beat, thorough): (f32, bool),
    rng: &mut Pcg64Mcg,
    counts: &mut ScoreCounts,
) -> Option<Route> {
    let tables = Tables::new(library, target, route);
    let ceiling = route.score - LEAST_GAIN * route.score.abs().max(1e-3);
    let (at_start, at_end) = (window.start == 0, window.end == route.spans.len());
    // A window's share of the score is what its changes can gain.
    let share = window.len() as f32 / route.spans.len().max(1) as f32;
    let good_gain = GOOD_GAIN * share * route.score;
    let best = Best::new(N_BEST, ceiling);
    let mut evaluator = Evaluator::new(library, target, scope, route, &tables, best).within(window);
    // The many joint mutations only when the simple ones bring little. Of the detours a sample
    // first; when nothing at all is better, every one of them, so that a minimum is one.
    let brings_little = |evaluator: &Evaluator<'_>| {
        evaluator.best.least().is_none_or(|least| least > route.score - good_gain)
    };
    evaluator.reconnect();
    if at_start || at_end {
        evaluator.move_ends();
    }
    evaluator.refine();
    if brings_little(&evaluator) {
        evaluator.rejoin();
    }
    if at_start && brings_little(&evaluator) {
        evaluator.new_starts(SLACK);
    }
    if at_end && brings_little(&evaluator) {
        evaluator.new_ends(SLACK);
    }
    if brings_little(&evaluator) {
        let mut one_in = if route.score > ROUGH_SCORE { 2 * DETOUR_SAMPLE } else { DETOUR_SAMPLE };
        if target.has_surroundings() || !thorough {
            // Each that is not dropped is walked along.
            one_in *= 2;
        }
        evaluator.detours(|| rng.random_range(0..one_in) == 0);
    }
    let hopeless = route.score > to_beat;
    if evaluator.best.least().is_none() && !hopeless && thorough {
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
