//! The shown take changed by hand, with the mouse and keys.

use egui::{Event, Key, Modifiers, Pos2, Rect, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::Vec3;
use motion_editor::app::EditorApp;
use motion_editor::panels::right_tab::RightTab;
use motion_editor::settings::Tool;
use motion_editor::viewport::gesture::sight::Sight;
use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef, HandChange, HandEdit};
use motion_session::session::ExportRange;

use crate::window::{button, drag, hold, quiet, settle, solved};

type Window = Harness<'static, EditorApp>;

/// Where the changes are made.
const FRAME: usize = 60;

/// The sample, solved, at a frame in the middle, with the tool.
fn with_tool() -> Option<Window> {
    let mut harness = solved()?;
    // All of the tab is in sight.
    harness.set_size(Vec2::new(1600.0, 1700.0));
    harness.state_mut().state.stop_at(FRAME);
    harness.key_press(Key::I);
    harness.run_steps(3);
    assert_eq!(harness.state().state.settings.tool, Tool::ByHand, "the key's tool");
    assert_eq!(harness.state().state.right_tab, RightTab::ByHand, "and its tab");
    Some(harness)
}

/// Where a joint of the shown take is at a frame of what is shown, metres.
fn joint_m(harness: &Window, joint: &str, frame: usize) -> Vec3 {
    let actor = &harness.state().state.stage.actors[0];
    let joint = actor.skeleton.find(joint).expect("a joint of the body");
    actor.motion.joint_path_m(&actor.skeleton, joint)[frame]
}

/// Where that is in the window.
fn place(harness: &Window, joint: &str) -> Pos2 {
    let app = harness.state();
    let sight = Sight { camera: app.viewport.camera, rect: app.viewport.rect() };
    sight.place(joint_m(harness, joint, FRAME)).expect("a joint in sight")
}

fn edits(harness: &Window) -> Vec<HandEdit> {
    let layer = harness.state().state.hand_layer();
    layer.into_iter().flat_map(|layer| layer.edits()).map(|(_, edit)| edit.clone()).collect()
}

fn n_undo(harness: &Window) -> usize {
    harness.state().state.session.history().n_steps().0
}

fn undo(harness: &mut Window) {
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
}

/// Goes on until the shown motion is made for what is asked and changed now.
fn made(harness: &mut Window) {
    harness.step();
    for _ in 0..1500 {
        let state = &harness.state().state;
        let found = state.session.snapshot().character(CharacterIdx(0)).expect("a character");
        let take = found.shown().expect("a shown take");
        let layer = take.by_hand.as_ref().map(|known| (*known.layer).clone());
        let wished = state.hand_layer().cloned();
        if !found.is_stale(take) && layer.unwrap_or_default() == wished.unwrap_or_default() {
            harness.run_steps(3);
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
        harness.step();
    }
    panic!("the motion is not made anew");
}

fn rect(harness: &Window, label: &str) -> Rect {
    harness.get_by_label_contains(label).rect()
}

fn shift_m(edit: &HandEdit) -> Vec3 {
    let HandChange::Hand { shift_m, .. } = edit.change else { panic!("{edit:?}") };
    Vec3::from_array(shift_m.map(|x| x as f32))
}

#[test]
fn a_hand_is_dragged_stays_when_the_take_is_refined_and_is_exported() {
    let Some(mut harness) = with_tool() else { return };
    quiet(&mut harness);
    let picked = harness.state().state.shown().unwrap();
    let before_m = joint_m(&harness, "LeftHand", FRAME);
    let n_before = n_undo(&harness);
    let at = place(&harness, "LeftHand");
    hold(&mut harness, at, Vec2::new(6.0, -30.0));
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    harness.event(button(at, false));
    harness.run_steps(2);
    assert_eq!((edits(&harness).len(), n_undo(&harness)), (0, n_before), "Escape restores");
    harness.key_press(Key::I);
    harness.run_steps(2);

    drag(&mut harness, at, Vec2::new(6.0, -30.0));
    let [edit] = &edits(&harness)[..] else { panic!("one edit") };
    let by_m = shift_m(edit);
    assert_eq!((edit.from, edit.to, edit.ease_in, edit.ease_out), (60, 60, 12, 12));
    assert!(by_m.y > 0.02, "up: {by_m}");
    assert_eq!(n_undo(&harness), n_before + 1);
    made(&mut harness);
    let moved_m = joint_m(&harness, "LeftHand", FRAME) - before_m;
    assert!(moved_m.distance(by_m) < 0.02, "{moved_m} {by_m}");
    assert!(harness.state().state.actor_before_hand().is_some(), "a ghost of what it was");

    // Again: the same edit is changed.
    let at = place(&harness, "LeftHand");
    drag(&mut harness, at, Vec2::new(0.0, -20.0));
    assert_eq!((edits(&harness).len(), n_undo(&harness)), (1, n_before + 2));
    assert!(shift_m(&edits(&harness)[0]).y > by_m.y + 0.01);
    undo(&mut harness);
    assert_eq!(&edits(&harness)[0], edit);

    // A checkpoint elsewhere: the take is refined, and keeps it.
    harness.state_mut().state.session.search().resume();
    let end = ConstraintRef::new(CharacterIdx(0), "end");
    let state = &mut harness.state_mut().state;
    let [x, z] = state.place_of(&end).unwrap();
    assert!(state.apply(&Command::Move { at: end, position_m: [x + 0.6, z + 0.5] }));
    settle(&mut harness);
    made(&mut harness);
    let state = &harness.state().state;
    let shown = state.session.shown().unwrap().take.clone();
    let layer = shown.by_hand.clone().expect("a descendant has the layer");
    assert!(layer.from == picked && state.has_hand_edits());
    quiet(&mut harness);
    made(&mut harness);
    let state = &harness.state().state;
    let shown = state.session.shown().unwrap().take.clone();
    let before = state.motion_before_hand().unwrap();
    let skeleton = &state.stage.actors[0].skeleton;
    let wrist = skeleton.find("LeftHand").unwrap();
    let before_m = before.joint_path_m(skeleton, wrist)[FRAME];
    let after_m = shown.made.as_ref().unwrap().motion.joint_path_m(skeleton, wrist)[FRAME];
    assert!((after_m - before_m).distance(by_m) < 0.02, "{} {by_m}", after_m - before_m);

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("take.bvh");
    let (whole, character) = (ExportRange::Whole, CharacterIdx(0));
    let report = state.session.export_take(character, shown.id, &file, whole).unwrap();
    assert!(report.worst_m < 0.001, "the file is the motion that is seen: {}", report.worst_m);

    harness.state_mut().state.session.search().resume();
    undo(&mut harness);
    assert!(harness.state().state.has_hand_edits());
    undo(&mut harness);
    assert!(!harness.state().state.has_hand_edits());
    settle(&mut harness);
    made(&mut harness);
    assert!(harness.state().state.actor_before_hand().is_none(), "the motion before");
}

#[test]
fn a_joint_is_turned() {
    let Some(mut harness) = with_tool() else { return };
    quiet(&mut harness);
    let at = place(&harness, "Head");
    drag(&mut harness, at, Vec2::new(50.0, 0.0));
    let [edit] = &edits(&harness)[..] else { panic!("one edit") };
    let HandChange::Joint { joint, turn_deg } = &edit.change else { panic!("{edit:?}") };
    assert_eq!(joint, "Head");
    let turned = turn_deg.iter().map(|deg| deg * deg).sum::<f64>().sqrt();
    assert!((25.0..35.0).contains(&turned), "half a degree a point: {turned}");
    // By key it goes again.
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert!(edits(&harness).is_empty());
}

/// A window with a hand edit from 60 to 60, eased by 12, made by the menu.
fn with_edit() -> Option<Window> {
    let mut harness = with_tool()?;
    quiet(&mut harness);
    harness.get_by_role_and_label(Role::Button, "Add").click();
    harness.run_steps(3);
    harness.get_by_label("Left hand").click();
    harness.run_steps(3);
    assert_eq!(edits(&harness).len(), 1, "the menu makes one");
    Some(harness)
}

#[test]
fn a_bar_is_dragged_by_its_ends_and_slopes() {
    let Some(mut harness) = with_edit() else { return };
    let panel = &harness.state().timeline;
    let [a, b] = [400.0, 500.0].map(|x| panel.frame_at(x).unwrap());
    let pt_per_frame = (100.0 / (b - a)) as f32;
    let ten = Vec2::new(10.0 * pt_per_frame, 0.0);
    let before = n_undo(&harness);
    let stretch = |harness: &Window| {
        let edit = &edits(harness)[0];
        [edit.from, edit.to, edit.ease_in, edit.ease_out]
    };
    let near = |a: [u32; 4], b: [u32; 4]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1);
    for (nth, (part, by, expected)) in [
        ("End of Left hand by hand", ten, [60, 70, 12, 12]),
        ("Ease out of Left hand by hand", ten, [60, 70, 12, 22]),
        ("Ease in of Left hand by hand", -ten, [60, 70, 22, 22]),
        ("Beginning of Left hand by hand", -ten, [50, 70, 22, 22]),
    ]
    .into_iter()
    .enumerate()
    {
        let at = rect(&harness, part).center();
        drag(&mut harness, at, by);
        assert!(near(stretch(&harness), expected), "{part}: {:?}", stretch(&harness));
        assert_eq!(n_undo(&harness), before + nth + 1, "{part}");
    }
    let middle = rect(&harness, "Left hand by hand, ").center();
    drag(&mut harness, middle, ten);
    assert!(near(stretch(&harness), [60, 80, 22, 22]), "{:?}", stretch(&harness));
    harness.get_by_label_contains("Left hand by hand, ").click();
    harness.run_steps(2);
    assert!(harness.state().state.selected_edit().is_some());
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert!(edits(&harness).is_empty());
    assert!(harness.query_by_label_contains("Left hand by hand, ").is_none(), "the row is gone");
}

#[test]
fn fields_and_buttons_change_it() {
    let Some(mut harness) = with_edit() else { return };
    let before = n_undo(&harness);
    let field = harness.get_by_role_and_label(Role::SpinButton, "Shift y (up)");
    let field = field.rect().center();
    drag(&mut harness, field, Vec2::new(60.0, 0.0));
    assert!(shift_m(&edits(&harness)[0]).y > 0.05, "{:?}", edits(&harness));
    assert_eq!(n_undo(&harness), before + 1, "a drag of a field is one step");
    let before_y = shift_m(&edits(&harness)[0]).y;
    harness.key_press_modifiers(Modifiers::ALT, Key::ArrowUp);
    harness.run_steps(2);
    let by = shift_m(&edits(&harness)[0]).y - before_y;
    assert!((0.005..=0.011).contains(&by), "a centimetre up in the view: {by}");
    made(&mut harness);
    let card = harness.query_all_by_label_contains("changed by hand").count();
    assert!(card >= 1, "its card says so");
    harness.get_by_label("Clear all").click();
    harness.run_steps(2);
    assert!(edits(&harness).is_empty());
    harness.get_by_label_contains("Press I and drag a hand");
    undo(&mut harness);
    harness.get_by_label("Delete the change of left hand").click();
    harness.run_steps(2);
    assert!(edits(&harness).is_empty());
}

#[test]
fn the_timing_is_bent() {
    let Some(mut harness) = with_tool() else { return };
    quiet(&mut harness);
    let n_frames = harness.state().state.n_frames();
    let before = n_undo(&harness);
    harness.get_by_label("Slower here").click();
    harness.run_steps(2);
    assert_eq!(n_undo(&harness), before + 1);
    made(&mut harness);
    assert_eq!(harness.state().state.n_frames(), n_frames + 30, "half a second twice");
    let n_knots = |harness: &Window| {
        harness.state().state.hand_layer().map_or(0, |layer| layer.retime().knots().len())
    };
    assert_eq!(n_knots(&harness), 6);
    let knot = rect(&harness, "Knot 6").center();
    drag(&mut harness, knot, Vec2::new(20.0, 0.0));
    assert_eq!(n_undo(&harness), before + 2);
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert_eq!(n_knots(&harness), 5);
    // A double click puts one on the curve; here every event takes its quarter of a second.
    harness.ctx.options_mut(|options| options.input_options.max_double_click_delay = 5.0);
    let plot = rect(&harness, "Timing curve");
    let at = plot.lerp_inside(Vec2::new(0.12, 0.4));
    for _ in 0..2 {
        harness.event(Event::PointerMoved(at));
        harness.event(button(at, true));
        harness.event(button(at, false));
        harness.run_steps(1);
    }
    harness.run_steps(2);
    assert_eq!(n_knots(&harness), 6);
    harness.get_by_label("Own timing").click();
    harness.run_steps(2);
    assert_eq!(n_knots(&harness), 0);
    made(&mut harness);
    assert_eq!(harness.state().state.n_frames(), n_frames);
}
