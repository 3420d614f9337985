//! A file that appears under its name once it is complete.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::diagnostic::FileError;

/// A file that is being written, under a hidden name beside the one it will have.
///
/// [`PendingFile::keep`] gives it its name. Dropped before that, it is gone, and what had the name
/// is as it was.
#[derive(Debug)]
pub struct PendingFile {
    /// As the user named it, for messages.
    path: PathBuf,
    /// What will be replaced: the path with links followed.
    target: PathBuf,
    temporary: PathBuf,
    file: File,
    is_kept: bool,
}

impl PendingFile {
    /// Begins the file that will be at `path`. A link is followed, so that the file it points to is
    /// replaced.
    pub fn create(path: &Path) -> Result<Self, FileError> {
        if path.is_dir() {
            return Err(FileError::new(path, "it is a folder", "name a file to write"));
        }
        // A path that does not exist yet has no canonical form; then it is no link either.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let Some(name) = target.file_name() else {
            return Err(FileError::new(path, "it does not name a file", "name a file to write"));
        };
        let create = || -> io::Result<(PathBuf, File)> {
            // A process that was killed leaves its temporary file, and its number may be ours now.
            for _ in 0..MAX_LEFT {
                let temporary = folder_of(&target).join(temporary_name(name.to_owned()));
                match OpenOptions::new().write(true).create_new(true).open(&temporary) {
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                    opened => return Ok((temporary, opened?)),
                }
            }
            Err(io::ErrorKind::AlreadyExists.into())
        };
        let (temporary, file) = create().map_err(|error| FileError::writing(path, &error))?;
        Ok(Self { path: path.to_owned(), target, temporary, file, is_kept: false })
    }

    /// The hidden name, for a program that is to write the file.
    pub fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// Where it will be, as the user named it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Syncs the file, renames it over what was there, and syncs the folder.
    pub fn keep(mut self) -> Result<(), FileError> {
        self.file
            .sync_all()
            .and_then(|()| fs::rename(&self.temporary, &self.target))
            .map_err(|error| FileError::writing(&self.path, &error))?;
        self.is_kept = true;
        sync_folder(&folder_of(&self.target))
            .map_err(|error| FileError::writing(&self.path, &error))
    }
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        if !self.is_kept {
            // Best effort: after a failed write the temporary file may not even exist.
            drop(fs::remove_file(&self.temporary));
        }
    }
}

/// Removes what processes that were killed while they wrote `path` have left beside it. Only for who
/// knows that nobody writes `path` now.
pub fn remove_leftovers(path: &Path) {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let Some(name) = target.file_name().and_then(|name| name.to_str()) else { return };
    let entries = fs::read_dir(folder_of(&target)).into_iter().flatten().flatten();
    for entry in entries {
        let of_entry = entry.file_name();
        let number = of_entry.to_str().and_then(|of_entry| {
            of_entry.strip_prefix('.')?.strip_prefix(name)?.strip_prefix('.')?.strip_suffix(".tmp")
        });
        let is_number = |n: &str| n.bytes().all(|b| b.is_ascii_digit() || b == b'-');
        if number.is_some_and(|number| !number.is_empty() && is_number(number)) {
            // Best effort: it only takes room.
            drop(fs::remove_file(entry.path()));
        }
    }
}

/// More temporary files of one number are never left.
const MAX_LEFT: usize = 1_000;

fn folder_of(target: &Path) -> PathBuf {
    match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// A hidden name beside the target that no other process or thread chooses.
fn temporary_name(name: OsString) -> OsString {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let count = COUNTER.fetch_add(1, Ordering::Relaxed);
    let mut temporary = OsString::from(".");
    temporary.push(name);
    temporary.push(format!(".{}-{count}.tmp", std::process::id()));
    temporary
}

/// Makes the rename itself durable. Only Unix can open a folder for that.
fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_killed_process_left_is_in_nobodys_way() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("walk.gaitway");
        // Names that this process, with the number of the killed one, would take next.
        let next: u64 = temporary_name("n".into())
            .to_str()
            .and_then(|name| name.strip_suffix(".tmp")?.rsplit('-').next()?.parse().ok())
            .unwrap();
        for count in next..next + 60 {
            let name = format!(".walk.gaitway.{}-{count}.tmp", std::process::id());
            File::create(dir.path().join(name)).unwrap();
        }
        for other in [".walk.gaitway.x.tmp", ".other.gaitway.1-1.tmp", "walk.gaitway.1-1.tmp"] {
            File::create(dir.path().join(other)).unwrap();
        }
        let mut pending = PendingFile::create(&path).unwrap();
        pending.write_all(b"new").unwrap();
        pending.keep().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        remove_leftovers(&path);
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 4, "others' files stay");
    }

    #[test]
    fn what_is_not_kept_was_never_there() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("film.gif");
        File::create(&path).unwrap().write_all(b"old").unwrap();
        let mut pending = PendingFile::create(&path).unwrap();
        pending.write_all(b"half of the ne").unwrap();
        drop(pending);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }

    #[test]
    fn another_program_may_write_under_the_hidden_name() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("film.mp4");
        let pending = PendingFile::create(&path).unwrap();
        assert!(pending.temporary().exists() && !path.exists());
        File::create(pending.temporary()).unwrap().write_all(b"new").unwrap();
        pending.keep().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}
