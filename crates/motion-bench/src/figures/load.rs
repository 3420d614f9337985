//! Opening a library file.

use motion_bench::clips::build;
use motion_bench::stopwatch::{Spent, timed};
use motion_io::library_file::LibraryFile;

use super::Bench;
use super::quantile::median;
use crate::table::Row;

const N_LOADS: usize = 7;

/// Loads the file several times; the system has it in memory, as after a build.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("bench.gwlib");
    let file = build(bench.source.load()?, false)?;
    let (saved, saving) = timed(|| file.save(&path));
    saved?;
    let bytes = std::fs::metadata(&path)?.len();
    let mut walls = Vec::new();
    let mut spent = Spent::default();
    for _ in 0..N_LOADS {
        let (loaded, once) = timed(|| LibraryFile::load(&path));
        loaded?;
        walls.push(once.wall.as_secs_f64());
        spent.wall += once.wall / N_LOADS as u32;
        spent.cpu += once.cpu / N_LOADS as u32;
    }
    let secs = median(&walls);
    let note = format!(
        "{:.1} MiB; median of {N_LOADS}; saving took {:.2} s",
        bytes as f64 / (1 << 20) as f64,
        saving.wall.as_secs_f64()
    );
    Ok(vec![Row {
        figure: ".gwlib load".to_owned(),
        target: "0.3 s",
        measured: format!("{secs:.3} s"),
        is_met: secs < 0.3,
        spent,
        notes: vec![note],
    }])
}
