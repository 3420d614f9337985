//! `cargo xtask pictures`: the pictures of the documentation, made by the program itself of what it
//! has built in, so that they show what it does today.

use std::fs;
use std::path::Path;
use std::process::Command;

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

/// The editor at work, and a film of it.
const EDITOR: &str = "editor.png";
const FILM: &str = "editor.gif";
/// What is alike from frame to frame is written once; few colours are enough for a window.
const FILM_FILTER: &str = "scale=880:-1:flags=lanczos,split[a][b];\
    [a]palettegen=max_colors=96:stats_mode=diff[p];\
    [b][p]paletteuse=dither=none:diff_mode=rectangle";
/// A window's picture has more in it.
const MOST_BYTES_OF_EDITOR: u64 = 1_200_000;

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
        check_size(&path, MOST_BYTES)?;
    }
    film_editor(&folder, graphics.as_ref().ok())
}

/// Drives the editor as a person would. Its frames become a film by `ffmpeg`.
fn film_editor(folder: &Path, graphics: Option<&Graphics>) -> anyhow::Result<()> {
    let frames = root().join("target/film-of-editor");
    // Frames of an earlier film that was longer.
    drop(fs::remove_dir_all(&frames));
    let mut command = cargo(&["run", "--release", "--locked", "--package", "motion-editor"]);
    command.args(["--example", "film_of_editor", "--"]).arg(&frames);
    if let Some(graphics) = graphics {
        graphics.apply(&mut command);
    }
    ensure!(command.status().context("cannot start cargo run")?.success(), "no film was made");
    let picture = folder.join(EDITOR);
    fs::copy(frames.join(EDITOR), &picture).context("the editor's picture")?;
    check_size(&picture, MOST_BYTES_OF_EDITOR)?;
    let film = folder.join(FILM);
    let mut ffmpeg = Command::new("ffmpeg");
    ffmpeg.args(["-loglevel", "error", "-y", "-framerate", "12", "-i"]);
    ffmpeg.arg(frames.join("frame-%03d.png")).args(["-vf", FILM_FILTER]).arg(&film);
    let status = ffmpeg.status().context("the film of the editor needs ffmpeg; install it")?;
    ensure!(status.success(), "ffmpeg made no film");
    check_size(&film, MOST_BYTES_OF_EDITOR)
}

fn check_size(path: &Path, most: u64) -> anyhow::Result<()> {
    let name = path.display();
    let bytes = fs::metadata(path).with_context(|| name.to_string())?.len();
    ensure!(bytes < most, "{name} has {bytes} bytes; make it smaller");
    Ok(())
}
