//! What tests of several crates share.
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

pub mod cli;
pub mod creature;
pub mod kept_picture;
pub mod sources;
pub mod walker;

use std::path::{Path, PathBuf};

/// The workspace's root.
pub fn workspace_root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}

/// The folder with real motion capture, or `None` after saying that the test is skipped.
///
/// The clips are not ours to commit, so a checkout alone has none.
pub fn shared_dir() -> Option<PathBuf> {
    let found = find_shared_dir();
    if found.is_none() {
        eprintln!("skipped: no shared/ folder with mocap/cmu (GAITWAY_SHARED can name it)");
    }
    found
}

/// The same without a word: what `GAITWAY_SHARED` names, else a folder `shared` beside the
/// checkout or above it.
pub fn find_shared_dir() -> Option<PathBuf> {
    let named = std::env::var_os("GAITWAY_SHARED").map(PathBuf::from);
    let near = workspace_root().ancestors().skip(1).map(|folder| folder.join("shared"));
    named.into_iter().chain(near).find(|folder| folder.join("mocap/cmu").is_dir())
}
