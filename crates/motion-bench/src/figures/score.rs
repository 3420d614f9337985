//! How far a second's best is from the best that is known.

use motion_bench::problems::ASKS;
use motion_bench::stopwatch::Spent;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::{add, search_for};
use crate::table::Row;

/// Added to both scores, so that two very good motions are not worlds apart.
const SLACK: f64 = 0.1;

/// Seeds of the long runs begin here: other ones than those of the short runs.
const FIRST_SEED: u64 = 1001;

/// The best known score of a problem is the best of its long runs and of all seeds' runs.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let runs = bench.runs()?;
    let effort = bench.effort;
    let mut spent = Spent::default();
    let mut ratios = Vec::new();
    let mut by_problem = Vec::new();
    for ask in ASKS {
        let scores: Vec<f64> =
            runs.runs.iter().filter(|run| run.ask.name == ask.name).map(|run| run.score).collect();
        let mut best = scores.iter().copied().fold(f64::INFINITY, f64::min);
        for seed in FIRST_SEED..FIRST_SEED + effort.n_long_runs {
            let (search, once, _) = search_for(&library, &ask, seed, effort.long_run)?;
            best = best.min(f64::from(search.progress().best));
            add(&mut spent, once);
        }
        let of: Vec<f64> = scores.iter().map(|score| (score + SLACK) / (best + SLACK)).collect();
        by_problem.push(format!("{} {:.3} ({best:.3})", &ask.name[..2], median(&of)));
        ratios.extend(of);
    }
    let ratio = median(&ratios);
    Ok(vec![Row {
        figure: "(score + 0.1) at 1 s over best known, median".to_owned(),
        target: "1.15",
        measured: format!("{ratio:.3} (95th {:.2})", quantile(&ratios, 0.95)),
        is_met: ratio <= 1.15,
        spent,
        notes: vec![format!("by problem, median (best known): {}", by_problem.join(", "))],
    }])
}
