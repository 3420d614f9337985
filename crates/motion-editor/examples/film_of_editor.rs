//! Pictures of the editor at work, for the documentation: `editor.png`, and the frames of a film in
//! which an arrow is placed and dragged and the motion follows.
//!
//! It is the real editor, driven by the mouse's events and drawn in software:
//! `cargo run --release --package motion-editor --example film_of_editor -- FOLDER`.
#![allow(clippy::print_stderr, reason = "a tool for a terminal")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Context as _, anyhow, ensure};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::EditorOptions;
use motion_editor::viewport::gesture::sight::Sight;

type Window = Harness<'static, EditorApp>;

/// Frames of the film per second.
const FPS: f64 = 12.0;
/// The frame that the new arrow is for.
const FRAME: usize = 175;

fn main() -> anyhow::Result<()> {
    let folder = std::env::args().nth(1).map(PathBuf::from).context("say where to write")?;
    std::fs::create_dir_all(&folder)?;
    let mut window = open(Vec2::new(1600.0, 1000.0))?;
    picture(&mut window, &folder)?;
    drop(window);
    let mut film = Film { window: open(Vec2::new(1120.0, 700.0))?, folder, n_frames: 0 };
    film.shoot()
}

/// The editor with some takes of the sample.
fn open(size: Vec2) -> anyhow::Result<Window> {
    const LIMIT: Duration = Duration::from_secs(120);
    let builder = Harness::builder().with_size(size).with_step_dt(1.0 / FPS as f32).wgpu();
    let mut window = builder.build_eframe(|cc| {
        match EditorApp::new(cc, EditorOptions::new(ProjectSource::Sample)) {
            Ok(app) => app,
            // Without threads there is nothing to be seen.
            Err(error) => panic!("{error}"),
        }
    });
    let start = Instant::now();
    while window.state().state.cards.len() < 6 {
        ensure!(start.elapsed() < LIMIT, "the search finds nothing");
        std::thread::sleep(Duration::from_millis(20));
        window.step();
    }
    Ok(window)
}

fn save(window: &mut Window, path: &Path) -> anyhow::Result<()> {
    let picture = window.render().map_err(|error| anyhow!(error))?;
    picture.save(path).with_context(|| path.display().to_string())
}

/// A moment worth looking at: the best take, a checkpoint selected, another take as a ghost.
fn picture(window: &mut Window, folder: &Path) -> anyhow::Result<()> {
    for _ in 0..100 {
        std::thread::sleep(Duration::from_millis(50));
        window.step();
    }
    let state = &mut window.state_mut().state;
    state.show_card(0);
    state.stop_at(88);
    let corner = state.marks.get(1).map(|mark| mark.at.clone()).context("there is a corner")?;
    let item = motion_session::selection::Selectable::Constraint(corner);
    state.session.selection_mut().select(item);
    for _ in 0..40 {
        std::thread::sleep(Duration::from_millis(20));
        window.step();
    }
    let second = window.get_by_label_contains("Take 2, cost").rect().center();
    window.hover_at(second);
    window.run_steps(6);
    save(window, &folder.join("editor.png"))
}

/// A film under way.
struct Film {
    window: Window,
    folder: PathBuf,
    n_frames: usize,
}

impl Film {
    fn shoot(&mut self) -> anyhow::Result<()> {
        self.window.set_render_cursor(true);
        // Room for the view.
        self.window.state_mut().state.settings.left.open = false;
        self.window.run_steps(3);
        self.window.key_press(Key::Home);
        self.window.run_steps(8);
        self.window.state_mut().state.seek(90.0);
        self.window.state_mut().state.play();
        // Between the corner and the end, beside the way.
        let [from, aim, to] = [[1.9, 6.3], [3.0, 6.8], [3.1, 4.3]].map(|place| self.place(place));
        let (from, aim, to) = (from?, aim?, to?);
        self.glide(from, 10)?;
        self.window.key_press(Key::C);
        self.window.state_mut().state.stop_at(FRAME);
        self.frames(3)?;
        self.button(from, true);
        self.frames(1)?;
        self.glide(aim, 7)?;
        self.button(aim, false);
        self.frames(1)?;
        self.window.key_press(Key::Q);
        self.frames(10)?;
        self.glide(from, 5)?;
        self.frames(2)?;
        self.button(from, true);
        self.frames(1)?;
        self.glide(to, 22)?;
        self.button(to, false);
        self.frames(4)?;
        self.window.state_mut().state.seek(95.0);
        self.window.state_mut().state.play();
        self.glide(to + Vec2::new(120.0, 90.0), 5)?;
        self.frames(42)?;
        eprintln!("{} frames", self.n_frames);
        Ok(())
    }

    /// Where a place on the floor, `[x, z]` in metres, is in the window.
    fn place(&self, [x_m, z_m]: [f32; 2]) -> anyhow::Result<Pos2> {
        let viewport = &self.window.state().viewport;
        let sight = Sight { camera: viewport.camera, rect: viewport.rect() };
        sight.place(glam::Vec3::new(x_m, 0.0, z_m)).context("the place is in view")
    }

    fn button(&self, pos: Pos2, pressed: bool) {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        self.window.event(Event::PointerButton { pos, button, pressed, modifiers });
    }

    /// Brings the pointer somewhere in so many frames.
    fn glide(&mut self, to: Pos2, n: usize) -> anyhow::Result<()> {
        let from = self.window.ctx.pointer_latest_pos().unwrap_or(to + Vec2::new(-120.0, -90.0));
        for nth in 1..=n {
            let share = nth as f32 / n as f32;
            let eased = share * share * (3.0 - 2.0 * share);
            self.window.event(Event::PointerMoved(from + (to - from) * eased));
            self.frames(1)?;
        }
        Ok(())
    }

    fn frames(&mut self, n: usize) -> anyhow::Result<()> {
        for _ in 0..n {
            // The search has as long as it had in a window.
            std::thread::sleep(Duration::from_secs_f64(0.5 / FPS));
            self.window.step();
            let path = self.folder.join(format!("frame-{:03}.png", self.n_frames));
            save(&mut self.window, &path)?;
            self.n_frames += 1;
        }
        Ok(())
    }
}
