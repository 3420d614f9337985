//! `gaitway completions`.

use clap_complete::Shell;

use crate::args;
use crate::output::{self, Failure};

/// Prints the completion script of `shell`.
pub(crate) fn run(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut args::program(), "gaitway", &mut script);
    output::print(&String::from_utf8(script).map_err(anyhow::Error::from)?)
}
