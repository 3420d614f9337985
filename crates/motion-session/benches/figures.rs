//! The figures that users feel: how long a library takes, how fast the search is, how soon a first
//! motion is there, how long its assembly takes.
//!
//! On the shared motion capture where there is some, else on the built-in clips. `cargo xtask bench`
//! prints all medians as one table.
#![allow(clippy::print_stdout, reason = "a benchmark has something to say")]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group};
use motion_core::assemble::{Assembler, Piece, Plan, Policies};
use motion_core::cancel::CancelToken;
use motion_core::ids::ClipId;
use motion_core::planar::PlanarTransform;
use motion_core::search::{Problem, Search, SearchLibrary};
use motion_core::units::FrameIdx;
use motion_io::diagnostic::Warnings;
use motion_io::import::ImportOptions;
use motion_io::library_file::LibraryFile;
use motion_io::project_file;
use motion_session::library_job::{Clips, GraphChoices, build, import, with_mirror_images};
use motion_session::library_source::builtin_clips;
use motion_session::problem::problem_of;
use motion_session::{Library, sample};

/// Seeds that a figure over many searches is taken over.
const SEEDS: std::ops::Range<u64> = 1..21;

fn clips() -> (Clips, Option<PathBuf>) {
    let Some(shared) = motion_tests::shared_dir() else {
        return (builtin_clips().expect("our own clips"), None);
    };
    let inputs = [shared.join("mocap/cmu")];
    let cancel = CancelToken::new();
    let (options, mut warnings) = (ImportOptions::default(), Warnings::new());
    let (clips, _) =
        import(&inputs, &options, &cancel, &mut warnings, &|_, _| ()).expect("readable clips");
    (clips, Some(shared))
}

fn built(clips: &Clips) -> LibraryFile {
    let choices = GraphChoices::default();
    build(clips.clone(), &choices, &CancelToken::new(), &|_, _| ()).expect("a library")
}

/// The problems to search: the shared ones 01 to 05, or the sample.
fn problems(library: &Library, shared: Option<&Path>) -> Vec<(String, Problem)> {
    let projects = match shared {
        None => vec![sample::sample().expect("the sample is a project")],
        Some(shared) => {
            let names = [
                "01-straight-walk",
                "02-left-corner",
                "03-three-checkpoints",
                "04-run",
                "05-about-turn",
            ];
            let load = |name: &str| {
                let path = shared.join(format!("problems/{name}.gaitway"));
                project_file::load(&path, &mut Warnings::new()).expect("a project")
            };
            names.map(load).into()
        }
    };
    let problem = |project: &project_file::Project| {
        let path = Path::new(&project.name);
        let found = problem_of(project, &project.characters[0], library, true, path);
        (project.name.clone(), found.expect("a problem").problem)
    };
    projects.iter().map(problem).collect()
}

fn library_build(c: &mut Criterion) {
    let (clips, _) = clips();
    let mirrored = with_mirror_images(clips.clone());
    let mut group = c.benchmark_group("library");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    group.bench_function("graph", |b| b.iter(|| built(&clips)));
    group.bench_function("graph_mirrored", |b| b.iter(|| built(&mirrored)));
    let file = built(&clips);
    let dir = tempfile::tempdir().expect("room for a file");
    let path = dir.path().join("bench.gwlib");
    group.bench_function("save", |b| b.iter(|| file.save(&path)));
    group.bench_function("load", |b| b.iter(|| LibraryFile::load(&path)));
    group.finish();
}

fn search(c: &mut Criterion) {
    let (clips, shared) = clips();
    let library = Library::new(built(&clips), None);
    let ready =
        Arc::new(SearchLibrary::new(Arc::clone(&library.clips), Arc::clone(&library.graph)));
    let problems = problems(&library, shared.as_deref());
    let never = CancelToken::new();
    let mut group = c.benchmark_group("search");
    group.sample_size(10);
    for (name, problem) in &problems {
        group.bench_function(format!("first_acceptable/{name}"), |b| {
            b.iter_custom(|n| {
                let mut seed = 0;
                let mut total = Duration::ZERO;
                for _ in 0..n {
                    seed += 1;
                    total +=
                        first_acceptable(&ready, problem, seed).unwrap_or(Duration::from_secs(5));
                }
                total
            });
        });
    }
    group.finish();

    println!("\nfirst acceptable motion, {} seeds:       median    95th percentile", SEEDS.count());
    for (name, problem) in &problems {
        let mut times: Vec<f64> = SEEDS
            .map(|seed| {
                first_acceptable(&ready, problem, seed).map_or(f64::INFINITY, |t| t.as_secs_f64())
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let at = |share: f64| 1e3 * times[(share * (times.len() - 1) as f64).round() as usize];
        println!("  {name:<34} {:>9.1} ms {:>9.1} ms", at(0.5), at(0.95));
    }
    println!("candidates scored per second and thread, pruned ones apart:");
    for (name, problem) in &problems {
        let mut search = Search::new(Arc::clone(&ready), problem.clone(), 1).expect("a problem");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let start = Instant::now();
        pool.install(|| while start.elapsed() < Duration::from_secs(2) && search.step(&never) {});
        let per_s = |n: u64| n as f64 / start.elapsed().as_secs_f64() / 1e6;
        let counts = search.progress().counts;
        println!(
            "  {name:<34} {:>9.2} million scored, {:.2} million pruned",
            per_s(counts.scored),
            per_s(counts.pruned)
        );
    }
}

/// Time to a first acceptable motion; `None` after five seconds without.
fn first_acceptable(
    library: &Arc<SearchLibrary>,
    problem: &Problem,
    seed: u64,
) -> Option<Duration> {
    let start = Instant::now();
    let mut search = Search::new(Arc::clone(library), problem.clone(), seed).expect("a problem");
    let never = CancelToken::new();
    while search.progress().first_acceptable.is_none() {
        if start.elapsed() > Duration::from_secs(5) {
            return None;
        }
        search.step(&never);
    }
    Some(start.elapsed())
}

/// 1800 frames in pieces of about a second.
fn assembly(c: &mut Criterion) {
    let (clips, _) = clips();
    let assembler = Assembler::new(&clips.set);
    let long = clips.set.clips().iter().enumerate().filter(|(_, clip)| clip.n_frames() > 60);
    let piece = |(clip, _): (usize, _)| Piece {
        clip: ClipId::from_idx(clip),
        from: FrameIdx(10),
        to: FrameIdx(39),
    };
    let pieces: Vec<Piece> = long.map(piece).cycle().take(60).collect();
    let plan =
        Plan { pieces: &pieces, start: PlanarTransform::IDENTITY, targets: &[], hard_frames: &[] };
    c.bench_function("assembly/1800_frames", |b| {
        b.iter(|| assembler.assemble(&plan, Policies::BEST).expect("a plan"));
    });
}

criterion_group!(benches, library_build, search, assembly);

fn main() {
    benches();
    Criterion::default().configure_from_args().final_summary();
}
