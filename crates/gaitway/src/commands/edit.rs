//! `gaitway edit`.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::Context as _;

use motion_editor::dialogs::Answers;
use motion_editor::project_source::ProjectSource;
use motion_editor::run::{Closed, OpenError, run as open};
use motion_editor::state::EditorOptions;
use motion_io::diagnostic::Warnings;
use motion_io::project_file;
use motion_session::preferences::{config_folder, state_folder};

use crate::output::{Console, Failure};

/// Opens the editor and waits until it is closed.
pub(crate) fn run(
    console: &Console,
    project: Option<PathBuf>,
    recovered: Option<PathBuf>,
) -> Result<(), Failure> {
    if let Some(path) = &project {
        // A window that opens only to say that the file is wrong is worth less than a line here.
        let mut warnings = Warnings::new();
        project_file::load(path, &mut warnings)?;
        console.warnings(&warnings);
    }
    let source = match recovered {
        Some(work) => ProjectSource::Recovered { work, project: project.clone() },
        None => project.clone().map_or(ProjectSource::Sample, ProjectSource::File),
    };
    let closed = open(options(source)).map_err(|error| {
        let way_out = match error {
            OpenError::NoDisplay(_) => "use solve and render, which need none",
            OpenError::NoWindow(_) => "install a graphics driver, or use solve and render",
        };
        Failure::Other(anyhow::anyhow!("{error}; {way_out}"))
    })?;
    after(console, closed, project.as_deref())
}

/// An editor that remembers, and asks with the system's dialogs.
fn options(source: ProjectSource) -> EditorOptions {
    EditorOptions {
        source,
        state_folder: Some(state_folder()),
        config_folder: Some(config_folder()),
        answers: Answers::System,
    }
}

/// Opens the editor on the built-in sample and waits until it is closed: then gives how that went.
/// Fails where no window can be.
pub(crate) fn open_sample(console: &Console) -> Result<Result<(), Failure>, OpenError> {
    open(options(ProjectSource::Sample)).map(|closed| after(console, closed, None))
}

/// Sees to what must be done after a window.
fn after(console: &Console, closed: Closed, project: Option<&Path>) -> Result<(), Failure> {
    match closed {
        Closed::ByUser => Ok(()),
        Closed::DeviceLost(work) => {
            console.note(&format!(
                "the graphics device was lost; the work is in {}, and the window opens again on it",
                work.display()
            ));
            open_again(&work, project)
        }
    }
}

/// Starts the program over on saved work.
fn open_again(work: &Path, project: Option<&Path>) -> Result<(), Failure> {
    let program = std::env::current_exe().context("the program does not find itself")?;
    let mut again = Command::new(program);
    again.arg("edit").args(project).arg("--recovered").arg(work);
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt as _;
        // Comes back only if the program cannot be started.
        Err(anyhow::Error::new(again.exec()).context("the window cannot be opened again").into())
    }
    #[cfg(not(unix))]
    {
        again.spawn().context("the window cannot be opened again")?;
        Ok(())
    }
}
