//! Whole screens beside those that were looked at and kept.
//!
//! What is shown must be the same every time, so the search is let settle: it counts in rounds, not
//! in seconds, and ends with the same takes on every machine.

use std::time::{Duration, Instant};

use egui::{Key, Modifiers, Role};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::state::Gain;
use motion_scene::camera::OrbitCamera;
use motion_session::live::SearchState;
use motion_tests::kept_picture::assert_is_kept;

use crate::window::open;

type Window = Harness<'static, EditorApp>;

/// The editor with all takes that the sample has, paused where somebody walks.
fn settled() -> Option<Window> {
    const LIMIT: Duration = Duration::from_secs(300);
    let mut window = open()?;
    let start = Instant::now();
    while window.state().state.search_state() != SearchState::Settled {
        assert!(start.elapsed() < LIMIT, "it never settles");
        std::thread::sleep(Duration::from_millis(50));
        window.step();
    }
    crate::window::quiet(&mut window);
    let state = &mut window.state_mut().state;
    state.stop_at(60);
    // Hues are given in the order of finding, which is the order in which somebody looks.
    state.cards.clear();
    state.refresh();
    // Nothing is new any more, and nobody knows since when.
    state.clock_secs += 3600.0;
    state.gain = Gain::default();
    state.refresh();
    // It was framed for the take that was shown first, which is a matter of when somebody looked.
    state.is_new_scene = true;
    window.state_mut().viewport.camera = OrbitCamera::default();
    still(&mut window);
    Some(window)
}

/// Goes on until every picture on a card is drawn and nothing glides.
fn still(window: &mut Window) {
    window.remove_cursor();
    for _ in 0..60 {
        window.step();
    }
}

#[track_caller]
fn check(window: &mut Window, name: &str) {
    let picture = window.render().expect("a software device renders");
    assert_is_kept(name, &picture);
}

#[test]
fn screens_look_as_they_were_kept() {
    let Some(mut window) = settled() else { return };
    check(&mut window, "screen_author_dark");
    window.get_by_label("Why").click();
    let corner = window.get_by_label_contains("Body checkpoint 2").rect().center();
    window.hover_at(corner);
    window.run_steps(2);
    still(&mut window);
    check(&mut window, "screen_why");
    window.get_by_label("Inspector").click();
    window.key_press_modifiers(Modifiers::CTRL, Key::P);
    window.run_steps(3);
    window.event(egui::Event::Text("take".to_owned()));
    still(&mut window);
    check(&mut window, "screen_palette");
    window.key_press(Key::Escape);
    window.run_steps(3);
    window.key_press(Key::F1);
    still(&mut window);
    assert!(window.query_by_role_and_label(Role::Window, "Keyboard shortcuts").is_some());
    check(&mut window, "screen_shortcuts");
    window.key_press(Key::Escape);
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::SHIFT, Key::U);
    window.run_steps(3);
    window.state_mut().state.ask(motion_editor::ui_command::UiCommand::Theme);
    still(&mut window);
    check(&mut window, "screen_split_light");
}
