//! From clips to a library: import, calibrated floors, mirror images, the graph.

use std::ops::ControlFlow;
use std::path::PathBuf;

use motion_core::cancel::{CancelToken, Cancelled};
use motion_core::clip::{Clip, ClipSet};
use motion_core::graph::build::Stage;
use motion_core::graph::{self, BuildError, BuildOptions, TauRule};
use motion_core::skeleton::mirror::{MIRROR_SUFFIX, MirrorMap};
use motion_io::content_hash::ContentHash;
use motion_io::import::{ImportError, ImportOptions, Report, import_files};
use motion_io::library_file::LibraryFile;

use crate::error::JobError;
use motion_io::diagnostic::Warnings;

/// How a library's graph is made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GraphChoices {
    /// Cuts cheaper than this are edges; chosen from the clips where left out.
    pub tau: Option<f64>,
    /// Whether every clip's mirror image is added.
    pub mirror: bool,
    /// Whether parts that τ leaves apart stay apart.
    pub no_bridges: bool,
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
    let clips = if choices.mirror { with_mirror_images(clips) } else { clips };
    let options = BuildOptions {
        tau: choices.tau.map_or_else(TauRule::default, TauRule::Fixed),
        bridges: !choices.no_bridges,
        ..BuildOptions::default()
    };
    let graph = graph::build(&clips.set, &options, cancel, &|stage| match stage {
        Stage::Features => on_progress("features", 0.0),
        Stage::Neighbours(share) => on_progress("neighbours", 0.1 + 0.2 * f64::from(share)),
        Stage::Edges(share) => on_progress("edges", 0.3 + 0.4 * f64::from(share)),
        Stage::Hierarchy => on_progress("levels", 0.7),
        Stage::Bridges => on_progress("bridges", 0.9),
    })?;
    Ok(LibraryFile { clips: clips.set, content_hashes: clips.content_hashes, graph })
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
