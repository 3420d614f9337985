//! One command of a run: said, timed, and remembered.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::Context as _;

/// The workspace's root.
pub(crate) fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here)
}

/// `cargo` with `args` at the workspace's root, with no input.
pub(crate) fn cargo(args: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(args).current_dir(root()).stdin(Stdio::null());
    command
}

/// Whether a command runs and succeeds; its output is not shown.
pub(crate) fn succeeds(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// How a step ended.
pub(crate) enum Outcome {
    Passed(Duration),
    Failed(Duration),
    Skipped(&'static str),
}

/// Steps in the order they were run. A failure does not stop the ones that follow, so that one run
/// says everything that is wrong.
#[derive(Default)]
pub(crate) struct Steps(Vec<(&'static str, Outcome)>);

impl Steps {
    /// Runs `command` with its output passed on.
    pub(crate) fn run(&mut self, name: &'static str, command: &mut Command) -> anyhow::Result<()> {
        println!("\n== {name}: {}", shown(command));
        let start = Instant::now();
        let status = command.status().with_context(|| format!("{name}: cannot start"))?;
        let took = start.elapsed();
        let outcome = if status.success() { Outcome::Passed(took) } else { Outcome::Failed(took) };
        self.0.push((name, outcome));
        Ok(())
    }

    /// Notes a step that this machine cannot run.
    pub(crate) fn skip(&mut self, name: &'static str, why: &'static str) {
        println!("\n== {name}: skipped, {why}");
        self.0.push((name, Outcome::Skipped(why)));
    }

    /// Prints what passed and fails if anything did.
    pub(crate) fn finish(self) -> anyhow::Result<()> {
        println!();
        let mut failed = Vec::new();
        for (name, outcome) in &self.0 {
            match outcome {
                Outcome::Passed(took) => {
                    println!("{name:<16} passed  {:>6.1} s", took.as_secs_f64());
                }
                Outcome::Skipped(why) => println!("{name:<16} skipped: {why}"),
                Outcome::Failed(took) => {
                    println!("{name:<16} FAILED  {:>6.1} s", took.as_secs_f64());
                    failed.push(*name);
                }
            }
        }
        anyhow::ensure!(failed.is_empty(), "failed: {}", failed.join(", "));
        Ok(())
    }
}

/// A command as a person would type it.
fn shown(command: &Command) -> String {
    let args: Vec<_> = command.get_args().map(|arg| arg.to_string_lossy()).collect();
    format!("cargo {}", args.join(" "))
}
