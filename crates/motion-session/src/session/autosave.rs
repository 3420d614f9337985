//! What is not saved yet, kept where a crash leaves it.
//!
//! An autosave is a small wrapper around a project: where its file is, and the project. It is
//! written whole or not at all, by a thread of its own, since syncing a disk takes a while.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use motion_io::atomic_write::atomic_write;
use motion_io::diagnostic::{FileError, Warnings};
use motion_io::limits::MAX_PROJECT_FILE_BYTES;
use motion_io::project_file::{self, Project};
use motion_io::read_file::read_file;
use serde_json::{Value, json};

use super::project_lock::{AUTOSAVE, ProjectLock};
use crate::live::mailbox::Mailbox;

const VERSION_KEY: &str = "gaitway_autosave";

/// A project that a session left behind.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovery {
    /// The autosave.
    pub autosave: PathBuf,
    /// The project's own file, if it had one.
    pub file: Option<PathBuf>,
    /// The project as it was last kept.
    pub project: Project,
    /// Whether the project's file was written after this: then it may well have everything.
    pub file_is_newer: bool,
}

/// The text of an autosave.
pub(super) fn encode(project: &Project, file: Option<&Path>) -> String {
    let text = project_file::write(project);
    // A project that was just written is JSON.
    let project: Value = serde_json::from_str(&text).unwrap_or(Value::Null);
    let file = file.map(|file| file.to_string_lossy().into_owned());
    json!({VERSION_KEY: 1, "file": file, "project": project}).to_string()
}

/// Reads an autosave. Fails, as a project file does, with what is wrong.
pub(super) fn read(autosave: &Path) -> Result<Recovery, FileError> {
    let bytes = read_file(autosave, MAX_PROJECT_FILE_BYTES)?;
    let bad = || FileError::new(autosave, "it is no autosave", "delete it");
    let mut wrapper: Value = serde_json::from_slice(&bytes).map_err(|_bad_json| bad())?;
    let is_known = wrapper.get(VERSION_KEY).and_then(Value::as_u64) == Some(1);
    let project = wrapper.get_mut("project").filter(|_| is_known).map(Value::take);
    let text = project.ok_or_else(bad)?.to_string();
    let file = wrapper.get("file").and_then(Value::as_str).map(PathBuf::from);
    let project = project_file::read(text.as_bytes(), autosave, &mut Warnings::new())?;
    let written_at = |path: &Path| std::fs::metadata(path).and_then(|m| m.modified()).ok();
    let of_file = file.as_deref().and_then(written_at);
    let file_is_newer = of_file.is_some_and(|of_file| Some(of_file) > written_at(autosave));
    Ok(Recovery { autosave: autosave.to_owned(), file, project, file_is_newer })
}

/// What sessions that are over have left in `folder`, by the name of the autosave. What cannot be
/// read is left out, and what another session is at.
pub(super) fn recoveries(folder: &Path) -> Vec<Recovery> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == AUTOSAVE));
    paths.sort();
    paths.retain(|path| matches!(ProjectLock::of_autosave(path), Ok(Some(_))));
    paths.iter().filter_map(|path| read(path).ok()).collect()
}

/// Writes autosaves on a thread of its own. Of several that wait, the latest is written.
#[derive(Debug)]
pub(super) struct Autosaver {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug, Default)]
struct Shared {
    tasks: Mailbox<Task>,
    failures: Mailbox<FileError>,
}

#[derive(Debug)]
enum Task {
    Write { project: Box<Project>, file: Option<PathBuf>, to: PathBuf },
    Remove { autosave: PathBuf },
    End,
}

impl Autosaver {
    pub(super) fn start() -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let for_thread = Arc::clone(&shared);
        let thread =
            thread::Builder::new().name("autosave".to_owned()).spawn(move || for_thread.run())?;
        Ok(Self { shared, thread: Some(thread) })
    }

    pub(super) fn write(&self, project: Project, file: Option<&Path>, to: &Path) {
        let (file, to) = (file.map(Path::to_owned), to.to_owned());
        self.shared.tasks.put(Task::Write { project: Box::new(project), file, to });
    }

    /// Removes an autosave after anything that is being written.
    pub(super) fn remove(&self, autosave: &Path) {
        self.shared.tasks.put(Task::Remove { autosave: autosave.to_owned() });
    }

    /// Why the last one could not be written, once.
    pub(super) fn failure(&self) -> Option<FileError> {
        self.shared.failures.try_take()
    }

    /// Waits until everything is done.
    pub(super) fn finish(&mut self) {
        let Some(thread) = self.thread.take() else { return };
        // What still waits is more than an end, and comes after what is being done: an autosave that
        // is to be removed may be being written.
        let waiting = self.shared.tasks.take();
        self.shared.tasks.put(Task::End);
        drop(thread.join());
        if let Some(task) = waiting {
            self.shared.carry_out(task);
        }
    }
}

impl Drop for Autosaver {
    fn drop(&mut self) {
        self.finish();
    }
}

impl Shared {
    fn run(&self) {
        loop {
            match self.tasks.wait(Duration::from_secs(3600)) {
                Some(Task::End) => return,
                Some(task) => self.carry_out(task),
                None => {}
            }
        }
    }

    fn carry_out(&self, task: Task) {
        match task {
            Task::Write { project, file, to } => {
                let text = encode(&project, file.as_deref());
                if let Err(error) = atomic_write(&to, text.as_bytes()) {
                    self.failures.put(error);
                }
            }
            // Best effort: at worst it is offered once too often.
            Task::Remove { autosave } => drop(std::fs::remove_file(autosave)),
            Task::End => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn what_was_kept_is_offered_once_nobody_is_at_it() {
        let dir = tempfile::tempdir().unwrap();
        let lock = ProjectLock::untitled(dir.path()).unwrap();
        let project = sample::sample().unwrap();
        let mut autosaver = Autosaver::start().unwrap();
        autosaver.write(project.clone(), Some(Path::new("walk.gaitway")), lock.autosave());
        autosaver.finish();
        assert_eq!(recoveries(dir.path()), [], "its session is still there");
        let autosave = lock.autosave().to_owned();
        drop(lock);
        atomic_write(&dir.path().join("broken.autosave"), b"{\"gaitway_auto").unwrap();
        let found = recoveries(dir.path());
        let file = Some(PathBuf::from("walk.gaitway"));
        assert_eq!(
            found,
            [Recovery { autosave: autosave.clone(), file, project, file_is_newer: false }]
        );
        let mut autosaver = Autosaver::start().unwrap();
        autosaver.remove(&autosave);
        autosaver.finish();
        assert_eq!(recoveries(dir.path()), []);
    }

    #[test]
    fn a_folder_that_is_not_there_is_said() {
        let mut autosaver = Autosaver::start().unwrap();
        let dir = tempfile::tempdir().unwrap();
        autosaver.write(sample::sample().unwrap(), None, &dir.path().join("none/x.autosave"));
        autosaver.finish();
        assert_eq!(autosaver.failure().unwrap().what, "the folder it goes into does not exist");
        assert_eq!(autosaver.failure(), None);
    }
}
