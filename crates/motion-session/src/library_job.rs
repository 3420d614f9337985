//! From clips to a library: import, calibrated floors, mirror images, the graph.

use std::ops::ControlFlow;
use std::path::PathBuf;

use motion_core::cancel::{CancelToken, Cancelled};
use motion_core::clip::{Clip, ClipSet};
use motion_core::graph::build::Stage;
use motion_core::graph::memory::build_bytes;
use motion_core::graph::{self, BuildError, BuildOptions, MotionGraph, TauRule};
use motion_core::similarity::Shard;
use motion_core::skeleton::mirror::{MIRROR_SUFFIX, MirrorMap};
use motion_io::content_hash::ContentHash;
use motion_io::import::{ImportError, ImportOptions, Report, import_files};
use motion_io::library_file::LibraryFile;
use motion_io::library_file::part::LibraryPart;

use crate::error::JobError;
use motion_io::diagnostic::Warnings;

/// How a library's graph is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GraphChoices {
    /// Cuts cheaper than this are edges; chosen from the clips where left out.
    pub tau: Option<f64>,
    /// Whether every clip's mirror image is added.
    pub mirror: bool,
    /// Whether parts that τ leaves apart stay apart.
    pub no_bridges: bool,
    /// Bytes that a build may take at its height, clips included: one that would take more is
    /// refused before it begins.
    pub memory_bytes: u64,
}

/// What a build may take of memory where nothing else is said: a million frames of motion capture.
pub const DEFAULT_MEMORY_BYTES: u64 = 4 << 30;

impl Default for GraphChoices {
    fn default() -> Self {
        Self { tau: None, mirror: false, no_bridges: false, memory_bytes: DEFAULT_MEMORY_BYTES }
    }
}

/// Hears what a job is doing and the share of it that is done, 0 to 1.
pub type OnProgress<'a> = &'a (dyn Fn(&str, f64) + Sync);

/// Clips on their way to a library.
#[derive(Clone, Debug)]
pub struct Clips {
    /// The clips, floors calibrated.
    pub set: ClipSet,
    /// Hash of the file that each came from.
    pub content_hashes: Vec<ContentHash>,
}

/// Imports files and folders. What was done beyond reading comes back as a report.
pub fn import(
    inputs: &[PathBuf],
    options: &ImportOptions,
    cancel: &CancelToken,
    warnings: &mut Warnings,
    on_progress: OnProgress<'_>,
) -> Result<(Clips, Report), JobError> {
    let imported = import_files(inputs, options, &|progress| {
        on_progress("reading", progress.n_done as f64 / progress.n_files.max(1) as f64);
        if cancel.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let mut imported = imported.map_err(|error| match error {
        ImportError::File(error) => JobError::File(error),
        ImportError::Cancelled => JobError::Cancelled(Cancelled),
    })?;
    warnings.append(std::mem::take(&mut imported.warnings));
    let report = std::mem::take(&mut imported.report);
    let content_hashes = imported.clips.iter().map(|clip| clip.content_hash).collect();
    let (set, _calibration) = imported.into_clip_set()?;
    Ok((Clips { set, content_hashes }, report))
}

/// Builds the library of `clips`.
pub fn build(
    clips: Clips,
    choices: &GraphChoices,
    cancel: &CancelToken,
    on_progress: OnProgress<'_>,
) -> Result<LibraryFile, BuildError> {
    let options = affordable_options(&clips.set, choices)?;
    let clips = if choices.mirror { with_mirror_images(clips) } else { clips };
    let on_stage = |stage| tell(on_progress, stage);
    let graph = graph::build(&clips.set, &options, cancel, &on_stage)?;
    Ok(clips.into_library(graph))
}

/// The share of [`build`] that one of several machines does.
pub fn build_part(
    clips: Clips,
    choices: &GraphChoices,
    shard: Shard,
    cancel: &CancelToken,
    on_progress: OnProgress<'_>,
) -> Result<LibraryPart, BuildError> {
    // Parts of one build must agree on the budget of edges, so that is not what memory is saved by.
    affordable_options(&clips.set, choices)?;
    let options = build_options(choices);
    let clips = if choices.mirror { with_mirror_images(clips) } else { clips };
    let on_stage = |stage| tell(on_progress, stage);
    let graph = graph::build_part(&clips.set, &options, shard, cancel, &on_stage)?;
    let is_first = shard.nth() == 0;
    let clips = is_first.then_some((clips.set, clips.content_hashes));
    Ok(LibraryPart { graph, bridges: !choices.no_bridges, clips })
}

/// The library that [`build`] makes, of all parts of it. Fails with [`BuildError::Part`] where they
/// do not belong together; the number is that of the part.
pub fn merge(
    mut parts: Vec<LibraryPart>,
    cancel: &CancelToken,
    on_progress: OnProgress<'_>,
) -> Result<LibraryFile, BuildError> {
    let first = parts.first().map(|part| part.bridges);
    if let Some(other) = parts.iter().position(|part| Some(part.bridges) != first) {
        return Err(BuildError::Part(other));
    }
    let clips = parts.iter_mut().find_map(|part| part.clips.take());
    let (Some((set, content_hashes)), Some(bridges)) = (clips, first) else {
        return Err(BuildError::Part(0));
    };
    let options = BuildOptions { bridges, ..BuildOptions::default() };
    let on_stage = |stage| tell(on_progress, stage);
    let parts = parts.into_iter().map(|part| part.graph).collect();
    let graph = graph::merge(&set, &options, parts, cancel, &on_stage)?;
    Ok(Clips { set, content_hashes }.into_library(graph))
}

/// The library of `old` and `new` clips, of which the old ones are not compared with each other
/// again. τ and the metric stay those of `old`. `new` is on the skeleton and at the rate of `old`,
/// and has no clip's id.
pub fn extend(
    old: LibraryFile,
    new: Clips,
    choices: &GraphChoices,
    cancel: &CancelToken,
    on_progress: OnProgress<'_>,
) -> Result<LibraryFile, JobError> {
    let LibraryFile { clips, content_hashes, graph: old } = old;
    let all = clips.clips().iter().chain(new.set.clips()).cloned().collect();
    let set = ClipSet::new(clips.skeleton().clone(), clips.fps(), all)?;
    let content_hashes = [content_hashes, new.content_hashes].concat();
    let clips = Clips { set, content_hashes };
    let options = affordable_options(&clips.set, choices)?;
    let clips = if choices.mirror { with_mirror_images(clips) } else { clips };
    let on_stage = |stage| tell(on_progress, stage);
    let graph = graph::extend(&clips.set, &old, &options, cancel, &on_stage)?;
    Ok(clips.into_library(graph))
}

impl Clips {
    fn into_library(self, graph: MotionGraph) -> LibraryFile {
        LibraryFile { clips: self.set, content_hashes: self.content_hashes, graph }
    }

    /// Those that are not in `library` yet, by their content, and the ids of those that are.
    pub fn unknown_to(self, library: &LibraryFile) -> Result<(Self, Vec<String>), JobError> {
        let Self { set, content_hashes } = self;
        let (new, known): (Vec<_>, Vec<_>) = set
            .clips()
            .iter()
            .cloned()
            .zip(content_hashes)
            .partition(|(_, hash)| !library.content_hashes.contains(hash));
        let (clips, content_hashes) = new.into_iter().unzip();
        let set = ClipSet::new(set.skeleton().clone(), set.fps(), clips)?;
        let known = known.into_iter().map(|(clip, _)| clip.id).collect();
        Ok((Self { set, content_hashes }, known))
    }
}

fn build_options(choices: &GraphChoices) -> BuildOptions {
    BuildOptions {
        tau: choices.tau.map_or_else(TauRule::default, TauRule::Fixed),
        bridges: !choices.no_bridges,
        ..BuildOptions::default()
    }
}

/// [`build_options`] with as much room for edges as memory leaves; an error where even the frames
/// take more. Images that are still to be made count.
fn affordable_options(clips: &ClipSet, choices: &GraphChoices) -> Result<BuildOptions, BuildError> {
    let options = build_options(choices);
    let n_images = |clip: &Clip| if clip.id.ends_with(MIRROR_SUFFIX) { 0 } else { clip.n_frames() };
    let images: usize = clips.clips().iter().map(n_images).sum();
    let n_frames = clips.n_frames() + if choices.mirror { images } else { 0 };
    let needed_bytes = build_bytes(clips.skeleton(), n_frames, &options);
    let allowed_bytes = choices.memory_bytes;
    let Some(left) = allowed_bytes.checked_sub(needed_bytes) else {
        return Err(BuildError::Memory { needed_bytes, allowed_bytes });
    };
    let left = usize::try_from(left).unwrap_or(usize::MAX);
    Ok(BuildOptions { edge_budget_bytes: options.edge_budget_bytes.min(left), ..options })
}

fn tell(on_progress: OnProgress<'_>, stage: Stage) {
    match stage {
        Stage::Features => on_progress("features", 0.0),
        Stage::Neighbours(share) => on_progress("neighbours", 0.1 + 0.2 * f64::from(share)),
        Stage::Edges(share) => on_progress("edges", 0.3 + 0.4 * f64::from(share)),
        Stage::Hierarchy => on_progress("levels", 0.7),
        Stage::Bridges => on_progress("bridges", 0.9),
    }
}

/// Every clip and behind all of them their mirror images, those left out that are there already.
pub fn with_mirror_images(clips: Clips) -> Clips {
    let Clips { set, content_hashes } = clips;
    let mirror = MirrorMap::new(set.skeleton());
    let images: Vec<(Clip, ContentHash)> = set
        .clips()
        .iter()
        .zip(&content_hashes)
        .filter(|(clip, _)| !clip.id.ends_with(MIRROR_SUFFIX))
        .map(|(clip, hash)| (mirror.clip(clip), *hash))
        .filter(|(image, _)| set.by_id(&image.id).is_none())
        .collect();
    let own = set.clips().iter().cloned().zip(content_hashes.iter().copied());
    let (all, all_hashes): (Vec<Clip>, Vec<ContentHash>) = own.chain(images).unzip();
    // Images have the shape of their clips, and ids that were just seen to be free.
    match ClipSet::new(set.skeleton().clone(), set.fps(), all) {
        Ok(set) => Clips { set, content_hashes: all_hashes },
        Err(_) => Clips { set, content_hashes },
    }
}
