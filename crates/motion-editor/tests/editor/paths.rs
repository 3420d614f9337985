//! Paths: drawn on the floor, reshaped by their points, timed on the timeline, said in fields.

use egui::{Event, Key, Modifiers, Pos2, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::Vec3;
use motion_editor::app::EditorApp;
use motion_editor::settings::Tool;
use motion_editor::viewport;
use motion_editor::viewport::gesture::sight::Sight;
use motion_session::{ConstraintKind, PathHeading};

use crate::window::{button, click, drag, quiet, solved, steps_back, type_in};

type Window = Harness<'static, EditorApp>;

fn place(harness: &Window, [x, z]: [f64; 2]) -> Pos2 {
    let rect = harness.get_by_label(viewport::LABEL).rect();
    let sight = Sight { camera: harness.state().viewport.camera, rect };
    sight.place(Vec3::new(x as f32, 0.0, z as f32)).expect("in front of the camera")
}

/// The path that was made last.
#[track_caller]
fn path(harness: &Window) -> (u32, u32, Vec<[f64; 2]>, PathHeading) {
    let document = harness.state().state.session.document();
    let last = document.characters()[0].constraints.last().map(|c| c.kind.clone());
    let Some(ConstraintKind::Path { from, to, points_m, heading }) = last else {
        panic!("{last:?} is no path")
    };
    (from, to, points_m, heading)
}

/// Draws a corner on the floor from the playhead on.
fn draw(harness: &mut Window) {
    harness.key_press(Key::D);
    harness.run_steps(2);
    assert_eq!(harness.state().state.settings.tool, Tool::Path, "D is for drawing");
    let ways = [[0.0, 0.5], [0.0, 1.0], [0.0, 1.5], [0.5, 1.5], [1.0, 1.5], [1.5, 1.5]];
    let places = ways.map(|at| place(harness, at));
    harness.event(Event::PointerMoved(places[0]));
    harness.run_steps(4);
    harness.event(button(places[0], true));
    harness.run_steps(2);
    for to in &places[1..] {
        harness.event(Event::PointerMoved(*to));
        harness.run_steps(2);
    }
    harness.event(button(places[5], false));
    harness.run_steps(3);
}

#[test]
fn a_stroke_becomes_a_path_of_few_points_at_a_walk() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    harness.state_mut().state.stop_at(20);
    let camera = harness.state().viewport.camera;
    draw(&mut harness);
    let (from, to, points_m, heading) = path(&harness);
    assert_eq!((points_m.len(), heading), (3, PathHeading::Free), "{points_m:?}");
    for (point, expected) in points_m.iter().zip([[0.0, 0.5], [0.0, 1.5], [1.5, 1.5]]) {
        let off = (point[0] - expected[0]).hypot(point[1] - expected[1]);
        assert!(off < 0.03, "{points_m:?}");
    }
    // 2.5 m at 1.2 m/s.
    assert_eq!((from, to), (20, 20 + 63), "from the playhead on");
    assert_eq!(harness.state().viewport.camera, camera, "the camera stands still");
    assert_eq!(steps_back(&harness), 1);
    harness.get_by_label_contains("Path 1, frames 20 to 83");
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("Path 1, frames").is_none(), "undone");
    harness.key_press_modifiers(Modifiers::CTRL | Modifiers::SHIFT, Key::Z);
    harness.run_steps(2);
    assert_eq!(path(&harness).2, points_m);
}

#[test]
fn points_are_dragged_made_and_taken_away() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    draw(&mut harness);
    harness.key_press(Key::Q);
    harness.run_steps(2);
    let before = path(&harness).2;
    let (from, to) = (place(&harness, before[1]), place(&harness, [-0.5, 2.0]));
    drag(&mut harness, from, to - from);
    let moved = path(&harness).2;
    assert!((moved[1][0] + 0.5).hypot(moved[1][1] - 2.0) < 0.03, "{moved:?}");
    assert_eq!((moved[0], moved[2]), (before[0], before[2]), "others stay");
    let middle = [0, 1].map(|axis| 0.5 * (moved[1][axis] + moved[2][axis]));
    let from = place(&harness, middle);
    drag(&mut harness, from, Vec2::new(0.0, 40.0));
    let more = path(&harness).2;
    assert_eq!(more.len(), 4, "{more:?}");
    let at = place(&harness, more[2]);
    harness.event_modifiers(Event::PointerMoved(at), Modifiers::CTRL);
    harness.run_steps(8);
    for pressed in [true, false] {
        let modifiers = Modifiers::CTRL;
        let button = egui::PointerButton::Primary;
        harness.event_modifiers(
            Event::PointerButton { pos: at, button, pressed, modifiers },
            modifiers,
        );
        harness.run_steps(2);
    }
    assert_eq!(path(&harness).2, moved, "without the point");
    assert_eq!(steps_back(&harness), 4);
    for _ in 0..3 {
        harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
        harness.run_steps(2);
    }
    assert_eq!(path(&harness).2, before);
}

#[test]
fn a_path_is_timed_by_its_ends_and_says_where_to_look() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    draw(&mut harness);
    let (_, to, ..) = path(&harness);
    let end = harness.get_by_label_contains("End of Path 1").rect().center();
    drag(&mut harness, end, Vec2::new(80.0, 0.0));
    let later = path(&harness).1;
    assert!(later > to + 5, "{later} after {to}");
    type_in(&mut harness, "Speed", "2.5");
    // About 2.5 m in a second.
    let faster = path(&harness).1;
    assert!((29..=31).contains(&faster), "{faster}");
    click(&mut harness, Role::ComboBox, "Looks");
    harness.get_by_label("Along the path").click();
    harness.run_steps(3);
    assert_eq!(path(&harness).3, PathHeading::Along);
    let saved = harness.state().state.session.document().to_project();
    let again = crate::window::read_again(&saved);
    assert_eq!(again, saved, "as it was saved");
}

#[test]
fn a_path_is_moved_and_turned_as_a_whole() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    draw(&mut harness);
    let before = path(&harness).2;
    harness.key_press(Key::Q);
    harness.run_steps(2);
    harness.event(Event::PointerMoved(place(&harness, [0.3, 0.3])));
    harness.run_steps(2);
    harness.key_press(Key::G);
    harness.run_steps(2);
    for key in [Key::X, Key::Num1, Key::Enter] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    let moved = path(&harness).2;
    let by_one = |p: &[f64; 2]| [(p[0] + 1.0) * 1000.0, p[1] * 1000.0].map(f64::round);
    let expected: Vec<[f64; 2]> = before.iter().map(by_one).collect();
    let got: Vec<[f64; 2]> =
        moved.iter().map(|p| [p[0] * 1000.0, p[1] * 1000.0].map(f64::round)).collect();
    assert_eq!(got, expected);
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert_eq!(harness.state().state.marks.len(), 3);
}
