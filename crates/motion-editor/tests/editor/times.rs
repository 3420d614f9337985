//! Times of what is selected drawn out, and time that goes with the pointer.

use egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::mark::Mark;

use crate::window::{drag, quiet, solved};

type Window = Harness<'static, EditorApp>;

fn frames(harness: &Window) -> Vec<usize> {
    harness.state().state.marks.iter().map(Mark::frame).collect()
}

#[test]
fn times_are_drawn_out_about_the_playhead() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(100);
    harness.key_press_modifiers(Modifiers::CTRL, Key::A);
    harness.run_steps(2);
    harness.key_press(Key::S);
    harness.run_steps(3);
    for key in [Key::Num2, Key::Enter] {
        harness.key_press(key);
        harness.run_steps(3);
    }
    // 110 is ten behind the playhead, 239 is 139 behind it; the start stays.
    assert_eq!(frames(&harness), [0, 120, 378]);
    assert_eq!(harness.state().state.session.history().n_steps().0, 1);
    harness.key_press(Key::S);
    harness.run_steps(3);
    harness.key_press(Key::Period);
    harness.key_press(Key::Num5);
    harness.run_steps(3);
    assert_eq!(frames(&harness), [0, 110, 239], "as far as it is shown");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(frames(&harness), [0, 120, 378], "Escape restores");
}

#[test]
fn time_goes_with_the_pointer_while_k_is_held() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(50);
    let camera = harness.state().viewport.camera;
    let at = harness.get_by_label(motion_editor::viewport::LABEL).rect().center();
    let k = |pressed| Event::Key {
        key: Key::K,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    harness.event(k(true));
    harness.run_steps(2);
    drag(&mut harness, at, Vec2::new(80.0, 0.0));
    assert_eq!(harness.state().state.frame_number(), 70);
    drag(&mut harness, at, Vec2::new(-40.0, 0.0));
    assert_eq!(harness.state().state.frame_number(), 60);
    assert_eq!(harness.state().viewport.camera, camera, "the camera stands still");
    harness.event(k(false));
    harness.run_steps(2);
}
