//! `gaitway edit`.

use std::path::PathBuf;

use motion_editor::project_source::ProjectSource;
use motion_editor::run::{OpenError, run as open};
use motion_io::diagnostic::Warnings;
use motion_io::project_file;

use crate::output::{Console, Failure};

/// Opens the editor and waits until it is closed.
pub(crate) fn run(console: &Console, project: Option<PathBuf>) -> Result<(), Failure> {
    if let Some(path) = &project {
        // A window that opens only to say that the file is wrong is worth less than a line here.
        let mut warnings = Warnings::new();
        project_file::load(path, &mut warnings)?;
        console.warnings(&warnings);
    }
    let source = project.map_or(ProjectSource::Sample, ProjectSource::File);
    open(source).map_err(|error| {
        let way_out = match error {
            OpenError::NoDisplay(_) => "use solve and render, which need none",
            OpenError::NoWindow(_) => "install a graphics driver, or use solve and render",
        };
        Failure::Other(anyhow::anyhow!("{error}; {way_out}"))
    })
}
