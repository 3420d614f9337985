//! The application without a window: a document, its history, what is selected and played, the
//! search that always runs, files.
//!
//! A window makes a [`Session`], sends it commands, and once a frame calls [`Session::poll`] with
//! the seconds since the last. Nothing here waits: libraries, searches and autosaves have threads of
//! their own.

mod autosave;
mod clip_preview;
mod export;
mod files;
mod importing;
mod library_loading;
mod project_lock;
mod staging;
mod view_state;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use motion_core::units::Fps;
use motion_io::diagnostic::FileError;
use motion_io::project_file::Project;

use crate::command::{Command, CommandError};
use crate::document::{CharacterIdx, Document, TakeId};
use crate::history::History;
use crate::library_job::GraphChoices;
use crate::library_source::LibraryChoice;
use crate::live::{LiveSearch, Phase, ReadyLibrary, SearchSnapshot, SearchState, Take, Wake};
use crate::playback::{Playback, PlaybackCommand};
use crate::sample;
use crate::selection::Selection;
use autosave::Autosaver;
pub use autosave::Recovery;
pub use clip_preview::ClipPlace;
pub use export::{ExportRange, ExportReport};
use importing::Importing;
pub use importing::{ImportChoices, ImportRefusal, ImportState, PresentLibrary};
use library_loading::{LibraryLoading, LibraryWish};
pub use project_lock::ProjectLock;
pub use view_state::ViewState;

/// So long after a change, at most, it is kept where a crash leaves it, seconds.
pub const AUTOSAVE_SECS: f64 = 5.0;

/// Why a session cannot begin.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// The sample is wrong, which tests rule out.
    #[error("{0}; please report this")]
    Sample(#[from] FileError),
    /// No threads to be had.
    #[error("the system has no thread to give ({0}); close other programs")]
    Threads(#[from] std::io::Error),
}

/// How a session begins.
pub struct SessionOptions {
    /// Where autosaves and locks are; without one there are none.
    pub state_folder: Option<PathBuf>,
    /// Called from other threads when there is something to poll.
    pub wake: Wake,
    /// What `builtin` means to projects, where it is there already; otherwise it is built.
    pub builtin: Option<ReadyLibrary>,
    /// What the session begins with; the sample where left out.
    pub project: Option<Project>,
}

/// A person's work on a project.
pub struct Session {
    history: History,
    selection: Selection,
    playback: Playback,
    active: CharacterIdx,
    view: ViewState,
    live: LiveSearch,
    library: LibraryLoading,
    importing: Importing,
    previewed: Option<clip_preview::Previewed>,
    submitted: Option<(Document, Phase)>,
    wake: Wake,
    remarks: Vec<String>,
    files: files::Files,
}

/// The take that is looked at, and where in it.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// Whose motion it is.
    pub character: CharacterIdx,
    /// The take.
    pub take: &'a Take,
    /// The place in it, in frames.
    pub frame: f64,
}

/// What has changed since the last poll.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Polled {
    /// There is a new snapshot.
    pub snapshot: bool,
    /// Playback has moved.
    pub frame: bool,
    /// The library has come, or how far it is has changed.
    pub library: bool,
    /// The import has ended, or how far it is has changed.
    pub import: bool,
}

impl Session {
    /// A session on a project that has no file.
    pub fn new(options: SessionOptions) -> Result<Self, SessionError> {
        let SessionOptions { state_folder, wake, builtin, project } = options;
        let project = project.map_or_else(sample::sample, Ok)?;
        let view = ViewState::of(&project);
        let document = Document::from_project(project);
        let autosaver = state_folder.is_some().then(Autosaver::start).transpose()?;
        let mut session = Self {
            playback: Playback::new(1, Fps::THIRTY),
            selection: Selection::default(),
            active: CharacterIdx(0),
            view,
            live: LiveSearch::start(Arc::clone(&wake))?,
            library: LibraryLoading::with_builtin(builtin),
            importing: Importing::default(),
            previewed: None,
            submitted: None,
            wake,
            remarks: Vec::new(),
            files: files::Files::new(document.clone(), state_folder, autosaver),
            history: History::new(document),
        };
        session.begin_untitled();
        session.follow_document();
        Ok(session)
    }

    /// The document as it is to be seen, with a gesture under way.
    pub fn document(&self) -> &Document {
        self.history.present()
    }

    /// What can be undone and redone.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Carries out a command as one step.
    pub fn apply(&mut self, command: &Command) -> Result<(), CommandError> {
        self.history.apply(command)?;
        self.follow_document();
        Ok(())
    }

    /// Carries out several commands as one step, all or none.
    pub fn apply_all(&mut self, label: &str, commands: &[Command]) -> Result<(), CommandError> {
        self.history.apply_all(label, commands)?;
        self.follow_document();
        Ok(())
    }

    /// Begins a gesture, which will be one step.
    pub fn begin_gesture(&mut self, label: &str) {
        self.history.begin_gesture(label);
    }

    /// Shows what the gesture would do, instead of what was previewed before.
    pub fn preview(&mut self, commands: &[Command]) -> Result<(), CommandError> {
        self.history.preview(commands)?;
        self.follow_document();
        Ok(())
    }

    /// Ends the gesture: what was previewed last is done.
    pub fn commit(&mut self) {
        self.history.commit();
        self.follow_document();
    }

    /// Ends the gesture as if it had not been.
    pub fn cancel(&mut self) {
        self.history.cancel();
        self.follow_document();
    }

    /// Goes back one step. Returns whether anything changed.
    pub fn undo(&mut self) -> bool {
        let changed = self.history.undo();
        self.follow_document();
        changed
    }

    /// Goes forward one step. Returns whether anything changed.
    pub fn redo(&mut self) -> bool {
        let changed = self.history.redo();
        self.follow_document();
        changed
    }

    /// What is selected.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// What is selected, to be changed.
    pub fn selection_mut(&mut self) -> &mut Selection {
        &mut self.selection
    }

    /// Where playback is.
    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    /// Does what is asked of the playback.
    pub fn play(&mut self, command: PlaybackCommand) {
        self.playback.apply(command);
    }

    /// The character whose motion the timeline shows.
    pub fn active(&self) -> CharacterIdx {
        self.active
    }

    /// Shows another character in the timeline.
    pub fn set_active(&mut self, character: CharacterIdx) {
        if self.document().character(character).is_some() {
            self.active = character;
            self.follow_shown();
        }
    }

    /// What the editor keeps in the project file, to be read and set. It is not undone.
    pub fn view(&mut self) -> &mut ViewState {
        &mut self.view
    }

    /// The search: to pause, resume, shake, follow the best.
    pub fn search(&mut self) -> &mut LiveSearch {
        &mut self.live
    }

    /// Whether the search is paused.
    pub fn is_search_paused(&self) -> bool {
        self.live.is_paused()
    }

    /// Shows a take from now on.
    pub fn pick(&mut self, character: CharacterIdx, take: TakeId) {
        self.live.pick(character, take);
    }

    /// What the search knows, as of the last poll.
    pub fn snapshot(&self) -> &SearchSnapshot {
        self.live.latest()
    }

    /// Where everything stands, the library too.
    pub fn state(&self) -> SearchState {
        if self.live.has_died() {
            let sentence = "the search has stopped; save, start again, and please report this";
            return SearchState::Error(sentence.to_owned());
        }
        match self.library.state() {
            SearchState::Ready if self.snapshot().request > 0 => self.snapshot().state.clone(),
            other => other.clone(),
        }
    }

    /// The library, once it is there.
    pub fn library(&self) -> Option<&ReadyLibrary> {
        self.library.ready()
    }

    /// The take of the active character that is looked at, and where in it.
    pub fn shown(&self) -> Option<Shown<'_>> {
        self.shown_of(self.active)
    }

    /// The take of a character that is looked at, and where in it.
    pub fn shown_of(&self, character: CharacterIdx) -> Option<Shown<'_>> {
        let take = self.snapshot().character(character)?.shown()?;
        Some(Shown { character, take, frame: self.playback.frame() })
    }

    /// Sentences for the log: what was odd in files and libraries. Each is given once.
    pub fn take_remarks(&mut self) -> Vec<String> {
        std::mem::take(&mut self.remarks)
    }

    /// To be called once a frame with the seconds since the last: takes in what the threads have
    /// done, moves playback, and sees to the autosave. Never waits.
    pub fn poll(&mut self, dt_secs: f64) -> Polled {
        let library_was = (self.library.state().clone(), self.library.progress().cloned());
        let import = self.poll_import();
        self.remarks.extend(self.library.poll());
        let library = (self.library.state(), self.library.progress())
            != (&library_was.0, library_was.1.as_ref());
        if library {
            self.follow_document();
        }
        let snapshot = self.live.poll().is_some();
        if snapshot {
            self.follow_shown();
        }
        let frame = self.playback.advance(dt_secs);
        self.history.note_frame();
        self.keep(dt_secs);
        Polled { snapshot, frame, library, import }
    }

    /// Brings library and search to what the document asks now.
    fn follow_document(&mut self) {
        let document = self.history.present();
        if document.character(self.active).is_none() {
            self.active = CharacterIdx(0);
        }
        let wish = library_wish(document, self.files.path_in_messages());
        self.library.want(wish, &self.wake);
        let phase = match self.history.is_in_gesture() {
            true => Phase::Dragging,
            false => Phase::Settled,
        };
        let Some(ready) =
            self.library.ready().filter(|_| *self.library.state() == SearchState::Ready)
        else {
            self.submitted = None;
            return;
        };
        let is_known = self.submitted.as_ref().is_some_and(|(known, known_phase)| {
            *known_phase == phase
                && known.asks_the_same_as(document)
                && known.takes() == document.takes()
        });
        if !is_known {
            self.live.submit(document, ready, self.files.path_in_messages(), phase);
            self.submitted = Some((document.clone(), phase));
        }
    }

    /// Brings playback to the motion that is looked at.
    fn follow_shown(&mut self) {
        let fps = Fps::new(self.document().fps()).unwrap_or(Fps::THIRTY);
        let shown = self.snapshot().character(self.active).and_then(|c| c.shown());
        let made = shown.and_then(|take| take.made.as_ref());
        if let Some(n_frames) = made.map(|made| made.motion.n_frames()) {
            self.playback.set_motion(u32::try_from(n_frames).unwrap_or(u32::MAX), fps);
        }
    }

    /// Another project takes the place of this one.
    fn replace(&mut self, document: Document, view: ViewState) {
        // Its clips were for the other one.
        self.importing.cancel();
        self.history = History::new(document);
        self.selection.clear();
        self.view = view;
        self.active = CharacterIdx(0);
        self.submitted = None;
        self.playback = Playback::new(1, Fps::THIRTY);
        self.follow_document();
    }
}

/// The library that a document at `path` asks for.
fn library_wish(document: &Document, path: &Path) -> LibraryWish {
    let written = motion_io::project_file::relative_to(document.library(), path);
    LibraryWish {
        choice: LibraryChoice(written),
        fps: document.fps(),
        choices: GraphChoices {
            tau: document.search().tau,
            mirror: document.search().mirror.unwrap_or(false),
            ..GraphChoices::default()
        },
    }
}

#[cfg(all(test, unix))]
mod crash_tests;
#[cfg(test)]
mod library_tests;
#[cfg(test)]
mod memory {
    mod tests;
}
#[cfg(test)]
mod palette_tests;
#[cfg(test)]
mod random_tests;
#[cfg(test)]
mod tests;
