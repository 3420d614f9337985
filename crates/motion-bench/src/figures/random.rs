//! Random problems within what the clips can do: the share that is met in time.

use std::time::Duration;

use motion_bench::random_problems::random_problem;
use motion_bench::stopwatch::Spent;
use motion_core::search::SearchKind;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use super::trials::{Clock, Until, follow};
use crate::table::Row;

const BUDGET_S: f64 = 2.0;

/// Each problem once, with its number as the search's seed.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let n = bench.effort.n_random;
    let mut spent = Spent::default();
    let (mut wall, mut cpu, mut missed) = (Vec::new(), Vec::new(), Vec::new());
    // By the number of legs: problems, and those that were met.
    let mut by_legs = [[0u32; 2]; 3];
    for nth in 0..n {
        let problem = random_problem(library.clips(), nth);
        let until = Until::Acceptable(Duration::from_secs_f64(BUDGET_S));
        let trial = follow(&library, &problem, (nth, SearchKind::Gaitway), until)?;
        let (wall_s, cpu_s) = (trial.first_s(Clock::Wall), trial.first_s(Clock::Processor));
        let is_met = wall_s.min(cpu_s) <= BUDGET_S;
        let legs = &mut by_legs[(problem.wishes.body.len() - 2).min(2)];
        legs[0] += 1;
        legs[1] += u32::from(is_met);
        if !is_met {
            missed.push(nth.to_string());
        }
        wall.push(wall_s);
        cpu.push(cpu_s);
        add(&mut spent, trial.spent);
    }
    let share = |secs: &[f64]| {
        100.0 * secs.iter().filter(|&&s| s <= BUDGET_S).count() as f64 / secs.len().max(1) as f64
    };
    let legs = by_legs.map(|[n, met]| format!("{met} of {n}"));
    missed.truncate(20);
    Ok(vec![Row {
        figure: format!("{n} random problems within tolerance in 2 s"),
        target: "99 %",
        measured: format!("{:.1} %", share(&wall)),
        is_met: share(&wall) >= 99.0,
        spent,
        notes: vec![
            format!(
                "by the processor's time {:.1} %; first motion that meets all after {:.3} s (95th {:.2}), \
                 by the processor {:.3} s (95th {:.2})",
                share(&cpu),
                median(&wall),
                quantile(&wall, 0.95),
                median(&cpu),
                quantile(&cpu, 0.95)
            ),
            format!(
                "with 2, 3, 4 checkpoints: {}; the first that were missed: {}",
                legs.join(", "),
                missed.join(" ")
            ),
        ],
    }])
}
