//! Projects opened, saved and left; what is unsaved is asked about and comes back.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::slice::from_ref;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Key, Modifiers, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::dialogs::Answers;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::EditorOptions;
use motion_session::command::Command;
use motion_session::session::ImportState;
use motion_session::{Session, Warnings, load_project};

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
    let limit = Instant::now() + Duration::from_secs(60);
    while window.state().state.stage.actors.len() < 2 {
        assert!(Instant::now() < limit, "the second person never comes");
        std::thread::sleep(Duration::from_millis(20));
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

/// A file that is dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("nobody reads it whole".to_owned())
    }
}

fn drop_on(window: &mut Window, path: &Path) {
    window.input_mut().dropped_files.push(Arc::new(Dropped(path.to_owned())));
    window.run_steps(3);
}

#[test]
fn clips_that_are_dropped_become_a_library_and_undo_brings_the_last_one_back() {
    const LIMIT: Duration = Duration::from_secs(120);
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = open(folder.path(), ProjectSource::Sample, &[]) else { return };
    window.state_mut().state.settings.welcome_seen = true;
    crate::window::settle(&mut window);
    crate::window::quiet(&mut window);
    let clips = folder.path().join("clips");
    std::fs::create_dir(&clips).unwrap();
    let state = &mut window.state_mut().state;
    let (active, takes) = (state.session.active(), [state.cards[0].id, state.cards[1].id]);
    for (take, name) in takes.into_iter().zip(["one.bvh", "two.bvh"]) {
        let range = motion_session::session::ExportRange::Whole;
        state.session.export_take(active, take, &clips.join(name), range).unwrap();
    }
    std::fs::File::create(clips.join("broken.bvh")).unwrap();

    drop_on(&mut window, &clips);
    let start = Instant::now();
    while !matches!(window.state().state.session.import(), ImportState::Done(_)) {
        let import = window.state().state.session.import();
        assert!(!matches!(import, ImportState::Failed(..)), "{import:?}");
        assert!(start.elapsed() < LIMIT, "the import never ends: {import:?}");
        std::thread::sleep(Duration::from_millis(30));
        window.step();
    }
    window.run_steps(3);
    let ids = |window: &Window| -> Vec<String> {
        window.state().state.clips.iter().map(|clip| clip.id.clone()).collect()
    };
    assert_eq!(ids(&window), ["one", "two"]);
    window.get_by_label("Report").click();
    window.run_steps(3);
    window.get_by_label_contains("broken.bvh");
    press(&mut window, Modifiers::CTRL, Key::Z);
    let start = Instant::now();
    while ids(&window).len() < 10 {
        assert!(start.elapsed() < LIMIT, "the built-in clips never come back");
        std::thread::sleep(Duration::from_millis(30));
        window.step();
    }

    let other = folder.path().join("other.gaitway");
    let project = motion_session::sample::SAMPLES[1].project().unwrap();
    save_elsewhere(&project, &other);
    drop_on(&mut window, &other);
    assert_eq!(name(&window), "run and stop");
}

/// As another program would have saved it.
fn save_elsewhere(project: &motion_session::Project, path: &Path) {
    let state = tempfile::tempdir().expect("a temporary folder");
    let options = motion_session::session::SessionOptions {
        state_folder: Some(state.path().to_owned()),
        wake: Arc::new(|| ()),
        builtin: None,
        project: Some(project.clone()),
    };
    let mut session = Session::new(options).expect("threads");
    session.save_as(path).expect("it can be saved");
}
