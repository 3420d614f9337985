//! How long until a path meets every wish within tolerance, before any correction.

use motion_bench::problems::ASKS;

use super::Bench;
use super::quantile::{median, quantile};
use crate::table::Row;

/// Over all problems and seeds; a run without one counts as infinite.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let runs = bench.runs()?;
    let wall_ms = |name: Option<&str>| -> Vec<f64> {
        let runs = runs.runs.iter().filter(|run| name.is_none_or(|name| run.ask.name == name));
        let first = runs.map(|run| run.first_acceptable);
        first.map(|f| f.map_or(f64::INFINITY, |spent| spent.wall.as_secs_f64() * 1e3)).collect()
    };
    let cpu_ms: Vec<f64> = runs
        .runs
        .iter()
        .map(|run| run.first_acceptable.map_or(f64::INFINITY, |s| s.cpu.as_secs_f64() * 1e3))
        .collect();
    let all = wall_ms(None);
    let by_problem: Vec<String> = ASKS
        .iter()
        .map(|ask| {
            let of = wall_ms(Some(ask.name));
            format!("{} {:.0}/{:.0}", &ask.name[..2], median(&of), quantile(&of, 0.95))
        })
        .collect();
    let notes = vec![
        format!("by problem, median/95th percentile in ms: {}", by_problem.join(", ")),
        format!(
            "CPU time until then: median {:.0} ms, 95th percentile {:.0} ms",
            median(&cpu_ms),
            quantile(&cpu_ms, 0.95)
        ),
    ];
    let row = |figure: &str, target, limit_ms: f64, share: f64, notes| {
        let ms = quantile(&all, share);
        Row {
            figure: figure.to_owned(),
            target,
            measured: format!("{ms:.1} ms"),
            is_met: ms <= limit_ms,
            spent: runs.searching,
            notes,
        }
    };
    Ok(vec![
        row("first acceptable motion, median", "10 ms", 10.0, 0.5, notes),
        row("first acceptable motion, 95th percentile", "500 ms", 500.0, 0.95, Vec::new()),
    ])
}
