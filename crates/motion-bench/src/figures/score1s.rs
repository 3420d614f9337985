//! How far a second's best is from the best that is known, over every kind of constraint.

use std::time::Duration;

use motion_bench::stopwatch::Spent;
use motion_core::search::SearchKind;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use super::trials::{Clock, Until, follow};
use crate::table::Row;

/// Added to both scores, so that two very good motions are not worlds apart.
const SLACK: f64 = 0.1;

/// Seeds of the long runs begin here: other ones than those of the short runs.
const FIRST_SEED: u64 = 1001;

/// The median over problems of each one's median over seeds.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, all, effort) = (bench.library()?, bench.asked()?, bench.effort);
    let mut spent = Spent::default();
    let mut medians = [Vec::new(), Vec::new()];
    let mut by_problem = Vec::new();
    for asked in all.iter() {
        let mut best = f64::INFINITY;
        let mut scores = [Vec::new(), Vec::new()];
        for seed in 1..=effort.n_trials {
            let until = Until::BothTimes(Duration::from_secs(1));
            let trial = follow(&library, &asked.problem, (seed, SearchKind::Gaitway), until)?;
            scores[0].push(trial.score_at(Clock::Wall, 1.0));
            scores[1].push(trial.score_at(Clock::Processor, 1.0));
            best = best.min(f64::from(trial.search.progress().best));
            add(&mut spent, trial.spent);
        }
        for seed in FIRST_SEED..FIRST_SEED + effort.n_long_runs {
            let until = Until::Clock(effort.long_run);
            let trial = follow(&library, &asked.problem, (seed, SearchKind::Gaitway), until)?;
            best = best.min(f64::from(trial.search.progress().best));
            add(&mut spent, trial.spent);
        }
        let ratios = scores.map(|scores| -> Vec<f64> {
            scores.iter().map(|score| (score + SLACK) / (best + SLACK)).collect()
        });
        by_problem.push(format!(
            "{} {:.2}/{:.2} ({best:.2})",
            asked.name,
            median(&ratios[0]),
            quantile(&ratios[0], 0.95)
        ));
        for (medians, ratios) in medians.iter_mut().zip(&ratios) {
            medians.push(median(ratios));
        }
    }
    let ratio = median(&medians[0]);
    let notes = vec![
        format!("median/95th percentile (best known): {}", by_problem.join(", ")),
        format!("by the processor's time {:.3}", median(&medians[1])),
    ];
    Ok(vec![Row {
        figure: "(score + 0.1) at 1 s over best known, all kinds".to_owned(),
        target: "1.10",
        measured: format!("{ratio:.3}"),
        is_met: ratio <= 1.10,
        spent,
        notes,
    }])
}
