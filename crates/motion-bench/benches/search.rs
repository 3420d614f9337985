//! Scoring candidates, and the way to a first acceptable motion.
#![allow(missing_docs, reason = "criterion's macros make public items")]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use motion_bench::clips::{Source, build, search_library};
use motion_bench::problems::ASKS;
use motion_core::cancel::CancelToken;
use motion_core::search::{Search, SearchLibrary};

/// Rounds after which a search that has found nothing acceptable is given up.
const MAX_ROUNDS: usize = 200;

fn search_for(library: &Arc<SearchLibrary>, nth: usize, seed: u64) -> Search {
    let problem = ASKS[nth].problem(library.graph().n_clips());
    Search::new(Arc::clone(library), problem, seed).expect("a problem")
}

fn search(criterion: &mut Criterion) {
    let clips = Source::find().load().expect("the clips can be loaded");
    let library = search_library(build(clips, false).expect("a graph"));
    let go = CancelToken::new();
    let mut group = criterion.benchmark_group("candidates");
    group.sample_size(10);
    for (nth, ask) in ASKS.iter().enumerate() {
        let mut search = search_for(&library, nth, 1);
        for _ in 0..12 {
            search.step(&go);
        }
        let Some(best) = search.best() else { continue };
        let Some(all) = search.score_neighbourhood(&best.path) else { continue };
        group.throughput(Throughput::Elements(all.counts.scored));
        group.bench_function(ask.name, |b| {
            b.iter(|| search.score_neighbourhood(black_box(&best.path)));
        });
    }
    group.finish();
    let mut group = criterion.benchmark_group("first acceptable");
    group.sample_size(10);
    for (nth, ask) in ASKS.iter().enumerate() {
        // A fresh seed each time: the mean over seeds is what a person waits for.
        let mut seed = 0;
        group.bench_function(ask.name, |b| {
            b.iter_batched(
                || {
                    seed += 1;
                    search_for(&library, nth, seed)
                },
                |mut search| {
                    for _ in 0..MAX_ROUNDS {
                        search.step(&go);
                        if search.progress().first_acceptable.is_some() {
                            break;
                        }
                    }
                    search
                },
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, search);
criterion_main!(benches);
