//! Wall and CPU time side by side: a machine with other work to do shows in the first only.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;

/// A running measurement of this process.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    wall: Instant,
    cpu: ProcessTime,
}

/// Time spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spent {
    /// On the clock.
    pub wall: Duration,
    /// By all threads together.
    pub cpu: Duration,
}

impl Stopwatch {
    /// Starts now.
    #[expect(clippy::new_without_default, reason = "starting a watch is no default")]
    pub fn new() -> Self {
        Self { wall: Instant::now(), cpu: ProcessTime::now() }
    }

    /// What was spent since.
    pub fn spent(&self) -> Spent {
        Spent { wall: self.wall.elapsed(), cpu: self.cpu.elapsed() }
    }
}

/// Runs `f` and says what it took.
pub fn timed<T>(f: impl FnOnce() -> T) -> (T, Spent) {
    let watch = Stopwatch::new();
    let value = f();
    (value, watch.spent())
}
