//! `gaitway man`.

use std::path::Path;

use anyhow::Context as _;

use crate::args;
use crate::output::Failure;

/// Writes a page for the program and one for each command.
pub(crate) fn run(dir: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(dir).with_context(|| dir.display().to_string())?;
    clap_mangen::generate_to(args::program(), dir).with_context(|| dir.display().to_string())?;
    Ok(())
}
