//! Candidates a second on one core, each with its whole score.

use std::hint::black_box;
use std::sync::Arc;

use motion_bench::problems::ASKS;
use motion_bench::stopwatch::{Spent, timed};
use motion_core::cancel::CancelToken;
use motion_core::path::Path;
use motion_core::search::{Search, SearchLibrary};

use super::Bench;
use super::quantile::median;
use super::runs::add;
use crate::table::Row;

/// Rounds that bring a search to paths such as it spends its time on.
const N_ROUNDS: usize = 12;

/// Times that each path's neighbourhood is scored; the median counts, since a pass takes a tenth
/// of a second and a machine with other work to do is uneven.
const N_PASSES: u32 = 7;

/// Scores all reconnections and detours of a path of each problem.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let mut spent = Spent::default();
    let mut n_scored = 0;
    let mut rates = Vec::new();
    // What all paths would take at their median rates.
    let mut median_s = 0.0;
    for nth in 0..ASKS.len() {
        let Some((search, path)) = a_path(&library, nth)? else { continue };
        let mut n = 0;
        let mut passes_s = Vec::new();
        for _ in 0..N_PASSES {
            let (found, once) = timed(|| search.score_neighbourhood(black_box(&path)));
            n = found.map_or(0, |found| found.counts.scored);
            passes_s.push(once.cpu.as_secs_f64());
            add(&mut spent, once);
        }
        let pass_s = median(&passes_s);
        n_scored += n;
        median_s += pass_s;
        rates.push(n as f64 / pass_s);
    }
    let rate = n_scored as f64 / median_s;
    let rates: Vec<String> = rates.iter().map(|rate| format!("{:.1}", rate / 1e6)).collect();
    let mut notes = vec![format!(
        "{:.1} million reconnections and detours of 5 paths, none bounded; by problem {} million/s; \
         seconds of CPU time, median of {N_PASSES}",
        n_scored as f64 / 1e6,
        rates.join(", ")
    )];
    notes.push(while_searching(bench)?);
    Ok(vec![Row {
        figure: "candidates scored, one core".to_owned(),
        target: "10 million/s",
        measured: format!("{:.1} million/s", rate / 1e6),
        is_met: rate >= 10e6,
        spent,
        notes,
    }])
}

/// What a real search looks at.
fn while_searching(bench: &mut Bench) -> anyhow::Result<String> {
    let runs = bench.runs()?;
    let cpu_s = runs.searching.cpu.as_secs_f64();
    let scored: u64 = runs.runs.iter().map(|run| run.progress.counts.scored).sum();
    let pruned: u64 = runs.runs.iter().map(|run| run.progress.counts.pruned).sum();
    Ok(format!(
        "while searching: {:.2} million/s scored, {:.0} million/s shown to be no better",
        scored as f64 / cpu_s / 1e6,
        pruned as f64 / cpu_s / 1e6
    ))
}

/// A search for problem `nth`, and its best path after some rounds.
fn a_path(library: &Arc<SearchLibrary>, nth: usize) -> anyhow::Result<Option<(Search, Path)>> {
    let problem = ASKS[nth].problem(library.graph().n_clips());
    let mut search = Search::new(Arc::clone(library), problem, 1)?;
    for _ in 0..N_ROUNDS {
        search.step(&CancelToken::new());
    }
    let best = search.best();
    Ok(best.map(|best| (search, best.path)))
}
