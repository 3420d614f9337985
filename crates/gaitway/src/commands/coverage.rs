//! `gaitway library coverage`.

use std::path::Path;

use motion_session::coverage_report::CoverageReport;

use super::library::open;
use crate::output::{Console, Failure};

/// Says what a library can do and what it cannot.
pub(super) fn run(console: &Console, library: &Path) -> Result<(), Failure> {
    let report = CoverageReport::new(&open(console, library)?);
    console.answer(&report, || report.text())
}
