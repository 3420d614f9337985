//! Making motions of paths.
#![allow(missing_docs, reason = "criterion's macros make public items")]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use motion_bench::clips::{Source, build, search_library};
use motion_bench::finish::Order;
use motion_bench::problems::{ASKS, a_minute};
use motion_core::assemble::Assembler;
use motion_core::cancel::CancelToken;
use motion_core::search::{Problem, Search};

fn assembly(criterion: &mut Criterion) {
    let clips = Source::find().load().expect("the clips can be loaded");
    let library = search_library(build(clips, false).expect("a graph"));
    let n_clips = library.graph().n_clips();
    let assembler = Assembler::new(library.clips());
    let order = |problem: Problem| {
        let mut search = Search::new(Arc::clone(&library), problem, 1).expect("a problem");
        while search.best().is_none() {
            search.step(&CancelToken::new());
        }
        let solution = search.best().expect("the loop ends with one");
        Order::new(&search, &solution).expect("a solution can be judged")
    };
    let mut group = criterion.benchmark_group("assembly");
    group.sample_size(20);
    for (name, order) in
        [("240 frames", order(ASKS[0].problem(n_clips))), ("1800 frames", order(a_minute(n_clips)))]
    {
        group.bench_function(name, |b| {
            b.iter(|| order.assemble(black_box(&assembler)).expect("an order that can be made"));
        });
    }
    group.finish();
}

criterion_group!(benches, assembly);
criterion_main!(benches);
