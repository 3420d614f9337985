//! What may take the place of the project that is open.

use std::path::PathBuf;

/// What is to be done as soon as unsaved work is safe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Next {
    /// An empty project.
    New,
    /// A project that a dialog asks for.
    AskOpen,
    /// This project.
    Open(PathBuf),
    /// One of the program's own.
    Sample(usize),
    /// The window closes.
    Close,
}

impl Next {
    /// What is said of unsaved work before it.
    pub(super) fn question(&self) -> &'static str {
        match self {
            Self::Close => "Save your changes before closing?",
            Self::New | Self::AskOpen | Self::Open(_) | Self::Sample(_) => {
                "Save your changes before opening another project?"
            }
        }
    }
}
