//! The search that always runs, behind the editor.
//!
//! A worker thread owns it. The editor's side holds a [`LiveSearch`]: it says what is wished, and
//! polls for whole [`SearchSnapshot`]s. Neither side waits for the other: wishes and snapshots go
//! through mailboxes with room for the latest one.

mod character_search;
mod company;
mod kindred;
mod layers;
mod lineage;
pub(crate) mod mailbox;
pub mod ready_library;
pub mod snapshot;
mod wish;
mod worker;

use std::path::Path;
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use motion_io::project_file::Project;

use crate::document::{CharacterIdx, Document, TakeId};
pub use ready_library::ReadyLibrary;
pub use snapshot::{
    BestAt, Better, CharacterSnapshot, ConstraintHash, HandLayer, Made, SearchSnapshot,
    SearchState, Take,
};
use wish::{Pick, Request, Shared, Wish};

/// Called by the worker when there is a new snapshot, so that a window can draw it.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// Whether a document is on its way to another or has arrived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// A gesture is under way: its steps are not worth remembering.
    Dragging,
    /// A document that can be undone to.
    Settled,
}

/// The editor's side of a running search. Dropping it ends the worker.
#[derive(Debug)]
pub struct LiveSearch {
    shared: Arc<Shared>,
    wish: Wish,
    latest: Arc<SearchSnapshot>,
    worker: Option<JoinHandle<()>>,
}

impl LiveSearch {
    /// Starts a worker that has nothing to do yet. `wake` is called on its thread. Fails only where
    /// the system has no thread to give.
    pub fn start(wake: Wake) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let for_worker = Arc::clone(&shared);
        let worker = thread::Builder::new()
            .name("live search".to_owned())
            .spawn(move || worker::run(&for_worker, &wake))?;
        let latest = Arc::default();
        Ok(Self { shared, wish: Wish::default(), latest, worker: Some(worker) })
    }

    /// Asks for motions of `document`. What is known stays and is scored anew. Messages name
    /// `path`. Returns the number that snapshots of it carry.
    pub fn submit(
        &mut self,
        document: &Document,
        library: &ReadyLibrary,
        path: &Path,
        phase: Phase,
    ) -> u64 {
        let number = self.wish.request.as_ref().map_or(0, |request| request.number) + 1;
        self.wish.request = Some(Arc::new(Request {
            number,
            document: document.clone(),
            library: library.clone(),
            path: path.to_owned(),
            phase,
        }));
        self.send();
        number
    }

    /// Stops for now; what is known stays.
    pub fn pause(&mut self) {
        self.wish.is_paused = true;
        self.send();
    }

    /// Goes on.
    pub fn resume(&mut self) {
        self.wish.is_paused = false;
        self.send();
    }

    /// Whether it is paused.
    pub fn is_paused(&self) -> bool {
        self.wish.is_paused
    }

    /// Begins from other seeds; what is known stays.
    pub fn shake(&mut self) {
        self.wish.n_shakes += 1;
        self.wish.is_paused = false;
        self.send();
    }

    /// Shows a take from now on.
    pub fn pick(&mut self, character: CharacterIdx, take: TakeId) {
        let n_picks = self.wish.picks.get(&character).map_or(0, |pick| pick.nth) + 1;
        self.wish.picks.insert(character, Pick { nth: n_picks, take });
        self.send();
    }

    /// Looks for takes that share much with one, and goes on if it was paused. What is found are
    /// takes like all others, made of that one.
    pub fn more_like(&mut self, character: CharacterIdx, take: TakeId) {
        let n_likes = self.wish.likes.get(&character).map_or(0, |like| like.nth) + 1;
        self.wish.likes.insert(character, Pick { nth: n_likes, take });
        self.wish.is_paused = false;
        self.send();
    }

    /// Whether the best take is shown whenever there is a better one. Off at first.
    pub fn follow_best(&mut self, follow: bool) {
        self.wish.follow_best = follow;
        self.send();
    }

    /// Whether the best take is followed.
    pub fn is_following_best(&self) -> bool {
        self.wish.follow_best
    }

    /// The latest snapshot, if there is one that was not polled yet. Never waits.
    pub fn poll(&mut self) -> Option<Arc<SearchSnapshot>> {
        let latest = self.shared.snapshots.try_take()?;
        self.latest = Arc::clone(&latest);
        Some(latest)
    }

    /// The snapshot that was polled last; an empty one before the first.
    pub fn latest(&self) -> &Arc<SearchSnapshot> {
        &self.latest
    }

    /// The latest request: its number and document.
    #[cfg(test)]
    pub(crate) fn submitted(&self) -> Option<(u64, &Document)> {
        self.wish.request.as_ref().map(|request| (request.number, &request.document))
    }

    /// Whether the worker has ended by itself, which only a mistake of ours can bring about.
    pub fn has_died(&self) -> bool {
        self.worker.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Ends the worker and waits for it: a round is cancelled within milliseconds.
    pub fn stop(mut self) {
        self.end();
    }

    fn end(&mut self) {
        self.wish.is_over = true;
        self.send();
        if let Some(worker) = self.worker.take() {
            // A worker that panicked has nothing left to be waited for.
            drop(worker.join());
        }
    }

    fn send(&self) {
        self.shared.wishes.put(self.wish.clone());
        self.shared.interrupt();
    }
}

impl Drop for LiveSearch {
    fn drop(&mut self) {
        self.end();
    }
}

/// The takes of `project` that are kept for the character `name`, as paths of the library, with a
/// sentence for each that is not possible any more.
fn kept_paths(
    project: &Document,
    name: &str,
    library: &ReadyLibrary,
) -> (Vec<motion_core::path::Path>, Vec<String>) {
    let (mut paths, mut remarks) = (Vec::new(), Vec::new());
    for take in project.takes().iter().filter(|take| take.character == name) {
        match library.path(&take.pieces) {
            Some(path) => paths.push(path),
            None => remarks.push(format!(
                "the kept take {} is not possible with this library: a clip or a cut is missing",
                take.name.clone().unwrap_or_else(|| take.id().to_string())
            )),
        }
    }
    (paths, remarks)
}

/// Whether the project wants bridges.
fn wants_bridges(project: &Project) -> bool {
    project.search.bridges.unwrap_or(true)
}

#[cfg(test)]
mod tests;
