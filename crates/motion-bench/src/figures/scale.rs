//! Building libraries of up to a million frames, each in a process of its own, so that its peak
//! memory is its own.

use std::sync::Mutex;
use std::time::Instant;

use motion_bench::clips::Source;
use motion_bench::many_frames::many_frames;
use motion_bench::stopwatch::{Stopwatch, timed};
use motion_core::cancel::CancelToken;
use motion_session::library_job::{self, GraphChoices};

use crate::machine::peak_memory_mib;

/// The promise is made for two cores.
const N_THREADS: usize = 2;

/// Where the copies' disturbances start.
const SEED: u64 = 1;

/// The body of the child: makes the set, builds, says what that took.
pub(crate) fn scale_once(source: &Source, n_frames: usize) -> anyhow::Result<()> {
    rayon::ThreadPoolBuilder::new().num_threads(N_THREADS).build_global()?;
    let (clips, spent) = timed(|| many_frames(source.load()?, n_frames, SEED));
    let clips = clips?;
    eprintln!(
        "made in {:.1} s, {:.0} MiB",
        spent.wall.as_secs_f64(),
        peak_memory_mib().unwrap_or_default()
    );
    let watch = Stopwatch::new();
    let stage = Mutex::new((String::new(), Instant::now()));
    let on_progress = |what: &str, _share: f64| {
        let Ok(mut stage) = stage.lock() else { return };
        if stage.0 != what {
            let spent = watch.spent();
            eprintln!(
                "{what}: at {:.1} s, {:.1} CPU s, {:.0} MiB",
                spent.wall.as_secs_f64(),
                spent.cpu.as_secs_f64(),
                peak_memory_mib().unwrap_or_default()
            );
            *stage = (what.to_owned(), Instant::now());
        }
    };
    let file =
        library_job::build(clips, &GraphChoices::default(), &CancelToken::new(), &on_progress)?;
    let spent = watch.spent();
    let forest = &file.graph.forest;
    println!(
        "{} clips {} frames tau {} levels {:?} nodes {} pairs {} parts {} {}; wall {} cpu {} peak {}",
        file.clips.clips().len(),
        file.clips.n_frames(),
        file.graph.tau,
        forest.edges_per_level(),
        forest.n_nodes(),
        forest.pairs().len(),
        file.graph.by_tau.n_parts,
        file.graph.with_bridges.n_parts,
        spent.wall.as_secs_f64(),
        spent.cpu.as_secs_f64(),
        peak_memory_mib().unwrap_or(f64::NAN),
    );
    Ok(())
}
