//! A project is open in one session at a time.
//!
//! The lock is a file in the state folder that the system holds for the process: it is free again
//! however the process ends. A project is known by its path, an untitled one by a number.

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use motion_io::content_hash::ContentHash;
use motion_io::diagnostic::FileError;

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
        // A file that is not there yet has no canonical form.
        let whole = std::fs::canonicalize(path).or_else(|_| std::path::absolute(path));
        let whole = whole.unwrap_or_else(|_| path.to_owned());
        let hash = ContentHash::of(whole.as_os_str().as_encoded_bytes()).to_string();
        let name = format!("file-{}", &hash[..16]);
        Self::named(folder, &name)?.ok_or_else(|| {
            FileError::new(path, "it is open in another window", "go on there, or close that first")
        })
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
        Ok(Some(Self { _file: file, autosave: folder.join(format!("{name}.{AUTOSAVE}")) }))
    }
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
