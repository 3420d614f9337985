//! Importing clips while everything else goes on: a job of its own, and its place in the history.
//!
//! A new library is a new file. It lies beside the project's file, named after it, or for a project
//! without one in the state folder's `libraries`; where the name is taken, a number is added, so
//! nothing is ever overwritten and undo finds the library before as it was.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;

use motion_core::cancel::CancelToken;
use motion_core::units::Fps;
use motion_io::diagnostic::FileError;

use super::library_loading::LibraryWish;
use super::{Session, library_wish};
use crate::command::Command;
use crate::import_job::{self, ImportDone, ImportPlan, ImportStopped};
use crate::import_report::ImportReport;
use crate::library_job::GraphChoices;
use crate::live::mailbox::Mailbox;
use crate::live::{SearchState, Wake};
use crate::progress::{JobProgress, ProgressBoard};

/// What becomes of the library that is there when clips are imported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PresentLibrary {
    /// The built-in one is replaced, since its figure is a stand-in for one's own data; any other is
    /// kept.
    #[default]
    KeepUnlessBuiltin,
    /// The new clips join it, on its skeleton.
    Keep,
    /// The new clips are a library by themselves, on the skeleton that most of them have.
    Replace,
}

/// How files are imported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ImportChoices {
    /// What becomes of the library that is there.
    pub present: PresentLibrary,
    /// Whether folders within folders are entered.
    pub recursive: bool,
}

/// Why an import cannot begin.
#[derive(Debug, thiserror::Error)]
pub enum ImportRefusal {
    /// There is one under way.
    #[error("an import is under way; wait for it or cancel it")]
    UnderWay,
    /// The library that is to be kept is not there.
    #[error("the library that the clips are to join is not ready; wait for it, or replace it")]
    NoLibrary,
    /// There is no file to lie beside and no other place.
    #[error("there is nowhere to keep the new library; save the project first")]
    NoPlace,
    /// The project's rate is none.
    #[error("the project's rate cannot be used ({0}); change it")]
    Rate(String),
    /// No thread to be had.
    #[error("the system has no thread to give ({0}); close other programs")]
    Threads(#[from] std::io::Error),
}

/// Where the import stands. What has ended stays to be read until the next one begins or
/// [`Session::dismiss_import`].
#[derive(Clone, Debug, Default, PartialEq)]
pub enum ImportState {
    /// There is none.
    #[default]
    Idle,
    /// It goes on.
    Running(JobProgress),
    /// It was cancelled, and everything is as it was.
    Cancelled,
    /// The new library is in use.
    Done(ImportReport),
    /// Everything is as it was: why, in a sentence, and what became of the files.
    Failed(String, ImportReport),
}

/// The import of a session.
#[derive(Debug, Default)]
pub(super) struct Importing {
    state: ImportState,
    job: Option<Job>,
}

/// An import under way. Dropping it cancels it and removes what it has written.
#[derive(Debug)]
struct Job {
    cancel: CancelToken,
    shared: Arc<Shared>,
    fps: f64,
    choices: GraphChoices,
}

#[derive(Debug)]
struct Shared {
    board: ProgressBoard,
    result: Mailbox<Result<ImportDone, ImportStopped>>,
}

impl Shared {
    /// Takes away what nobody will ask for any more.
    fn discard(&self) {
        if let Some(Ok(done)) = self.result.take() {
            import_job::remove(&done.file);
        }
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.cancel.cancel();
        self.shared.discard();
    }
}

impl Importing {
    fn begin(&mut self, plan: ImportPlan, wake: Wake) -> std::io::Result<()> {
        let board = ProgressBoard::new(wake);
        let shared = Arc::new(Shared { board, result: Mailbox::default() });
        let (fps, choices) = (plan.fps.get(), plan.choices);
        let job = Job { cancel: CancelToken::new(), shared, fps, choices };
        let (cancel, shared) = (job.cancel.clone(), Arc::clone(&job.shared));
        let work = move || {
            let result = import_job::run(&plan, &cancel, &shared.board);
            // The library before may be needed by nobody else now.
            drop(plan);
            shared.result.put(result);
            // Whoever cancelled may have looked before it was put in.
            if cancel.is_cancelled() {
                shared.discard();
            }
            shared.board.wake();
        };
        thread::Builder::new().name("import".to_owned()).spawn(work)?;
        self.state = ImportState::Running(JobProgress::begun("reading clips"));
        self.job = Some(job);
        Ok(())
    }

    /// Stops what is under way; returns whether anything was.
    pub(super) fn cancel(&mut self) -> bool {
        let was_under_way = self.job.take().is_some();
        if was_under_way {
            self.state = ImportState::Cancelled;
        }
        was_under_way
    }
}

impl Session {
    /// Begins to import files and folders (`.bvh`, `.glb`, `.gltf`) into a new library, in the
    /// background. [`Session::poll`] takes it in when it is done, as one step "Import clips".
    ///
    /// A file that cannot be used, or is there already, is a line of the report and stands in
    /// nobody's way. Imports of the present library's mirror setting and τ are made alike.
    pub fn begin_import(
        &mut self,
        paths: Vec<PathBuf>,
        choices: ImportChoices,
    ) -> Result<(), ImportRefusal> {
        if self.importing.job.is_some() {
            return Err(ImportRefusal::UnderWay);
        }
        let document = self.history.settled();
        let keep = match choices.present {
            PresentLibrary::Keep => true,
            PresentLibrary::Replace => false,
            PresentLibrary::KeepUnlessBuiltin => document.library() != "builtin",
        };
        let wish = library_wish(document, self.files.path_in_messages());
        let is_ready = *self.library.state() == SearchState::Ready && self.library.note().is_none();
        let ready = self.library.ready().filter(|_| is_ready);
        let present = match (keep, ready) {
            (false, _) => None,
            (true, Some(ready)) => Some(ready.library.clone()),
            (true, None) => return Err(ImportRefusal::NoLibrary),
        };
        let fps = Fps::new(wish.fps).map_err(|bad| ImportRefusal::Rate(bad.to_string()))?;
        let beside = self.path().and_then(Path::parent).map(Path::to_owned);
        let elsewhere = self.files.state_folder().map(|folder| folder.join("libraries"));
        let folders: Vec<PathBuf> = beside.into_iter().chain(elsewhere).collect();
        if folders.is_empty() {
            return Err(ImportRefusal::NoPlace);
        }
        let name = match self.path().and_then(Path::file_stem) {
            Some(stem) => stem.to_string_lossy().into_owned(),
            None => document.name().to_owned(),
        };
        let plan = ImportPlan {
            inputs: paths,
            fps,
            recursive: choices.recursive,
            present,
            choices: wish.choices,
            folders,
            stem: fit_for_a_file(&name),
        };
        let wake = Arc::clone(&self.wake);
        Ok(self.importing.begin(plan, wake)?)
    }

    /// Where the import stands.
    pub fn import(&self) -> &ImportState {
        &self.importing.state
    }

    /// Stops the import; everything is as it was, and no file is left of it. Returns whether there
    /// was one.
    pub fn cancel_import(&mut self) -> bool {
        self.importing.cancel()
    }

    /// The report of the last import was read.
    pub fn dismiss_import(&mut self) {
        if self.importing.job.is_none() {
            self.importing.state = ImportState::Idle;
        }
    }

    /// Uses a `.gwlib` from now on, as one step. The one before stays in use until it is open.
    pub fn use_library(&mut self, path: &Path) -> Result<(), FileError> {
        if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gwlib")) {
            let what_to_do = "drop a .gwlib, or import clips";
            return Err(FileError::new(path, "it is not a library", what_to_do));
        }
        std::fs::metadata(path).map_err(|error| FileError::reading(path, &error))?;
        let library = self.as_written(path);
        self.apply(&Command::SetLibrary { library }).map_err(|error| {
            FileError::new(path, error.to_string(), "move it to a folder with a shorter name")
        })
    }

    /// How far the library that is being opened or built is.
    pub fn library_progress(&self) -> Option<&JobProgress> {
        self.library.progress()
    }

    /// Why the library in use is not the document's, in a sentence: opening that was cancelled.
    pub fn library_note(&self) -> Option<&str> {
        self.library.note()
    }

    /// Stops opening or building a library. The one before stays in use, and
    /// [`Session::library_note`] says so; without one before, the state does. Returns whether there
    /// was anything to stop.
    pub fn cancel_library(&mut self) -> bool {
        let was_under_way = self.library.cancel();
        self.follow_document();
        was_under_way
    }

    /// Opens the document's library again, where that was cancelled or has failed.
    pub fn reopen_library(&mut self) {
        let wake = Arc::clone(&self.wake);
        self.library.retry(&wake);
        self.follow_document();
    }

    /// Takes in what the import has come to. Returns whether anything has changed.
    pub(super) fn poll_import(&mut self) -> bool {
        let Some(job) = &self.importing.job else { return false };
        let progress = job.shared.board.try_take();
        let is_new = progress.is_some();
        if let Some(progress) = progress {
            self.importing.state = ImportState::Running(progress);
        }
        // Applying a command would end what the user is dragging.
        let result = match self.history.is_in_gesture() {
            true => None,
            false => job.shared.result.try_take(),
        };
        let Some(result) = result else { return is_new };
        let (fps, choices) = (job.fps, job.choices);
        self.importing.job = None;
        self.importing.state = match result {
            Ok(done) => self.take_in(done, fps, choices),
            Err(ImportStopped::Cancelled) => ImportState::Cancelled,
            Err(ImportStopped::Failed(sentence, report)) => ImportState::Failed(sentence, *report),
            Err(ImportStopped::Nothing(report)) => {
                let all_there = report.totals.n_skipped > 0 && report.totals.n_refused == 0;
                let sentence = match all_there {
                    true => "all of these clips are in the library already",
                    false => "none of the files could be imported; each line says why",
                };
                ImportState::Failed(sentence.to_owned(), *report)
            }
        };
        true
    }

    fn take_in(&mut self, done: ImportDone, fps: f64, choices: GraphChoices) -> ImportState {
        let ImportDone { ready, file, report } = done;
        let library = self.as_written(&file);
        let command = Command::SetLibrary { library };
        if let Err(error) = self.history.apply_all("Import clips", &[command]) {
            import_job::remove(&file);
            return ImportState::Failed(error.to_string(), report);
        }
        // Where the document has another rate by now, its wish is another one, and it is said.
        let asked = library_wish(self.history.present(), self.files.path_in_messages());
        self.library.adopt(LibraryWish { fps, choices, ..asked }, ready);
        self.follow_document();
        ImportState::Done(report)
    }

    /// A path as the document has it: the name alone beside the project's file, otherwise whole.
    fn as_written(&self, path: &Path) -> String {
        let is_beside = self.path().is_some_and(|project| project.parent() == path.parent());
        let name = path.file_name().filter(|_| is_beside).map(PathBuf::from);
        let whole = || std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        name.unwrap_or_else(whole).to_string_lossy().into_owned()
    }
}

/// A name that every file system takes.
fn fit_for_a_file(name: &str) -> String {
    let fits = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    let name: String = name.chars().filter(fits).take(60).collect();
    match name.trim() {
        "" => "library".to_owned(),
        name => name.to_owned(),
    }
}
