//! Which files an import reads.

use std::path::{Path, PathBuf};

use crate::diagnostic::FileError;
use crate::limits::{MAX_FOLDER_DEPTH, MAX_LIBRARY_FILES};

/// Extensions of files that hold a motion, in small letters.
pub const MOTION_EXTENSIONS: [&str; 3] = ["bvh", "glb", "gltf"];

/// The motion files that `inputs` mean, in their order; folders by file name, files of a folder
/// before those of folders within it.
///
/// Fails for an input that is missing, a file of another kind, and a folder without motion files.
/// Hidden files and links to folders are passed over.
pub fn motion_files(inputs: &[PathBuf], recursive: bool) -> Result<Vec<PathBuf>, FileError> {
    let mut files = Vec::new();
    for input in inputs {
        let metadata =
            std::fs::metadata(input).map_err(|error| FileError::reading(input, &error))?;
        if !metadata.is_dir() {
            if !is_motion_file(input) {
                return Err(FileError::new(
                    input,
                    "it is not a kind of motion file that can be read",
                    "give .bvh, .glb or .gltf files, or folders of them",
                ));
            }
            files.push(input.clone());
            continue;
        }
        let n_before = files.len();
        add_folder(input, if recursive { MAX_FOLDER_DEPTH } else { 0 }, &mut files)?;
        if files.len() == n_before {
            let hint = if recursive {
                "give a folder with .bvh, .glb or .gltf files"
            } else {
                "give a folder with .bvh, .glb or .gltf files, or add --recursive"
            };
            return Err(FileError::new(input, "there are no motion files in the folder", hint));
        }
    }
    match inputs {
        [] => Err(FileError::new(".", "no input is given", "name files or folders")),
        [first, ..] if files.len() > MAX_LIBRARY_FILES => Err(FileError::new(
            first,
            format!("there are {} motion files, more than {MAX_LIBRARY_FILES}", files.len()),
            "build several libraries",
        )),
        _ => Ok(files),
    }
}

fn add_folder(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<(), FileError> {
    let reading = |error: std::io::Error| FileError::reading(folder, &error);
    let mut folders = Vec::new();
    let n_before = files.len();
    for entry in std::fs::read_dir(folder).map_err(reading)? {
        let entry = entry.map_err(reading)?;
        let name = entry.file_name();
        if name.to_string_lossy().starts_with('.') {
            continue;
        }
        let kind = entry.file_type().map_err(reading)?;
        let path = folder.join(name);
        if kind.is_dir() {
            folders.push(path);
        } else if is_motion_file(&path) && (kind.is_file() || path.is_file()) {
            files.push(path);
        }
        if files.len() > 2 * MAX_LIBRARY_FILES {
            // More than enough to be refused; a listing need not be read to its end.
            return Ok(());
        }
    }
    files[n_before..].sort();
    if depth > 0 {
        folders.sort();
        for folder in folders {
            add_folder(&folder, depth - 1, files)?;
        }
    }
    Ok(())
}

fn is_motion_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| {
        MOTION_EXTENSIONS.iter().any(|known| extension.eq_ignore_ascii_case(known))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(names: &[&str]) -> tempfile::TempDir {
        let dir = tempfile::tempdir().unwrap();
        for name in names {
            let path = dir.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::File::create(path).unwrap();
        }
        dir
    }

    fn names(dir: &Path, recursive: bool) -> Vec<String> {
        let files = motion_files(&[dir.to_owned()], recursive).unwrap();
        let name = |f: &PathBuf| f.strip_prefix(dir).unwrap().display().to_string();
        files.iter().map(name).collect()
    }

    #[test]
    fn a_folder_is_its_motion_files_by_name() {
        let dir = folder_with(&["b.bvh", "a.BVH", "README.md", ".c.bvh", "sub/0.bvh"]);
        assert_eq!(names(dir.path(), false), ["a.BVH", "b.bvh"]);
        assert_eq!(names(dir.path(), true), ["a.BVH", "b.bvh", "sub/0.bvh"]);
    }

    #[test]
    fn what_is_no_input_is_refused() {
        let dir = folder_with(&["a.txt", "sub/b.bvh"]);
        let what = |path: PathBuf, recursive| motion_files(&[path], recursive).unwrap_err().what;
        assert_eq!(what(dir.path().into(), false), "there are no motion files in the folder");
        assert_eq!(
            what(dir.path().join("a.txt"), false),
            "it is not a kind of motion file that can be read"
        );
        assert_eq!(what(dir.path().join("none"), false), "there is no such file");
        assert_eq!(motion_files(&[], false).unwrap_err().what, "no input is given");
    }

    #[cfg(unix)]
    #[test]
    fn links_to_folders_are_not_followed() {
        let dir = folder_with(&["a.bvh"]);
        std::os::unix::fs::symlink(dir.path(), dir.path().join("loop")).unwrap();
        assert_eq!(names(dir.path(), true), ["a.bvh"]);
    }
}
