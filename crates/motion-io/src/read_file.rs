//! Reading a whole file within a limit.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use crate::diagnostic::FileError;

/// The bytes of the file at `path`.
///
/// Fails when it is missing, unreadable, no plain file (a pipe would block), or larger than
/// `max_bytes`; memory is taken only for what passed the limit.
pub fn read_file(path: &Path, max_bytes: u64) -> Result<Vec<u8>, FileError> {
    let reading = |error: std::io::Error| FileError::reading(path, &error);
    // Asked before opening, since opening a pipe waits for its writer.
    let metadata = std::fs::metadata(path).map_err(reading)?;
    if metadata.is_dir() {
        return Err(FileError::new(path, "it is a folder", "name a file"));
    }
    if !metadata.is_file() {
        return Err(FileError::new(path, "it is not a plain file", "copy it into a file first"));
    }
    let too_large = || {
        FileError::new(
            path,
            format!("the file is larger than {} MiB", max_bytes >> 20),
            "split it or check that it is the right file",
        )
    };
    if metadata.len() > max_bytes {
        return Err(too_large());
    }
    let file = File::open(path).map_err(reading)?;
    let mut bytes = Vec::with_capacity(usize::try_from(metadata.len()).unwrap_or(0));
    // The file may have grown since.
    file.take(max_bytes + 1).read_to_end(&mut bytes).map_err(reading)?;
    if bytes.len() as u64 > max_bytes {
        return Err(too_large());
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_readable_file_is_refused_with_a_word() {
        let dir = tempfile::tempdir().unwrap();
        let missing = read_file(&dir.path().join("none.bvh"), 10).unwrap_err();
        assert_eq!((missing.what.as_str(), missing.line), ("there is no such file", None));
        assert_eq!(read_file(dir.path(), 10).unwrap_err().what, "it is a folder");
    }

    #[test]
    fn the_limit_is_inclusive() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::io::Write::write_all(&mut file.as_file(), b"0123456789").unwrap();
        assert_eq!(read_file(file.path(), 10).unwrap(), b"0123456789");
        assert!(read_file(file.path(), 9).is_err());
    }
}
