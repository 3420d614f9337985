//! An import in which a bad file stands in nobody's way, and whose clips may join others.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use motion_core::cancel::Cancelled;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;
use rayon::prelude::*;

use super::body::{Brought, LibraryBody, most_used};
use super::{
    ClipIndex, Facts, ImportOptions, ImportProgress, ImportedClip, MotionFile, Report, clip_id,
    motion_files, read_motion_file, words,
};
use crate::content_hash::ContentHash;
use crate::diagnostic::{FileError, Warnings};
use crate::limits::{MAX_LIBRARY_FILES, MAX_LIBRARY_FRAMES};

/// Clips that are there already, which new ones join: on their skeleton, under ids of their own.
#[derive(Clone, Debug)]
pub struct Joined<'a> {
    /// The skeleton that every new clip is brought to.
    pub skeleton: &'a Skeleton,
    /// A motion on it, from which standing is learned where the rest pose does not stand.
    pub some_motion: Option<&'a Motion>,
    /// The id of each clip that is there, and the content of its file.
    pub clips: Vec<(&'a str, ContentHash)>,
    /// Frames of all of them.
    pub n_frames: usize,
}

/// What became of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct FileFate {
    /// The file, or the input that was not even a file to be read.
    pub path: PathBuf,
    /// What became of it.
    pub fate: Fate,
    /// What was odd in it.
    pub warnings: Vec<String>,
}

/// What became of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Fate {
    /// It is a clip now.
    Imported {
        /// The clip's id.
        id: String,
        /// Its frames at the library's rate.
        n_frames: usize,
        /// What was recognised about the file.
        facts: Box<Facts>,
        /// Whether its motion was retargeted or its path scaled, as the body is another one.
        is_brought: bool,
        /// What was done beyond reading, a sentence each.
        notes: Vec<String>,
    },
    /// Its content is a clip already, which has this id.
    Same(String),
    /// It cannot be used.
    Refused(FileError),
}

/// Clips of all files that could be used, and what became of every file.
#[derive(Clone, Debug, PartialEq)]
pub struct EachImported {
    /// The skeleton of the clips; `None` without any, and none to join.
    pub skeleton: Option<Skeleton>,
    /// The new clips in the order of the inputs, floors as captured.
    pub clips: Vec<ImportedClip>,
    /// One for each file in the order of the inputs, and for each input that means no file.
    pub files: Vec<FileFate>,
}

/// Imports what can be imported of files and folders.
///
/// As [`import_files`](super::import_files), but a file that is wrong, or whose body cannot be
/// brought to the library's, is refused by itself. The skeleton is that of `joined`, or the options'
/// one, or what most frames have. `watch` is called after every file, from any thread.
pub fn import_each(
    inputs: &[PathBuf],
    options: &ImportOptions,
    joined: Option<&Joined<'_>>,
    watch: &(dyn Fn(ImportProgress) -> ControlFlow<()> + Sync),
) -> Result<EachImported, Cancelled> {
    let (paths, refused) = found(inputs, options.recursive);
    let is_cancelled = AtomicBool::new(false);
    let n_done = AtomicUsize::new(0);
    let n_frames = AtomicUsize::new(joined.map_or(0, |joined| joined.n_frames));
    let read = |path: &PathBuf| -> Option<(Result<MotionFile, FileError>, Warnings)> {
        if is_cancelled.load(Ordering::Relaxed) {
            return None;
        }
        let mut warnings = Warnings::new();
        let file = read_motion_file(path, &options.read, &mut warnings).and_then(|mut file| {
            file.motion = file.motion.resampled(options.fps);
            let n_own = file.motion.n_frames();
            if n_frames.fetch_add(n_own, Ordering::Relaxed) + n_own > MAX_LIBRARY_FRAMES {
                let what =
                    format!("with it there are more than {MAX_LIBRARY_FRAMES} frames of clips");
                return Err(FileError::new(path, what, "build several libraries"));
            }
            Ok(file)
        });
        let n_done = n_done.fetch_add(1, Ordering::Relaxed) + 1;
        if watch(ImportProgress { n_done, n_files: paths.len() }).is_break() {
            is_cancelled.store(true, Ordering::Relaxed);
        }
        Some((file, warnings))
    };
    let read: Option<Vec<_>> = paths.par_iter().map(read).collect();
    let read = read.filter(|_| !is_cancelled.load(Ordering::Relaxed)).ok_or(Cancelled)?;

    let mut each = Each::new(joined, options.fps);
    for (path, (file, warnings)) in paths.iter().zip(read) {
        each.add(path, file, warnings);
    }
    let mut imported = each.into_imported(options.skeleton.as_ref());
    imported.files.extend(refused.into_iter().map(|error| FileFate {
        path: error.path.clone(),
        fate: Fate::Refused(error),
        warnings: Vec::new(),
    }));
    Ok(imported)
}

/// The files that the inputs mean, and why some mean none.
fn found(inputs: &[PathBuf], recursive: bool) -> (Vec<PathBuf>, Vec<FileError>) {
    let (mut paths, mut refused) = (Vec::new(), Vec::new());
    for input in inputs {
        match motion_files(std::slice::from_ref(input), recursive) {
            Ok(files) if paths.len() + files.len() > MAX_LIBRARY_FILES => {
                let what = format!("with it there are more than {MAX_LIBRARY_FILES} motion files");
                refused.push(FileError::new(input, what, "build several libraries"));
            }
            Ok(files) => paths.extend(files),
            Err(error) => refused.push(error),
        }
    }
    (paths, refused)
}

/// Files on their way to clips.
struct Each<'a> {
    joined: Option<&'a Joined<'a>>,
    fps: Fps,
    index: ClipIndex,
    ids_by_content: BTreeMap<ContentHash, String>,
    /// Where the clip of an id comes from; `None` for one that was there before.
    sources: BTreeMap<String, Option<PathBuf>>,
    clips: Vec<ImportedClip>,
    bodies: Vec<Skeleton>,
    files: Vec<FileFate>,
    /// For each clip its place among the files.
    nth_file: Vec<usize>,
}

impl<'a> Each<'a> {
    fn new(joined: Option<&'a Joined<'a>>, fps: Fps) -> Self {
        let there = || joined.map_or(&[][..], |joined| &joined.clips).iter();
        Self {
            joined,
            fps,
            index: ClipIndex::default(),
            // A clip before its mirror image, which is of the same content.
            ids_by_content: there().rev().map(|&(id, hash)| (hash, id.to_owned())).collect(),
            sources: there().map(|&(id, _)| (id.to_owned(), None)).collect(),
            clips: Vec::new(),
            bodies: Vec::new(),
            files: Vec::new(),
            nth_file: Vec::new(),
        }
    }

    fn add(&mut self, path: &Path, file: Result<MotionFile, FileError>, mut warnings: Warnings) {
        let fate = match file {
            Ok(file) => self.take(path, file, &mut warnings).unwrap_or_else(Fate::Refused),
            Err(error) => Fate::Refused(error),
        };
        let sentence = |warning: &crate::diagnostic::Warning| match warning.line {
            Some(line) => format!("line {line}: {}", warning.what),
            None => warning.what.clone(),
        };
        let warnings = warnings.as_slice().iter().map(sentence).collect();
        self.files.push(FileFate { path: path.to_owned(), fate, warnings });
    }

    fn take(
        &mut self,
        path: &Path,
        file: MotionFile,
        warnings: &mut Warnings,
    ) -> Result<Fate, FileError> {
        if let Some(id) = self.ids_by_content.get(&file.content_hash) {
            return Ok(Fate::Same(id.clone()));
        }
        let id = clip_id(path)?;
        if let Some(first) = self.sources.get(&id) {
            let other = match first {
                Some(first) => format!("that of {}", first.display()),
                None => "one of the library".to_owned(),
            };
            let what = format!("its clip is called {id:?}, as {other}, and is another one");
            return Err(FileError::new(path, what, "rename the file"));
        }
        self.sources.insert(id.clone(), Some(path.to_owned()));
        self.ids_by_content.insert(file.content_hash, id.clone());
        let mut report = Report::default();
        file.facts.report(path, self.fps, &mut report);
        let mut tags = words(&id);
        for word in words(self.index.description(path, warnings)) {
            if !tags.contains(&word) {
                tags.push(word);
            }
        }
        let n_frames = file.motion.n_frames();
        self.nth_file.push(self.files.len());
        self.bodies.push(file.skeleton);
        self.clips.push(ImportedClip {
            id: id.clone(),
            source: path.to_owned(),
            content_hash: file.content_hash,
            motion: file.motion,
            tags,
        });
        Ok(Fate::Imported {
            id,
            n_frames,
            facts: Box::new(file.facts),
            is_brought: false,
            notes: report.lines().iter().map(|line| line.text.clone()).collect(),
        })
    }

    /// Brings every clip to one skeleton.
    fn into_imported(mut self, wanted: Option<&Skeleton>) -> EachImported {
        let skeleton = match (self.joined, wanted) {
            (Some(joined), _) => joined.skeleton.clone(),
            (None, Some(wanted)) => wanted.clone(),
            (None, None) if self.clips.is_empty() => {
                return EachImported { skeleton: None, clips: self.clips, files: self.files };
            }
            (None, None) => most_used(&self.bodies, &self.clips),
        };
        let body = match self.joined {
            Some(joined) => LibraryBody::standing_as(skeleton, joined.some_motion),
            None => LibraryBody::new(skeleton, &self.bodies, &self.clips),
        };
        let mut clips = Vec::with_capacity(self.clips.len());
        let clips_and_bodies = self.clips.into_iter().zip(&self.bodies);
        for ((mut clip, own), &nth_file) in clips_and_bodies.zip(&self.nth_file) {
            let file = &mut self.files[nth_file].fate;
            match body.bring(own, &mut clip.motion) {
                Ok(brought) => {
                    if let Fate::Imported { is_brought, notes, .. } = file
                        && brought != Brought::Same
                    {
                        *is_brought = true;
                        notes.push(brought.to_string());
                    }
                    clips.push(clip);
                }
                Err(misfit) => {
                    let what = format!("its skeleton is not the library's: {misfit}");
                    let what_to_do = "import such clips alone, into a library of their own";
                    *file = Fate::Refused(FileError::new(&clip.source, what, what_to_do));
                }
            }
        }
        EachImported { skeleton: Some(body.into_skeleton()), clips, files: self.files }
    }
}
