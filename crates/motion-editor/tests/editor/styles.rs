//! Styles, locks, velocities and tolerances: drawn, dragged, chosen, taken back.

use egui::{Event, Key, Modifiers, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::Vec3;
use motion_editor::app::EditorApp;
use motion_editor::timeline::style_drag;
use motion_editor::ui_command::UiCommand;
use motion_editor::viewport;
use motion_editor::viewport::gesture::handle::{HandleOf, handles};
use motion_editor::viewport::gesture::sight::Sight;
use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::selection::Selectable;

use crate::window::{click, drag, quiet, solved, steps_back, type_in};

type Window = Harness<'static, EditorApp>;

fn last(harness: &Window) -> Option<ConstraintKind> {
    let document = harness.state().state.session.document();
    document.characters()[0].constraints.last().map(|c| c.kind.clone())
}

fn sight(harness: &Window) -> Sight {
    let rect = harness.get_by_label(viewport::LABEL).rect();
    Sight { camera: harness.state().viewport.camera, rect }
}

/// Clicks a choice of a row whose list can be narrowed down.
fn pick(harness: &mut Window, row: &str, typed: &str) {
    click(harness, Role::ComboBox, row);
    harness.event(Event::Text(typed.to_owned()));
    harness.run_steps(3);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
}

#[test]
fn a_style_is_drawn_on_its_row_and_gets_a_tag() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let row = harness.get_by_label(style_drag::LABEL).rect();
    drag(&mut harness, row.lerp_inside(Vec2::new(0.3, 0.5)), Vec2::new(120.0, 0.0));
    let Some(ConstraintKind::Style { from, to, tag }) = last(&harness) else {
        panic!("{:?}", last(&harness))
    };
    assert!(from > 40 && to > from + 10 && to < 239, "{from} to {to}");
    assert!(!tag.is_empty(), "the library's commonest");
    assert_eq!(steps_back(&harness), 1);
    click(&mut harness, Role::ComboBox, "Style");
    let other = harness.state().state.clips.iter().flat_map(|clip| clip.tags.clone());
    let other = other.into_iter().find(|known| *known != tag).expect("several tags");
    click(&mut harness, Role::Button, &other);
    let is_other = |kind| matches!(kind, Some(ConstraintKind::Style { tag, .. }) if tag == other);
    assert!(is_other(last(&harness)), "{:?}", last(&harness));
    let begin = harness.get_by_label_contains("Beginning of Style").rect().center();
    drag(&mut harness, begin, Vec2::new(-60.0, 0.0));
    let Some(ConstraintKind::Style { from: earlier, to: same, .. }) = last(&harness) else {
        panic!("{:?}", last(&harness))
    };
    assert!(earlier + 5 < from && same == to, "{earlier} to {same}");
    for _ in 0..3 {
        harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
        harness.run_steps(2);
    }
    assert_eq!(harness.state().state.marks.len(), 3);
}

#[test]
fn a_style_can_be_asked_for_by_name() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(50);
    harness.state_mut().state.ask(UiCommand::AddStyle);
    harness.run_steps(2);
    let made = last(&harness);
    assert!(matches!(made, Some(ConstraintKind::Style { from: 50, to: 80, .. })), "{made:?}");
}

#[test]
fn a_stretch_is_locked_with_its_pieces_and_unlocked() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(30);
    harness.key_press(Key::Y);
    harness.run_steps(3);
    let Some(ConstraintKind::Lock { from, to, pieces }) = last(&harness) else {
        panic!("{:?}", last(&harness))
    };
    let n: u32 = pieces.iter().map(|piece| piece.to - piece.from + 1).sum();
    assert_eq!(n, to - from + 1, "as many frames of clips as of the motion");
    harness.get_by_label_contains(&format!("Locked stretch 1, frames {from} to {to}")).click();
    harness.run_steps(3);
    click(&mut harness, Role::Button, "Unlock");
    assert_eq!(harness.state().state.marks.len(), 3);
}

#[test]
fn a_velocity_is_pulled_and_a_joint_is_exchanged() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(40);
    harness.state_mut().state.ask(UiCommand::AddJointTarget);
    harness.run_steps(3);
    let is_velocity = |of: &HandleOf| matches!(of, HandleOf::Velocity(_));
    let all = handles(&harness.state().state, &sight(&harness));
    let at = all.iter().find(|handle| is_velocity(&handle.of)).map(|handle| handle.place);
    let at = at.expect("a target that is selected has one");
    drag(&mut harness, at, Vec2::new(50.0, -30.0));
    let velocity = |harness: &Window| match last(harness) {
        Some(ConstraintKind::Joint { velocity_m_s, .. }) => velocity_m_s,
        other => panic!("{other:?}"),
    };
    let pulled = velocity(&harness).expect("it has a velocity now");
    assert!(Vec3::from_array(pulled.map(|v| v as f32)).length() > 0.3, "{pulled:?}");
    click(&mut harness, Role::CheckBox, "Any velocity");
    assert_eq!(velocity(&harness), None);
    pick(&mut harness, "Joint", "left hand");
    let made = last(&harness);
    let is_hand = |joint: &str| joint.starts_with("LeftHand");
    assert!(
        matches!(&made, Some(ConstraintKind::Joint { joint, .. }) if is_hand(joint)),
        "{made:?}"
    );
    assert_eq!(steps_back(&harness), 4);
}

#[test]
fn a_pose_gets_another_clip_frame_and_place() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(70);
    harness.state_mut().state.ask(UiCommand::AddPose);
    harness.run_steps(3);
    pick(&mut harness, "Clip", "walk_slow");
    type_in(&mut harness, "Frame of the clip", "7");
    click(&mut harness, Role::CheckBox, "Any place");
    let made = last(&harness);
    let Some(ConstraintKind::Pose { frame: 70, clip, clip_frame: 7, position_m: Some(at), .. }) =
        &made
    else {
        panic!("{made:?}")
    };
    assert_eq!(clip, "walk_slow");
    let root = harness.state().state.stage.actors[0].root_at_m(70.0);
    let off = (at[0] - f64::from(root.x)).hypot(at[1] - f64::from(root.z));
    assert!(off < 2e-3, "where the body is then");
    click(&mut harness, Role::CheckBox, "Any place");
    let made = last(&harness);
    assert!(matches!(made, Some(ConstraintKind::Pose { position_m: None, .. })), "{made:?}");
}

#[test]
fn a_tolerance_is_a_disc_that_is_dragged() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let at = ConstraintRef::new(CharacterIdx(0), "corner");
    let item = Selectable::Constraint(at.clone());
    harness.state_mut().state.session.selection_mut().select(item);
    harness.run_steps(2);
    click(&mut harness, Role::CheckBox, "Near is enough");
    let radius = |harness: &Window| {
        let document = harness.state().state.session.document();
        document.constraint(&at).and_then(|c| c.tolerance.as_ref()?.position_m)
    };
    assert_eq!(radius(&harness), Some(0.3));
    let all = handles(&harness.state().state, &sight(&harness));
    let edge = all.iter().find(|handle| matches!(handle.of, HandleOf::Tolerance(_)));
    let edge = edge.map(|handle| handle.place).expect("a softened checkpoint has one");
    let place = sight(&harness).place(Vec3::ZERO).expect("in view");
    let metre = sight(&harness).place(Vec3::X).expect("in view") - place;
    drag(&mut harness, edge, metre);
    let wide = radius(&harness).expect("it is still soft");
    assert!((0.9..1.8).contains(&wide), "{wide}");
    let disc = harness.state().state.stage.scene_at(0.0, Default::default()).scene.checkpoints;
    assert!(disc.iter().any(|mark| mark.tolerance_m == Some(wide as f32)), "it is drawn");
    let command = Command::SetTolerance { at, tolerance: None };
    assert!(harness.state_mut().state.apply(&command));
    assert_eq!(steps_back(&harness), 3);
}
