//! The library of the document, made ready on a thread of its own.

use std::sync::Arc;
use std::thread;

use motion_core::cancel::CancelToken;
use motion_core::units::Fps;
use motion_io::diagnostic::Warnings;

use crate::library_job::GraphChoices;
use crate::library_source::{LibraryChoice, resolve};
use crate::live::mailbox::Mailbox;
use crate::live::{ReadyLibrary, SearchState, Wake};
use crate::progress::{JobProgress, ProgressBoard};

/// Which library, and how it is made.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LibraryWish {
    pub(super) choice: LibraryChoice,
    pub(super) fps: f64,
    pub(super) choices: GraphChoices,
}

/// The library that is wished for: there, on its way, or impossible.
#[derive(Debug, Default)]
pub(super) struct LibraryLoading {
    wish: Option<LibraryWish>,
    /// The library in use, and the wish that it was made for.
    ready: Option<(LibraryWish, ReadyLibrary)>,
    state: SearchState,
    progress: Option<JobProgress>,
    /// Why the library in use is not the one that is wished for.
    note: Option<String>,
    job: Option<Job>,
    /// Instead of building the built-in library.
    builtin: Option<ReadyLibrary>,
}

/// A library on its way. Dropping it cancels the work.
#[derive(Debug)]
struct Job {
    cancel: CancelToken,
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    board: ProgressBoard,
    result: Mailbox<Result<(ReadyLibrary, Vec<String>), String>>,
}

impl Drop for Job {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

impl LibraryLoading {
    /// A loading for which the built-in library is there already.
    pub(super) fn with_builtin(builtin: Option<ReadyLibrary>) -> Self {
        Self { builtin, ..Self::default() }
    }

    /// Sees to it that the library of `wish` comes. The one before stays until then.
    pub(super) fn want(&mut self, wish: LibraryWish, wake: &Wake) {
        if self.wish.as_ref() == Some(&wish) {
            return;
        }
        self.wish = Some(wish.clone());
        if self.ready.as_ref().is_some_and(|(of, _)| *of == wish) {
            // Back before the other one had come.
            self.settle();
            return;
        }
        if let Some(builtin) = self.builtin.clone().filter(|_| wish.choice.0.is_none()) {
            self.adopt(wish, builtin);
            return;
        }
        let board = ProgressBoard::new(wake.clone());
        let shared = Arc::new(Shared { board, result: Mailbox::default() });
        let job = Job { cancel: CancelToken::new(), shared };
        let (cancel, shared) = (job.cancel.clone(), Arc::clone(&job.shared));
        let work = move || {
            shared.result.put(load(&wish, &cancel, &shared.board));
            shared.board.wake();
        };
        (self.job, self.note) = (None, None);
        self.show(JobProgress::begun("opening the library"));
        match thread::Builder::new().name("library".to_owned()).spawn(work) {
            Ok(_) => self.job = Some(job),
            Err(error) => {
                self.state = SearchState::Error(format!("the library cannot be opened ({error})"));
            }
        }
    }

    /// Takes a library that was made elsewhere as the one of `wish`.
    pub(super) fn adopt(&mut self, wish: LibraryWish, ready: ReadyLibrary) {
        self.wish = Some(wish.clone());
        self.ready = Some((wish, ready));
        self.settle();
    }

    /// Stops a library that is on its way; the one before stays in use. Returns whether there was
    /// any.
    pub(super) fn cancel(&mut self) -> bool {
        if self.job.take().is_none() {
            return false;
        }
        self.settle();
        if self.ready.is_some() {
            let note = "opening the library was stopped, so the one before it is still in use; \
                        open it again, or undo the change";
            self.note = Some(note.to_owned());
        } else {
            let sentence = "opening the library was stopped; open it again, or choose another one";
            self.state = SearchState::Error(sentence.to_owned());
        }
        true
    }

    /// Begins anew with what is wished for, if it is not there and not on its way.
    pub(super) fn retry(&mut self, wake: &Wake) {
        let is_there = self.ready.as_ref().map(|(of, _)| of) == self.wish.as_ref();
        if !is_there
            && self.job.is_none()
            && let Some(wish) = self.wish.take()
        {
            self.want(wish, wake);
        }
    }

    /// Looks how far it is. Never waits. Returns what was odd, once the library is there.
    pub(super) fn poll(&mut self) -> Vec<String> {
        let Some(shared) = self.job.as_ref().map(|job| Arc::clone(&job.shared)) else {
            return Vec::new();
        };
        if let Some(progress) = shared.board.try_take() {
            self.show(progress);
        }
        let Some(result) = shared.result.try_take() else { return Vec::new() };
        self.settle();
        match (result, self.wish.clone()) {
            (Ok((ready, remarks)), Some(wish)) => {
                self.ready = Some((wish, ready));
                remarks
            }
            (Ok(_), None) => Vec::new(),
            (Err(sentence), _) => {
                // A library of another choice would pass for the one that was wished.
                self.ready = None;
                self.state = SearchState::Error(sentence);
                Vec::new()
            }
        }
    }

    /// The library, if it is there.
    pub(super) fn ready(&self) -> Option<&ReadyLibrary> {
        self.ready.as_ref().map(|(_, ready)| ready)
    }

    /// Where it stands; [`SearchState::Ready`] once it is there.
    pub(super) fn state(&self) -> &SearchState {
        &self.state
    }

    /// How far it is, while it is on its way.
    pub(super) fn progress(&self) -> Option<&JobProgress> {
        self.progress.as_ref()
    }

    /// Why the library in use is not the one that is wished for.
    pub(super) fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    fn show(&mut self, progress: JobProgress) {
        let (what, share) = (progress.stage.clone(), progress.share);
        self.state = SearchState::Building { what, share };
        self.progress = Some(progress);
    }

    fn settle(&mut self) {
        (self.job, self.progress, self.note) = (None, None, None);
        self.state = SearchState::Ready;
    }
}

fn load(
    wish: &LibraryWish,
    cancel: &CancelToken,
    board: &ProgressBoard,
) -> Result<(ReadyLibrary, Vec<String>), String> {
    let fps = Fps::new(wish.fps).map_err(|bad| bad.to_string())?;
    let mut warnings = Warnings::new();
    // Reading has a scale of its own, and building begins at none again.
    let on_progress = |what: &str, share: f64| {
        let share = if what == "reading" { 0.2 * share } else { 0.2 + 0.7 * share };
        board.report(what, share, None);
    };
    let library = resolve(&wish.choice, fps, &wish.choices, cancel, &mut warnings, &on_progress);
    let library = library.map_err(|error| error.to_string())?;
    let library_fps = library.clips.fps().get();
    if (library_fps - wish.fps).abs() > 1e-3 {
        return Err(format!(
            "the project counts {} frames per second and its library {library_fps}; build the \
             library again with --fps, or change the project",
            wish.fps
        ));
    }
    board.report("laying out", 0.95, None);
    let remarks = warnings.as_slice().iter().map(ToString::to_string).collect();
    Ok((ReadyLibrary::new(library), remarks))
}
