//! From files, and a library that is there, to another library in a file of its own.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use motion_core::cancel::{CancelToken, Cancelled};
use motion_core::clip::{Clip, ClipSet};
use motion_core::floor::calibrate_reported;
use motion_core::motion::Motion;
use motion_core::skeleton::mirror::MIRROR_SUFFIX;
use motion_core::units::Fps;
use motion_io::content_hash::ContentHash;
use motion_io::diagnostic::FileError;
use motion_io::import::{EachImported, ImportOptions, Joined, import_each};
use motion_io::library_file::LibraryFile;

use crate::Library;
use crate::error::JobError;
use crate::import_report::ImportReport;
use crate::library_job::{Clips, GraphChoices, build};
use crate::live::ReadyLibrary;
use crate::progress::{Counts, ProgressBoard};

/// What is to be imported, and to where.
#[derive(Clone, Debug)]
pub(crate) struct ImportPlan {
    /// Files and folders.
    pub(crate) inputs: Vec<PathBuf>,
    /// The rate of all clips.
    pub(crate) fps: Fps,
    /// Whether folders within folders are entered.
    pub(crate) recursive: bool,
    /// The library whose clips stay.
    pub(crate) present: Option<Library>,
    /// How the graph is made.
    pub(crate) choices: GraphChoices,
    /// Folders for the new file: the first that can be written to is taken.
    pub(crate) folders: Vec<PathBuf>,
    /// Its name without the ending, as long as that is free.
    pub(crate) stem: String,
}

/// A new library, ready for use.
#[derive(Debug)]
pub(crate) struct ImportDone {
    pub(crate) ready: ReadyLibrary,
    pub(crate) file: PathBuf,
    pub(crate) report: ImportReport,
}

/// Why there is no new library.
#[derive(Debug)]
pub(crate) enum ImportStopped {
    /// Somebody stopped it; nothing is left of it.
    Cancelled,
    /// No file became a clip: each for its own reason.
    Nothing(Box<ImportReport>),
    /// What the files became could not be made into a library, or not be written.
    Failed(String, Box<ImportReport>),
}

impl From<Cancelled> for ImportStopped {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// How much of the whole is done when files are read, clips prepared, the graph built and the file
/// written: as it is for a hundred clips of some seconds.
const READ: f64 = 0.25;
const PREPARED: f64 = 0.3;
const BUILT: f64 = 0.9;
const WRITTEN: f64 = 0.95;

/// Imports. Where it is cancelled no file is left behind.
pub(crate) fn run(
    plan: &ImportPlan,
    cancel: &CancelToken,
    board: &ProgressBoard,
) -> Result<ImportDone, ImportStopped> {
    let began = Instant::now();
    let present = plan.present.as_ref().map(without_images);
    let imported = read(plan, present.as_ref(), cancel, board)?;
    let mut report = ImportReport::new(imported.files);
    let Some(skeleton) = imported.skeleton.filter(|_| !imported.clips.is_empty()) else {
        return Err(ImportStopped::Nothing(Box::new(report)));
    };
    board.report("preparing clips", READ, None);
    let new: Vec<(Named, Motion)> = imported
        .clips
        .into_iter()
        .map(|clip| ((clip.id, clip.tags, clip.content_hash), clip.motion))
        .collect();
    report.totals.n_kept = plan.present.as_ref().map_or(0, |library| library.clips.clips().len());
    let (clips, content_hashes) = stood_on_the_floor(present, &skeleton, new);
    let set = match ClipSet::new(skeleton, plan.fps, clips) {
        Ok(set) => set,
        Err(error) => {
            return Err(ImportStopped::Failed(JobError::from(error).to_string(), Box::new(report)));
        }
    };
    if cancel.is_cancelled() {
        return Err(ImportStopped::Cancelled);
    }

    let has_images = |library: &Library| has_image(library.clips.clips());
    let mirror = plan.choices.mirror || plan.present.as_ref().is_some_and(has_images);
    let choices = GraphChoices { mirror, ..plan.choices };
    let n_clips = set.clips().len() * if mirror { 2 } else { 1 };
    let on_progress = |stage: &str, share: f64| {
        let counts = pairs_done(n_clips, share).filter(|_| matches!(stage, "neighbours" | "edges"));
        board.report(stage, PREPARED + (BUILT - PREPARED) * share, counts);
    };
    let built = build(Clips { set, content_hashes }, &choices, cancel, &on_progress);
    let file = match built.map_err(JobError::from) {
        Ok(file) => file,
        Err(JobError::Cancelled(_)) => return Err(ImportStopped::Cancelled),
        Err(error) => return Err(ImportStopped::Failed(error.to_string(), Box::new(report))),
    };
    board.report("writing the library", BUILT, None);
    let (path, hash) = match write(plan, &file, cancel) {
        Ok(written) => written,
        Err(_) if cancel.is_cancelled() => return Err(ImportStopped::Cancelled),
        Err(error) => return Err(ImportStopped::Failed(error.to_string(), Box::new(report))),
    };
    board.report("laying out", WRITTEN, None);
    let library = Library::new(file, Some(hash));
    report.totals.n_clips = library.clips.clips().len();
    report.totals.n_frames = library.clips.n_frames();
    report.totals.motion_secs = library.clips.fps().duration_secs(library.clips.n_frames());
    report.totals.file = Some(path.clone());
    let ready = ReadyLibrary::new(library);
    if cancel.is_cancelled() {
        remove(&path);
        return Err(ImportStopped::Cancelled);
    }
    report.totals.took_secs = began.elapsed().as_secs_f64();
    Ok(ImportDone { ready, file: path, report })
}

/// Removes the file of an import that nobody wants any more.
pub(crate) fn remove(file: &Path) {
    // Best effort: at worst a whole library stays that no project names.
    drop(std::fs::remove_file(file));
}

/// A clip's id, tags, and the content of its file.
type Named = (String, Vec<String>, ContentHash);

fn has_image(clips: &[Clip]) -> bool {
    clips.iter().any(|clip| clip.id.ends_with(MIRROR_SUFFIX))
}

/// The clips of a library without images of other clips in it, which are made anew.
fn without_images(library: &Library) -> Vec<(&Clip, ContentHash)> {
    let set = &library.clips;
    let is_image = |clip: &Clip| {
        clip.id.strip_suffix(MIRROR_SUFFIX).is_some_and(|source| set.by_id(source).is_some())
    };
    let clips = set.clips().iter().zip(library.content_hashes.iter().copied());
    clips.filter(|(clip, _)| !is_image(clip)).collect()
}

fn read(
    plan: &ImportPlan,
    present: Option<&Vec<(&Clip, ContentHash)>>,
    cancel: &CancelToken,
    board: &ProgressBoard,
) -> Result<EachImported, Cancelled> {
    let joined = plan.present.as_ref().zip(present).map(|(library, clips)| Joined {
        skeleton: library.clips.skeleton(),
        some_motion: clips.iter().map(|(clip, _)| &clip.motion).max_by_key(|m| m.n_frames()),
        clips: clips.iter().map(|(clip, hash)| (clip.id.as_str(), *hash)).collect(),
        n_frames: library.clips.n_frames(),
    });
    let (fps, recursive) = (plan.fps, plan.recursive);
    let options = ImportOptions { fps, recursive, ..ImportOptions::default() };
    board.report("reading clips", 0.0, None);
    import_each(&plan.inputs, &options, joined.as_ref(), &|progress| {
        let (n_done, n_all) = (progress.n_done, progress.n_files);
        let counts = Counts { what: "clips", n_done, n_all };
        board.report("reading clips", READ * n_done as f64 / n_all.max(1) as f64, Some(counts));
        if cancel.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
}

/// The clips that were there as they are, and behind them the new ones with their floors found.
///
/// Soles are learned from all of them together, so that both stand alike.
fn stood_on_the_floor(
    present: Option<Vec<(&Clip, ContentHash)>>,
    skeleton: &motion_core::skeleton::Skeleton,
    new: Vec<(Named, Motion)>,
) -> (Vec<Clip>, Vec<ContentHash>) {
    let present = present.unwrap_or_default();
    let (names, new): (Vec<Named>, Vec<Motion>) = new.into_iter().unzip();
    let n_present = present.len();
    let mut motions: Vec<Motion> =
        present.iter().map(|(clip, _)| clip.motion.clone()).chain(new).collect();
    let tracks = calibrate_reported(skeleton, &mut motions).tracks;
    let mut clips: Vec<Clip> = present.iter().map(|(clip, _)| (*clip).clone()).collect();
    let mut hashes: Vec<ContentHash> = present.iter().map(|(_, hash)| *hash).collect();
    let stood = motions.into_iter().zip(tracks).skip(n_present);
    for ((id, tags, hash), (motion, track)) in names.into_iter().zip(stood) {
        clips.push(Clip::found(skeleton, id, tags, motion, track));
        hashes.push(hash);
    }
    (clips, hashes)
}

/// How many pairs of clips were compared, by the share of a build; clips are compared with
/// themselves too.
fn pairs_done(n_clips: usize, share: f64) -> Option<Counts> {
    let n_all = n_clips * (n_clips + 1) / 2;
    let done = ((share - 0.1) / 0.6).clamp(0.0, 1.0);
    let n_done = (done * n_all as f64).round() as usize;
    (n_all > 0).then_some(Counts { what: "pairs", n_done, n_all })
}

/// Writes the library where nothing is yet.
fn write(
    plan: &ImportPlan,
    file: &LibraryFile,
    cancel: &CancelToken,
) -> Result<(PathBuf, ContentHash), FileError> {
    let mut failed = None;
    for folder in &plan.folders {
        if cancel.is_cancelled() {
            break;
        }
        let made = std::fs::create_dir_all(folder);
        let path = free_path(folder, &plan.stem);
        let made = made.map_err(|error| FileError::writing(folder, &error));
        match made.and_then(|()| file.save(&path)) {
            Ok(hash) => return Ok((path, hash)),
            Err(error) => failed = failed.or(Some(error)),
        }
    }
    Err(failed.unwrap_or_else(|| {
        let stopped = "the import was stopped before it was written";
        FileError::new(&plan.stem, stopped, "import again")
    }))
}

/// `stem.gwlib`, or the first of `stem-2.gwlib`, … that is free: a library that an earlier step of
/// the history names must stay as it is.
fn free_path(folder: &Path, stem: &str) -> PathBuf {
    let numbered = (2..).map(|nth| format!("{stem}-{nth}"));
    let names = std::iter::once(stem.to_owned()).chain(numbered);
    let mut paths = names.map(|name| folder.join(format!("{name}.gwlib")));
    paths.find(|path| !path.exists()).unwrap_or_else(|| folder.join("library.gwlib"))
}
