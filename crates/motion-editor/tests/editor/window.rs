//! An editor to be driven.

use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::EditorOptions;
use motion_render::gpu::{AdapterChoice, Gpu};
use motion_session::{Project, Warnings};

/// Whether anything can draw here; says a line where nothing can (and fails where
/// `GAITWAY_REQUIRE_GPU` is 1).
pub(crate) fn can_draw() -> bool {
    let Err(error) = Gpu::open(AdapterChoice::Software) else { return true };
    let required = std::env::var("GAITWAY_REQUIRE_GPU").is_ok_and(|value| value == "1");
    assert!(!required, "GAITWAY_REQUIRE_GPU is set, but {error}");
    eprintln!("skipped: {error}");
    false
}

/// The editor with the sample, not yet solved; `None` where nothing can draw.
pub(crate) fn open() -> Option<Harness<'static, EditorApp>> {
    if !can_draw() {
        return None;
    }
    let builder = Harness::builder().with_size(Vec2::new(1600.0, 1000.0)).wgpu();
    Some(builder.build_eframe(|cc| {
        EditorApp::new(cc, EditorOptions::new(ProjectSource::Sample)).expect("threads")
    }))
}

/// The editor once the search has found something, paused at the first frame.
pub(crate) fn solved() -> Option<Harness<'static, EditorApp>> {
    let mut harness = open()?;
    settle(&mut harness);
    harness.state_mut().state.stop_at(0);
    harness.run_steps(3);
    Some(harness)
}

/// Goes on until there are two takes for what is asked now.
pub(crate) fn settle(harness: &mut Harness<'_, EditorApp>) {
    /// A search takes a second or two; machines that are busy with other tests are slow.
    const LIMIT: Duration = Duration::from_secs(120);
    let start = Instant::now();
    harness.step();
    let mut n_answered = 0;
    loop {
        let state = &harness.state().state;
        let is_answered = state.shown_card().is_some_and(|card| !card.is_stale);
        n_answered = if state.cards.len() >= 2 && is_answered { n_answered + 1 } else { 0 };
        // The first answer may be to what was asked before the last change.
        if n_answered == 5 {
            break;
        }
        assert!(start.elapsed() < LIMIT, "the search finds nothing: {:?}", state.search_state());
        std::thread::sleep(Duration::from_millis(20));
        harness.step();
    }
    harness.run_steps(2);
}

/// Stops the search, so that nothing changes by itself.
pub(crate) fn quiet(harness: &mut Harness<'_, EditorApp>) {
    harness.state_mut().state.session.search().pause();
    // What was under way comes in.
    for _ in 0..10 {
        std::thread::sleep(Duration::from_millis(50));
        harness.step();
    }
}

/// Presses the left button, moves in several steps, and holds.
pub(crate) fn hold(harness: &mut Harness<'_, EditorApp>, from: Pos2, by: Vec2) {
    harness.event(Event::PointerMoved(from));
    // What lies under the pointer is known a little later.
    harness.run_steps(8);
    harness.event(button(from, true));
    harness.run_steps(2);
    for step in 1..=4 {
        harness.event(Event::PointerMoved(from + by * (step as f32 / 4.0)));
        harness.run_steps(2);
    }
}

/// The same, and lets go.
pub(crate) fn drag(harness: &mut Harness<'_, EditorApp>, from: Pos2, by: Vec2) {
    hold(harness, from, by);
    harness.event(button(from + by, false));
    harness.run_steps(3);
}

/// The left button goes down, or up.
pub(crate) fn button(pos: Pos2, pressed: bool) -> Event {
    let modifiers = Modifiers::NONE;
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
}

/// How many steps can be undone.
pub(crate) fn steps_back(harness: &Harness<'_, EditorApp>) -> usize {
    harness.state().state.session.history().n_steps().0
}

/// What is read of the file that a project is saved to.
pub(crate) fn read_again(project: &Project) -> Project {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("p.gaitway");
    motion_session::save_project(project, &path).expect("it can be saved");
    motion_session::load_project(&path, &mut Warnings::new()).expect("it can be read")
}

/// Brings something of a panel into sight and clicks it.
pub(crate) fn click(harness: &mut Harness<'_, EditorApp>, role: Role, label: &str) {
    harness.get_by_role_and_label(role, label).scroll_to_me();
    harness.run_steps(4);
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(4);
}

/// Types a number into a field.
pub(crate) fn type_in(harness: &mut Harness<'_, EditorApp>, label: &str, typed: &str) {
    click(harness, Role::SpinButton, label);
    harness.event(Event::Text(typed.to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
}
