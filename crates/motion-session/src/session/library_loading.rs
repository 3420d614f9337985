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
    ready: Option<ReadyLibrary>,
    state: SearchState,
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

#[derive(Debug, Default)]
struct Shared {
    progress: Mailbox<(String, f64)>,
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
        if let Some(builtin) = self.builtin.clone().filter(|_| wish.choice.0.is_none()) {
            (self.job, self.ready, self.state) = (None, Some(builtin), SearchState::Ready);
            return;
        }
        let job = Job { cancel: CancelToken::new(), shared: Arc::default() };
        let (cancel, shared, wake) = (job.cancel.clone(), Arc::clone(&job.shared), wake.clone());
        let work = move || {
            let result = load(&wish, &cancel, &|what, share| {
                shared.progress.put((what.to_owned(), share));
                wake();
            });
            shared.result.put(result);
            wake();
        };
        self.state = SearchState::Building { what: "opening the library".to_owned(), share: 0.0 };
        match thread::Builder::new().name("library".to_owned()).spawn(work) {
            Ok(_) => self.job = Some(job),
            Err(error) => {
                self.state = SearchState::Error(format!("the library cannot be opened ({error})"));
            }
        }
    }

    /// Looks how far it is. Never waits. Returns what was odd, once the library is there.
    pub(super) fn poll(&mut self) -> Vec<String> {
        let Some(job) = &self.job else { return Vec::new() };
        if let Some((what, share)) = job.shared.progress.try_take() {
            self.state = SearchState::Building { what, share };
        }
        let mut remarks = Vec::new();
        if let Some(result) = job.shared.result.try_take() {
            self.job = None;
            match result {
                Ok((ready, warnings)) => {
                    remarks = warnings;
                    self.ready = Some(ready);
                    self.state = SearchState::Ready;
                }
                Err(sentence) => {
                    // A library of another choice would pass for the one that was wished.
                    self.ready = None;
                    self.state = SearchState::Error(sentence);
                }
            }
        }
        remarks
    }

    /// The library, if it is there.
    pub(super) fn ready(&self) -> Option<&ReadyLibrary> {
        self.ready.as_ref()
    }

    /// Where it stands; [`SearchState::Ready`] once it is there.
    pub(super) fn state(&self) -> &SearchState {
        &self.state
    }
}

fn load(
    wish: &LibraryWish,
    cancel: &CancelToken,
    on_progress: &(dyn Fn(&str, f64) + Sync),
) -> Result<(ReadyLibrary, Vec<String>), String> {
    let fps = Fps::new(wish.fps).map_err(|bad| bad.to_string())?;
    let mut warnings = Warnings::new();
    let library = resolve(&wish.choice, fps, &wish.choices, cancel, &mut warnings, on_progress);
    let library = library.map_err(|error| error.to_string())?;
    let library_fps = library.clips.fps().get();
    if (library_fps - wish.fps).abs() > 1e-3 {
        return Err(format!(
            "the project counts {} frames per second and its library {library_fps}; build the \
             library again with --fps, or change the project",
            wish.fps
        ));
    }
    on_progress("laying out", 0.95);
    let remarks = warnings.as_slice().iter().map(ToString::to_string).collect();
    Ok((ReadyLibrary::new(library), remarks))
}
