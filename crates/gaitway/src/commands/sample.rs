//! `gaitway` alone: the built-in sample, authored without a window.

use std::path::Path;
use std::time::Duration;

use motion_io::diagnostic::Warnings;
use motion_session::budget::Budget;
use motion_session::project_job::ProjectRequest;
use motion_session::results::Clocks;
use motion_session::sample;

use super::solve::{solve_and_write, summary};
use crate::args::Common;
use crate::output::{Console, Failure};

/// Where the result goes.
const OUT: &str = "gaitway-out";

/// Enough for several good motions on any machine.
const BUDGET: Budget = Budget::Time(Duration::from_secs(3));

/// Authors the sample and says where it is.
pub(crate) fn run(common: &Common) -> Result<(), Failure> {
    let console = Console::new(common);
    console.note("there is no window yet; authoring the built-in sample (`gaitway --help` lists the commands)");
    let project = sample::sample()?;
    let request = ProjectRequest {
        project: &project,
        path: Path::new(sample::FILE_NAME),
        library: None,
        mirror: false,
        no_bridges: false,
        seed: common.seed,
        alternatives: None,
        budget: BUDGET,
    };
    let dir = Path::new(OUT);
    let (report, files) =
        solve_and_write(&console, &request, dir, Clocks::InReport, Warnings::new())?;
    console.answer(&report, || summary(&report, dir, &files))
}
