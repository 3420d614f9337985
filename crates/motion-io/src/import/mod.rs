//! From files and folders to clips of one skeleton at one rate.
//!
//! 1. Inputs become a list of motion files: a folder means the motion files in it, by name.
//! 2. Each file is read and [recognised](crate::guess): metres, Y up, facing +Z, no T-pose before
//!    the motion; then resampled to the library's rate. Files are read in parallel.
//! 3. Identical content is kept once; clips are named after their files.
//! 4. The library's skeleton is the one that most frames have, or a given one; clips of other
//!    bodies are brought to it, those of other hierarchies [retargeted](motion_core::retarget) by
//!    the parts of the body or refused.
//!
//! Everything that was done beyond reading is a line of the [report](Imported::report). The same
//! files give the same result, whatever the number of threads.

mod body;
mod each;
mod inputs;
mod motion_file;
mod report;
mod tags;

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use motion_core::clip::{Clip, ClipSet, ClipSetError};
use motion_core::floor::{self, Calibration};
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;
use rayon::prelude::*;

use crate::content_hash::ContentHash;
use crate::diagnostic::{FileError, Warnings, quoted};
use crate::limits::MAX_LIBRARY_FRAMES;
use body::{Brought, LibraryBody};

pub use each::{EachImported, Fate, FileFate, Joined, import_each};
pub use inputs::{MOTION_EXTENSIONS, motion_files};
pub use motion_file::{Facts, MotionFile, ReadOptions, read_motion_file};
pub use report::{Report, ReportLine};
pub use tags::{ClipIndex, words};

/// How files become clips.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportOptions {
    /// The rate of all clips.
    pub fps: Fps,
    /// Whether folders within folders are entered.
    pub recursive: bool,
    /// How each file is read.
    pub read: ReadOptions,
    /// The skeleton of all clips; the one that most frames have where left out.
    pub skeleton: Option<Skeleton>,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self { fps: Fps::THIRTY, recursive: false, read: ReadOptions::default(), skeleton: None }
    }
}

/// Clips of one skeleton at one rate, floors as captured.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The body of all clips: rest pose facing +Z, Y up, metres.
    pub skeleton: Skeleton,
    /// The rate of all clips.
    pub fps: Fps,
    /// In the order of the inputs, folders by name.
    pub clips: Vec<ImportedClip>,
    /// What was done, for a person.
    pub report: Report,
    /// What was odd in the files.
    pub warnings: Warnings,
}

/// A clip and where it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedClip {
    /// The file's stem, unique.
    pub id: String,
    /// The file as the inputs named it.
    pub source: PathBuf,
    /// Hash of the file's bytes.
    pub content_hash: ContentHash,
    /// What the body does, from the first kept frame, at the library's rate.
    pub motion: Motion,
    /// Words from the file's name and its folder's `INDEX.tsv`.
    pub tags: Vec<String>,
}

/// How far an import is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImportProgress {
    /// Files read.
    pub n_done: usize,
    /// Files in all.
    pub n_files: usize,
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImportError {
    /// A file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The watcher asked to stop.
    #[error("the import was cancelled")]
    Cancelled,
}

/// Imports files and folders.
///
/// `watch` is called after every file, from any thread; when it breaks, the import ends with
/// [`ImportError::Cancelled`]. Of several files that fail, the first in order is reported.
pub fn import_files(
    inputs: &[PathBuf],
    options: &ImportOptions,
    watch: &(dyn Fn(ImportProgress) -> ControlFlow<()> + Sync),
) -> Result<Imported, ImportError> {
    let files = motion_files(inputs, options.recursive)?;
    let is_cancelled = AtomicBool::new(false);
    let n_done = AtomicUsize::new(0);
    let n_frames = AtomicUsize::new(0);
    let read = |path: &PathBuf| -> Result<Read, ImportError> {
        if is_cancelled.load(Ordering::Relaxed) {
            return Err(ImportError::Cancelled);
        }
        let mut warnings = Warnings::new();
        let mut file = read_motion_file(path, &options.read, &mut warnings)?;
        file.motion = file.motion.resampled(options.fps);
        let so_far = n_frames.fetch_add(file.motion.n_frames(), Ordering::Relaxed);
        if so_far + file.motion.n_frames() > MAX_LIBRARY_FRAMES {
            let what = format!("the clips have more than {MAX_LIBRARY_FRAMES} frames together");
            let what_to_do = "build several libraries, or one with a lower rate";
            return Err(FileError::new(&inputs[0], what, what_to_do).into());
        }
        let n_done = n_done.fetch_add(1, Ordering::Relaxed) + 1;
        if watch(ImportProgress { n_done, n_files: files.len() }).is_break() {
            is_cancelled.store(true, Ordering::Relaxed);
            return Err(ImportError::Cancelled);
        }
        Ok(Read { file, warnings })
    };
    let results: Vec<Result<Read, ImportError>> = files.par_iter().map(read).collect();
    if is_cancelled.load(Ordering::Relaxed) {
        return Err(ImportError::Cancelled);
    }
    let read: Vec<Read> = results.into_iter().collect::<Result<_, _>>()?;
    Ok(assemble(&files, read, options)?)
}

struct Read {
    file: MotionFile,
    warnings: Warnings,
}

/// Makes a library of files that were read, in order.
fn assemble(
    files: &[PathBuf],
    read: Vec<Read>,
    options: &ImportOptions,
) -> Result<Imported, FileError> {
    let mut report = Report::default();
    let mut warnings = Warnings::new();
    let mut index = ClipIndex::default();
    let mut by_hash: HashMap<ContentHash, PathBuf> = HashMap::new();
    let mut by_id: HashMap<String, PathBuf> = HashMap::new();
    let mut clips = Vec::with_capacity(read.len());
    let mut bodies = Vec::with_capacity(read.len());
    for (path, Read { file, warnings: own }) in files.iter().zip(read) {
        warnings.append(own);
        if let Some(first) = by_hash.get(&file.content_hash) {
            report.add(path, format!("the same as {}, imported once", first.display()));
            continue;
        }
        by_hash.insert(file.content_hash, path.clone());
        let id = clip_id(path)?;
        if let Some(first) = by_id.insert(id.clone(), path.clone()) {
            return Err(FileError::new(
                path,
                format!("its clip is called {id:?}, as that of {}", first.display()),
                "rename one of the files",
            ));
        }
        file.facts.report(path, options.fps, &mut report);
        let mut tags = words(&id);
        tags.extend(words(index.description(path, &mut warnings)));
        let mut seen = std::collections::HashSet::new();
        tags.retain(|tag| seen.insert(tag.clone()));
        bodies.push(file.skeleton);
        clips.push(ImportedClip {
            id,
            source: path.clone(),
            content_hash: file.content_hash,
            motion: file.motion,
            tags,
        });
    }
    let skeleton = match &options.skeleton {
        Some(skeleton) => skeleton.clone(),
        None => body::most_used(&bodies, &clips),
    };
    let library = LibraryBody::new(skeleton, &bodies, &clips);
    for (clip, own) in clips.iter_mut().zip(&bodies) {
        let brought = library.bring(own, &mut clip.motion).map_err(|misfit| {
            FileError::new(
                &clip.source,
                format!("its skeleton is not the library's: {misfit}"),
                "leave the file out, name its joints' roles (--roles), or build a library of such \
                 clips alone",
            )
        })?;
        if brought != Brought::Same {
            report.add(&clip.source, brought.to_string());
        }
    }
    let skeleton = library.into_skeleton();
    Ok(Imported { skeleton, fps: options.fps, clips, report, warnings })
}

/// The file's stem. Refuses the form that is kept for mirrored clips.
fn clip_id(path: &Path) -> Result<String, FileError> {
    let id = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    if id.contains('@') {
        return Err(FileError::new(
            path,
            format!("its clip would be called {}", quoted(id.as_bytes())),
            "rename the file without @, which is kept for mirrored clips",
        ));
    }
    Ok(id)
}

impl Imported {
    /// The clips with their floors calibrated over the whole set, and what that did.
    ///
    /// Cannot fail for what [`import_files`] gives; the error says which clip does not fit its
    /// set.
    pub fn into_clip_set(self) -> Result<(ClipSet, Calibration), ClipSetError> {
        let mut motions: Vec<Motion> = Vec::with_capacity(self.clips.len());
        let mut names = Vec::with_capacity(self.clips.len());
        for clip in self.clips {
            names.push((clip.id, clip.tags));
            motions.push(clip.motion);
        }
        let calibration = floor::calibrate_reported(&self.skeleton, &mut motions);
        let clips = names
            .into_iter()
            .zip(motions)
            .zip(calibration.tracks.iter().cloned())
            .map(|(((id, tags), motion), track)| {
                Clip::found(&self.skeleton, id, tags, motion, track)
            })
            .collect();
        Ok((ClipSet::new(self.skeleton, self.fps, clips)?, calibration))
    }
}

#[cfg(test)]
mod each_tests;
#[cfg(test)]
mod tests;
