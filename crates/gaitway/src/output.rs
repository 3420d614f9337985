//! What is said, where, and the exit status.

use std::io::{self, Write as _};
use std::process::ExitCode;

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
            Self::Other(error) => say(&format!("{error:#}"), ExitCode::FAILURE),
            Self::Wrong(message) => say(&message, ExitCode::from(2)),
        }
    }
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Other(error.into())
    }
}

/// One line on stderr. Nobody can be told when that fails.
fn say(message: &str, status: ExitCode) -> ExitCode {
    let line = message.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    drop(writeln!(io::stderr(), "gaitway: {line}"));
    status
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
        drop(writeln!(
            io::stderr(),
            "gaitway: a mistake in gaitway itself, at {place}: {what}; please report it"
        ));
    }));
}
