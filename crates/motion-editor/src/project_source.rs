//! Where a project comes from.

use std::path::PathBuf;

use motion_session::{Session, Warnings, load_project};

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

/// A project was opened.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Opened {
    /// What is odd about it.
    pub remarks: Vec<String>,
}

impl ProjectSource {
    /// Opens it in the place of the session's project, or fails with a sentence and changes nothing.
    pub fn open_in(&self, session: &mut Session) -> Result<Opened, String> {
        let said = |error: motion_session::FileError| error.to_string();
        match self {
            // What a session begins with.
            Self::Sample => Ok(Opened::default()),
            Self::File(path) => {
                session.open(path).map_err(said)?;
                Ok(Opened::default())
            }
            Self::Recovered { work, project } => {
                let mut warnings = Warnings::new();
                let saved = load_project(work, &mut warnings).map_err(said)?;
                session.go_on_with(&saved, project.as_deref()).map_err(said)?;
                let remarks = warnings.as_slice().iter().map(ToString::to_string).collect();
                Ok(Opened { remarks })
            }
        }
    }
}
