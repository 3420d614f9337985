//! Characters who meet: made by a command, on both timelines, in fields, undone.

use egui::{Event, Key, Modifiers, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::meeting::beside_first;
use motion_editor::panels::right_tab::RightTab;
use motion_editor::ui_command::UiCommand;
use motion_session::Interaction;
use motion_session::document::CharacterIdx;
use motion_session::selection::Selectable;

use crate::window::{click, drag, quiet, settle, solved, steps_back, type_in};

type Window = Harness<'static, EditorApp>;

/// Two characters, each with takes.
fn two() -> Option<Window> {
    let mut harness = solved()?;
    click(&mut harness, Role::Button, "Add a character");
    settle(&mut harness);
    quiet(&mut harness);
    harness.state_mut().state.activate(CharacterIdx(0));
    harness.run_steps(2);
    Some(harness)
}

fn meetings(harness: &Window) -> Vec<Interaction> {
    harness.state().state.session.document().interactions().to_vec()
}

fn meet(harness: &mut Window) {
    harness.state_mut().state.stop_at(60);
    harness.state_mut().state.ask(UiCommand::MeetHere);
    harness.run_steps(4);
}

#[test]
fn two_meet_face_to_face_and_part_by_undo() {
    let Some(mut harness) = two() else { return };
    let n_steps = steps_back(&harness);
    meet(&mut harness);
    let [meeting] = &meetings(&harness)[..] else { panic!("one meeting") };
    assert_eq!(meeting.frame, 60);
    let names: Vec<&str> = meeting.members.iter().map(|m| m.character.as_str()).collect();
    let document = harness.state().state.session.document();
    let expected: Vec<&str> = document.characters().iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, expected);
    assert_eq!(beside_first(meeting, 1), ([1.0, 0.0], 180.0));
    let seen = &harness.state().state.stage.meetings;
    assert!(seen.len() == 1 && seen[0].bodies.iter().all(|(_, joints)| joints.is_some()));
    assert_eq!(steps_back(&harness), n_steps + 1);
    // It stands on both timelines.
    let label = format!("{} meets {}, frame 60", names[0], names[1]);
    harness.get_by_label(&label);
    harness.state_mut().state.activate(CharacterIdx(1));
    harness.run_steps(2);
    harness.get_by_label(&label);
    // What it costs is said too.
    harness.state_mut().state.activate(CharacterIdx(0));
    harness.state_mut().state.right_tab = RightTab::Why;
    harness.run_steps(3);
    harness.get_by_label_contains(&format!("{} meets {} · f 60", names[0], names[1]));
    let saved = harness.state().state.session.document().to_project();
    assert_eq!(crate::window::read_again(&saved), saved, "as it was saved");
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert!(meetings(&harness).is_empty());
    assert!(harness.query_by_label(&label).is_none());
}

#[test]
fn a_meeting_is_retimed_typed_and_deleted() {
    let Some(mut harness) = two() else { return };
    meet(&mut harness);
    let mark = harness.get_by_label_contains("meets Character 2, frame").rect().center();
    drag(&mut harness, mark, Vec2::new(70.0, 0.0));
    let later = meetings(&harness)[0].frame;
    assert!(later > 65, "{later}");
    type_in(&mut harness, "Turned from A", "90");
    assert_eq!(beside_first(&meetings(&harness)[0], 1), ([1.0, 0.0], 90.0));
    click(&mut harness, Role::ComboBox, "Clip of Character 2");
    harness.event(Event::Text("walk_slow".to_owned()));
    harness.run_steps(3);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(meetings(&harness)[0].members[1].clip, "walk_slow");
    let selected = harness.state().state.selected().cloned();
    assert!(matches!(selected, Some(Selectable::Interaction(_))), "{selected:?}");
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    assert!(meetings(&harness).is_empty());
}

#[test]
fn characters_are_added_and_removed() {
    let Some(mut harness) = two() else { return };
    harness.state_mut().state.session.selection_mut().clear();
    harness.state_mut().state.activate(CharacterIdx(1));
    harness.run_steps(2);
    click(&mut harness, Role::Button, "Remove this character");
    assert_eq!(harness.state().state.session.document().characters().len(), 1);
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state.session.document().characters().len(), 2);
}
