//! Making a motion of a minute.

use std::hint::black_box;
use std::sync::Arc;

use anyhow::Context as _;
use motion_bench::finish::Order;
use motion_bench::problems::a_minute;
use motion_bench::stopwatch::{Spent, timed};
use motion_core::assemble::Assembler;
use motion_core::cancel::CancelToken;
use motion_core::search::Search;

use super::Bench;
use super::quantile::median;
use super::runs::add;
use crate::table::Row;

const N_TIMES: u32 = 51;

/// Assembles a path of 1,800 frames with everything on: seams, corrections, feet.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let problem = a_minute(library.graph().n_clips());
    let mut search = Search::new(Arc::clone(&library), problem, 1)?;
    while search.best().is_none() && search.progress().iteration < 50 {
        search.step(&CancelToken::new());
    }
    let solution = search.best().context("no path of 1,800 frames was found")?;
    let order = Order::new(&search, &solution)?;
    let assembler = Assembler::new(library.clips());
    let mut walls_ms = Vec::new();
    let mut spent = Spent::default();
    let mut n_frames = 0;
    for _ in 0..N_TIMES {
        let (made, once) = timed(|| order.assemble(black_box(&assembler)));
        n_frames = made?.motion.n_frames();
        walls_ms.push(once.wall.as_secs_f64() * 1e3);
        add(&mut spent, once);
    }
    let ms = median(&walls_ms);
    let cpu_ms = spent.cpu.as_secs_f64() * 1e3 / f64::from(N_TIMES);
    Ok(vec![Row {
        figure: "assembly of 1,800 frames".to_owned(),
        target: "5 ms",
        measured: format!("{ms:.2} ms"),
        is_met: ms <= 5.0,
        spent,
        notes: vec![format!(
            "{n_frames} frames, {} pieces, 2 constraints; median of {N_TIMES}; {cpu_ms:.2} ms of \
             CPU time each",
            order.pieces.len()
        )],
    }])
}
