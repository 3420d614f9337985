//! The terminal: what is said, where, and the exit status.
//!
//! Answers go to stdout. Everything else goes to stderr: errors as `gaitway: what; what to do`,
//! remarks, and progress bars where stderr is a terminal.

use std::fmt;
use std::io::{self, IsTerminal as _, Write as _};
use std::process::ExitCode;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use motion_core::graph::BuildError;
use motion_io::diagnostic::{FileError, Warnings};
use motion_session::JobError;

use crate::args::Common;

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The input or the arguments are wrong: `[FILE[:LINE]: ]what is wrong; what to do`. Status 2.
    Wrong(String),
    /// Anything else. Status 1.
    Other(anyhow::Error),
    /// Help or version was asked for: printed, status 0.
    Help(clap::Error),
}

impl Failure {
    /// The input or the arguments are wrong; the message says what and what to do.
    pub(crate) fn wrong(message: impl Into<String>) -> Self {
        Self::Wrong(message.into())
    }

    /// Says it and gives the exit status.
    pub(crate) fn report(self) -> ExitCode {
        match self {
            Self::Help(help) => match help.print() {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => Self::from(error).report(),
            },
            // Whoever read our output has seen enough (`gaitway … | head`).
            Self::Other(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
            Self::Other(error) => {
                say(&format!("{error:#}"));
                ExitCode::FAILURE
            }
            Self::Wrong(message) => {
                say(&message);
                ExitCode::from(2)
            }
        }
    }
}

/// The line that [`Failure::report`] says, without the program's name.
impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wrong(message) => message.fmt(f),
            Self::Other(error) => write!(f, "{error:#}"),
            Self::Help(help) => help.fmt(f),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Other(error.into())
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Self::Other(error)
    }
}

/// A file that cannot be used is wrong input.
impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::Wrong(error.to_string())
    }
}

/// Wrong input is the user's to mend; everything else is not.
impl From<JobError> for Failure {
    fn from(error: JobError) -> Self {
        match error {
            JobError::File(error) => error.into(),
            JobError::Build(
                error @ (BuildError::NoClips | BuildError::BadTau(_) | BuildError::Memory { .. }),
            ) => Self::Wrong(error.to_string()),
            other => Self::Other(other.into()),
        }
    }
}

/// One line on stderr. Nobody can be told when that fails.
fn say(message: &str) {
    let line = message.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    drop(writeln!(io::stderr(), "gaitway: {line}"));
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
    })
}

/// Writes to stdout; a closed pipe comes back as an error that ends the program quietly.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    Ok(stdout.flush()?)
}

/// A panic is a mistake of ours. It still must not throw a stack of frames at an animator.
pub(crate) fn report_panics_in_one_line() {
    std::panic::set_hook(Box::new(|info| {
        let what = info
            .payload_as_str()
            .map_or("for a reason that was not said", |what| what.lines().next().unwrap_or(what));
        let place = info.location().map(|at| format!("{}:{}", at.file(), at.line()));
        let place = place.unwrap_or_else(|| "an unknown place".to_owned());
        say(&format!("a mistake in gaitway itself, at {place}: {what}; please report it"));
    }));
}

/// How much a command says besides its answer.
#[derive(Clone, Debug)]
pub(crate) struct Console {
    json: bool,
    quiet: bool,
    verbose: bool,
}

/// So many warnings are shown without `--verbose`.
const MAX_WARNINGS: usize = 8;

impl Console {
    /// As the options say.
    pub(crate) fn new(common: &Common) -> Self {
        Self { json: common.json, quiet: common.quiet, verbose: common.verbose }
    }

    /// Whether more than the usual is asked for.
    pub(crate) fn is_verbose(&self) -> bool {
        self.verbose
    }

    /// The command's answer, as text for people or as one JSON document.
    pub(crate) fn answer(
        &self,
        document: &impl serde::Serialize,
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        if self.json {
            let mut json = serde_json::to_string_pretty(document).map_err(anyhow::Error::from)?;
            json.push('\n');
            print(&json)
        } else {
            print(&text())
        }
    }

    /// A remark that helps to follow the work.
    pub(crate) fn note(&self, line: &str) {
        if !self.quiet {
            say(line);
        }
    }

    /// What was odd about the input.
    pub(crate) fn warnings(&self, warnings: &Warnings) {
        if self.quiet {
            return;
        }
        let found = warnings.as_slice();
        let shown = if self.verbose { found.len() } else { found.len().min(MAX_WARNINGS) };
        for warning in &found[..shown] {
            say(&format!("warning: {warning}"));
        }
        if shown < found.len() {
            say(&format!("{} more warnings; --verbose shows all", found.len() - shown));
        }
    }

    /// A bar on a terminal, nothing elsewhere.
    pub(crate) fn bar(&self) -> Bar {
        let hidden = self.quiet || !io::stderr().is_terminal();
        let bar = if hidden { ProgressBar::hidden() } else { ProgressBar::new(1000) };
        let style = ProgressStyle::with_template(
            "{msg:<24} {wide_bar} {percent:>3} %  {elapsed}, {eta} left",
        );
        if let Ok(style) = style {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Bar(bar)
    }
}

/// How far some work is. Dropped, it is gone from the terminal.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// `share` (0 to 1) of the work called `what` is done.
    pub(crate) fn set(&self, what: &str, share: f64) {
        if self.0.message() != what {
            self.0.set_message(what.to_owned());
        }
        self.0.set_position((share.clamp(0.0, 1.0) * 1000.0) as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
