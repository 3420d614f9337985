//! How many of the projects are met within tolerance before correction, and how soon.

use std::time::Duration;

use motion_bench::stopwatch::Spent;
use motion_core::search::SearchKind;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use super::trials::{Clock, Until, follow};
use crate::table::Row;

/// How long a search may take.
const LIMIT_S: f64 = 5.0;

/// A project counts as soon when the median is no later.
const SOON_S: f64 = 0.5;

/// Where a project has two characters, its time is that of both searches.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, asked) = (bench.library()?, bench.asked()?);
    let mut spent = Spent::default();
    let n_seeds = bench.effort.n_trials;
    // Project, then `[by the clock, by the processor]` for each seed.
    let mut projects: Vec<(String, [Vec<f64>; 2])> = Vec::new();
    for asked in asked.iter() {
        let number = asked.name[..2].to_owned();
        if projects.last().is_none_or(|(last, _)| *last != number) {
            let none = vec![0.0; n_seeds as usize];
            projects.push((number, [none.clone(), none]));
        }
        for seed in 0..n_seeds {
            let until = Until::Acceptable(Duration::from_secs_f64(LIMIT_S));
            let trial = follow(&library, &asked.problem, (seed + 1, SearchKind::Gaitway), until)?;
            add(&mut spent, trial.spent);
            if let Some((_, times)) = projects.last_mut() {
                times[0][seed as usize] += trial.first_s(Clock::Wall);
                times[1][seed as usize] += trial.first_s(Clock::Processor);
            }
        }
    }
    let n = projects.len();
    let count = |clock: usize, limit_s: f64, share: f64| {
        projects.iter().filter(|(_, times)| quantile(&times[clock], share) <= limit_s).count()
    };
    let by_project: Vec<String> = projects
        .iter()
        .map(|(name, [wall, cpu])| {
            let n_met = wall.iter().filter(|s| s.is_finite()).count();
            format!(
                "{name} {:.2}/{:.2} ({:.2}) {n_met}/{n_seeds}",
                median(wall),
                quantile(wall, 0.95),
                median(cpu)
            )
        })
        .collect();
    let notes = vec![
        format!(
            "seconds, median/95th percentile (median by processor), seeds met: {}",
            by_project.join(", ")
        ),
        format!("by the processor's time {} of {n} in {SOON_S} s", count(1, SOON_S, 0.5)),
    ];
    let (soon, ever) = (count(0, SOON_S, 0.5), count(0, LIMIT_S, 0.5));
    let row = |figure: &str, target, n_met: usize, least: usize, notes| Row {
        figure: figure.to_owned(),
        target,
        measured: format!("{n_met} of {n}"),
        is_met: n_met + (12 - least) >= n,
        spent,
        notes,
    };
    Ok(vec![
        row("problems within tolerance in 0.5 s, median", "11 of 12", soon, 11, notes),
        row("problems within tolerance in 5 s, median", "12 of 12", ever, 12, Vec::new()),
    ])
}
