//! Projects opened, saved and left; what is unsaved is asked about and comes back.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::slice::from_ref;

use egui::{Key, Modifiers, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::dialogs::Answers;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::EditorOptions;
use motion_session::command::Command;
use motion_session::{Warnings, load_project};

use crate::window::can_draw;

type Window = Harness<'static, EditorApp>;

/// A window that keeps what it remembers below `folder`, where questions for files are answered by
/// `answers`.
fn open(folder: &Path, source: ProjectSource, answers: &[PathBuf]) -> Option<Window> {
    if !can_draw() {
        return None;
    }
    let prepared: VecDeque<Vec<PathBuf>> = answers.iter().map(|path| vec![path.clone()]).collect();
    let options = EditorOptions {
        source,
        state_folder: Some(folder.join("state")),
        config_folder: Some(folder.join("config")),
        answers: Answers::Prepared(prepared),
    };
    let builder = Harness::builder().with_size(Vec2::new(1400.0, 900.0)).wgpu();
    let mut window = builder.build_eframe(|cc| EditorApp::new(cc, options).expect("threads"));
    window.run_steps(3);
    Some(window)
}

fn rename(window: &mut Window, name: &str) {
    let name = name.to_owned();
    let done = window.state_mut().state.apply(&Command::RenameProject { name });
    assert!(done, "a project can be called anything");
    window.run_steps(2);
}

fn name(window: &Window) -> String {
    window.state().state.session.document().name().to_owned()
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(4);
}

#[test]
fn a_project_is_saved_where_it_is_said_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.gaitway");
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, from_ref(&path)) else {
        return;
    };
    rename(&mut window, "mine");
    press(&mut window, Modifiers::CTRL, Key::S);
    assert_eq!(load_project(&path, &mut Warnings::new()).unwrap().name, "mine");
    assert!(!window.state().state.session.is_changed());
    rename(&mut window, "mine, later");
    press(&mut window, Modifiers::CTRL, Key::S);
    let saved = load_project(&path, &mut Warnings::new()).unwrap();
    assert_eq!(saved.name, "mine, later", "the file is known by now");
    assert_eq!(window.state().state.recent, from_ref(&path));
    window.state_mut().state.close();
    drop(window);

    let Some(mut window) = open(folder.path(), ProjectSource::Sample, from_ref(&path)) else {
        return;
    };
    assert_eq!(window.state().state.recent, from_ref(&path), "it is remembered");
    press(&mut window, Modifiers::CTRL, Key::O);
    assert_eq!(name(&window), "mine, later");
    assert_eq!(window.state().state.session.path(), Some(path.as_path()));
}

#[test]
fn unsaved_work_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.gaitway");
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, from_ref(&path)) else {
        return;
    };
    rename(&mut window, "precious");
    press(&mut window, Modifiers::CTRL, Key::N);
    assert_eq!(name(&window), "precious", "it asks first");
    window.get_by_role_and_label(Role::Button, "Cancel").click();
    window.run_steps(3);
    assert_eq!(name(&window), "precious");
    press(&mut window, Modifiers::CTRL, Key::N);
    window.get_by_role_and_label(Role::Button, "Save").click();
    window.run_steps(4);
    assert_eq!(load_project(&path, &mut Warnings::new()).unwrap().name, "precious");
    assert_eq!(name(&window), "untitled", "saved, and then begun anew");
    rename(&mut window, "not precious");
    press(&mut window, Modifiers::CTRL, Key::N);
    window.get_by_role_and_label(Role::Button, "Discard changes").click();
    window.run_steps(4);
    assert_eq!(name(&window), "untitled");
}

#[test]
fn what_a_crash_left_is_offered() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, &[]) else { return };
    rename(&mut window, "nearly lost");
    window.state_mut().state.poll(motion_session::session::AUTOSAVE_SECS + 1.0);
    // Nobody closes it: the autosave stays.
    drop(window);
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, &[]) else { return };
    assert_eq!(name(&window), "sample");
    window.get_by_role_and_label(Role::Button, "Restore").click();
    window.run_steps(4);
    assert_eq!(name(&window), "nearly lost");
    assert!(window.state().state.session.is_changed(), "it is in no file yet");
}

#[test]
fn the_window_is_as_it_was_left() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, &[]) else { return };
    assert!(window.query_by_label("Close welcome").is_some(), "a newcomer is welcomed");
    window.get_by_label("Close welcome").click();
    window.run_steps(2);
    window.state_mut().state.settings.trail = false;
    window.state_mut().state.settings.left.open = false;
    window.run_steps(2);
    window.state_mut().state.close();
    drop(window);
    let Some(window) = open(folder.path(), ProjectSource::Sample, &[]) else { return };
    let settings = &window.state().state.settings;
    assert!(!settings.trail && !settings.left.open && settings.right.open);
    assert!(window.query_by_label("Close welcome").is_none(), "once is enough");
}

#[test]
fn samples_open_and_move() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, &[]) else { return };
    window.get_by_label_contains("Two pass").click();
    window.run_steps(3);
    crate::window::settle(&mut window);
    let state = &window.state().state;
    assert_eq!(state.session.document().characters().len(), 2);
    let limit = std::time::Instant::now() + std::time::Duration::from_secs(60);
    while window.state().state.stage.actors.len() < 2 {
        assert!(std::time::Instant::now() < limit, "the second person never comes");
        std::thread::sleep(std::time::Duration::from_millis(20));
        window.step();
    }
}

#[test]
fn the_shown_motion_is_exported_and_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.bvh");
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, from_ref(&path)) else {
        return;
    };
    window.state_mut().state.settings.welcome_seen = true;
    crate::window::settle(&mut window);
    crate::window::quiet(&mut window);
    press(&mut window, Modifiers::CTRL, Key::E);
    window.get_by_role_and_label(Role::Button, "Export…").click();
    window.run_steps(4);
    let state = &window.state().state;
    assert_eq!(state.notices.refusal(), None);
    let n_frames = state.n_frames();
    let told = state.notices.current().map(|notice| notice.text.clone()).unwrap_or_default();
    assert!(told.contains(&format!("{n_frames} frames")) && told.contains("1 mm"), "{told}");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains(&format!("Frames: {n_frames}")));
}
