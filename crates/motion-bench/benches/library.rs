//! From files to a library that can be searched.
#![allow(missing_docs, reason = "criterion's macros make public items")]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use motion_bench::clips::{Source, build};
use motion_core::search::SearchLibrary;
use motion_io::library_file::LibraryFile;

fn library(criterion: &mut Criterion) {
    let source = Source::find();
    let clips = source.load().expect("the clips can be loaded");
    let mut group = criterion.benchmark_group("library");
    group.sample_size(10);
    let import = match source {
        Source::Cmu(_) => "import",
        Source::BuiltIn => "perform",
    };
    group.bench_function(import, |b| b.iter(|| source.load().expect("it did before")));
    for (name, mirror) in [("build", false), ("build mirrored", true)] {
        group.bench_function(name, |b| {
            let make = |clips| build(black_box(clips), mirror).expect("a graph");
            b.iter_batched(|| clips.clone(), make, BatchSize::PerIteration);
        });
    }
    let file = build(clips, false).expect("a graph");
    let (set, graph) = (Arc::new(file.clips.clone()), Arc::new(file.graph.clone()));
    group.bench_function("arrange for searching", |b| {
        b.iter(|| SearchLibrary::new(Arc::clone(&set), Arc::clone(&graph)));
    });
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("bench.gwlib");
    file.save(&path).expect("it can be saved");
    group.bench_function("load", |b| {
        b.iter(|| LibraryFile::load(&path).expect("it was just saved"));
    });
    group.finish();
}

criterion_group!(benches, library);
criterion_main!(benches);
