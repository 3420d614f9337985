//! How building grows with the number of frames, each build in a process of its own, so that its
//! peak memory is its own. Many frames are copies of the clips (`many_frames`).

use std::process::Command;
use std::time::Duration;

use anyhow::{Context as _, ensure};
use motion_bench::clips::{Source, build};
use motion_bench::many_frames::many_frames;
use motion_bench::stopwatch::{Spent, timed};

use super::Bench;
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

/// What the child says, in this order.
#[derive(Clone, Copy, Debug)]
struct Said {
    n_frames: f64,
    n_edges: f64,
    wall_s: f64,
    cpu_s: f64,
    peak_mib: f64,
}

/// The body of the child: makes the set, builds, prints five numbers.
pub(crate) fn scale_once(source: &Source, n_frames: usize) -> anyhow::Result<()> {
    rayon::ThreadPoolBuilder::new().num_threads(N_THREADS).build_global()?;
    let clips = many_frames(source.load()?, n_frames, SEED)?;
    let (file, spent) = timed(|| build(clips, false));
    let file = file?;
    let n_edges = file.graph.forest.edges_per_level().last().copied().unwrap_or_default();
    println!(
        "{} {n_edges} {} {} {}",
        file.clips.n_frames(),
        spent.wall.as_secs_f64(),
        spent.cpu.as_secs_f64(),
        peak_memory_mib().unwrap_or(f64::NAN),
    );
    Ok(())
}

/// The largest set whose edges are all kept, and a large one: a million frames with full effort.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let large = if bench.effort == Effort::of(false, true) { 1_000_000 } else { 100_000 };
    let small = child(49_000)?;
    let large = child(large)?;
    // CPU time is what other work on the machine changes least.
    let exponent = (large.cpu_s / small.cpu_s).ln() / (large.n_frames / small.n_frames).ln();
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
            notes: vec![describe(small)],
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
    let [n_frames, n_edges, wall_s, cpu_s, peak_mib] =
        <[f64; 5]>::try_from(numbers).ok().context("a build said something else")?;
    Ok(Said { n_frames, n_edges, wall_s, cpu_s, peak_mib })
}
