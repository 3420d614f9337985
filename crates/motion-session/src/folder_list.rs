//! What is in a folder, for choosing from.

use std::path::{Path, PathBuf};

use motion_io::diagnostic::FileError;

/// Most that are listed: nobody looks further down.
pub const MAX_LISTED: usize = 2_000;

/// Most that are looked at, so that a folder without an end comes to one.
const MAX_LOOKED_AT: usize = 200_000;

/// Something in a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FolderEntry {
    /// What it is called, as far as that is text.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
    /// Whether it is a folder, or a link to one.
    pub is_folder: bool,
}

/// Folders first, then files, each by name whatever the case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FolderList {
    /// The first [`MAX_LISTED`].
    pub entries: Vec<FolderEntry>,
    /// How many more there are, at least.
    pub n_left_out: usize,
}

impl FolderList {
    /// Lists a folder's folders, and its files whose names end in one of `endings` whatever the case;
    /// all files where there are no endings. What is hidden is left out. Fails where the folder
    /// cannot be read. A slow disk makes it slow: not for the thread that draws.
    pub fn read(folder: &Path, endings: &[&str]) -> Result<Self, FileError> {
        Self::read_at_most(folder, endings, MAX_LISTED)
    }

    fn read_at_most(folder: &Path, endings: &[&str], most: usize) -> Result<Self, FileError> {
        let reading = |error: std::io::Error| FileError::reading(folder, &error);
        let mut entries = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(reading)?.take(MAX_LOOKED_AT) {
            let Ok(entry) = entry else { continue };
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.starts_with('.') {
                continue;
            }
            // A link is what it leads to.
            let is_folder = match entry.file_type() {
                Ok(kind) if kind.is_symlink() => path.is_dir(),
                Ok(kind) => kind.is_dir(),
                Err(_) => continue,
            };
            if is_folder || fits(&path, endings) {
                entries.push(FolderEntry { name, path, is_folder });
            }
        }
        entries.sort_by_cached_key(|e| (!e.is_folder, e.name.to_lowercase(), e.name.clone()));
        let n_left_out = entries.len().saturating_sub(most);
        entries.truncate(most);
        Ok(Self { entries, n_left_out })
    }
}

/// Whether a file's name ends in one of these.
fn fits(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    endings.is_empty() || endings.iter().any(|known| known.eq_ignore_ascii_case(ending))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_first_and_only_what_fits() {
        let dir = tempfile::tempdir().unwrap();
        for name in ["b.bvh", "A.BVH", "c.txt", ".hidden.bvh"] {
            std::fs::File::create(dir.path().join(name)).unwrap();
        }
        for name in ["zoo", "Ape", ".git"] {
            std::fs::create_dir(dir.path().join(name)).unwrap();
        }
        let names = |endings: &[&str], most| {
            let list = FolderList::read_at_most(dir.path(), endings, most).unwrap();
            let names: Vec<String> = list.entries.into_iter().map(|e| e.name).collect();
            (names.join(" "), list.n_left_out)
        };
        assert_eq!(names(&["bvh"], 10), ("Ape zoo A.BVH b.bvh".to_owned(), 0));
        assert_eq!(names(&["bvh"], 3), ("Ape zoo A.BVH".to_owned(), 1));
        assert_eq!(names(&[], 10), ("Ape zoo A.BVH b.bvh c.txt".to_owned(), 0));
    }

    #[test]
    fn a_folder_that_cannot_be_read_is_said() {
        let dir = tempfile::tempdir().unwrap();
        assert!(FolderList::read(&dir.path().join("none"), &[]).is_err());
    }
}
