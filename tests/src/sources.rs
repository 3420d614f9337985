//! The workspace's own files, for tests that read them.

use std::fs;
use std::path::{Path, PathBuf};

use crate::workspace_root;

/// A file of the workspace as text.
pub struct SourceFile {
    /// Relative to the root, with `/`.
    pub path: String,
    /// Its content.
    pub text: String,
}

/// Every text file of ours with one of these extensions, in order. Build output and hidden folders
/// are left out.
pub fn source_files(extensions: &[&str]) -> Vec<SourceFile> {
    let mut paths = Vec::new();
    collect(workspace_root(), &mut paths);
    paths.sort();
    let wanted = |path: &Path| {
        path.extension().is_some_and(|e| extensions.iter().any(|wanted| *wanted == e))
    };
    paths
        .into_iter()
        .filter(|path| wanted(path))
        .map(|path| SourceFile {
            path: relative(&path),
            text: fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())),
        })
        .collect()
}

/// The folders of our crates, relative to the root.
pub fn crate_dirs() -> Vec<String> {
    let mut dirs: Vec<String> = fs::read_dir(workspace_root().join("crates"))
        .expect("the workspace has crates")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.join("Cargo.toml").is_file())
        .map(|path| relative(&path))
        .collect();
    dirs.push("tests".to_owned());
    dirs.sort();
    dirs
}

fn relative(path: &Path) -> String {
    let path = path.strip_prefix(workspace_root()).unwrap_or(path);
    path.to_string_lossy().replace('\\', "/")
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if path.is_dir() {
            let ours =
                !name.starts_with('.') && !name.starts_with("target") && name != "gaitway-out";
            if ours {
                collect(&path, found);
            }
        } else {
            found.push(path);
        }
    }
}
