//! Where a library comes from: a `.gwlib`, clips, or the program itself.

use std::path::{Path, PathBuf};

use motion_core::cancel::CancelToken;
use motion_core::units::Fps;
use motion_io::content_hash::ContentHash;
use motion_io::diagnostic::{FileError, Warnings};
use motion_io::import::ImportOptions;
use motion_io::library_file::LibraryFile;

use crate::Library;
use crate::error::JobError;
use crate::library_job::{Clips, GraphChoices, OnProgress, build, import, with_mirror_images};

/// A library by where it is: `None` for the built-in one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LibraryChoice(pub Option<PathBuf>);

impl LibraryChoice {
    /// What a person typed: a path, or `builtin`.
    pub fn typed(path: &Path) -> Self {
        Self((path != Path::new("builtin")).then(|| path.to_owned()))
    }
}

/// The library of `choice`, with mirror images and another τ where `choices` ask for them. Clips
/// that are no library yet are imported at `fps`.
pub fn resolve(
    choice: &LibraryChoice,
    fps: Fps,
    choices: &GraphChoices,
    cancel: &CancelToken,
    warnings: &mut Warnings,
    on_progress: OnProgress<'_>,
) -> Result<Library, JobError> {
    let clips = match &choice.0 {
        None => builtin_clips()?,
        Some(path) if is_library_file(path) => {
            let (file, hash) = LibraryFile::load(path)?;
            if !needs_rebuild(&file, choices) {
                return Ok(Library::new(file, Some(hash)));
            }
            Clips { set: file.clips, content_hashes: file.content_hashes }
        }
        Some(path) => {
            let options = ImportOptions { fps, ..ImportOptions::default() };
            let inputs = [path.clone()];
            import(&inputs, &options, cancel, warnings, on_progress)?.0
        }
    };
    Ok(Library::new(build(clips, choices, cancel, on_progress)?, None))
}

/// The library of `choice` as it is; for looking into.
pub fn open(choice: &LibraryChoice, on_progress: OnProgress<'_>) -> Result<Library, JobError> {
    match &choice.0 {
        None => {
            let clips = builtin_clips()?;
            let file = build(clips, &GraphChoices::default(), &CancelToken::new(), on_progress)?;
            Ok(Library::new(file, None))
        }
        Some(path) => {
            if path.is_dir() {
                let what = "it is a folder and not a library";
                let build_one = "build a library of it with `gaitway library build`";
                return Err(FileError::new(path, what, build_one).into());
            }
            let (file, hash) = LibraryFile::load(path)?;
            Ok(Library::new(file, Some(hash)))
        }
    }
}

/// The clips that the program makes itself.
pub fn builtin_clips() -> Result<Clips, JobError> {
    let set =
        motion_performer::builtin_clips().map_err(|error| JobError::Builtin(error.to_string()))?;
    let hash = |id: &str| ContentHash::of(format!("builtin {id}").as_bytes());
    let content_hashes = set.clips().iter().map(|clip| hash(&clip.id)).collect();
    Ok(Clips { set, content_hashes })
}

/// Whether a path means a library that is built already.
fn is_library_file(path: &Path) -> bool {
    !path.is_dir() && path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gwlib"))
}

fn needs_rebuild(file: &LibraryFile, choices: &GraphChoices) -> bool {
    let other_tau = choices.tau.is_some_and(|tau| tau != file.graph.tau);
    let n_clips = file.clips.clips().len();
    let lacks_images = choices.mirror && {
        let clips = Clips { set: file.clips.clone(), content_hashes: file.content_hashes.clone() };
        with_mirror_images(clips).set.clips().len() > n_clips
    };
    other_tau || lacks_images
}
