//! The built-in sample, authored without a window.

use std::path::Path;
use std::time::Duration;

use motion_core::search::SearchKind;
use motion_io::diagnostic::Warnings;
use motion_io::project_file::Project;
use motion_session::budget::Budget;
use motion_session::project_job::{ProjectRequest, Solved};
use motion_session::results::Clocks;
use motion_session::sample;

use super::solve::{solve_and_write, summary};
use crate::args::Common;
use crate::output::{Console, Failure};

/// Where the result goes.
const OUT: &str = "gaitway-out";

/// What the best motion looks like.
const SHEET: &str = "A-1.png";

/// Enough for several good motions on any machine.
const BUDGET: Budget = Budget::Time(Duration::from_secs(3));

/// Authors the sample and says where it is.
pub(crate) fn run(common: &Common) -> Result<(), Failure> {
    let console = Console::new(common);
    let project = sample::sample()?;
    let request = ProjectRequest {
        project: &project,
        path: Path::new(sample::FILE_NAME),
        library: None,
        mirror: false,
        no_bridges: false,
        seed: common.seed,
        kind: SearchKind::default(),
        alternatives: None,
        budget: BUDGET,
    };
    let dir = Path::new(OUT);
    let (solved, files) =
        solve_and_write(&console, &request, dir, Clocks::InReport, Warnings::new())?;
    let sheet = picture(&console, &project, &solved, &dir.join(SHEET));
    let report = &solved.report;
    console.answer(report, || summary(report, dir, &files) + &sheet)
}

/// Draws the best motion's contact sheet, and says where it is or why it is not: motions are worth
/// having without it.
#[cfg(feature = "render")]
fn picture(console: &Console, project: &Project, solved: &Solved, path: &Path) -> String {
    match super::render::draw_sheet(console, project, solved, path) {
        Ok(()) => format!("a contact sheet of the best is {}\n", path.display()),
        Err(failure) => {
            console.note(&format!("there is no contact sheet: {failure}"));
            String::new()
        }
    }
}

#[cfg(not(feature = "render"))]
fn picture(_: &Console, _: &Project, _: &Solved, _: &Path) -> String {
    String::new()
}
