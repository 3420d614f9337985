//! `gaitway library build`: a library of clips, a part of one, or one with more clips.

use std::path::Path;
use std::time::Instant;

use motion_core::cancel::CancelToken;
use motion_core::clip::ClipSet;
use motion_core::ids::ClipId;
use motion_core::similarity::Shard;
use motion_core::units::Fps;
use motion_io::diagnostic::{FileError, Warnings};
use motion_io::import::{ImportOptions, Report, read_motion_file};
use motion_io::library_file::LibraryFile;
use motion_session::library_info::{BuildTimes, LibraryInfo};
use motion_session::library_job::{self, Clips, GraphChoices, OnProgress};
use motion_session::{JobError, Library};

use crate::args::LibraryBuild;
use crate::interrupt::cancel_on_interrupt;
use crate::output::{Console, Failure};
use crate::plan;

/// Does what was asked.
pub(super) fn run(console: &Console, args: &LibraryBuild) -> Result<(), Failure> {
    match args.shard {
        Some(_) => plan::check_part_output(&args.output)?,
        None => plan::check_library_output(&args.output)?,
    }
    let cancel = cancel_on_interrupt();
    let bar = console.bar();
    let on_progress = |what: &str, share| bar.set(what, share);
    let old = match &args.extend {
        Some(path) => Some(LibraryFile::load(path)?.0),
        None => None,
    };
    let start = Instant::now();
    let mut warnings = Warnings::new();
    let body = old.as_ref().map(|old| &old.clips);
    let imported = import(args, body, &cancel, &mut warnings, &on_progress);
    let import_s = start.elapsed().as_secs_f64();
    let (clips, report) = match imported {
        Ok(imported) => imported,
        Err(failure) => {
            drop(bar);
            console.warnings(&warnings);
            return Err(failure);
        }
    };
    let choices = GraphChoices {
        tau: args.tau,
        mirror: args.mirror,
        no_bridges: args.no_bridges,
        memory_bytes: (args.memory * f64::from(1u32 << 30)) as u64,
    };
    if let Some(shard) = args.shard {
        let part = library_job::build_part(clips, &choices, shard, &cancel, &on_progress)
            .map_err(JobError::from)?;
        bar.set("writing", 1.0);
        part.save(&args.output)?;
        drop(bar);
        console.warnings(&warnings);
        let part = Part::new(shard, part.graph.edges.len(), &args.output);
        return console.answer(&part, || part.text());
    }

    let start = Instant::now();
    let mut notes: Vec<String> = report.lines().iter().map(ToString::to_string).collect();
    let file = match old {
        None => {
            library_job::build(clips, &choices, &cancel, &on_progress).map_err(JobError::from)?
        }
        Some(old) => {
            let (new, known) = clips.unknown_to(&old)?;
            refuse_taken_ids(args, &old, &new)?;
            notes.extend(known.iter().map(|id| format!("clip {id} is in the library already")));
            notes.push(format!(
                "{} clips added to {}; the metric and τ stay as they were",
                new.set.clips().len(),
                old.clips.clips().len()
            ));
            library_job::extend(old, new, &choices, &cancel, &on_progress)?
        }
    };
    let graph_s = start.elapsed().as_secs_f64();
    bar.set("writing", 1.0);
    let start = Instant::now();
    let hash = file.save(&args.output)?;
    let save_s = start.elapsed().as_secs_f64();
    drop(bar);

    console.warnings(&warnings);
    for note in &notes {
        console.note(note);
    }
    let library = Library::new(file, Some(hash));
    say_what_was_built(console, &library, BuildTimes { import_s, graph_s, save_s }, &args.output)
}

/// The clips that were named, on the body of `library` and at its rate where there is one.
fn import(
    args: &LibraryBuild,
    library: Option<&ClipSet>,
    cancel: &CancelToken,
    warnings: &mut Warnings,
    on_progress: OnProgress<'_>,
) -> Result<(Clips, Report), Failure> {
    let read = plan::read_options(&args.reading)?;
    let skeleton = match (library, &args.skeleton) {
        (Some(library), _) => Some(library.skeleton().clone()),
        (None, Some(path)) => Some(read_motion_file(path, &read, warnings)?.skeleton),
        (None, None) => None,
    };
    let fps: Fps = library.map_or(args.fps, ClipSet::fps);
    let options = ImportOptions { fps, recursive: args.recursive, read, skeleton };
    Ok(library_job::import(&args.inputs, &options, cancel, warnings, on_progress)?)
}

/// Fails where another clip of the library has the name of a new one.
fn refuse_taken_ids(args: &LibraryBuild, old: &LibraryFile, new: &Clips) -> Result<(), FileError> {
    let path = args.extend.as_deref().unwrap_or(&args.output);
    let mut clips = new.set.clips().iter();
    if let Some(taken) = clips.find(|clip| old.clips.by_id(&clip.id).is_some()) {
        let what = format!("it has another clip {:?} already", taken.id);
        return Err(FileError::new(path, what, "rename the new clip's file"));
    }
    if new.set.clips().is_empty() {
        let what = "all the clips are in it already";
        return Err(FileError::new(path, what, "name clips that it does not have"));
    }
    Ok(())
}

/// Describes a library that was just built and written to `output`.
pub(super) fn say_what_was_built(
    console: &Console,
    library: &Library,
    times: BuildTimes,
    output: &Path,
) -> Result<(), Failure> {
    for clip in unreachable_clips(library) {
        console.note(&format!("clip {clip} is not connected to the others"));
    }
    let info = LibraryInfo::new(library, Some(times));
    console.answer(&info, || {
        format!("{}written to         {}\n", info.text(console.is_verbose()), output.display())
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

/// What is said of a part.
#[derive(serde::Serialize)]
struct Part {
    gaitway: u32,
    shard: u32,
    shards: u32,
    edges: usize,
    written_to: String,
}

impl Part {
    fn new(shard: Shard, edges: usize, output: &Path) -> Self {
        let written_to = output.display().to_string();
        Self { gaitway: 1, shard: shard.nth() + 1, shards: shard.n(), edges, written_to }
    }

    fn text(&self) -> String {
        let Self { shard, shards, edges, written_to, .. } = self;
        format!(
            "part               {shard} of {shards}\nedges found        {edges}\n\
             written to         {written_to}\n"
        )
    }
}
