//! Projects that were open lately.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// Most that are remembered.
pub const MAX_RECENT: usize = 12;

/// Project files, the latest first.
///
/// 1. Every path is whole and can be written as text.
/// 2. None is there twice, and there are [`MAX_RECENT`] at most.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<PathBuf>", into = "Vec<PathBuf>")]
pub struct RecentFiles {
    paths: Vec<PathBuf>,
}

impl RecentFiles {
    /// Puts a file first. One whose path is no text is not remembered.
    pub fn note(&mut self, path: &Path) {
        let Ok(path) = std::path::absolute(path) else { return };
        if path.to_str().is_none() {
            return;
        }
        self.paths.retain(|known| *known != path);
        self.paths.insert(0, path);
        self.paths.truncate(MAX_RECENT);
    }

    /// Forgets one.
    pub fn forget(&mut self, path: &Path) {
        self.paths.retain(|known| known != path);
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.paths.clear();
    }

    /// All that are remembered. Some may be gone.
    pub fn all(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Those that are there now. The others stay remembered: a disk may come back. It asks the file
    /// system, so ask when a menu opens and not in every frame.
    pub fn shown(&self) -> Vec<PathBuf> {
        self.paths.iter().filter(|path| path.is_file()).cloned().collect()
    }

    /// What two windows remember together: `self`, after which come the files of `theirs` that are
    /// new since both had `before`.
    pub(super) fn merged(&self, before: &Self, theirs: &Self) -> Self {
        let news = |path: &&PathBuf| !self.paths.contains(path) && !before.paths.contains(path);
        self.paths
            .iter()
            .chain(theirs.paths.iter().filter(news))
            .cloned()
            .collect::<Vec<_>>()
            .into()
    }
}

impl From<Vec<PathBuf>> for RecentFiles {
    fn from(paths: Vec<PathBuf>) -> Self {
        let mut recent = Self::default();
        for path in paths.iter().filter(|path| path.is_absolute()).rev() {
            recent.note(path);
        }
        recent
    }
}

impl From<RecentFiles> for Vec<PathBuf> {
    fn from(recent: RecentFiles) -> Self {
        recent.paths
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(dir: &Path, names: &[&str]) -> RecentFiles {
        names.iter().map(|name| dir.join(name)).collect::<Vec<_>>().into()
    }

    #[test]
    fn the_latest_is_first_and_none_is_there_twice() {
        let dir = tempfile::tempdir().unwrap();
        let mut recent = of(dir.path(), &["a", "b", "c"]);
        recent.note(&dir.path().join("b"));
        assert_eq!(recent, of(dir.path(), &["b", "a", "c"]));
        for nth in 0..30 {
            recent.note(&dir.path().join(format!("{nth}")));
        }
        assert_eq!(recent.all().len(), MAX_RECENT);
        assert_eq!(recent.all()[0], dir.path().join("29"));
        recent.forget(&dir.path().join("29"));
        assert_eq!(recent.all()[0], dir.path().join("28"));
        recent.clear();
        assert_eq!(recent, RecentFiles::default());
    }

    #[test]
    fn what_is_gone_is_not_shown() {
        let dir = tempfile::tempdir().unwrap();
        let here = dir.path().join("b");
        motion_io::atomic_write::atomic_write(&here, b"").unwrap();
        let recent = of(dir.path(), &["a", "b"]);
        assert_eq!(recent.shown(), [here]);
        assert_eq!(recent.all().len(), 2);
    }

    #[test]
    fn two_windows_remember_together() {
        let dir = tempfile::tempdir().unwrap();
        let of = |names| of(dir.path(), names);
        let before = of(&["a", "b"]);
        let (ours, theirs) = (of(&["c", "a"]), of(&["d", "b", "a"]));
        assert_eq!(ours.merged(&before, &theirs), of(&["c", "a", "d"]), "b was forgotten by us");
    }
}
