//! Obstacles: drawn, moved, sized and turned by their handles, said in fields, saved.

use egui::{Key, Modifiers, Pos2, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::Vec3;
use motion_editor::app::EditorApp;
use motion_editor::obstacle_form::{ObstacleForm, center_m, floor_m, heading_deg, levels_m};
use motion_editor::viewport;
use motion_editor::viewport::gesture::handle::{HandleOf, handles};
use motion_editor::viewport::gesture::sight::Sight;
use motion_session::Shape;

use crate::window::{click, drag, quiet, solved, steps_back, type_in};

type Window = Harness<'static, EditorApp>;

fn sight(harness: &Window) -> Sight {
    let rect = harness.get_by_label(viewport::LABEL).rect();
    Sight { camera: harness.state().viewport.camera, rect }
}

fn place(harness: &Window, [x, z]: [f64; 2]) -> Pos2 {
    let at_m = Vec3::new(x as f32, 0.0, z as f32);
    sight(harness).place(at_m).expect("in front of the camera")
}

fn shapes(harness: &Window) -> Vec<Shape> {
    let obstacles = harness.state().state.session.document().obstacles();
    obstacles.iter().map(|obstacle| obstacle.shape.clone()).collect()
}

/// Where a handle of the selected obstacle is.
#[track_caller]
fn handle(harness: &Window, is_it: impl Fn(&HandleOf) -> bool) -> Pos2 {
    let all = handles(&harness.state().state, &sight(harness));
    let found = all.iter().find(|handle| is_it(&handle.of));
    found.map(|handle| handle.place).expect("the obstacle has that handle")
}

/// Draws from a place on the floor to another with the tool that is out.
fn draw(harness: &mut Window, from: [f64; 2], to: [f64; 2]) {
    let (from, to) = (place(harness, from), place(harness, to));
    drag(harness, from, to - from);
}

/// Where the sample walks nobody stands here.
const FREE: ([f64; 2], [f64; 2]) = ([-2.5, 1.0], [-1.5, 3.0]);

/// A box drawn there, selected, with its tool still out.
fn with_box() -> Option<Window> {
    let mut harness = solved()?;
    quiet(&mut harness);
    harness.key_press(Key::O);
    harness.run_steps(2);
    draw(&mut harness, FREE.0, FREE.1);
    Some(harness)
}

#[test]
fn forms_are_drawn_each_as_one_step() {
    let Some(mut harness) = with_box() else { return };
    let wall = shapes(&harness).remove(0);
    let [x, y, z] = center_m(&wall);
    assert!((x + 2.0).abs() < 0.03 && (z - 2.0).abs() < 0.03 && y == 0.5, "{wall:?}");
    let [width, depth] = floor_m(&wall);
    assert!((width - 1.0).abs() < 0.04 && (depth - 2.0).abs() < 0.04, "{wall:?}");
    harness.get_by_label_contains("Box 1, 1.00 m high");
    harness.key_press(Key::O);
    harness.run_steps(2);
    draw(&mut harness, [1.0, -1.5], [1.5, -1.5]);
    let column = shapes(&harness).pop().expect("a second one");
    assert_eq!(ObstacleForm::of(&column), ObstacleForm::Cylinder);
    assert!((floor_m(&column)[0] - 1.0).abs() < 0.04, "{column:?}");
    assert_eq!(steps_back(&harness), 2);
    let saved = harness.state().state.session.document().to_project();
    assert_eq!(crate::window::read_again(&saved), saved, "as it was saved");
    for _ in 0..2 {
        harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
        harness.run_steps(2);
    }
    assert!(shapes(&harness).is_empty());
}

#[test]
fn handles_size_raise_and_turn() {
    let Some(mut harness) = with_box() else { return };
    harness.key_press(Key::Q);
    harness.run_steps(2);
    let before = shapes(&harness).remove(0);
    let edge = handle(&harness, |of| matches!(of, HandleOf::Edge(_, 0, false)));
    let to = place(&harness, [-3.5, 2.0]);
    drag(&mut harness, edge, to - edge);
    let wider = shapes(&harness).remove(0);
    assert!((floor_m(&wider)[0] - 2.0).abs() < 0.06, "{wider:?}");
    let far = |shape: &Shape| center_m(shape)[0] + 0.5 * floor_m(shape)[0];
    assert!((far(&wider) - far(&before)).abs() < 2e-3, "the other edge stays");
    let top = handle(&harness, |of| matches!(of, HandleOf::Top(_)));
    drag(&mut harness, top, Vec2::new(0.0, -40.0));
    let higher = shapes(&harness).remove(0);
    assert!(levels_m(&higher).1 > 1.1 && levels_m(&higher).0 == 0.0, "{higher:?}");
    let turn = handle(&harness, |of| matches!(of, HandleOf::Turn(_)));
    let [x, _, z] = center_m(&higher);
    let to = place(&harness, [x + 1.5, z]);
    drag(&mut harness, turn, to - turn);
    let turned = shapes(&harness).remove(0);
    assert!(heading_deg(&turned).is_some_and(|deg| (deg - 90.0).abs() < 3.0), "{turned:?}");
    assert_eq!(steps_back(&harness), 4);
}

#[test]
fn a_chosen_obstacle_goes_along_and_others_are_orbited_around() {
    let Some(mut harness) = with_box() else { return };
    harness.key_press(Key::Q);
    harness.run_steps(2);
    let before = shapes(&harness);
    let camera = harness.state().viewport.camera;
    let on_it = sight(&harness).place(Vec3::new(-2.0, 0.6, 2.0)).expect("in view");
    drag(&mut harness, on_it, Vec2::new(-70.0, 10.0));
    assert!(shapes(&harness) != before, "it was selected, and goes along");
    assert_eq!(harness.state().viewport.camera, camera);
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    harness.state_mut().state.session.selection_mut().clear();
    harness.run_steps(2);
    drag(&mut harness, on_it, Vec2::new(-70.0, 10.0));
    assert_eq!(shapes(&harness), before, "nobody has chosen it");
    assert!(harness.state().viewport.camera != camera, "the camera goes round");
}

#[test]
fn fields_say_everything_of_an_obstacle() {
    let Some(mut harness) = with_box() else { return };
    for (name, typed) in [("Height", "2"), ("Width", "1.5"), ("Heading", "30"), ("x", "-3")] {
        type_in(&mut harness, name, typed);
    }
    let wall = shapes(&harness).remove(0);
    assert_eq!((levels_m(&wall), floor_m(&wall)[0]), ((0.0, 2.0), 1.5));
    assert_eq!((heading_deg(&wall), center_m(&wall)[0]), (Some(30.0), -3.0));
    click(&mut harness, Role::ComboBox, "Form");
    click(&mut harness, Role::Button, "Ceiling");
    type_in(&mut harness, "Clear height", "1.3");
    let roof = shapes(&harness).remove(0);
    assert_eq!((ObstacleForm::of(&roof), levels_m(&roof).1), (ObstacleForm::Ceiling, 1.3));
    harness.key_press_modifiers(Modifiers::SHIFT, Key::D);
    harness.run_steps(3);
    assert_eq!(shapes(&harness).len(), 2, "once more, beside it");
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert_eq!(shapes(&harness), [roof]);
}
