//! `gaitway library merge`: the library of which several machines built a part each.

use std::path::{Path, PathBuf};
use std::time::Instant;

use motion_core::graph::BuildError;
use motion_io::diagnostic::FileError;
use motion_io::library_file::part::LibraryPart;
use motion_session::library_info::BuildTimes;
use motion_session::{JobError, Library, library_job};

use super::build::say_what_was_built;
use crate::interrupt::cancel_on_interrupt;
use crate::output::{Console, Failure};
use crate::plan;

/// Does what was asked.
pub(super) fn run(console: &Console, paths: &[PathBuf], output: &Path) -> Result<(), Failure> {
    plan::check_library_output(output)?;
    let cancel = cancel_on_interrupt();
    let bar = console.bar();
    let start = Instant::now();
    let mut parts = Vec::with_capacity(paths.len());
    for (nth, path) in paths.iter().enumerate() {
        bar.set("reading", nth as f64 / paths.len() as f64);
        parts.push(LibraryPart::load(path)?);
    }
    check_numbers(paths, &parts)?;
    let import_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let file = library_job::merge(parts, &cancel, &|what, share| bar.set(what, share));
    let file = file.map_err(|error| match error {
        BuildError::Part(nth) => {
            let what = "the part is not of the same build as the others";
            let way_out = "build all parts from the same clips with the same options";
            FileError::new(&paths[nth], what, way_out).into()
        }
        other => Failure::from(JobError::from(other)),
    })?;
    let graph_s = start.elapsed().as_secs_f64();
    bar.set("writing", 1.0);
    let start = Instant::now();
    let hash = file.save(output)?;
    let save_s = start.elapsed().as_secs_f64();
    drop(bar);
    let library = Library::new(file, Some(hash));
    say_what_was_built(console, &library, BuildTimes { import_s, graph_s, save_s }, output)
}

/// Fails unless every share of the first part's build is there once.
fn check_numbers(paths: &[PathBuf], parts: &[LibraryPart]) -> Result<(), FileError> {
    let (Some(first), Some(path)) = (parts.first(), paths.first()) else { return Ok(()) };
    let n = first.graph.shard.n();
    for (nth, part) in parts.iter().enumerate() {
        let shard = part.graph.shard;
        if parts[..nth].iter().any(|other| other.graph.shard == shard) {
            let what = format!("part {} of {n} is there twice", shard.nth() + 1);
            return Err(FileError::new(&paths[nth], what, "name every part once"));
        }
    }
    let is_there = |nth: &u32| parts.iter().any(|part| part.graph.shard.nth() == *nth);
    if let Some(missing) = (0..n).find(|nth| !is_there(nth)) {
        let what = format!("part {} of {n} is missing", missing + 1);
        return Err(FileError::new(path, what, "name every part of the build"));
    }
    Ok(())
}
