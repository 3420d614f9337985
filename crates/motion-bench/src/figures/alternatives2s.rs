//! How many different motions there are to choose from after two seconds.

use std::time::Duration;

use motion_bench::stopwatch::Spent;
use motion_core::search::SearchKind;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use super::trials::{Until, follow};
use crate::table::Row;

const BUDGET: Duration = Duration::from_secs(2);

/// Projects up to this number.
const LAST: &str = "08";

/// Each.
const WANTED: f64 = 6.0;

/// As the search counts them, which asks for a fifth more between two motions than being distinct
/// takes, since correction brings them nearer to each other. By the clock.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, all) = (bench.library()?, bench.asked()?);
    let mut spent = Spent::default();
    let (mut medians, mut by_problem) = (Vec::new(), Vec::new());
    for asked in all.iter().filter(|asked| asked.name.as_str() <= LAST) {
        let mut counts = Vec::new();
        for seed in 1..=bench.effort.n_trials {
            let (chance, until) = ((seed, SearchKind::Gaitway), Until::Clock(BUDGET));
            let trial = follow(&library, &asked.problem, chance, until)?;
            counts.push(trial.search.alternatives().len() as f64);
            add(&mut spent, trial.spent);
        }
        by_problem.push(format!("{} {}/{}", asked.name, quantile(&counts, 0.0), median(&counts)));
        medians.push(median(&counts));
    }
    let least = quantile(&medians, 0.0);
    Ok(vec![Row {
        figure: "distinct alternatives after 2 s, each problem".to_owned(),
        target: "6",
        measured: format!("{least} in the worst, {} in the middle", median(&medians)),
        is_met: least >= WANTED,
        spent,
        notes: vec![format!("least/median of the seeds: {}", by_problem.join(", "))],
    }])
}
