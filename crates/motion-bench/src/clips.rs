//! The clips that everything is measured on, and the library of them.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Context as _;
use motion_core::cancel::CancelToken;
use motion_core::search::SearchLibrary;
use motion_io::diagnostic::Warnings;
use motion_io::import::ImportOptions;
use motion_io::library_file::LibraryFile;
use motion_session::library_job::{self, Clips, GraphChoices};
use motion_session::library_source::builtin_clips;
use motion_tests::find_shared_dir;

/// Where the clips come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A folder with the motion capture that the figures are promised for.
    Cmu(PathBuf),
    /// Our own clips, for want of others; the figures then only compare with each other.
    BuiltIn,
}

impl Source {
    /// The motion capture where there is some, else the built-in library.
    pub fn find() -> Self {
        find_shared_dir().map_or(Self::BuiltIn, |shared| Self::Cmu(shared.join("mocap/cmu")))
    }

    /// Where projects on these clips are.
    pub fn problems(&self) -> anyhow::Result<PathBuf> {
        let shared = find_shared_dir().context("there is no shared folder")?;
        Ok(shared.join("problems"))
    }

    /// Imports the clips and calibrates their floors, or performs them.
    pub fn load(&self) -> anyhow::Result<Clips> {
        let Self::Cmu(folder) = self else { return Ok(builtin_clips()?) };
        let (inputs, options) = ([folder.clone()], ImportOptions::default());
        let (cancel, mut warnings) = (CancelToken::new(), Warnings::new());
        Ok(library_job::import(&inputs, &options, &cancel, &mut warnings, &|_, _| ())?.0)
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cmu(_) => f.write_str("shared/mocap/cmu"),
            Self::BuiltIn => f.write_str("the built-in library (no shared/mocap/cmu was found)"),
        }
    }
}

/// The library of `clips` with default options, as `gaitway library build` makes it.
pub fn build(clips: Clips, mirror: bool) -> anyhow::Result<LibraryFile> {
    let choices = GraphChoices { mirror, ..GraphChoices::default() };
    Ok(library_job::build(clips, &choices, &CancelToken::new(), &|_, _| ())?)
}

/// A library arranged for searching.
pub fn search_library(file: LibraryFile) -> Arc<SearchLibrary> {
    let LibraryFile { clips, graph, .. } = file;
    Arc::new(SearchLibrary::new(Arc::new(clips), Arc::new(graph)))
}
