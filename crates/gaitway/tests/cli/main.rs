//! The program as a person runs it.

mod words;

use motion_tests::cli::{Dir, Ran};

/// Runs the program in `dir`; the arguments are separated by single spaces.
fn gaitway(dir: &Dir, args: &str) -> Ran {
    let args: Vec<&str> = args.split(' ').filter(|arg| !arg.is_empty()).collect();
    motion_tests::cli::run(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args)
}
