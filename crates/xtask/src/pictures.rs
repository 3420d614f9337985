//! `cargo xtask pictures`: the pictures of the documentation, made by the program itself of what it
//! has built in, so that they show what it does today.

use std::fs;

use anyhow::{Context as _, ensure};

use crate::graphics::Graphics;
use crate::step::{cargo, root};

/// Where they are.
const FOLDER: &str = "docs/pictures";
/// The sample that `gaitway` alone authors.
const SAMPLE: &str = "crates/motion-session/src/samples/corner.gaitway";
/// Everybody who reads the documentation fetches them.
const MOST_BYTES: u64 = 600_000;

/// A picture's file, and how it is made.
struct Picture {
    name: &'static str,
    options: &'static [&'static str],
}

const PICTURES: &[Picture] = &[
    Picture { name: "sheet.png", options: &["--size", "1400x875"] },
    Picture { name: "sample.gif", options: &["--size", "600x260", "--fps", "20"] },
];

/// Draws all of them, in software, as every machine can.
pub(crate) fn run() -> anyhow::Result<()> {
    let graphics = Graphics::find_or_install();
    let folder = root().join(FOLDER);
    fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    for Picture { name, options } in PICTURES {
        let path = folder.join(name);
        let mut command = cargo(&["run", "--release", "--locked", "--package", "gaitway", "--"]);
        command.args(["render", SAMPLE, "--software", "-o"]).arg(&path).args(*options);
        if let Ok(graphics) = &graphics {
            graphics.apply(&mut command);
        }
        let status = command.status().context("cannot start cargo run")?;
        ensure!(status.success(), "{name} could not be made");
        let bytes = fs::metadata(&path).with_context(|| path.display().to_string())?.len();
        ensure!(bytes < MOST_BYTES, "{name} has {bytes} bytes; make it smaller");
    }
    Ok(())
}
