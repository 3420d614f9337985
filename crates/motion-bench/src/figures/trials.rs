//! A search followed round by round: how good it was when, by the clock and by the processor.

use std::sync::Arc;
use std::time::Duration;

use motion_bench::stopwatch::{Spent, Stopwatch};
use motion_core::cancel::CancelToken;
use motion_core::search::{Problem, Search, SearchKind, SearchLibrary};

/// Where other work takes the processor, searches go on for up to so many times their time by the
/// clock, until they have had their time by the processor too.
const PATIENCE: u32 = 3;

/// What a search had come to at the end of a round in which it became better.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) spent: Spent,
    pub(crate) score: f64,
}

/// A search that was followed.
pub(crate) struct Trial {
    pub(crate) search: Search,
    pub(crate) curve: Vec<Point>,
    /// When a path first met every wish within tolerance.
    pub(crate) first: Option<Spent>,
    pub(crate) spent: Spent,
}

/// When a search ends.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Until {
    /// With the first path that meets every wish, or after the time.
    Acceptable(Duration),
    /// After the time, by the clock and by the processor.
    BothTimes(Duration),
    /// After the time by the clock.
    Clock(Duration),
}

/// Searches, a round at a time; the last round is not cut short.
pub(crate) fn follow(
    library: &Arc<SearchLibrary>,
    problem: &Problem,
    (seed, kind): (u64, SearchKind),
    until: Until,
) -> anyhow::Result<Trial> {
    let (limit, go) = match until {
        Until::Acceptable(limit) | Until::BothTimes(limit) | Until::Clock(limit) => {
            (limit, CancelToken::new())
        }
    };
    let watch = Stopwatch::new();
    let mut search = Search::of_kind(Arc::clone(library), problem.clone(), seed, kind)?;
    let (mut curve, mut first): (Vec<Point>, _) = (Vec::new(), None);
    loop {
        search.step(&go);
        let (spent, progress) = (watch.spent(), search.progress());
        let score = f64::from(progress.best);
        if curve.last().is_none_or(|last| score < last.score) {
            curve.push(Point { spent, score });
        }
        if first.is_none() && progress.first_acceptable.is_some() {
            first = Some(spent);
        }
        let worked = Clock::Processor.secs(spent) >= limit.as_secs_f64();
        let is_over = match until {
            Until::Clock(_) => spent.wall >= limit,
            _ => spent.wall >= limit && (worked || spent.wall >= PATIENCE * limit),
        };
        if is_over || (first.is_some() && matches!(until, Until::Acceptable(_))) {
            return Ok(Trial { search, curve, first, spent });
        }
    }
}

/// What time is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Clock {
    /// The one on the wall.
    Wall,
    /// The processor's: time of all threads over their number, as if nothing else had to be done.
    Processor,
}

impl Clock {
    pub(crate) fn secs(self, spent: Spent) -> f64 {
        match self {
            Self::Wall => spent.wall.as_secs_f64(),
            Self::Processor => spent.cpu.as_secs_f64() / rayon::current_num_threads() as f64,
        }
    }
}

impl Trial {
    /// When every wish was met first, seconds; infinite where never.
    pub(crate) fn first_s(&self, clock: Clock) -> f64 {
        self.first.map_or(f64::INFINITY, |spent| clock.secs(spent))
    }

    /// The best score after so many seconds; infinite before the first round was over.
    pub(crate) fn score_at(&self, clock: Clock, secs: f64) -> f64 {
        let in_time = self.curve.iter().take_while(|point| clock.secs(point.spent) <= secs);
        in_time.last().map_or(f64::INFINITY, |point| point.score)
    }

    /// When a score was reached, seconds; infinite where never.
    pub(crate) fn reached_s(&self, clock: Clock, score: f64) -> f64 {
        let reached = self.curve.iter().find(|point| point.score <= score);
        reached.map_or(f64::INFINITY, |point| clock.secs(point.spent))
    }
}
