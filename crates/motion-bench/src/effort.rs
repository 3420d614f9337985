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
    /// Searches that are followed for each problem, each kind of constraint among them.
    pub(crate) n_trials: u64,
    /// The same where several searches are held against each other.
    pub(crate) n_duels: u64,
    /// Random problems.
    pub(crate) n_random: u64,
    /// Long runs for each problem, from which the best known score comes.
    pub(crate) n_long_runs: u64,
    /// How long each of them is.
    pub(crate) long_run: Duration,
}

impl Effort {
    /// What the promises are made for is `full`.
    pub(crate) fn of(quick: bool, full: bool) -> Self {
        let secs = Duration::from_secs;
        let usual = Self {
            n_builds: 3,
            n_seeds: 20,
            n_trials: 10,
            n_duels: 5,
            n_random: 1000,
            n_long_runs: 2,
            long_run: secs(5),
        };
        match (quick, full) {
            (true, _) => Self {
                n_builds: 1,
                n_seeds: 2,
                n_trials: 2,
                n_duels: 1,
                n_random: 50,
                n_long_runs: 1,
                long_run: secs(2),
            },
            (_, true) => {
                Self { n_builds: 5, n_duels: 10, n_long_runs: 10, long_run: secs(60), ..usual }
            }
            _ => usual,
        }
    }
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { n_builds, n_seeds, n_trials, n_long_runs, long_run, .. } = self;
        let secs = long_run.as_secs();
        write!(f, "{n_builds} builds, {n_seeds} or {n_trials} seeds a problem, ")?;
        write!(f, "best known scores from {n_long_runs} runs of {secs} s a problem and the seeds'")
    }
}
