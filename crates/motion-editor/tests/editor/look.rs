//! What is there, and what it does to what is looked at.

use egui::{Key, Modifiers, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use motion_editor::app::EditorApp;
use motion_editor::settings::GhostMode;
use motion_editor::settings::Tool;
use motion_editor::{timeline, viewport};

use crate::window::{open, quiet, solved};

/// Few enough to be looked over.
const MAX_CONTROLS: usize = 40;

#[test]
fn the_window_opens_with_a_view_and_few_controls() {
    let Some(harness) = open() else { return };
    let canvas = harness.get_by_label(viewport::LABEL);
    assert_eq!(canvas.accesskit_node().role(), Role::Canvas);
    assert!(harness.state().viewport.n_drawn() > 0, "the floor is drawn");
    let roles = [Role::Button, Role::TextInput, Role::ComboBox, Role::Slider, Role::CheckBox];
    let count = |role| harness.query_all_by_role(role).count();
    let n: usize = roles.into_iter().map(count).sum();
    assert!((10..=MAX_CONTROLS).contains(&n), "{n} controls");
}

#[test]
fn the_longest_menu_is_seen_whole() {
    let Some(mut harness) = open() else { return };
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::Button, "Edit").click();
    harness.run_steps(4);
    let last = harness.get_by_label_contains("Nudge").rect();
    assert!(last.bottom() <= 1000.0, "it goes on to {}", last.bottom());
}

/// Who aims at a button while takes come presses that button.
#[test]
fn nothing_moves_while_takes_come() {
    let Some(mut harness) = open() else { return };
    harness.run_steps(2);
    let place = |harness: &Harness<'_, EditorApp>| {
        let tab = harness.get_by_role_and_label(Role::Tab, "Inspector").rect();
        let add = harness.get_by_role_and_label(Role::Button, "Add a character").rect();
        (tab, add)
    };
    let before = place(&harness);
    assert!(harness.state().state.cards.is_empty());
    crate::window::settle(&mut harness);
    assert_eq!(place(&harness), before);
}

#[test]
fn the_sample_plays_by_itself_and_space_pauses() {
    let Some(mut harness) = open() else { return };
    crate::window::settle(&mut harness);
    assert!(harness.state().state.is_playing());
    assert!(harness.state().state.cards.len() >= 2, "distinct takes");
    harness.key_press(Key::Space);
    harness.run_steps(2);
    let state = &harness.state().state;
    assert!(!state.is_playing());
    assert_eq!(state.frame().fract(), 0.0);
}

#[test]
fn a_press_on_the_ruler_scrubs() {
    let Some(mut harness) = solved() else { return };
    let ruler = harness.get_by_label(timeline::ruler::LABEL).rect();
    for share in [0.25, 0.5] {
        harness.drag_at(ruler.lerp_inside(Vec2::new(share, 0.5)));
        harness.run_steps(2);
        let state = &harness.state().state;
        let expected = state.n_frames() as f64 * f64::from(share);
        assert!((state.frame() - expected).abs() < 8.0, "{share}: {}", state.frame());
    }
}

#[test]
fn the_palette_finds_a_command_and_does_it() {
    let Some(mut harness) = solved() else { return };
    assert_eq!(harness.state().state.settings.ghosts, GhostMode::Off);
    harness.key_press_modifiers(Modifiers::CTRL, Key::P);
    harness.run_steps(3);
    harness.event(egui::Event::Text("ghost".to_owned()));
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ListItem, "Show ghosts");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().state.settings.ghosts, GhostMode::Around);
    let line = harness.query_by_role_and_label(Role::ListItem, "Show ghosts");
    assert!(line.is_none(), "it closes");
}

#[test]
fn another_take_is_shown_at_the_same_frame() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let state = &mut harness.state_mut().state;
    state.seek(50.0);
    let is_second = state.shown_card().is_some_and(|card| card.number == 2);
    let (key, nth) = if is_second { (Key::Num1, 0) } else { (Key::Num2, 1) };
    let other = state.cards[nth].id;
    harness.key_press(key);
    quiet(&mut harness);
    let state = &harness.state().state;
    assert_eq!((state.shown(), state.frame()), (Some(other), 50.0));
    harness.key_press(Key::F1);
    harness.run_steps(2);
    let sheet = |harness: &Harness<'_, EditorApp>| {
        harness.query_by_role_and_label(Role::Window, "Keyboard shortcuts").is_some()
    };
    assert!(sheet(&harness));
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(!sheet(&harness), "Escape closes it");
}

#[test]
fn a_picture_is_drawn_only_when_something_changed() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let n_drawn = harness.state().viewport.n_drawn();
    harness.run_steps(5);
    assert_eq!(harness.state().viewport.n_drawn(), n_drawn);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(3);
    assert_eq!(harness.state().viewport.n_drawn(), n_drawn + 1);
}

#[test]
fn a_clips_box_switches_it_and_its_name_takes_its_pose() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let row = harness.get_by_label_contains("Clip walk_slow").rect();
    let click = |harness: &mut Harness<'_, EditorApp>, at: egui::Pos2| {
        harness.drag_at(at);
        harness.run_steps(2);
        harness.drop_at(at);
        harness.run_steps(3);
    };
    click(&mut harness, row.left_center() + Vec2::new(8.0, 0.0));
    let is_in = |harness: &Harness<'_, EditorApp>| {
        let clips = &harness.state().state.clips;
        clips.iter().find(|clip| clip.id == "walk_slow").map(|clip| clip.is_in_palette)
    };
    assert_eq!(is_in(&harness), Some(false));
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(3);
    assert_eq!(is_in(&harness), Some(true), "one step");
    click(&mut harness, row.center());
    let state = &harness.state().state;
    assert_eq!(state.pose_clip.as_ref().map(|(clip, _)| clip.as_str()), Some("walk_slow"));
    assert_eq!(state.settings.tool, Tool::Pose);
    assert_eq!(state.session.history().n_steps().0, 0, "nothing is asked yet");
}
