//! The same seed and rounds on 1, 2 and 8 threads.

use std::sync::Arc;

use motion_bench::stopwatch::{Spent, timed};
use motion_core::cancel::CancelToken;
use motion_core::search::{Search, SearchKind};
use rayon::ThreadPoolBuilder;

use super::Bench;
use super::runs::add;
use crate::table::Row;

const N_THREADS: [usize; 3] = [1, 2, 8];

const N_ROUNDS: usize = 12;

/// Compares everything that the searches know, of every problem and every search.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, all) = (bench.library()?, bench.asked()?);
    let mut spent = Spent::default();
    let (mut n, mut different) = (0, Vec::new());
    for asked in all.iter() {
        for kind in SearchKind::ALL {
            // The rivals' rounds are long: fewer show as much.
            let n_rounds = if kind == SearchKind::Af02 { 2 } else { N_ROUNDS };
            let mut found = Vec::new();
            for n_threads in N_THREADS {
                let pool = ThreadPoolBuilder::new().num_threads(n_threads).build()?;
                let (known, once) = timed(|| {
                    pool.install(|| {
                        let problem = asked.problem.clone();
                        let mut search = Search::of_kind(Arc::clone(&library), problem, 1, kind)?;
                        for _ in 0..n_rounds {
                            search.step(&CancelToken::new());
                        }
                        anyhow::Ok((search.progress(), search.alternatives(), search.best()))
                    })
                });
                add(&mut spent, once);
                found.push(known?);
            }
            n += 1;
            if found.iter().any(|other| *other != found[0]) {
                different.push(format!("{} {}", asked.name, kind.name()));
            }
        }
    }
    Ok(vec![Row {
        figure: "1, 2 and 8 threads find".to_owned(),
        target: "the same",
        measured: if different.is_empty() { "the same" } else { "something else" }.to_owned(),
        is_met: different.is_empty(),
        spent,
        notes: vec![format!(
            "{n} searches, 2 to {N_ROUNDS} rounds each; different: {}",
            if different.is_empty() { "none".to_owned() } else { different.join(", ") }
        )],
    }])
}
