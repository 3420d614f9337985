//! What continuous integration runs, runnable at home.
//!
//! `cargo xtask test` is all of it; `cargo xtask bench` measures.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for developers' terminals"
)]

mod bench;
mod step;
mod system;
mod test;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  test     everything CI runs: formatting, lints, documentation, tests, dependencies
  bench    all benchmarks in release; one table at the end (arguments go to `cargo bench`)";

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let result = match args.next().as_deref() {
        Some("test") => test::run(),
        Some("bench") => bench::run(&args.collect::<Vec<_>>()),
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
