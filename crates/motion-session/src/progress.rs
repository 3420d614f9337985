//! How far a job on another thread is, for a progress bar.

use std::fmt;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::eta::EtaEstimator;
use crate::live::Wake;
use crate::live::mailbox::Mailbox;

/// How far a job is.
#[derive(Clone, Debug, PartialEq)]
pub struct JobProgress {
    /// What is being done.
    pub stage: String,
    /// The share of the whole job that is done, 0 to 1; it never falls.
    pub share: f64,
    /// What is counted in this stage, if anything.
    pub counts: Option<Counts>,
    /// Seconds until it is done, by the rate of this stage; `None` while nobody can know.
    pub eta_secs: Option<f64>,
}

/// Some of all of something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// What is counted, in the plural.
    pub what: &'static str,
    /// How many are done.
    pub n_done: usize,
    /// How many there are.
    pub n_all: usize,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} of {}", self.what, self.n_done, self.n_all)
    }
}

impl JobProgress {
    /// A job that has just begun.
    pub fn begun(stage: &str) -> Self {
        Self { stage: stage.to_owned(), share: 0.0, counts: None, eta_secs: None }
    }
}

/// Between reports of one stage nobody is woken sooner.
const MIN_BETWEEN: Duration = Duration::from_millis(40);

/// Where a job says how far it is, from any of its threads, and its owner looks.
pub(crate) struct ProgressBoard {
    tracker: Mutex<Tracker>,
    latest: Mailbox<JobProgress>,
    wake: Wake,
}

struct Tracker {
    began: Instant,
    eta: EtaEstimator,
    stage: String,
    share: f64,
    last: Option<Instant>,
}

impl fmt::Debug for ProgressBoard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ProgressBoard").field("latest", &self.latest).finish_non_exhaustive()
    }
}

impl ProgressBoard {
    /// A board for a job that begins now; `wake` is called for what is to be looked at.
    pub(crate) fn new(wake: Wake) -> Self {
        let tracker = Tracker {
            began: Instant::now(),
            eta: EtaEstimator::default(),
            stage: String::new(),
            share: 0.0,
            last: None,
        };
        Self { tracker: Mutex::new(tracker), latest: Mailbox::default(), wake }
    }

    /// Says how far it is.
    pub(crate) fn report(&self, stage: &str, share: f64, counts: Option<Counts>) {
        let now = Instant::now();
        // A thread that panicked while it reported has left numbers, whatever they are.
        let mut tracker = self.tracker.lock().unwrap_or_else(PoisonError::into_inner);
        let is_soon = tracker.last.is_some_and(|last| now.duration_since(last) < MIN_BETWEEN);
        if is_soon && tracker.stage == stage {
            return;
        }
        // Threads overtake each other on the way here.
        let share = share.clamp(tracker.share, 1.0);
        let now_secs = now.duration_since(tracker.began).as_secs_f64();
        let eta_secs = tracker.eta.update(stage, share, now_secs);
        stage.clone_into(&mut tracker.stage);
        (tracker.share, tracker.last) = (share, Some(now));
        drop(tracker);
        let stage = stage.to_owned();
        self.latest.put(JobProgress { stage, share, counts, eta_secs });
        (self.wake)();
    }

    /// Calls the owner for something other than progress.
    pub(crate) fn wake(&self) {
        (self.wake)();
    }

    /// What was reported last, if it was not looked at yet. Never waits.
    pub(crate) fn try_take(&self) -> Option<JobProgress> {
        self.latest.try_take()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    #[test]
    fn shares_never_fall_and_every_stage_is_heard_of() {
        let board = ProgressBoard::new(Arc::new(|| ()));
        board.report("reading", 0.5, None);
        assert_eq!(board.try_take().map(|p| p.share), Some(0.5));
        board.report("reading", 0.6, None);
        assert_eq!(board.try_take(), None, "so soon");
        let counts = Counts { what: "pairs", n_done: 1, n_all: 3 };
        board.report("edges", 0.3, Some(counts));
        let edges = board.try_take().unwrap();
        assert_eq!((edges.stage.as_str(), edges.share), ("edges", 0.5));
        assert_eq!(edges.counts.unwrap().to_string(), "pairs 1 of 3");
        assert_eq!(board.try_take(), None);
    }
}
