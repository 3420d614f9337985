//! `gaitway` alone.

use crate::args::Common;
use crate::output::{self, Failure};

/// Says what there is.
pub(crate) fn run(_common: &Common) -> Result<(), Failure> {
    output::print("gaitway: there is no window yet; `gaitway --help` lists the commands\n")
}
