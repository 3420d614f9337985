//! `gaitway`: say where a person must be, how and when; get the motion, cut from motion capture.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the one crate with a terminal")]

mod args;
mod commands;
mod interrupt;
mod output;
mod plan;
#[cfg(feature = "render")]
mod quiet_drivers;
#[cfg(feature = "render")]
mod render;

use std::process::ExitCode;

use crate::args::Args;
use crate::output::Failure;

fn main() -> ExitCode {
    output::report_panics_in_one_line();
    let work = || args::parse(std::env::args_os()).and_then(run);
    // A panic has said its line by then. No file is half-written, since files are renamed into
    // place, so nothing has to be mended before leaving.
    match std::panic::catch_unwind(work) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(failure)) => failure.report(),
        Err(_panic) => ExitCode::FAILURE,
    }
}

fn run(args: Args) -> Result<(), Failure> {
    #[cfg(feature = "render")]
    if matches!(args.command, None | Some(args::Command::Render(_))) {
        quiet_drivers::start_over_quietly();
    }
    plan::use_threads(args.common.threads)?;
    match args.command {
        Some(command) => commands::run(&args.common, command),
        None => commands::alone::run(&args.common),
    }
}
