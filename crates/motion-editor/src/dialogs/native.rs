//! The system's own file dialogs.

use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use rfd::{AsyncFileDialog, FileHandle};

use super::ask::{Ask, Wanted};
use super::portal;

/// Nobody reads a dialog and cancels it as fast as this. Where no dialog can be opened the library
/// says the same as for one that was cancelled, but at once.
const FASTER_THAN_ANYBODY: Duration = Duration::from_millis(250);

/// How a dialog of the system's ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NativeAnswer {
    /// These were chosen.
    Chosen(Vec<PathBuf>),
    /// It was closed.
    Cancelled,
    /// There is no such dialog here.
    Unavailable,
}

/// A dialog that is open, on a thread of its own.
#[derive(Debug)]
pub(super) struct NativeDialog {
    answers: Receiver<NativeAnswer>,
}

impl NativeDialog {
    /// Opens one; `wake` is called when there is an answer.
    pub(super) fn open(ask: &Ask, folder: &Path, wake: impl Fn() + Send + 'static) -> Self {
        // The system's dialog on a Mac must be made on the window's thread. On Linux making it is
        // already asking for it, which comes after the question whether there is one.
        let early = (!cfg!(target_os = "linux")).then(|| begin(ask, folder));
        let (ask, folder) = (ask.clone(), folder.to_owned());
        let (sender, answers) = sync_channel(1);
        let for_thread: SyncSender<NativeAnswer> = sender.clone();
        let work = move || {
            let answer = if portal::has_file_dialog() {
                let start = Instant::now();
                let chosen = pollster::block_on(early.unwrap_or_else(|| begin(&ask, &folder)));
                judge(chosen, start.elapsed())
            } else {
                NativeAnswer::Unavailable
            };
            // A window that is gone needs no answer.
            drop(for_thread.send(answer));
            wake();
        };
        if thread::Builder::new().name("file dialog".to_owned()).spawn(work).is_err() {
            drop(sender.send(NativeAnswer::Unavailable));
        }
        Self { answers }
    }

    /// How it ended, once.
    pub(super) fn poll(&self) -> Option<NativeAnswer> {
        match self.answers.try_recv() {
            Ok(answer) => Some(answer),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(NativeAnswer::Unavailable),
        }
    }
}

/// What came of a dialog that was there for so long.
fn judge(chosen: Option<Vec<PathBuf>>, lasted: Duration) -> NativeAnswer {
    match chosen.filter(|paths| !paths.is_empty()) {
        Some(paths) => NativeAnswer::Chosen(paths),
        None if lasted < FASTER_THAN_ANYBODY => NativeAnswer::Unavailable,
        None => NativeAnswer::Cancelled,
    }
}

type Choosing = Pin<Box<dyn Future<Output = Option<Vec<PathBuf>>> + Send>>;

fn begin(ask: &Ask, folder: &Path) -> Choosing {
    let mut dialog = AsyncFileDialog::new().set_title(ask.title()).set_directory(folder);
    if ask.wanted() != Wanted::Folder {
        dialog = dialog.add_filter(ask.kind_of_files(), ask.endings());
    }
    let one = |handle: Option<FileHandle>| handle.map(|handle| vec![handle.path().to_owned()]);
    match ask.wanted() {
        Wanted::File => {
            let choosing = dialog.pick_file();
            Box::pin(async move { one(choosing.await) })
        }
        Wanted::Files => {
            let choosing = dialog.pick_files();
            Box::pin(async move {
                let handles = choosing.await?;
                Some(handles.iter().map(|handle| handle.path().to_owned()).collect())
            })
        }
        Wanted::Folder => {
            let choosing = dialog.pick_folder();
            Box::pin(async move { one(choosing.await) })
        }
        Wanted::NewFile => {
            let choosing = dialog.set_file_name(ask.suggested()).save_file();
            Box::pin(async move { one(choosing.await) })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dialog_that_was_never_there_is_told_from_one_that_was_cancelled() {
        let (soon, later) = (Duration::from_millis(3), Duration::from_secs(2));
        assert_eq!(judge(None, soon), NativeAnswer::Unavailable);
        assert_eq!(judge(Some(Vec::new()), later), NativeAnswer::Cancelled);
        assert_eq!(judge(None, later), NativeAnswer::Cancelled);
        let chosen = vec![PathBuf::from("a")];
        assert_eq!(judge(Some(chosen.clone()), soon), NativeAnswer::Chosen(chosen));
    }
}
