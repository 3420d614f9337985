//! Writing a file so that it is there whole or not at all.

use std::io::Write as _;
use std::path::Path;

use crate::diagnostic::FileError;
use crate::pending_file::PendingFile;

/// Writes `bytes` to `path`: to a temporary name in the same folder, synced, then renamed over
/// what was there; then the folder is synced.
///
/// Whatever happens on the way, `path` holds either its old content or all of the new one, and
/// no temporary file stays. A link is followed, so that the file it points to is replaced.
pub fn atomic_write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let mut pending = PendingFile::create(path)?;
    pending.write_all(bytes).map_err(|error| FileError::writing(path, &error))?;
    pending.keep()
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;
    use std::fs;

    use super::*;

    fn names_in(folder: &Path) -> Vec<OsString> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect()
    }

    #[test]
    fn old_content_is_replaced_and_nothing_else_stays() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.bvh");
        atomic_write(&path, b"old").unwrap();
        atomic_write(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names_in(dir.path()), ["a.bvh"]);
    }

    #[test]
    fn a_missing_folder_is_said() {
        let dir = tempfile::tempdir().unwrap();
        let error = atomic_write(&dir.path().join("none/a.bvh"), b"x").unwrap_err();
        assert_eq!(error.what, "the folder it goes into does not exist");
    }

    #[test]
    fn a_folder_is_never_replaced() {
        let dir = tempfile::tempdir().unwrap();
        assert_eq!(atomic_write(dir.path(), b"x").unwrap_err().what, "it is a folder");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed() {
        let dir = tempfile::tempdir().unwrap();
        let (file, link) = (dir.path().join("file"), dir.path().join("link"));
        atomic_write(&file, b"old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        atomic_write(&link, b"new").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
