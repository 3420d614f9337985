//! `cargo xtask test`.

use crate::graphics::Graphics;
use crate::step::{Steps, cargo, succeeds};
use crate::system;

/// Everything CI runs, cheapest first.
pub(crate) fn run() -> anyhow::Result<()> {
    system::install_missing()?;
    let mut steps = Steps::default();
    steps.run("formatting", &mut cargo(&["fmt", "--all", "--", "--check"]))?;
    steps.run(
        "lints",
        &mut cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"]),
    )?;
    steps.run(
        "documentation",
        cargo(&["doc", "--workspace", "--no-deps", "--document-private-items", "--locked"])
            .env("RUSTDOCFLAGS", "-D warnings"),
    )?;
    // Unit tests, integration tests and doctests. The rules of the workspace (who may depend on
    // whom, what a source file looks like) are tests too, in `tests/headless`.
    let mut tests = cargo(&["test", "--workspace", "--locked", "--no-fail-fast"]);
    let graphics = Graphics::find_or_install();
    match &graphics {
        Ok(graphics) => steps.run("tests", graphics.apply(&mut tests))?,
        Err(why) => {
            steps.skip("software Vulkan", why);
            steps.run("tests", &mut tests)?;
        }
    }
    if succeeds(&mut cargo(&["deny", "--version"])) {
        // Advisories need a database from the network, which CI may not have.
        steps.run("licences", &mut cargo(&["deny", "check", "licenses", "bans", "sources"]))?;
    } else {
        steps.skip("licences", "cargo-deny is not installed (`cargo install cargo-deny`)");
    }
    steps.finish()
}
