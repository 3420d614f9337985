//! `gaitway render`.

use std::ops::RangeInclusive;
use std::path::Path;
use std::time::Instant;

use motion_core::cancel::CancelToken;
use motion_io::atomic_write::atomic_write;
use motion_io::diagnostic::{FileError, Warnings};
use motion_io::pending_file::PendingFile;
use motion_io::project_file::Project;
use motion_render::gpu::AdapterChoice;
use motion_render::picture::Picture;
use motion_scene::camera::Viewport;
use motion_session::project_job::Solved;
use motion_session::stage::framing::Margins;
use motion_session::stage::shot::{Shot, Take};
use motion_session::stage::{Show, Stage};
use serde::Serialize;

use crate::args::Common;
use crate::args::render::{Camera, Render, Size};
use crate::interrupt::cancel_on_interrupt;
use crate::output::{Bar, Console, Failure};
use crate::render::delays;
use crate::render::film::{FilmPlan, stopped};
use crate::render::film_frames::{film_frames, usual_fps};
use crate::render::format::Format;
use crate::render::input::{Shown, is_project, load, project_on_stage};
use crate::render::painter::{Painter, pixels_per_point};
use crate::render::png::png;
use crate::render::sheet::SheetPlan;
use crate::render::wardrobe::Wardrobe;

/// What `render --json` says.
#[derive(Serialize)]
struct Rendered {
    output: String,
    /// `picture`, `sheet` or `film`.
    kind: &'static str,
    width: u32,
    height: u32,
    /// Frames of the motion that are shown: the first and the last.
    frames: [usize; 2],
    /// Pictures of a film.
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures: Option<usize>,
    /// Pictures of it per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    fps: Option<f64>,
    bytes: u64,
    adapter: String,
    /// What it all took; only where a search had a time to keep to, since everything else is the
    /// same every time.
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    unmet: Vec<String>,
}

/// Films are no longer than this.
const MAX_PICTURES: usize = 100_000;

/// Draws a motion and writes the picture or film.
pub(crate) fn run(console: &Console, common: &Common, args: &Render) -> Result<(), Failure> {
    let start = Instant::now();
    let format = Format::of(&args.output)?;
    check(args, format)?;
    // Made and thrown away: a place that cannot be written to is said before hours of searching.
    drop(PendingFile::create(&args.output)?);
    let cancel = cancel_on_interrupt();
    let shown = load(console, common.seed, args, &cancel)?;
    if cancel.is_cancelled() {
        return Err(stopped());
    }
    let range = frames_to_show(args, shown.stage.n_frames())?;
    let choice = if args.software { AdapterChoice::Software } else { AdapterChoice::Any };
    let mut painter = Painter::new(choice, &shown.stage)?;
    let bar = console.bar();
    let work =
        Work { args, format, shown: &shown, range: range.clone(), bar: &bar, cancel: &cancel };
    let (size, film) = work.write(&mut painter)?;
    drop(bar);

    let bytes = std::fs::metadata(&args.output).map(|file| file.len()).unwrap_or_default();
    let rendered = Rendered {
        output: args.output.display().to_string(),
        kind: match (format.is_film(), args.frame) {
            (true, _) => "film",
            (false, Some(_)) => "picture",
            (false, None) => "sheet",
        },
        width: size.width,
        height: size.height,
        frames: [*range.start(), *range.end()],
        pictures: film.map(|(pictures, _)| pictures),
        fps: film.map(|(_, fps)| fps),
        bytes,
        adapter: painter.adapter_name().to_owned(),
        seconds: args.time.map(|_| start.elapsed().as_secs_f64()),
        unmet: shown.unmet,
    };
    for sentence in &rendered.unmet {
        console.note(&format!("not met: {sentence}"));
    }
    console.answer(&rendered, || rendered.text())
}

impl Rendered {
    fn text(&self) -> String {
        let Self { output, width, height, frames: [first, last], adapter, .. } = self;
        let what = match (self.pictures, self.fps) {
            (Some(1), _) => "1 picture".to_owned(),
            (Some(n), Some(fps)) => format!("{n} pictures, {:.1} s", n as f64 / fps),
            _ if first == last => format!("frame {first}"),
            _ => format!("frames {first} to {last}"),
        };
        let size = match self.bytes {
            bytes @ 0..1_000_000 => format!("{} kB", bytes.div_ceil(1000)),
            bytes => format!("{:.1} MB", bytes as f64 / 1e6),
        };
        format!("{output}: {what}, {width} × {height}, {size}, drawn by {adapter}\n")
    }
}

/// Draws the contact sheet of a solved project's best motion, as `render` does without options.
pub(super) fn draw_sheet(
    console: &Console,
    project: &Project,
    solved: &Solved,
    path: &Path,
) -> Result<(), Failure> {
    let mut warnings = Warnings::new();
    let mut wardrobe = Wardrobe::new(None, &mut warnings);
    let theme = motion_scene::color::Theme::Dark;
    let shown = project_on_stage(project, path, solved, 0, theme, &mut wardrobe)?;
    let frames: Vec<usize> = (0..shown.stage.n_frames()).collect();
    let plan = SheetPlan {
        stage: &shown.stage,
        title: &title(&shown, frames.len()),
        frames: &frames,
        size: SHEET_SIZE,
        shot: Shot::default(),
        show: Show::default(),
    };
    let mut painter = Painter::new(AdapterChoice::Any, &shown.stage)?;
    let bar = console.bar();
    let sheet = plan.make(&mut painter, &CancelToken::new(), &bar)?;
    drop(bar);
    Ok(atomic_write(path, &png(&sheet)?)?)
}

/// A contact sheet's size where none is asked for.
const SHEET_SIZE: Size = Size { width: 1600, height: 1000 };

/// What is written in the corner of a contact sheet.
fn title(shown: &Shown, n_frames: usize) -> String {
    let secs = n_frames.saturating_sub(1) as f64 / shown.fps;
    format!("{} · {n_frames} frames · {secs:.1} s", shown.name)
}

/// Fails on options that do not go together.
fn check(args: &Render, format: Format) -> Result<(), Failure> {
    let wrong =
        |what: &str, what_to_do: &str| Err(FileError::new(&args.output, what, what_to_do).into());
    if format.is_film() && args.frame.is_some() {
        return wrong(
            "--frame asks for one picture, and this is a film",
            "use --frames A-B, or .png",
        );
    }
    if !format.is_film() && args.fps.is_some() {
        return wrong("--fps is for films, and this is a picture", "leave it out, or use .gif");
    }
    let of_search =
        args.take > 1 || args.library.is_some() || args.iterations.is_some() || args.time.is_some();
    if of_search && !is_project(&args.input) {
        let what =
            "it is a motion, and --take, --library, --iterations and --time are for projects";
        return Err(FileError::new(&args.input, what, "leave them out").into());
    }
    let reading = &args.reading;
    let of_file = reading.scale.is_some() || reading.up.is_some() || reading.roles.is_some();
    if of_file && is_project(&args.input) {
        let what = "it is a project, and --scale, --up and --roles are for motion files";
        return Err(FileError::new(&args.input, what, "leave them out").into());
    }
    let is_too_fast = |fps: motion_core::units::Fps| fps.get() > delays::MAX_FPS;
    if format == Format::Gif && args.fps.is_some_and(is_too_fast) {
        return wrong("a GIF shows at most 50 pictures a second", "use a lower --fps, or .mp4");
    }
    Ok(())
}

/// The frames that `--frame` and `--frames` ask for, of a motion that has `n_frames`.
fn frames_to_show(args: &Render, n_frames: usize) -> Result<RangeInclusive<usize>, Failure> {
    let last = n_frames.saturating_sub(1);
    let asked = match (args.frame, args.frames) {
        (Some(frame), _) => frame as usize..=frame as usize,
        (None, Some(range)) => range.first as usize..=range.last as usize,
        (None, None) => 0..=last,
    };
    if *asked.end() > last {
        let path = args.input.display();
        return Err(Failure::wrong(format!(
            "{path}: it has no frame {}; its frames are 0 to {last}",
            asked.end()
        )));
    }
    Ok(asked)
}

/// Everything that is known before the first picture.
struct Work<'a> {
    args: &'a Render,
    format: Format,
    shown: &'a Shown,
    range: RangeInclusive<usize>,
    bar: &'a Bar,
    cancel: &'a CancelToken,
}

impl Work<'_> {
    /// Draws and writes; gives the size, and of a film how many pictures it has and how fast they
    /// are shown.
    fn write(&self, painter: &mut Painter) -> Result<(Size, Option<(usize, f64)>), Failure> {
        let stage = &self.shown.stage;
        let size = self.size();
        if self.format.is_film() {
            let motion_fps = self.shown.fps;
            let usual = usual_fps(motion_fps, self.format == Format::Gif);
            let fps = self.args.fps.map_or(usual, motion_core::units::Fps::get);
            let frames = film_frames(self.range.clone(), motion_fps, fps);
            if frames.len() > MAX_PICTURES {
                return Err(Failure::wrong(format!(
                    "a film of {} pictures is too long; use --frames, or a lower --fps",
                    frames.len()
                )));
            }
            let frames: Vec<f64> = frames.collect();
            let plan = FilmPlan {
                stage,
                frames: &frames,
                fps,
                size,
                shot: self.shot(),
                show: self.show(),
                format: self.format,
                path: &self.args.output,
            };
            plan.make(painter, self.cancel, self.bar)?;
            return Ok((size, Some((frames.len(), fps))));
        }
        let picture = match self.args.frame {
            Some(_) => self.one_frame(stage, size, painter)?,
            None => {
                let frames: Vec<usize> = self.range.clone().collect();
                let plan = SheetPlan {
                    stage,
                    title: &title(self.shown, frames.len()),
                    frames: &frames,
                    size,
                    shot: self.shot(),
                    show: self.show(),
                };
                plan.make(painter, self.cancel, self.bar)?
            }
        };
        self.bar.set("writing", 1.0);
        atomic_write(&self.args.output, &png(&picture)?)?;
        Ok((size, None))
    }

    fn one_frame(
        &self,
        stage: &Stage,
        size: Size,
        painter: &mut Painter,
    ) -> Result<Picture, Failure> {
        let frame = *self.range.start() as f64;
        let show = self.show();
        // With ghosts all of the motion is to be seen, else the body alone, as large as it can be.
        let all: Vec<f64> = (0..stage.n_frames()).map(|frame| frame as f64).collect();
        let viewport = Viewport::new(size.width as f32, size.height as f32);
        let scale = pixels_per_point(size.height);
        let take = Take {
            stage,
            frames: if show.ghosts > 0 { &all } else { std::slice::from_ref(&frame) },
            fps: self.shown.fps,
            wishes: show.ghosts > 0 && show.wishes,
            viewport,
            margins: Margins::new(viewport, scale),
        };
        let camera = take.still(self.shot());
        painter.paint(&stage.scene_at(frame, show).scene, camera, size, scale)
    }

    fn show(&self) -> Show {
        Show {
            wishes: !self.args.no_marks,
            trail: self.args.trail,
            ghosts: usize::from(self.args.ghosts.unwrap_or_default()),
        }
    }

    fn shot(&self) -> Shot {
        match self.args.camera {
            Camera::ThreeQuarter => Shot::ThreeQuarter,
            Camera::Follow => Shot::Follow,
            Camera::Turntable => Shot::Turntable,
            Camera::Front => Shot::Front,
            Camera::Side => Shot::Side,
            Camera::Top => Shot::Top,
        }
    }

    /// The size that was asked for or is usual. What `ffmpeg` writes has even sides: colours are stored for
    /// two by two pixels.
    fn size(&self) -> Size {
        let usual = match (self.format, self.args.frame) {
            (Format::Png, None) => SHEET_SIZE,
            (Format::Gif, _) => Size { width: 640, height: 360 },
            _ => Size { width: 1280, height: 720 },
        };
        let Size { width, height } = self.args.size.unwrap_or(usual);
        match self.format {
            Format::Video(_) => Size { width: width & !1, height: height & !1 },
            Format::Png | Format::Gif => Size { width, height },
        }
    }
}
