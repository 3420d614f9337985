//! A film of a motion, by the program as a user runs it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, ensure};
use motion_bench::stopwatch::timed;
use motion_io::atomic_write::atomic_write;
use motion_session::sample;

use super::Bench;
use crate::table::Row;

const TARGET_SECS: f64 = 20.0;

/// Makes a GIF of 240 frames with software Vulkan, of the sample's best motion.
pub(crate) fn measure(_: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let program = program()?;
    let dir = tempfile::tempdir()?;
    atomic_write(&dir.path().join(sample::FILE_NAME), sample::TEXT.as_bytes())?;
    run(&program, dir.path(), &["solve", sample::FILE_NAME, "-o", "out", "--iterations", "60"])?;
    let film = ["render", "out/A-1.bvh", "-o", "film.gif", "--size", "640x360", "--software"];
    // The rate is said, so that the film has a picture for each of the 240 frames.
    let frames = ["--frames", "0-239", "--fps", "30"];
    let (made, spent) = timed(|| run(&program, dir.path(), &[&film[..], &frames].concat()));
    made?;
    let bytes = std::fs::metadata(dir.path().join("film.gif"))?.len();
    let secs = spent.wall.as_secs_f64();
    Ok(vec![Row {
        figure: "film, 240 frames".to_owned(),
        target: "20 s",
        measured: format!("{secs:.1} s"),
        is_met: secs <= TARGET_SECS,
        spent,
        notes: vec![format!(
            "`gaitway render` to a GIF of 640 × 360 in software: {:.2} MB; the program's own \
             processor time is not counted",
            bytes as f64 / 1e6
        )],
    }])
}

/// The program, built as this one is: in the folder of its own.
fn program() -> anyhow::Result<PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .args(["build", "--quiet", "--release", "--package", "gaitway"])
        .stdin(Stdio::null())
        .status()
        .context("cannot start cargo")?;
    ensure!(status.success(), "gaitway could not be built");
    let own = std::env::current_exe()?;
    let name = format!("gaitway{}", std::env::consts::EXE_SUFFIX);
    let program = own.parent().context("a program is in a folder")?.join(name);
    ensure!(program.is_file(), "{} is not there; run this in release", program.display());
    Ok(program)
}

fn run(program: &Path, dir: &Path, args: &[&str]) -> anyhow::Result<()> {
    let output = Command::new(program).args(args).arg("-q").current_dir(dir).output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "gaitway {}: {}", args.join(" "), said.trim());
    Ok(())
}
