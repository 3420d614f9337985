//! Where a project comes from.

use std::path::{Path, PathBuf};

use motion_session::{Project, Warnings, load_project, sample};

/// The project that is opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProjectSource {
    /// The one that the program has with it.
    Sample,
    /// A file.
    File(PathBuf),
    /// Work that was saved when a window went down.
    Recovered {
        /// Where it was saved.
        work: PathBuf,
        /// The project that it belongs to; `None` for the sample.
        project: Option<PathBuf>,
    },
}

impl ProjectSource {
    /// Reads it; fails with a sentence. The path is the one that messages name.
    pub fn read(&self, warnings: &mut Warnings) -> Result<(Project, PathBuf), String> {
        let said = |error: motion_session::FileError| error.to_string();
        match self {
            Self::Sample => {
                let path = Path::new(sample::FILE_NAME).to_owned();
                Ok((sample::sample().map_err(said)?, path))
            }
            Self::File(path) => Ok((load_project(path, warnings).map_err(said)?, path.clone())),
            Self::Recovered { work, project } => {
                let sample = || Path::new(sample::FILE_NAME).to_owned();
                let path = project.clone().unwrap_or_else(sample);
                Ok((load_project(work, warnings).map_err(said)?, path))
            }
        }
    }
}
