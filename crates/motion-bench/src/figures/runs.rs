//! The searches that several figures are read from: every problem, every seed, one second.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use motion_bench::finish::Order;
use motion_bench::problems::{ASKS, Ask};
use motion_bench::stopwatch::{Spent, Stopwatch};
use motion_core::assemble::{Assembled, Assembler};
use motion_core::cancel::CancelToken;
use motion_core::search::{Progress, Search, SearchLibrary};

/// How long each search may take.
const BUDGET: Duration = Duration::from_secs(1);

/// Motions that a solve writes by default.
pub(crate) const N_WRITTEN: usize = 6;

/// Everything that was found.
pub(crate) struct Runs {
    /// Problem by problem, seed by seed.
    pub(crate) runs: Vec<Run>,
    /// Of the searches.
    pub(crate) searching: Spent,
    /// Of making motions of what they found.
    pub(crate) finishing: Spent,
}

/// One search.
pub(crate) struct Run {
    pub(crate) ask: Ask,
    /// When a path first met every wish within tolerance.
    pub(crate) first_acceptable: Option<Spent>,
    /// The best score at the end.
    pub(crate) score: f64,
    /// Where the search stood at the end.
    pub(crate) progress: Progress,
    /// The alternatives at the end as motions, best first.
    pub(crate) motions: Vec<Made>,
}

/// An alternative as a motion.
pub(crate) struct Made {
    pub(crate) order: Order,
    pub(crate) assembled: Assembled,
}

/// Searches for every problem with seeds 1 to `n_seeds`.
pub(crate) fn run_all(library: &Arc<SearchLibrary>, n_seeds: u64) -> anyhow::Result<Runs> {
    let assembler = Assembler::new(library.clips());
    let mut all =
        Runs { runs: Vec::new(), searching: Spent::default(), finishing: Spent::default() };
    for ask in ASKS {
        for seed in 1..=n_seeds {
            let (search, spent, first_acceptable) = search_for(library, &ask, seed, BUDGET)?;
            let watch = Stopwatch::new();
            let mut motions = Vec::new();
            for solution in search.alternatives() {
                let order = Order::new(&search, &solution)?;
                let assembled = order.assemble(&assembler)?;
                motions.push(Made { order, assembled });
            }
            let progress = search.progress();
            let score = f64::from(progress.best);
            all.runs.push(Run { ask, first_acceptable, score, progress, motions });
            add(&mut all.searching, spent);
            add(&mut all.finishing, watch.spent());
        }
    }
    Ok(all)
}

/// Searches for so long. Also says when a path was first acceptable.
pub(crate) fn search_for(
    library: &Arc<SearchLibrary>,
    ask: &Ask,
    seed: u64,
    budget: Duration,
) -> anyhow::Result<(Search, Spent, Option<Spent>)> {
    let problem = ask.problem(library.graph().n_clips());
    let cancel = CancelToken::new();
    let (done, is_done) = std::sync::mpsc::sync_channel::<()>(1);
    let deadline = {
        let cancel = cancel.clone();
        thread::Builder::new().name("deadline".to_owned()).spawn(move || {
            // Ends early when the search does, because `done` is dropped then.
            if is_done.recv_timeout(budget).is_err() {
                cancel.cancel();
            }
        })?
    };
    let watch = Stopwatch::new();
    let mut search = Search::new(Arc::clone(library), problem, seed)?;
    let mut first_acceptable = None;
    while search.step(&cancel) {
        if first_acceptable.is_none() && search.progress().first_acceptable.is_some() {
            first_acceptable = Some(watch.spent());
        }
    }
    let spent = watch.spent();
    drop(done);
    anyhow::ensure!(deadline.join().is_ok(), "the deadline's thread failed");
    Ok((search, spent, first_acceptable))
}

/// Adds up what was spent.
pub(crate) fn add(sum: &mut Spent, more: Spent) {
    sum.wall += more.wall;
    sum.cpu += more.cpu;
}
