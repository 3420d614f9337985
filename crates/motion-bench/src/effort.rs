//! How long a run of the table may take.

use std::fmt;
use std::time::Duration;

/// How often and how long things are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Effort {
    /// Library builds, each in a process of its own; the median counts.
    pub(crate) n_builds: usize,
    /// Searches of one second for each problem.
    pub(crate) n_seeds: u64,
    /// Long runs for each problem, from which the best known score comes.
    pub(crate) n_long_runs: u64,
    /// How long each of them is.
    pub(crate) long_run: Duration,
}

impl Effort {
    /// What the promises are made for is `full`.
    pub(crate) fn of(quick: bool, full: bool) -> Self {
        let secs = Duration::from_secs;
        match (quick, full) {
            (true, _) => Self { n_builds: 1, n_seeds: 2, n_long_runs: 1, long_run: secs(2) },
            (_, true) => Self { n_builds: 5, n_seeds: 20, n_long_runs: 10, long_run: secs(30) },
            _ => Self { n_builds: 3, n_seeds: 20, n_long_runs: 2, long_run: secs(5) },
        }
    }
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { n_builds, n_seeds, n_long_runs, long_run } = self;
        let secs = long_run.as_secs();
        write!(f, "{n_builds} builds, {n_seeds} seeds a problem, ")?;
        write!(f, "best known scores from {n_long_runs} runs of {secs} s a problem and the seeds'")
    }
}
