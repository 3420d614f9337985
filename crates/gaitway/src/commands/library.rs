//! `gaitway library build`, `info` and `edges`; `coverage` is in a file of its own.

use std::fmt::Write as _;
use std::time::Instant;

use motion_core::ids::ClipId;
use motion_io::diagnostic::Warnings;
use motion_io::import::{ImportOptions, read_motion_file};
use motion_session::Library;
use motion_session::library_info::{BuildTimes, LibraryInfo};
use motion_session::library_job::{self, GraphChoices};
use motion_session::library_source::{self, LibraryChoice};

use super::coverage;
use crate::args;
use crate::interrupt::cancel_on_interrupt;
use crate::output::{Console, Failure};
use crate::plan;

/// Does what was asked.
pub(crate) fn run(console: &Console, command: &args::Library) -> Result<(), Failure> {
    match command {
        args::Library::Build(args) => build(console, args),
        args::Library::Info { library } => {
            let info = LibraryInfo::new(&open(console, library)?, None);
            console.answer(&info, || info.text(console.is_verbose()))
        }
        args::Library::Coverage { library } => coverage::run(console, library),
        args::Library::Edges { library: path, from, to } => {
            let library = open(console, path)?;
            let edges = library.edges(from, to).map_err(|missing| {
                let similar = library.similar_ids(&missing).join(", ");
                let path = path.display();
                Failure::wrong(format!(
                    "{path}: it has no clip {missing:?}; did you mean {similar}?"
                ))
            })?;
            console.answer(&edges, || {
                let mut text = String::new();
                for edge in &edges {
                    // Writing to a string cannot fail.
                    let _ok = writeln!(text, "{} {} {}", edge.from_frame, edge.to_frame, edge.cost);
                }
                text
            })
        }
    }
}

pub(super) fn open(console: &Console, path: &std::path::Path) -> Result<Library, Failure> {
    let bar = console.bar();
    Ok(library_source::open(&LibraryChoice::typed(path), &|what, share| bar.set(what, share))?)
}

fn build(console: &Console, args: &args::LibraryBuild) -> Result<(), Failure> {
    plan::check_library_output(&args.output)?;
    let cancel = cancel_on_interrupt();
    let mut warnings = Warnings::new();
    let read = plan::read_options(&args.reading)?;
    let skeleton = match &args.skeleton {
        Some(path) => Some(read_motion_file(path, &read, &mut warnings)?.skeleton),
        None => None,
    };
    let options = ImportOptions { fps: args.fps, recursive: args.recursive, read, skeleton };
    let choices = GraphChoices { tau: args.tau, mirror: args.mirror, no_bridges: args.no_bridges };

    let bar = console.bar();
    let on_progress = |what: &str, share| bar.set(what, share);
    let start = Instant::now();
    let imported =
        library_job::import(&args.inputs, &options, &cancel, &mut warnings, &on_progress);
    let import_s = start.elapsed().as_secs_f64();
    let (clips, report) = match imported {
        Ok(imported) => imported,
        Err(error) => {
            drop(bar);
            console.warnings(&warnings);
            return Err(error.into());
        }
    };
    let start = Instant::now();
    let file = library_job::build(clips, &choices, &cancel, &on_progress)
        .map_err(motion_session::JobError::from)?;
    let graph_s = start.elapsed().as_secs_f64();
    bar.set("writing", 1.0);
    let start = Instant::now();
    let hash = file.save(&args.output)?;
    let save_s = start.elapsed().as_secs_f64();
    drop(bar);

    console.warnings(&warnings);
    for line in report.lines() {
        console.note(&line.to_string());
    }
    let library = Library::new(file, Some(hash));
    for clip in unreachable_clips(&library) {
        console.note(&format!("clip {clip} is not connected to the others"));
    }
    let info = LibraryInfo::new(&library, Some(BuildTimes { import_s, graph_s, save_s }));
    console.answer(&info, || {
        format!("{}written to         {}\n", info.text(console.is_verbose()), args.output.display())
    })
}

/// Clips outside the main component of the finished graph; with bridges there is none as a rule.
fn unreachable_clips(library: &Library) -> impl Iterator<Item = &str> {
    let parts = library.graph.with_bridges.part_of_clip.iter().enumerate();
    parts
        .filter(|(_, part)| **part != 0)
        .map(|(clip, _)| library.clips.clip(ClipId::from_idx(clip)).id.as_str())
        .take(8)
}
