//! Work saved where it is found again after something went wrong.

use std::path::{Path, PathBuf};

use motion_io::diagnostic::FileError;
use motion_io::project_file::{self, Project};

/// The folder for work that was saved by the program rather than its user: `gaitway` in the user's
/// folder for state (`XDG_STATE_HOME`, `LOCALAPPDATA`, or `.local/state` at home), or in the
/// temporary folder where there is none.
pub fn recovery_folder() -> PathBuf {
    let named = |name| std::env::var_os(name).filter(|path| !path.is_empty()).map(PathBuf::from);
    let state = named("XDG_STATE_HOME")
        .or_else(|| named("LOCALAPPDATA"))
        .or_else(|| named("HOME").map(|home| home.join(".local/state")));
    state.unwrap_or_else(std::env::temp_dir).join("gaitway")
}

/// Saves `project` in `folder`, which is made if it is missing; gives the file. A file saved there
/// before for the same project is replaced.
pub fn save_for_recovery(project: &Project, folder: &Path) -> Result<PathBuf, FileError> {
    std::fs::create_dir_all(folder).map_err(|error| {
        FileError::new(folder, format!("it cannot be made ({error})"), "check its parent folder")
    })?;
    let path = folder.join(format!("{}-recovered.gaitway", file_stem(project)));
    project_file::save(project, &path)?;
    Ok(path)
}

/// The project's name as far as a file's name can hold it.
fn file_stem(project: &Project) -> String {
    const MAX_CHARS: usize = 60;
    let fits = |c: char| if c.is_alphanumeric() || "-_ ".contains(c) { c } else { '-' };
    let stem: String = project.name.trim().chars().take(MAX_CHARS).map(fits).collect();
    if stem.is_empty() { "untitled".to_owned() } else { stem }
}

#[cfg(test)]
mod tests {
    use motion_io::diagnostic::Warnings;

    use super::*;
    use crate::sample;

    #[test]
    fn what_is_saved_can_be_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut project = sample::sample().unwrap();
        for name in ["turn and jump", "../../etc/passwd", "", "  a\\b:c  "] {
            project.name = name.to_owned();
            let path = save_for_recovery(&project, &folder.path().join("state")).unwrap();
            assert_eq!(path.parent().unwrap(), folder.path().join("state"), "{name:?}");
            let again = project_file::load(&path, &mut Warnings::new()).unwrap();
            assert_eq!(again.name, name);
            assert_eq!(again.characters, project.characters);
        }
    }

    #[test]
    fn a_folder_that_cannot_be_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::File::create(&file).unwrap();
        let project = sample::sample().unwrap();
        assert!(save_for_recovery(&project, &file.join("below")).is_err());
    }
}
