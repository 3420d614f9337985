//! Checkpoints placed, moved and taken back, with the mouse and keys.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::mark::Mark;
use motion_editor::viewport;

use crate::window::{settle, solved};

type Window = Harness<'static, EditorApp>;

/// Frames of the body constraints.
fn frames(harness: &Window) -> Vec<usize> {
    harness.state().state.marks.iter().map(Mark::frame).collect()
}

/// A press, a way in several steps, a release.
fn drag(harness: &mut Window, from: Pos2, by: Vec2) {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    harness.event(Event::PointerMoved(from));
    harness.run_steps(8);
    harness.event(button(from, true));
    harness.run_steps(2);
    for step in 1..=4 {
        harness.event(Event::PointerMoved(from + by * (step as f32 / 4.0)));
        harness.run_steps(2);
    }
    harness.event(button(from + by, false));
    harness.run_steps(2);
}

#[test]
fn a_mark_is_dragged_to_another_frame_and_back_by_undo() {
    let Some(mut harness) = solved() else { return };
    let before = frames(&harness);
    let corner = harness.get_by_label_contains("Body checkpoint 2").rect().center();
    drag(&mut harness, corner, Vec2::new(3.0, 0.0));
    assert_eq!(frames(&harness), before, "a shaky click moves nothing");
    drag(&mut harness, corner, Vec2::new(90.0, 0.0));
    let after = frames(&harness);
    assert!(after[1] > before[1] + 5, "{after:?}");
    settle(&mut harness);
    assert!(harness.state().state.marks.iter().all(|mark| mark.miss.is_some()));
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert_eq!(frames(&harness), before);
    harness.key_press_modifiers(Modifiers::CTRL | Modifiers::SHIFT, Key::Z);
    harness.run_steps(2);
    assert_eq!(frames(&harness), after);
}

#[test]
fn a_checkpoint_is_placed_on_the_floor_and_deleted() {
    let Some(mut harness) = solved() else { return };
    harness.state_mut().state.seek(60.0);
    harness.key_press(Key::C);
    harness.run_steps(2);
    let view = harness.get_by_label(viewport::LABEL).rect();
    let at = view.lerp_inside(Vec2::new(0.3, 0.7));
    drag(&mut harness, at, Vec2::new(60.0, 10.0));
    assert_eq!(frames(&harness), [0, 60, 110, 239]);
    let state = &harness.state().state;
    let mark = state.selected_mark().expect("the new one is selected");
    let has_heading = mark.body().is_some_and(|(_, heading)| heading.is_some());
    assert!(mark.number == 2 && has_heading, "{mark:?}");
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert_eq!(frames(&harness), [0, 110, 239]);
}

#[test]
fn escape_ends_a_drag_as_if_it_had_not_been() {
    let Some(mut harness) = solved() else { return };
    let camera = harness.state().viewport.camera;
    harness.key_press(Key::C);
    harness.run_steps(2);
    let view = harness.get_by_label(viewport::LABEL).rect();
    let at = view.lerp_inside(Vec2::new(0.3, 0.7));
    harness.drag_at(at);
    harness.run_steps(2);
    assert_eq!(frames(&harness).len(), 4);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(frames(&harness).len(), 3);
    harness.drop_at(at);
    harness.run_steps(2);
    assert_eq!(frames(&harness).len(), 3);
    assert_eq!(harness.state().viewport.camera, camera, "the camera stood still");
}
