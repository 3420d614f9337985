//! The dialog inside the window, with the keyboard and with the mouse.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::{Key, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use motion_editor::dialogs::{Answer, Answers, Ask, FileDialogs};
use motion_editor::theme;

/// What the window under test holds.
struct Asked {
    dialogs: FileDialogs,
    answer: Option<Answer>,
}

/// A folder with two clips, something else, and a folder with one.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("the system has room");
    fs::create_dir(dir.path().join("more")).expect("the folder is ours");
    for name in ["run.bvh", "walk.bvh", "notes.txt", "more/jump.bvh", "old.gaitway"] {
        fs::File::create(dir.path().join(name)).expect("the folder is ours");
    }
    dir
}

/// A window that asks this, beginning in the folder, once it is listed.
fn asking(ask: Ask, folder: &Path) -> Harness<'static, Asked> {
    let asked = Asked { dialogs: FileDialogs::new(Answers::Own), answer: None };
    let mut is_set_up = false;
    let folder = folder.to_owned();
    let app = move |ui: &mut egui::Ui, asked: &mut Asked| {
        if !std::mem::replace(&mut is_set_up, true) {
            theme::install(ui.ctx());
            assert!(asked.dialogs.ask(ask.clone(), &folder, ui.ctx()), "nothing else is open");
            return;
        }
        asked.dialogs.ui(ui);
        asked.answer = asked.dialogs.poll().or(asked.answer.take());
    };
    let mut harness =
        Harness::builder().with_size(Vec2::new(900.0, 700.0)).build_ui_state(app, asked);
    listed(&mut harness);
    harness
}

/// Goes on until the folder is listed, or the dialog is closed.
#[track_caller]
fn listed(harness: &mut Harness<'_, Asked>) {
    let start = Instant::now();
    harness.run_steps(3);
    while harness.query_by_label_contains("Reading the folder").is_some() {
        assert!(start.elapsed() < Duration::from_secs(20), "the folder is never listed");
        std::thread::sleep(Duration::from_millis(5));
        harness.run_steps(2);
    }
    harness.run_steps(2);
}

fn press(harness: &mut Harness<'_, Asked>, keys: &[Key]) {
    for key in keys {
        harness.key_press(*key);
        listed(harness);
    }
}

fn type_text(harness: &mut Harness<'_, Asked>, text: &str) {
    harness.event(egui::Event::Text(text.to_owned()));
    listed(harness);
}

/// The rows that are in sight, in order.
fn rows(harness: &Harness<'_, Asked>) -> Vec<String> {
    let label = |node: egui_kittest::Node<'_>| node.accesskit_node().label().unwrap_or_default();
    harness.query_all_by_role(Role::ListItem).map(label).collect()
}

#[track_caller]
fn check(harness: &Harness<'_, Asked>, expected: &[PathBuf]) {
    let answer = harness.state().answer.as_ref().expect("it is answered");
    assert_eq!(answer.paths, expected, "what was chosen");
    assert!(!harness.state().dialogs.is_open(), "it closes");
}

#[test]
fn a_folder_is_listed_and_a_file_taken_with_the_keyboard() {
    let dir = folder();
    let mut harness = asking(Ask::ImportClips, dir.path());
    assert_eq!(rows(&harness), ["..", "more", "run.bvh", "walk.bvh"]);
    for label in ["Import", "Cancel"] {
        harness.get_by_role_and_label(Role::Button, label);
    }
    harness.get_by_role_and_label(Role::TextInput, "Path");
    press(&mut harness, &[Key::ArrowDown, Key::ArrowDown, Key::Enter]);
    assert_eq!(rows(&harness), ["..", "jump.bvh"]);
    press(&mut harness, &[Key::ArrowDown, Key::Enter]);
    assert_eq!(rows(&harness), ["..", "more", "run.bvh", "walk.bvh"], "up again");
    press(&mut harness, &[Key::ArrowDown, Key::ArrowDown, Key::ArrowDown, Key::Enter]);
    check(&harness, &[dir.path().join("run.bvh")]);
}

#[test]
fn escape_and_cancel_are_no_answer() {
    let dir = folder();
    let mut harness = asking(Ask::OpenProject, dir.path());
    press(&mut harness, &[Key::Escape]);
    check(&harness, &[]);
    let mut harness = asking(Ask::OpenProject, dir.path());
    harness.get_by_label("Cancel").click();
    harness.run_steps(3);
    check(&harness, &[]);
}

#[test]
fn many_files_are_marked_with_the_mouse() {
    let dir = folder();
    let mut harness = asking(Ask::ImportClips, dir.path());
    for name in ["walk.bvh", "run.bvh"] {
        harness.get_by_label(name).click();
        harness.run_steps(40);
    }
    harness.get_by_label("2 files chosen");
    harness.get_by_role_and_label(Role::Button, "Import").click();
    harness.run_steps(3);
    check(&harness, &[dir.path().join("run.bvh"), dir.path().join("walk.bvh")]);
}

#[test]
fn a_new_file_gets_its_ending_and_one_that_is_there_is_replaced_only_when_asked_twice() {
    let dir = folder();
    let suggested = "old".to_owned();
    let mut harness = asking(Ask::SaveProject { suggested }, dir.path());
    press(&mut harness, &[Key::Enter]);
    harness.get_by_label("\"old.gaitway\" is there already; Enter again replaces it");
    harness.get_by_role_and_label(Role::Button, "Replace");
    type_text(&mut harness, "er walk");
    harness.get_by_role_and_label(Role::Button, "Save");
    press(&mut harness, &[Key::Enter]);
    check(&harness, &[dir.path().join("older walk.gaitway")]);

    let mut harness = asking(Ask::SaveProject { suggested: "old.gaitway".into() }, dir.path());
    press(&mut harness, &[Key::Enter, Key::Enter]);
    check(&harness, &[dir.path().join("old.gaitway")]);
}

#[test]
fn what_is_not_there_is_said_and_a_name_goes_along_into_another_folder() {
    let dir = folder();
    let mut harness = asking(Ask::OpenProject, dir.path());
    type_text(&mut harness, "none.gaitway");
    press(&mut harness, &[Key::Enter]);
    harness.get_by_label("there is no file \"none.gaitway\" here; check the name");
    assert!(harness.state().answer.is_none());

    let mut harness = asking(Ask::ExportMotion { suggested: "A-1".into() }, dir.path());
    press(&mut harness, &[Key::ArrowDown, Key::ArrowDown, Key::Enter, Key::Enter]);
    check(&harness, &[dir.path().join("more").join("A-1.bvh")]);
}

#[test]
fn a_typed_path_opens_its_folder_and_a_folder_can_be_the_answer() {
    let dir = folder();
    let mut harness = asking(Ask::ImportFolder, dir.path());
    type_text(&mut harness, "more/");
    assert_eq!(rows(&harness), ["..", "jump.bvh"]);
    press(&mut harness, &[Key::Enter]);
    check(&harness, &[dir.path().join("more")]);
}

#[test]
fn only_the_first_thousands_of_a_huge_folder_are_listed() {
    let dir = tempfile::tempdir().unwrap();
    for nth in 0..2_010 {
        fs::File::create(dir.path().join(format!("{nth:05}.bvh"))).unwrap();
    }
    let mut harness = asking(Ask::ImportClips, dir.path());
    harness.get_by_label("The first 2000 are listed; 10 more are not. Type the name.");
    type_text(&mut harness, "02009.bvh");
    press(&mut harness, &[Key::Enter]);
    check(&harness, &[dir.path().join("02009.bvh")]);
}

/// Continuous integration has no desktop: the dialog inside the window takes over by itself.
#[test]
fn where_the_system_has_no_dialog_ours_opens() {
    if !cfg!(target_os = "linux") || std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some() {
        return;
    }
    let ctx = egui::Context::default();
    let mut dialogs = FileDialogs::new(Answers::System);
    assert!(dialogs.ask(Ask::OpenProject, Path::new("."), &ctx));
    let start = Instant::now();
    while !dialogs.is_own_open() {
        assert_eq!(dialogs.poll(), None, "nobody answered");
        assert!(
            start.elapsed() < Duration::from_secs(20),
            "it waits for a dialog that never comes"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
}
