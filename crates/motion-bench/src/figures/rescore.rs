//! What is known, scored anew after one constraint was changed.

use std::sync::Arc;

use anyhow::Context as _;
use glam::Vec2;
use motion_bench::stopwatch::{Spent, timed};
use motion_core::cancel::CancelToken;
use motion_core::path::Path;
use motion_core::search::Search;

use super::Bench;
use super::quantile::{median, quantile};
use super::runs::add;
use crate::table::Row;

/// Paths that are known.
const N_PATHS: usize = 200;

/// Rounds after which it is given up to gather so many.
const MAX_ROUNDS: usize = 400;

const N_PASSES: usize = 21;

/// The last checkpoint is moved by 0.3 m; everything known becomes part of a search for that.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, all) = (bench.library()?, bench.asked()?);
    let asked = all.first().context("no problem was found")?;
    let mut search = Search::new(Arc::clone(&library), asked.problem.clone(), 1)?;
    let mut paths: Vec<Path> = Vec::new();
    for _ in 0..MAX_ROUNDS {
        search.step(&CancelToken::new());
        for path in search.paths() {
            if paths.len() < N_PATHS && !paths.contains(&path) {
                paths.push(path);
            }
        }
    }
    let mut changed = asked.problem.clone();
    if let Some(last) = changed.wishes.body.last_mut() {
        last.position_m += Vec2::new(0.3, 0.0);
    }
    let mut spent = Spent::default();
    let (mut wall_ms, mut cpu_ms) = (Vec::new(), Vec::new());
    for _ in 0..N_PASSES {
        let (made, once) =
            timed(|| Search::with_paths(Arc::clone(&library), changed.clone(), 1, &paths));
        made?;
        wall_ms.push(once.wall.as_secs_f64() * 1e3);
        cpu_ms.push(once.cpu.as_secs_f64() * 1e3);
        add(&mut spent, once);
    }
    let ms = median(&wall_ms);
    Ok(vec![Row {
        figure: format!("{} known paths scored anew", paths.len()),
        target: "5 ms",
        measured: format!("{ms:.2} ms (95th {:.2})", quantile(&wall_ms, 0.95)),
        is_met: ms < 5.0 && paths.len() == N_PATHS,
        spent,
        notes: vec![format!(
            "all threads' time {:.2} ms; fastest and slowest of {N_PASSES} by the clock {:.2} and {:.2} \
             ms; sorting out which are the same motion is in it",
            median(&cpu_ms),
            quantile(&wall_ms, 0.0),
            quantile(&wall_ms, 1.0)
        )],
    }])
}
