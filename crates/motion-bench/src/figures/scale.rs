//! How building grows with the number of frames, and how soon a motion is found then; each build in
//! a process of its own, so that its peak memory is its own. Many frames are copies of the clips
//! (`many_frames`).

use std::process::Command;
use std::sync::Arc;
use std::time::Duration;

use anyhow::{Context as _, ensure};
use motion_bench::clips::{Source, build, search_library};
use motion_bench::many_frames::many_frames;
use motion_bench::problems::{ASKS, Ask};
use motion_bench::stopwatch::{Spent, Stopwatch, timed};
use motion_core::cancel::CancelToken;
use motion_core::search::{Search, SearchLibrary};

use super::Bench;
use super::quantile::median;
use crate::effort::Effort;
use crate::machine::peak_memory_mib;
use crate::table::Row;

/// The promise is made for two cores.
const N_THREADS: usize = 2;

/// Where the copies' disturbances start.
const SEED: u64 = 1;

/// The most memory of a build, GB, and the most time of the largest, seconds.
const MAX_PEAK_GB: f64 = 4.0;
const MAX_WALL_S: f64 = 600.0;

/// Time grows at most with this power of the number of frames.
const MAX_EXPONENT: f64 = 1.3;

/// How soon the first acceptable motion is there on the largest, median, milliseconds, and the seeds
/// that each problem is tried with.
const MAX_FIRST_MS: f64 = 100.0;
const N_SEEDS: u64 = 5;

/// How long it is waited for at most.
const PATIENCE: Duration = Duration::from_secs(2);

/// What the child says, in this order.
#[derive(Clone, Copy, Debug)]
struct Said {
    n_frames: f64,
    n_edges: f64,
    wall_s: f64,
    cpu_s: f64,
    peak_mib: f64,
    arranging_s: f64,
    first_ms: f64,
}

/// The body of the child: makes the set, builds, searches, prints seven numbers.
pub(crate) fn scale_once(source: &Source, n_frames: usize) -> anyhow::Result<()> {
    rayon::ThreadPoolBuilder::new().num_threads(N_THREADS).build_global()?;
    let clips = many_frames(source.load()?, n_frames, SEED)?;
    let (file, spent) = timed(|| build(clips, false));
    let file = file?;
    let n_edges = file.graph.forest.edges_per_level().last().copied().unwrap_or_default();
    let (n_frames, peak_mib) = (file.clips.n_frames(), peak_memory_mib().unwrap_or(f64::NAN));
    let (library, arranging) = timed(|| search_library(file));
    let mut first_ms = Vec::new();
    for ask in ASKS {
        for seed in 1..=N_SEEDS {
            first_ms.push(first_acceptable_ms(&library, &ask, seed)?);
        }
    }
    println!(
        "{n_frames} {n_edges} {} {} {peak_mib} {} {}",
        spent.wall.as_secs_f64(),
        spent.cpu.as_secs_f64(),
        arranging.wall.as_secs_f64(),
        median(&first_ms),
    );
    Ok(())
}

/// How long until a path meets every wish within tolerance.
fn first_acceptable_ms(library: &Arc<SearchLibrary>, ask: &Ask, seed: u64) -> anyhow::Result<f64> {
    let (cancel, watch) = (CancelToken::new(), Stopwatch::new());
    let problem = ask.problem(library.graph().n_clips());
    let mut search = Search::new(Arc::clone(library), problem, seed)?;
    while search.progress().first_acceptable.is_none() {
        search.step(&cancel);
        if watch.spent().wall > PATIENCE {
            return Ok(f64::INFINITY);
        }
    }
    Ok(watch.spent().wall.as_secs_f64() * 1e3)
}

/// The largest set whose edges are all kept, the smallest that keeps the best, and a large one: a
/// million frames with full effort.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let large = if bench.effort == Effort::of(false, true) { 1_000_000 } else { 100_000 };
    let small = child(49_000)?;
    let smallest_alike = child(60_000)?;
    let large = child(large)?;
    // CPU time is what other work on the machine changes least.
    let growth =
        |from: Said| (large.cpu_s / from.cpu_s).ln() / (large.n_frames / from.n_frames).ln();
    let exponent = growth(small);
    let peak_gb = large.peak_mib * 1.048_576e-3;
    let spent = |said: Said| Spent {
        wall: Duration::from_secs_f64(said.wall_s),
        cpu: Duration::from_secs_f64(said.cpu_s),
    };
    let describe = |said: Said| {
        format!(
            "{} frames: {:.1} s, {:.1} CPU s, {} leaf edges, peak {:.0} MiB",
            said.n_frames, said.wall_s, said.cpu_s, said.n_edges, said.peak_mib
        )
    };
    Ok(vec![
        Row {
            figure: format!("library build, {} frames", large.n_frames),
            target: "600 s on 2 cores",
            measured: format!("{:.0} s, {peak_gb:.1} GB", large.wall_s),
            is_met: large.wall_s <= MAX_WALL_S && peak_gb <= MAX_PEAK_GB,
            spent: spent(large),
            notes: vec![describe(large)],
        },
        Row {
            figure: "library build, growth".to_owned(),
            target: "exponent 1.3",
            measured: format!("{exponent:.2}"),
            is_met: exponent <= MAX_EXPONENT,
            spent: spent(small),
            notes: vec![
                describe(small),
                format!(
                    "{:.2} from the smallest set that keeps no more than 32 edges a frame: {}",
                    growth(smallest_alike),
                    describe(smallest_alike)
                ),
            ],
        },
        Row {
            figure: format!("first acceptable, {} frames", large.n_frames),
            target: "100 ms median",
            measured: format!("{:.1} ms", large.first_ms),
            is_met: large.first_ms <= MAX_FIRST_MS,
            spent: spent(large),
            notes: vec![format!(
                "problems 01 to 05, {N_SEEDS} seeds each; arranging the library for the search: \
                 {:.1} s",
                large.arranging_s
            )],
        },
    ])
}

fn child(n_frames: usize) -> anyhow::Result<Said> {
    let program = std::env::current_exe().context("where this program is")?;
    let output = Command::new(program).args(["--scale-once", &n_frames.to_string()]).output()?;
    let error = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "a build failed: {error}");
    let text = String::from_utf8(output.stdout)?;
    let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let [n_frames, n_edges, wall_s, cpu_s, peak_mib, arranging_s, first_ms] =
        <[f64; 7]>::try_from(numbers).ok().context("a build said something else")?;
    Ok(Said { n_frames, n_edges, wall_s, cpu_s, peak_mib, arranging_s, first_ms })
}
