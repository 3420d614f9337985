//! Building a library, each time in a process of its own, so that its peak memory is its own.

use std::process::Command;
use std::time::Duration;

use anyhow::{Context as _, ensure};
use motion_bench::clips::{Source, build};
use motion_bench::stopwatch::{Spent, timed};

use super::Bench;
use super::quantile::median;
use crate::machine::peak_memory_mib;
use crate::table::Row;

/// The promise is made for two cores; more would only flatter.
const N_THREADS: usize = 2;

/// What the child says, in this order.
#[derive(Clone, Copy, Debug)]
struct Said {
    n_clips: f64,
    n_frames: f64,
    n_edges: f64,
    wall_s: f64,
    cpu_s: f64,
    peak_mib: f64,
    peak_before_mib: f64,
}

/// The body of the child: loads the clips, builds, prints seven numbers.
pub(crate) fn build_once(source: &Source, mirrored: bool) -> anyhow::Result<()> {
    rayon::ThreadPoolBuilder::new().num_threads(N_THREADS).build_global()?;
    let clips = source.load()?;
    let peak_before_mib = peak_memory_mib().unwrap_or(f64::NAN);
    let (file, spent) = timed(|| build(clips, mirrored));
    let file = file?;
    let n_edges = file.graph.forest.edges_per_level().last().copied().unwrap_or_default();
    println!(
        "{} {} {n_edges} {} {} {} {peak_before_mib}",
        file.clips.clips().len(),
        file.clips.n_frames(),
        spent.wall.as_secs_f64(),
        spent.cpu.as_secs_f64(),
        peak_memory_mib().unwrap_or(f64::NAN),
    );
    Ok(())
}

/// Clips as they are.
pub(crate) fn plain(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let said = children(bench.effort.n_builds, "plain")?;
    let mut row = row("library build (import excluded)", "1 s on 2 cores", 1.0, &said);
    row.notes.push(describe(&said));
    let peak_mib = said.iter().map(|said| said.peak_mib).fold(0.0, f64::max);
    let before_mib = said.iter().map(|said| said.peak_before_mib).fold(0.0, f64::max);
    let memory = Row {
        figure: "library build, peak memory".to_owned(),
        target: "600 MB",
        measured: format!("{peak_mib:.0} MiB"),
        is_met: peak_mib * 1.048_576 <= 600.0,
        spent: Spent::default(),
        notes: vec![format!("of the whole process; {before_mib:.0} MiB while importing")],
    };
    Ok(vec![row, memory])
}

/// Clips and their mirror images.
pub(crate) fn mirrored(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let said = children(bench.effort.n_builds, "mirrored")?;
    let mut row = row("library build, mirrored", "4 s on 2 cores", 4.0, &said);
    let peak_mib = said.iter().map(|said| said.peak_mib).fold(0.0, f64::max);
    row.notes.push(format!("{}; peak memory {peak_mib:.0} MiB", describe(&said)));
    Ok(vec![row])
}

fn children(n: usize, which: &str) -> anyhow::Result<Vec<Said>> {
    let program = std::env::current_exe().context("where this program is")?;
    let mut said = Vec::new();
    for _ in 0..n {
        let output = Command::new(&program).args(["--build-once", which]).output()?;
        let error = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "a build failed: {error}");
        let text = String::from_utf8(output.stdout)?;
        let numbers: Vec<f64> =
            text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        let [n_clips, n_frames, n_edges, wall_s, cpu_s, peak_mib, peak_before_mib] =
            <[f64; 7]>::try_from(numbers).ok().context("a build said something else")?;
        said.push(Said { n_clips, n_frames, n_edges, wall_s, cpu_s, peak_mib, peak_before_mib });
    }
    Ok(said)
}

/// A build's own time is the measured one, so that is what the time columns show.
fn row(figure: &str, target: &'static str, limit_s: f64, said: &[Said]) -> Row {
    let wall_s = median(&said.iter().map(|said| said.wall_s).collect::<Vec<f64>>());
    let cpu_s = median(&said.iter().map(|said| said.cpu_s).collect::<Vec<f64>>());
    Row {
        figure: figure.to_owned(),
        target,
        measured: format!("{wall_s:.2} s"),
        is_met: wall_s <= limit_s,
        spent: Spent { wall: Duration::from_secs_f64(wall_s), cpu: Duration::from_secs_f64(cpu_s) },
        notes: Vec::new(),
    }
}

fn describe(said: &[Said]) -> String {
    let Some(first) = said.first() else { return String::new() };
    let least = said.iter().map(|said| said.wall_s).fold(f64::INFINITY, f64::min);
    format!(
        "{} clips, {} frames, {} leaf edges; median of {}, the best {least:.2} s",
        first.n_clips,
        first.n_frames,
        first.n_edges,
        said.len()
    )
}
