//! Checkpoints placed, moved and taken back, with the mouse and keys.

use egui::{Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::mark::Mark;
use motion_editor::viewport;
use motion_session::ConstraintKind;

use crate::window::{drag, settle, solved};

type Window = Harness<'static, EditorApp>;

/// Frames of the body constraints.
fn frames(harness: &Window) -> Vec<usize> {
    harness.state().state.marks.iter().map(Mark::frame).collect()
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

#[test]
fn a_clips_pose_is_dragged_to_the_floor_and_to_a_frame() {
    let Some(mut harness) = solved() else { return };
    crate::window::quiet(&mut harness);
    let poses = |harness: &Window| -> Vec<(usize, bool)> {
        let of = |mark: &Mark| match &mark.constraint.kind {
            ConstraintKind::Pose { frame, position_m, .. } => {
                Some((*frame as usize, position_m.is_some()))
            }
            _ => None,
        };
        harness.state().state.marks.iter().filter_map(of).collect()
    };
    harness.state_mut().state.stop_at(40);
    let row = harness.get_by_label_contains("Clip walk_fast").rect().center();
    let view = harness.get_by_label(viewport::LABEL).rect();
    drag(&mut harness, row, view.lerp_inside(Vec2::new(0.4, 0.7)) - row);
    assert_eq!(poses(&harness), [(40, true)]);
    assert_eq!(harness.state().state.session.history().n_steps().0, 1);
    let corner = harness.get_by_label_contains("Body checkpoint 2").rect().center();
    drag(&mut harness, row, corner + Vec2::new(60.0, 0.0) - row);
    let poses = poses(&harness);
    assert!(poses.len() == 2 && poses[1].0 > 110 && !poses[1].1, "{poses:?}");
}

/// What somebody does in the first minutes, with mouse and keys alone.
#[test]
fn two_arrows_are_placed_a_take_is_picked_and_everything_is_undone() {
    let Some(mut harness) = solved() else { return };
    let saved = harness.state().state.session.document().to_project();
    let view = harness.get_by_label(viewport::LABEL).rect();
    for (frame, at) in [(60.0, Vec2::new(0.34, 0.62)), (180.0, Vec2::new(0.5, 0.78))] {
        harness.state_mut().state.seek(frame);
        harness.key_press(Key::C);
        harness.run_steps(2);
        drag(&mut harness, view.lerp_inside(at), Vec2::new(40.0, 10.0));
        harness.key_press(Key::Q);
        harness.run_steps(2);
    }
    assert_eq!(frames(&harness), [0, 60, 110, 180, 239]);
    settle(&mut harness);
    crate::window::quiet(&mut harness);
    let second = harness.state().state.cards[1].id;
    harness.key_press(Key::Num2);
    crate::window::quiet(&mut harness);
    assert_eq!(harness.state().state.shown(), Some(second));
    let ruler = harness.get_by_label(motion_editor::timeline::ruler::LABEL).rect();
    harness.drag_at(ruler.lerp_inside(Vec2::new(0.5, 0.5)));
    harness.run_steps(2);
    harness.drop_at(ruler.lerp_inside(Vec2::new(0.5, 0.5)));
    let frame = harness.state().state.frame();
    assert!((frame - 120.0).abs() < 10.0, "scrubbed to {frame}");
    for _ in 0..2 {
        harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
        harness.run_steps(2);
    }
    let state = &harness.state().state;
    assert_eq!(state.session.document().to_project(), saved);
    assert!(!state.session.is_changed(), "as it was opened");
}
