//! `gaitway solve`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use motion_io::diagnostic::Warnings;
use motion_io::project_file;
use motion_io::report_file::Report;
use motion_session::project_job::{ProjectRequest, Solved, solve_project};
use motion_session::results::{Clocks, write_results};
use motion_session::suggest::WOULD_HELP;

use crate::args::{Common, Solve};
use crate::interrupt::cancel_on_interrupt;
use crate::output::{Console, Failure};
use crate::plan;

/// Solves a project and writes what was found.
pub(crate) fn run(console: &Console, common: &Common, args: &Solve) -> Result<(), Failure> {
    let mut warnings = Warnings::new();
    let project = project_file::load(&args.project, &mut warnings)?;
    let (budget, clocks) = plan::budget(args);
    let request = ProjectRequest {
        project: &project,
        path: &args.project,
        library: plan::library(args),
        mirror: args.mirror,
        no_bridges: args.no_bridges,
        seed: common.seed,
        kind: plan::search_kind(args),
        alternatives: args.alternatives.map(usize::from),
        budget,
    };
    let (solved, files) = solve_and_write(console, &request, &args.output, clocks, warnings)?;
    console.answer(&solved.report, || summary(&solved.report, &args.output, &files))
}

/// Solves, writes to `dir`, and gives what was found and the motions' files.
pub(crate) fn solve_and_write(
    console: &Console,
    request: &ProjectRequest<'_>,
    dir: &Path,
    clocks: Clocks,
    mut warnings: Warnings,
) -> Result<(Solved, Vec<PathBuf>), Failure> {
    plan::check_results_folder(dir)?;
    let cancel = cancel_on_interrupt();
    let bar = console.bar();
    let on_progress = |what: &str, share| bar.set(what, share);
    let solved = solve_project(request, &cancel, &mut warnings, &on_progress);
    drop(bar);
    console.warnings(&warnings);
    let mut solved = solved?;
    let files = write_results(&mut solved, dir, clocks)?;
    if files.is_empty() {
        let sentences: Vec<String> =
            solved.report.characters.into_iter().flat_map(|c| c.unmet).collect();
        return Err(anyhow::anyhow!("{}", sentences.join("; ")).into());
    }
    Ok((solved, files))
}

/// What a person wants to know at once.
pub(crate) fn summary(report: &Report, dir: &Path, files: &[PathBuf]) -> String {
    let mut out = String::new();
    for character in &report.characters {
        // Writing to a string cannot fail.
        let _ok = writeln!(
            out,
            "{}: {} motions{}",
            character.name,
            character.alternatives.len(),
            if character.alternatives.is_empty() { "" } else { ", best first" }
        );
        for alternative in &character.alternatives {
            let _ok = writeln!(
                out,
                "  {:<12} score {:>7.3}  {} frames  {} pieces",
                alternative.files.join(" "),
                alternative.score,
                alternative.frames,
                alternative.pieces.len()
            );
        }
        for sentence in &character.unmet {
            let _ok = match sentence.strip_prefix(WOULD_HELP) {
                Some(what) => writeln!(out, "  would help: {what}"),
                None => writeln!(out, "  not met: {sentence}"),
            };
        }
    }
    let n = files.len();
    let _ok = writeln!(out, "{n} motions and report.json are in {}", dir.display());
    out
}
