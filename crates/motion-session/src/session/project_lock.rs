//! A project is open in one session at a time.
//!
//! The lock is a file in the state folder that the system holds for the process: it is free again
//! however the process ends. A project is known by its path, an untitled one by a number.

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use motion_io::content_hash::ContentHash;
use motion_io::diagnostic::FileError;
use motion_io::pending_file::remove_leftovers;

/// Holds a project for this session.
#[derive(Debug)]
pub struct ProjectLock {
    /// Released when it is closed.
    _file: File,
    autosave: PathBuf,
}

impl ProjectLock {
    /// Holds the project at `path`. Fails where another session has it open.
    pub fn of_file(folder: &Path, path: &Path) -> Result<Self, FileError> {
        let lock = Self::named(folder, &name_of(path))?.ok_or_else(|| {
            FileError::new(path, "it is open in another window", "go on there, or close that first")
        })?;
        lock.set_aside_what_is_left()?;
        Ok(lock)
    }

    /// An autosave that a crash has left is not to be written over by the next session with the
    /// project: it goes out of the way, and is offered until somebody recovers or discards it.
    fn set_aside_what_is_left(&self) -> Result<(), FileError> {
        if !self.autosave.exists() {
            return Ok(());
        }
        let stem = self.autosave.file_stem().unwrap_or_default().to_string_lossy();
        let aside = (1..10_000)
            .map(|nth| self.autosave.with_file_name(format!("{stem}-left-{nth}.{AUTOSAVE}")))
            .find(|aside| !aside.exists());
        let aside = aside.ok_or_else(|| {
            FileError::new(&self.autosave, "too much is left unsaved", "recover or delete some")
        })?;
        std::fs::rename(&self.autosave, &aside)
            .map_err(|error| FileError::writing(&self.autosave, &error))
    }

    /// Holds a project that has no file, under a number that nobody has and nothing is left of.
    pub fn untitled(folder: &Path) -> Result<Self, FileError> {
        for nth in 1..10_000 {
            if let Some(lock) = Self::named(folder, &format!("untitled-{nth}"))?
                && !lock.autosave.exists()
            {
                return Ok(lock);
            }
        }
        Err(FileError::new(folder, "it is full of untitled projects", "recover or delete some"))
    }

    /// Holds what an autosave is of, if nobody does.
    pub fn of_autosave(autosave: &Path) -> Result<Option<Self>, FileError> {
        let folder = autosave.parent().unwrap_or(Path::new(""));
        let name = autosave.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Self::named(folder, &name)
    }

    /// Whether this holds the project at `path`, and not only something that is left of it.
    pub(super) fn is_of_file(&self, path: &Path) -> bool {
        self.autosave.file_stem().is_some_and(|stem| stem == name_of(path).as_str())
    }

    /// Where the project's autosave is.
    pub fn autosave(&self) -> &Path {
        &self.autosave
    }

    fn named(folder: &Path, name: &str) -> Result<Option<Self>, FileError> {
        std::fs::create_dir_all(folder).map_err(|error| FileError::writing(folder, &error))?;
        let path = folder.join(format!("{name}.lock"));
        let open = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
        let file = open.map_err(|error| FileError::writing(&path, &error))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) => return Err(FileError::writing(&path, &error)),
        }
        let autosave = folder.join(format!("{name}.{AUTOSAVE}"));
        // It is held, so nobody writes it.
        remove_leftovers(&autosave);
        Ok(Some(Self { _file: file, autosave }))
    }
}

/// What the lock of a project at `path` is called.
fn name_of(path: &Path) -> String {
    let hash = ContentHash::of(whole(path).as_os_str().as_encoded_bytes()).to_string();
    format!("file-{}", &hash[..16])
}

/// The same for every way to name a file, whether it is there yet or not.
fn whole(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    // A file that is not there yet has no canonical form, but its folder has.
    let in_folder = || {
        let folder = std::fs::canonicalize(absolute.parent()?).ok()?;
        Some(folder.join(absolute.file_name()?))
    };
    std::fs::canonicalize(path).ok().or_else(in_folder).unwrap_or(absolute)
}

/// The ending of autosaves.
pub(super) const AUTOSAVE: &str = "autosave";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_project_is_held_once_and_free_again() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.gaitway");
        let lock = ProjectLock::of_file(dir.path(), &path).unwrap();
        let error = ProjectLock::of_file(dir.path(), &path).unwrap_err();
        assert_eq!(error.what, "it is open in another window");
        assert!(ProjectLock::of_file(dir.path(), &dir.path().join("b.gaitway")).is_ok());
        drop(lock);
        assert!(ProjectLock::of_file(dir.path(), &path).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn a_project_is_the_same_through_a_link_before_and_after_it_is_written() {
        let dir = tempfile::tempdir().unwrap();
        let (folder, link) = (dir.path().join("folder"), dir.path().join("link"));
        std::fs::create_dir(&folder).unwrap();
        std::os::unix::fs::symlink(&folder, &link).unwrap();
        let _held = ProjectLock::of_file(dir.path(), &link.join("a.gaitway")).unwrap();
        assert!(ProjectLock::of_file(dir.path(), &folder.join("a.gaitway")).is_err());
        File::create(folder.join("a.gaitway")).unwrap();
        for path in [&folder, &link] {
            assert!(ProjectLock::of_file(dir.path(), &path.join("a.gaitway")).is_err());
        }
    }

    #[test]
    fn untitled_projects_do_not_get_into_each_others_way() {
        let dir = tempfile::tempdir().unwrap();
        let first = ProjectLock::untitled(dir.path()).unwrap();
        let second = ProjectLock::untitled(dir.path()).unwrap();
        assert_ne!(first.autosave(), second.autosave());
        motion_io::atomic_write::atomic_write(first.autosave(), b"left over").unwrap();
        let left = first.autosave().to_owned();
        drop(first);
        assert_ne!(ProjectLock::untitled(dir.path()).unwrap().autosave(), left);
        assert!(ProjectLock::of_autosave(&left).unwrap().is_some());
        assert!(ProjectLock::of_autosave(second.autosave()).unwrap().is_none());
    }
}
