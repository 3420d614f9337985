//! A project or a motion file on a stage.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use motion_core::cancel::CancelToken;
use motion_core::retarget::PathScale;
use motion_core::search::SearchKind;
use motion_io::diagnostic::Warnings;
use motion_io::gltf;
use motion_io::import::read_motion_file;
use motion_io::project_file::{self, Project, relative_to};
use motion_scene::color::Theme;
use motion_session::budget::Budget;
use motion_session::library_source::LibraryChoice;
use motion_session::project_job::{ProjectRequest, Solved, solve_project};
use motion_session::stage::Stage;
use motion_session::stage::cast::{self, NobodyError, Part};
use motion_session::stage::character::soles_of_character;
use motion_session::stage::standing::set_on_floor;

use crate::args::render::{Render, Theme as TypedTheme};
use crate::output::{Console, Failure};
use crate::plan;
use crate::render::wardrobe::Wardrobe;

/// What is to be shown.
pub(crate) struct Shown {
    pub(crate) stage: Stage,
    /// Frames per second of its motions.
    pub(crate) fps: f64,
    /// What it is called.
    pub(crate) name: String,
    /// Sentences on what a project asks and its motion does not meet.
    pub(crate) unmet: Vec<String>,
}

/// Enough for a good motion of a small project, and the same one every time.
const ROUNDS: u64 = 60;

/// Whether a file is a project, by its ending.
pub(crate) fn is_project(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gaitway"))
}

/// Reads a motion, or solves a project, and puts it on a stage.
pub(crate) fn load(
    console: &Console,
    seed: Option<u64>,
    args: &Render,
    cancel: &CancelToken,
) -> Result<Shown, Failure> {
    let theme = match args.theme {
        TypedTheme::Dark => Theme::Dark,
        TypedTheme::Light => Theme::Light,
    };
    if !is_project(&args.input) {
        return motion(console, args, theme);
    }
    let mut warnings = Warnings::new();
    let project = project_file::load(&args.input, &mut warnings)?;
    let request = ProjectRequest {
        project: &project,
        path: &args.input,
        library: args.library.as_deref().map(LibraryChoice::typed),
        mirror: false,
        no_bridges: false,
        seed,
        kind: SearchKind::default(),
        alternatives: Some(usize::from(args.take)),
        budget: match args.time {
            Some(secs) => {
                // Longer than a duration can be is as good as for ever.
                Budget::Time(Duration::try_from_secs_f64(secs).unwrap_or(Duration::MAX))
            }
            None => Budget::Iterations(args.iterations.unwrap_or(ROUNDS)),
        },
    };
    let bar = console.bar();
    let on_progress = |what: &str, share| bar.set(what, share);
    let solved = solve_project(&request, cancel, &mut warnings, &on_progress);
    drop(bar);
    let mut wardrobe = Wardrobe::new(args.character.as_deref(), &mut warnings);
    let shown = solved.map_err(Failure::from).and_then(|solved| {
        let take = usize::from(args.take) - 1;
        project_on_stage(&project, &args.input, &solved, take, theme, &mut wardrobe)
    });
    console.warnings(&warnings);
    shown
}

/// A solved project's motions number `take` (from 0) on a stage.
pub(crate) fn project_on_stage(
    project: &Project,
    path: &Path,
    solved: &Solved,
    take: usize,
    theme: Theme,
    wardrobe: &mut Wardrobe<'_>,
) -> Result<Shown, Failure> {
    let mut unmet: Vec<String> = Vec::new();
    for sentence in solved.report.characters.iter().flat_map(|character| &character.unmet) {
        // What is not met in the project as a whole is said of every character.
        if !unmet.contains(sentence) {
            unmet.push(sentence.clone());
        }
    }
    let parts = cast::parts(solved, take).map_err(|nobody| match nobody {
        NobodyError::NoMotion(_) if !unmet.is_empty() => {
            Failure::Other(anyhow::anyhow!("{}", unmet.join("; ")))
        }
        NobodyError::NoMotion(_) => Failure::Other(nobody.into()),
        NobodyError::NoTake { .. } => Failure::wrong(format!("{}: {nobody}", path.display())),
    })?;
    let mut actors = Vec::with_capacity(parts.len());
    for (nth, (part, character)) in parts.into_iter().zip(&project.characters).enumerate() {
        let own = character.body.as_deref().and_then(|body| relative_to(body, path));
        // Places that the project asks for are met by whoever walks there.
        actors.push(wardrobe.dress(nth, part, own.as_deref(), PathScale::Keep, theme)?);
    }
    let stage = cast::stage_of_project(project, solved, take, actors, theme);
    Ok(Shown { stage, fps: project.fps, name: project.name.clone(), unmet })
}

/// A motion file on a stage, set on the floor. A glTF file shows its own body.
fn motion(console: &Console, args: &Render, theme: Theme) -> Result<Shown, Failure> {
    let mut warnings = Warnings::new();
    let options = plan::read_options(&args.reading)?;
    let file = read_motion_file(&args.input, &options, &mut warnings)?;
    let mut wardrobe = Wardrobe::new(args.character.as_deref(), &mut warnings);
    let has_own = gltf::is_gltf(&args.input) && args.character.is_none();
    let body = if has_own { wardrobe.own_body(&args.input) } else { None };
    let own = body.as_ref().map(|_| &*args.input);
    let same = body.filter(|character| character.skeleton == file.skeleton);
    let known = same.map(|character| soles_of_character(&character));
    let name = args.input.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let fps = file.motion.fps().get();
    let standing = set_on_floor(&file.skeleton, file.motion, known);
    let part = Part {
        name: name.clone(),
        skeleton: Arc::new(file.skeleton),
        motion: Arc::new(standing.motion),
        soles: standing.soles,
    };
    let actor = wardrobe.dress(0, part, own, PathScale::ByLegs, theme)?;
    console.warnings(&warnings);
    Ok(Shown { stage: Stage::new(theme, vec![actor]), fps, name, unmet: Vec::new() })
}
