//! Project files as search problems, as the tool itself understands them: what the figures of the search
//! are measured on.

use std::path::Path;

use anyhow::Context as _;
use motion_core::search::{Problem, SearchLibrary};
use motion_io::diagnostic::Warnings;
use motion_io::project_file;
use motion_session::Library;
use motion_session::problem::problem_of;

/// The sample that asks for what cannot be.
const IMPOSSIBLE: &str = "09";

/// A problem and what it is called.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The project's number, and the character's name where there are several: `01`, `10B`.
    pub name: String,
    /// What is asked.
    pub problem: Problem,
}

/// Every character of every project in `folder`, in the order of their names, but for the impossible
/// one. Characters are asked for one by one: each keeps to its own wishes.
pub fn load_all(folder: &Path, library: &SearchLibrary) -> anyhow::Result<Vec<Asked>> {
    let library = Library {
        clips: library.clips().clone(),
        graph: library.graph().clone(),
        content_hashes: Vec::new().into(),
        hash: None,
    };
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "gaitway") {
            paths.push(path);
        }
    }
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let number = stem.split('-').next().unwrap_or_default().to_owned();
        if number == IMPOSSIBLE {
            continue;
        }
        let project = project_file::load(&path, &mut Warnings::new())?;
        for character in &project.characters {
            let asked = problem_of(&project, character, &library, true, &path)?;
            let alone = project.characters.len() == 1;
            let name = if alone { number.clone() } else { number.clone() + &character.name };
            all.push(Asked { name, problem: asked.problem });
        }
    }
    Ok(all)
}
