//! One module for each command.

mod completions;
mod man;
pub(crate) mod sample;

use crate::args::{Command, Common};
use crate::output::Failure;

/// Does what was asked.
pub(crate) fn run(_common: &Common, command: Command) -> Result<(), Failure> {
    match command {
        Command::Completions { shell } => completions::run(shell),
        Command::Man { output } => man::run(&output),
    }
}
