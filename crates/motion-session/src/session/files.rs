//! A session's project on disk: opening, saving, autosaves, what a crash has left.

use std::path::{Path, PathBuf};

use motion_io::diagnostic::{FileError, Warnings};
use motion_io::pending_file::remove_leftovers;
use motion_io::project_file::{self, Project, relative_to};

use super::autosave::{self, Autosaver, Recovery};
use super::project_lock::ProjectLock;
use super::view_state::ViewState;
use super::{AUTOSAVE_SECS, Session};
use crate::command::Command;
use crate::document::Document;
use crate::sample;

/// Where a session's project is, and what of it is saved.
#[derive(Debug)]
pub(super) struct Files {
    /// Its file, if it has one.
    path: Option<PathBuf>,
    /// The document as it is in the file, or as it was begun.
    saved: Document,
    /// Whether it is in no file at all: recovered, or never saved and changed.
    is_unsaved: bool,
    state_folder: Option<PathBuf>,
    autosaver: Option<Autosaver>,
    lock: Option<ProjectLock>,
    /// Holds the autosave that was recovered, where that is not the one of `lock`: it stays until
    /// everything is saved.
    recovered: Option<ProjectLock>,
    /// So long after a change it is kept, at most, seconds.
    autosave_secs: f64,
    /// Why an autosave failed last.
    failure: Option<FileError>,
    /// The document that was last autosaved.
    kept: Option<Document>,
    /// Seconds since a change that is not kept yet.
    secs_at_risk: f64,
}

impl Files {
    pub(super) fn new(
        saved: Document,
        state_folder: Option<PathBuf>,
        autosaver: Option<Autosaver>,
    ) -> Self {
        let (path, lock, kept) = (None, None, None);
        let (is_unsaved, secs_at_risk) = (false, 0.0);
        let (recovered, autosave_secs) = (None, AUTOSAVE_SECS);
        Self {
            path,
            saved,
            is_unsaved,
            state_folder,
            autosaver,
            lock,
            recovered,
            autosave_secs,
            failure: None,
            kept,
            secs_at_risk,
        }
    }

    /// The project's path for messages, and for what is relative to it.
    pub(super) fn path_in_messages(&self) -> &Path {
        self.path.as_deref().unwrap_or(Path::new(sample::FILE_NAME))
    }

    /// Where what has no file of its own is kept, if anywhere.
    pub(super) fn state_folder(&self) -> Option<&Path> {
        self.state_folder.as_deref()
    }

    /// Another project, which is in this file; the last one's autosave goes.
    fn begin(&mut self, path: Option<PathBuf>, saved: Document, lock: Option<ProjectLock>) {
        self.forget();
        (self.path, self.saved, self.lock) = (path, saved, lock);
        (self.is_unsaved, self.kept, self.secs_at_risk) = (false, None, 0.0);
    }

    /// Removes the autosave: everything is saved, or given up.
    fn forget(&mut self) {
        self.kept = None;
        if let (Some(autosaver), Some(lock)) = (&self.autosaver, &self.lock) {
            autosaver.remove(lock.autosave());
        }
        if let Some(recovered) = self.recovered.take() {
            // Best effort: at worst it is offered once too often. No autosaver writes this one.
            drop(std::fs::remove_file(recovered.autosave()));
        }
    }

    fn lock_for(&self, path: &Path) -> Result<Option<ProjectLock>, FileError> {
        let folder = self.state_folder.as_deref();
        folder.map(|folder| ProjectLock::of_file(folder, path)).transpose()
    }
}

impl Session {
    /// The project's file, if it has one.
    pub fn path(&self) -> Option<&Path> {
        self.files.path.as_deref()
    }

    /// Whether there is something that is in no file.
    pub fn is_changed(&self) -> bool {
        self.files.is_unsaved || *self.history.settled() != self.files.saved
    }

    /// Opens a project in the place of this one, whose unsaved changes are given up. Fails, with
    /// nothing changed, on a file that is wrong or open in another session.
    pub fn open(&mut self, path: &Path) -> Result<(), FileError> {
        let is_own = self.files.path.as_deref() == Some(path);
        let mut warnings = Warnings::new();
        let project = project_file::load(path, &mut warnings)?;
        // Its own file is held already.
        let lock = if is_own { self.files.lock.take() } else { self.files.lock_for(path)? };
        if is_own {
            self.files.lock = lock;
            self.files.forget();
            self.begin_project(&project);
        } else {
            let document = Document::from_project(project.clone());
            if lock.is_some() {
                // It is ours, so nobody writes it.
                remove_leftovers(path);
            }
            self.files.begin(Some(path.to_owned()), document, lock);
            self.begin_project(&project);
        }
        self.remarks.extend(warnings.as_slice().iter().map(ToString::to_string));
        Ok(())
    }

    /// Begins a project that has no file, in the place of this one.
    pub fn begin_new(&mut self, project: &Project) {
        self.files.begin(None, Document::from_project(project.clone()), None);
        self.begin_untitled();
        self.begin_project(project);
    }

    /// Goes on with work that was saved elsewhere when the program went down, in the place of this
    /// project. It belongs to `file`, if to any, and is changed until it is saved there.
    pub fn go_on_with(&mut self, work: &Project, file: Option<&Path>) -> Result<(), FileError> {
        let lock = file.map(|file| self.files.lock_for(file)).transpose()?.flatten();
        self.files.begin(file.map(Path::to_owned), Document::from_project(work.clone()), lock);
        if file.is_none() {
            self.begin_untitled();
        }
        self.files.is_unsaved = true;
        self.begin_project(work);
        Ok(())
    }

    /// Saves to the project's own file. Fails where it has none: then ask for one and
    /// [`save_as`](Self::save_as).
    pub fn save(&mut self) -> Result<(), FileError> {
        let Some(path) = self.files.path.clone() else {
            let path = Path::new("the project");
            return Err(FileError::new(path, "it has no file yet", "say where to save it"));
        };
        self.write_to(&path)
    }

    /// Saves to another file, which is the project's own from now on.
    pub fn save_as(&mut self, path: &Path) -> Result<(), FileError> {
        if self.files.path.as_deref() == Some(path) {
            return self.write_to(path);
        }
        let lock = self.files.lock_for(path)?;
        self.take_library_along(path);
        self.write_to(path)?;
        (self.files.path, self.files.lock) = (Some(path.to_owned()), lock);
        self.follow_document();
        Ok(())
    }

    /// What sessions that are over have left unsaved.
    pub fn recoveries(&self) -> Vec<Recovery> {
        self.files.state_folder.as_deref().map(autosave::recoveries).unwrap_or_default()
    }

    /// Goes on with what a session left unsaved, in the place of this project. It is changed until
    /// it is saved.
    pub fn recover(&mut self, recovery: &Recovery) -> Result<(), FileError> {
        let held = ProjectLock::of_autosave(&recovery.autosave)?.ok_or_else(|| {
            FileError::new(&recovery.autosave, "another window is at it", "go on there")
        })?;
        let document = Document::from_project(recovery.project.clone());
        let file = recovery.file.clone();
        // An autosave that was set aside does not hold the project's file.
        let is_own = file.is_some() && self.files.path == file;
        let (lock, recovered) = match file.as_deref().filter(|file| !held.is_of_file(file)) {
            Some(_) if is_own => {
                self.files.forget();
                (self.files.lock.take(), Some(held))
            }
            Some(file) => (self.files.lock_for(file)?, Some(held)),
            None => (Some(held), None),
        };
        if let Some(file) = file.as_deref().filter(|_| lock.is_some()) {
            remove_leftovers(file);
        }
        self.files.begin(file, document.clone(), lock);
        self.files.recovered = recovered;
        self.files.is_unsaved = true;
        // It is what the autosave has; that stays until it is saved.
        self.files.kept = Some(document);
        self.begin_project(&recovery.project);
        Ok(())
    }

    /// Throws away what a session left unsaved.
    pub fn discard(&self, recovery: &Recovery) {
        // Best effort: at worst it is offered once more.
        drop(std::fs::remove_file(&recovery.autosave));
    }

    /// Ends the session; unsaved changes are given up, since the user was asked. A session that is
    /// only dropped leaves them for [`recoveries`](Self::recoveries).
    pub fn close(&mut self) {
        self.files.forget();
        // What was given up is not kept again, and as soon as its autosave is gone the project is
        // anybody's to open.
        self.files.autosaver = None;
        self.files.lock = None;
    }

    /// Holds a place for a project without a file.
    pub(super) fn begin_untitled(&mut self) {
        let Some(folder) = self.files.state_folder.as_deref() else { return };
        match ProjectLock::untitled(folder) {
            Ok(lock) => self.files.lock = Some(lock),
            Err(error) => self.remarks.push(format!("there is no autosave: {error}")),
        }
    }

    /// Keeps what has changed so long after it did, at most. Until this is called that is
    /// [`AUTOSAVE_SECS`].
    pub fn set_autosave_secs(&mut self, secs: f64) {
        self.files.autosave_secs = if secs.is_finite() { secs.max(0.0) } else { AUTOSAVE_SECS };
    }

    /// Keeps what has changed, in time.
    pub(super) fn keep(&mut self, dt_secs: f64) {
        let files = &mut self.files;
        let Some(autosaver) = &files.autosaver else { return };
        if let Some(error) = autosaver.failure() {
            // It is tried again and again, and said once.
            files.kept = None;
            if files.failure.replace(error.clone()).is_none_or(|said| said != error) {
                self.remarks.push(format!("the autosave failed: {error}"));
            }
        }
        let settled = self.history.settled();
        if files.kept.is_some() && !files.is_unsaved && *settled == files.saved {
            // Everything was undone: there is nothing to be recovered.
            files.forget();
        }
        let files = &mut self.files;
        let Some(autosaver) = &files.autosaver else { return };
        let is_kept = *settled == *files.kept.as_ref().unwrap_or(&files.saved);
        if is_kept {
            files.secs_at_risk = 0.0;
            return;
        }
        files.secs_at_risk += dt_secs.max(0.0);
        let Some(lock) = files.lock.as_ref().filter(|_| files.secs_at_risk >= files.autosave_secs)
        else {
            return;
        };
        let mut project = settled.to_project();
        self.view.put_into(&mut project);
        autosaver.write(project, files.path.as_deref(), lock.autosave());
        files.kept = Some(settled.clone());
        files.secs_at_risk = 0.0;
    }

    /// A library is written relative to its project's file; in another folder it is written whole.
    fn take_library_along(&mut self, to: &Path) {
        let Some(from) = self.files.path.clone() else { return };
        let written = self.history.settled().library().to_owned();
        let whole = relative_to(&written, &from).and_then(|at| std::path::absolute(at).ok());
        let moves = from.parent() != to.parent() && Path::new(&written).is_relative();
        if let Some(library) = whole.filter(|_| moves) {
            let library = library.to_string_lossy().into_owned();
            // Only an empty name is refused.
            drop(self.history.apply(&Command::SetLibrary { library }));
        }
    }

    fn begin_project(&mut self, project: &Project) {
        let document = Document::from_project(project.clone());
        if !self.files.is_unsaved {
            self.files.saved = document.clone();
        }
        self.replace(document, ViewState::of(project));
    }

    fn write_to(&mut self, path: &Path) -> Result<(), FileError> {
        let settled = self.history.settled().clone();
        let mut project = settled.to_project();
        self.view.put_into(&mut project);
        project_file::save(&project, path)?;
        self.files.forget();
        self.files.saved = settled;
        self.files.is_unsaved = false;
        self.files.secs_at_risk = 0.0;
        Ok(())
    }
}
