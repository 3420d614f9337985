//! One module for each command.

pub(crate) mod alone;
mod completions;
mod convert;
mod coverage;
#[cfg(feature = "editor")]
mod edit;
mod library;
mod man;
mod measure;
#[cfg(feature = "render")]
mod render;
mod sample;
mod solve;

use crate::args::{Command, Common};
use crate::output::{Console, Failure};

/// Does what was asked.
pub(crate) fn run(common: &Common, command: Command) -> Result<(), Failure> {
    let console = Console::new(common);
    match command {
        Command::Library(args) => library::run(&console, &args),
        Command::Solve(args) => solve::run(&console, common, &args),
        Command::Measure(args) => measure::run(&console, &args),
        Command::Convert(args) => convert::run(&console, &args),
        #[cfg(feature = "render")]
        Command::Render(args) => render::run(&console, common, &args),
        #[cfg(feature = "editor")]
        Command::Edit { project, recovered } => edit::run(&console, project, recovered),
        Command::Completions { shell } => completions::run(shell),
        Command::Man { output } => man::run(&output),
    }
}
