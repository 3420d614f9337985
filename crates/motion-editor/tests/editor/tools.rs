//! The view's tools, its navigation and the inspector, with mouse and keys.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::Vec3;
use motion_core::skeleton::JointRole;
use motion_editor::app::EditorApp;
use motion_editor::settings::Navigation;
use motion_editor::viewport;
use motion_editor::viewport::gesture::sight::Sight;
use motion_session::ConstraintKind;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::selection::Selectable;

use crate::window::{quiet, solved};

type Window = Harness<'static, EditorApp>;

/// How the view is looked at now.
fn sight(harness: &Window) -> Sight {
    let rect = harness.get_by_label(viewport::LABEL).rect();
    Sight { camera: harness.state().viewport.camera, rect }
}

/// Where a place of the world is in the window.
fn place(harness: &Window, at_m: Vec3) -> Pos2 {
    sight(harness).place(at_m).expect("in front of the camera")
}

fn n_steps(harness: &Window) -> usize {
    harness.state().state.session.history().n_steps().0
}

fn kinds(harness: &Window) -> Vec<ConstraintKind> {
    let document = harness.state().state.session.document();
    document.characters()[0].constraints.iter().map(|c| c.kind.clone()).collect()
}

fn at(id: &str) -> ConstraintRef {
    ConstraintRef::new(CharacterIdx(0), id)
}

fn select(harness: &mut Window, ids: &[&str]) {
    let items = ids.iter().map(|id| Selectable::Constraint(at(id)));
    harness.state_mut().state.session.selection_mut().select_all(items);
    harness.run_steps(2);
}

fn floor_of(harness: &Window, id: &str) -> [f64; 2] {
    harness.state().state.place_of(&at(id)).expect("it stands somewhere")
}

/// A press with a button and modifiers, a way in several steps, a release.
fn drag(harness: &mut Window, button: PointerButton, modifiers: Modifiers, from: Pos2, by: Vec2) {
    let event = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    harness.event_modifiers(Event::PointerMoved(from), modifiers);
    harness.run_steps(8);
    harness.event_modifiers(event(from, true), modifiers);
    harness.run_steps(2);
    for step in 1..=4 {
        let to = from + by * (step as f32 / 4.0);
        harness.event_modifiers(Event::PointerMoved(to), modifiers);
        harness.run_steps(2);
    }
    harness.event_modifiers(event(from + by, false), modifiers);
    harness.run_steps(2);
}

const LEFT: PointerButton = PointerButton::Primary;

#[test]
fn a_target_is_pulled_from_the_head() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(40);
    harness.key_press(Key::T);
    harness.run_steps(3);
    let actor = harness.state().state.stage.actors[0].clone();
    let head = actor.skeleton.by_role(JointRole::Head).expect("a head");
    let joints = actor.body_at(40.0, actor.look).world_from_joint;
    let from_m = joints[head.idx()].w_axis.truncate();
    let from = place(&harness, from_m);
    drag(&mut harness, LEFT, Modifiers::NONE, from, Vec2::new(25.0, -60.0));
    let made = kinds(&harness).pop();
    let Some(ConstraintKind::Joint { frame: 40, joint, position_m, .. }) = made else {
        panic!("{made:?}")
    };
    assert_eq!(joint, "Head");
    // Straight up by itself, as far as the pointer went.
    assert!((position_m[0] - f64::from(from_m.x)).abs() < 2e-3);
    assert!(position_m[1] > f64::from(from_m.y) + 0.1, "{position_m:?} from {from_m}");
    let now = place(&harness, Vec3::from_array(position_m.map(|x| x as f32)));
    assert!((now.y - (from.y - 60.0)).abs() < 8.0, "{now} should be 60 above {from}");
    assert_eq!(n_steps(&harness), 1);
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert_eq!(kinds(&harness).len(), 3);
}

#[test]
fn a_pose_is_put_down_turned_at_the_playhead() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(70);
    let clip = harness.state().state.clips[0].id.clone();
    harness.state_mut().state.pose_clip = Some((clip.clone(), 5));
    harness.key_press(Key::P);
    harness.run_steps(2);
    let on_floor = place(&harness, Vec3::new(-1.0, 0.0, 2.0));
    harness.event(Event::PointerMoved(on_floor));
    harness.run_steps(6);
    harness.key_press(Key::R);
    harness.key_press(Key::CloseBracket);
    harness.run_steps(3);
    drag(&mut harness, LEFT, Modifiers::NONE, on_floor, Vec2::ZERO);
    let made = kinds(&harness).pop();
    let Some(ConstraintKind::Pose { frame, clip: of, clip_frame, position_m, heading_deg, .. }) =
        made
    else {
        panic!("{made:?}")
    };
    assert_eq!((frame, of, clip_frame, heading_deg), (70, clip, 6, Some(15.0)));
    let [x, z] = position_m.expect("a place");
    assert!((x + 1.0).abs() < 0.02 && (z - 2.0).abs() < 0.02, "{x} {z}");
    assert_eq!(n_steps(&harness), 1);
    assert_eq!(harness.state().state.stage.roles[0].poses.len(), 1, "it is seen");
}

#[test]
fn several_marks_move_together_as_one_step_and_escape_restores() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    select(&mut harness, &["corner", "end"]);
    let before = (floor_of(&harness, "corner"), floor_of(&harness, "end"));
    let middle = harness.get_by_label(viewport::LABEL).rect().center();
    harness.event(Event::PointerMoved(middle));
    harness.run_steps(2);
    harness.key_press(Key::G);
    harness.run_steps(2);
    for key in [Key::X, Key::Num1, Key::Period, Key::Num5] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    assert_eq!(floor_of(&harness, "corner")[0], before.0[0] + 1.5);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!((floor_of(&harness, "corner"), floor_of(&harness, "end")), before);
    assert_eq!(n_steps(&harness), 0, "X held an axis and deleted nothing");
    harness.key_press(Key::G);
    harness.run_steps(2);
    for key in [Key::Z, Key::Minus, Key::Num2, Key::Enter] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    assert_eq!(floor_of(&harness, "corner"), [before.0[0], before.0[1] - 2.0]);
    assert_eq!(floor_of(&harness, "end"), [before.1[0], before.1[1] - 2.0]);
    assert_eq!(n_steps(&harness), 1);
}

#[test]
fn small_steps_by_key_are_one_step_of_the_history() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    select(&mut harness, &["corner"]);
    let before = floor_of(&harness, "corner");
    for _ in 0..3 {
        harness.key_press_modifiers(Modifiers::ALT, Key::ArrowRight);
        harness.step();
    }
    let after = floor_of(&harness, "corner");
    let gone = (after[0] - before[0]).hypot(after[1] - before[1]);
    assert!((gone - 0.3).abs() < 1e-6, "{before:?} to {after:?}");
    let right = place(&harness, Vec3::new(after[0] as f32, 0.0, after[1] as f32));
    let left = place(&harness, Vec3::new(before[0] as f32, 0.0, before[1] as f32));
    assert!(right.x > left.x, "right is right");
    assert!(n_steps(&harness) <= 3);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::A);
    harness.run_steps(2);
    assert_eq!(kinds(&harness).len(), 4);
}

#[test]
fn the_industry_scheme_moves_the_camera_as_it_says() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.settings.navigation = Navigation::Industry;
    harness.run_steps(2);
    let start = sight(&harness).rect.lerp_inside(Vec2::new(0.2, 0.2));
    let by = Vec2::new(60.0, 20.0);
    let before = harness.state().viewport.camera;
    drag(&mut harness, LEFT, Modifiers::ALT, start, by);
    let orbited = harness.state().viewport.camera;
    assert!(orbited.yaw_rad != before.yaw_rad && orbited.target_m == before.target_m);
    drag(&mut harness, PointerButton::Middle, Modifiers::ALT, start, by);
    let panned = harness.state().viewport.camera;
    assert!(panned.target_m != orbited.target_m && panned.yaw_rad == orbited.yaw_rad);
    drag(&mut harness, PointerButton::Secondary, Modifiers::ALT, start, by);
    let zoomed = harness.state().viewport.camera;
    assert!(zoomed.distance_m < panned.distance_m, "to the right is nearer");
    assert_eq!(zoomed.yaw_rad, panned.yaw_rad);
    assert_eq!(n_steps(&harness), 0, "cameras are no part of a document");
}

#[test]
fn the_gizmo_and_keys_look_along_axes() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.get_by_label("View from +X").click();
    harness.run_steps(6);
    let camera = harness.state().viewport.camera;
    assert!((camera.yaw_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-5, "{camera:?}");
    let is_flat = camera.projection == motion_scene::camera::Projection::Orthographic;
    assert!(is_flat);
    harness.get_by_label(viewport::gizmo::MIDDLE).click();
    harness.run_steps(3);
    let camera = harness.state().viewport.camera;
    assert!(camera.projection != motion_scene::camera::Projection::Orthographic);
    harness.key_press_modifiers(Modifiers::ALT, Key::Num7);
    harness.run_steps(6);
    let pitch_rad = harness.state().viewport.camera.pitch_rad;
    assert!((pitch_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-5);
    select(&mut harness, &["end"]);
    harness.key_press(Key::F);
    harness.run_steps(6);
    let [x, z] = floor_of(&harness, "end");
    let target_m = harness.state().viewport.camera.target_m;
    assert!(target_m.with_y(0.0).distance(Vec3::new(x as f32, 0.0, z as f32)) < 0.3);
}

#[test]
fn the_wheel_with_ctrl_retimes_as_one_step() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let [x, z] = floor_of(&harness, "corner");
    let on_ring = place(&harness, Vec3::new(x as f32, 0.0, z as f32));
    harness.event(Event::PointerMoved(on_ring));
    harness.run_steps(12);
    assert!(harness.state().state.hovered.is_some(), "the ring is under the pointer");
    let camera = harness.state().viewport.camera;
    for _ in 0..3 {
        harness.event(Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: Vec2::new(0.0, 1.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::CTRL,
        });
        harness.step();
    }
    harness.run_steps(8);
    assert_eq!(harness.state().state.marks[1].frame(), 113);
    assert_eq!(n_steps(&harness), 1);
    assert_eq!(harness.state().viewport.camera, camera, "it did not zoom");
}

#[test]
fn a_frame_typed_in_the_inspector_is_one_step() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    select(&mut harness, &["corner"]);
    harness.get_by_role_and_label(Role::SpinButton, "Frame").click();
    harness.run_steps(3);
    harness.event(Event::Text("95".to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().state.marks[1].frame(), 95);
    assert_eq!(n_steps(&harness), 1);
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state.marks[1].frame(), 110);
}

#[test]
fn there_are_few_controls_with_a_mark_selected_too() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let roles = [
        Role::Button,
        Role::TextInput,
        Role::ComboBox,
        Role::Slider,
        Role::CheckBox,
        Role::SpinButton,
    ];
    let count = |harness: &Window| {
        let takes = harness.state().state.cards.len();
        let n: usize = roles.iter().map(|role| harness.query_all_by_role(*role).count()).sum();
        // Takes and marks are what there is to choose from, not what it is done with.
        n - takes - harness.query_all_by_label_contains("Body checkpoint").count()
    };
    let nothing = count(&harness);
    assert!(nothing <= 40, "{nothing} controls");
    select(&mut harness, &["corner"]);
    let one = count(&harness);
    assert!(one <= 46, "{one} controls with a checkpoint selected");
}
