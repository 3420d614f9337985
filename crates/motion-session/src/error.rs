//! Why a job did not end with a result.

use motion_core::cancel::Cancelled;
use motion_core::clip::ClipSetError;
use motion_core::graph::BuildError;
use motion_io::diagnostic::FileError;

/// Why a job did not end with a result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JobError {
    /// A file is wrong, or something in it.
    #[error(transparent)]
    File(#[from] FileError),
    /// Somebody stopped the job before there was anything to keep.
    #[error("stopped before there was a result")]
    Cancelled(#[from] Cancelled),
    /// The graph could not be built.
    #[error(transparent)]
    Build(BuildError),
    /// Imported clips do not form a set, which import rules out.
    #[error("{0}; please report this")]
    Clips(#[from] ClipSetError),
    /// The program's own clips are wrong, which tests rule out.
    #[error("the built-in library cannot be made ({0}); please report this")]
    Builtin(String),
}

impl From<BuildError> for JobError {
    fn from(error: BuildError) -> Self {
        match error {
            BuildError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            other => Self::Build(other),
        }
    }
}
