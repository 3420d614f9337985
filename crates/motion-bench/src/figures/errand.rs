//! A minute through ten checkpoints: how soon every one is within tolerance.

use std::time::Duration;

use motion_bench::stopwatch::Spent;
use motion_core::search::SearchKind;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use super::trials::{Clock, Until, follow};
use crate::table::Row;

/// The project's number.
const ERRAND: &str = "08";

const LIMIT: Duration = Duration::from_secs(10);

/// Over the seeds; a search without one counts as infinite.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, all) = (bench.library()?, bench.asked()?);
    let Some(asked) = all.iter().find(|asked| asked.name == ERRAND) else { return Ok(vec![]) };
    let mut spent = Spent::default();
    let (mut wall, mut cpu) = (Vec::new(), Vec::new());
    for seed in 1..=bench.effort.n_trials {
        let until = Until::Acceptable(LIMIT);
        let trial = follow(&library, &asked.problem, (seed, SearchKind::Gaitway), until)?;
        wall.push(trial.first_s(Clock::Wall));
        cpu.push(trial.first_s(Clock::Processor));
        add(&mut spent, trial.spent);
    }
    let secs = median(&wall);
    Ok(vec![Row {
        figure: "a minute's ten checkpoints within tolerance".to_owned(),
        target: "1 s",
        measured: format!("{secs:.2} s (95th {:.2})", quantile(&wall, 0.95)),
        is_met: secs <= 1.0,
        spent,
        notes: vec![format!(
            "by the processor's time {:.2} s (95th {:.2}); {} of {} seeds within {} s",
            median(&cpu),
            quantile(&cpu, 0.95),
            wall.iter().filter(|s| s.is_finite()).count(),
            wall.len(),
            LIMIT.as_secs()
        )],
    }])
}
