//! The Why tab says what would help where something is missed, and a press does it.

use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_session::command::Command;
use motion_session::suggest::Suggestion;

use crate::window::solved;

/// A search settles within seconds; machines that are busy with other tests are slow.
const LIMIT_SECS: u64 = 300;

fn suggestions(harness: &Harness<'_, EditorApp>) -> Vec<Suggestion> {
    let session = &harness.state().state.session;
    let known = session.snapshot().character(session.active());
    known.map_or_else(Vec::new, |known| known.suggestions.clone())
}

#[test]
fn what_would_help_is_done_by_a_press() {
    let Some(mut harness) = solved() else { return };
    let last = harness.state().state.marks.last().cloned().expect("an end");
    let ([x, z], _) = last.body().expect("a checkpoint");
    // Farther than anybody gets in the time.
    let far = Command::Move { at: last.at, position_m: [x, z + 12.0] };
    harness.state_mut().state.apply(&far);
    let start = std::time::Instant::now();
    while suggestions(&harness).is_empty() {
        assert!(start.elapsed().as_secs() < LIMIT_SECS, "nothing is suggested");
        std::thread::sleep(std::time::Duration::from_millis(20));
        harness.step();
    }
    harness.state_mut().state.session.search().pause();
    harness.get_by_label("Why").click();
    harness.run_steps(4);
    let known = suggestions(&harness);
    let before = harness.state().state.session.document().to_project();
    let n_steps = harness.state().state.session.history().n_steps().0;
    harness.get_by_label(&format!("Apply: {}", known[0].sentence)).click();
    harness.run_steps(4);
    assert_eq!(harness.state().state.session.history().n_steps().0, n_steps + 1, "one step");
    assert_ne!(harness.state().state.session.document().to_project(), before);
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(3);
    assert_eq!(harness.state().state.session.document().to_project(), before);
}
