//! What continuous integration runs, runnable at home.
//!
//! `cargo xtask test` is all of it; `cargo xtask bench` measures; `cargo xtask pictures`
//! draws.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for developers' terminals"
)]

mod bench;
mod graphics;
mod pictures;
mod step;
mod system;
mod test;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  test     everything CI runs: formatting, lints, documentation, tests, dependencies
  bench    all benchmarks in release, then the table of figures beside what was promised
           --quick       short runs and few seeds: a look, not a result
           --full        best known scores from long runs (half an hour, on a quiet machine)
           --only NAME   one figure, or `benches`; a wrong NAME says which there are
  pictures remakes the pictures of the documentation, in docs/pictures";

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let result = match args.next().as_deref() {
        Some("test") => test::run(),
        Some("bench") => bench::run(&args.collect::<Vec<_>>()),
        Some("pictures") => pictures::run(),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}
