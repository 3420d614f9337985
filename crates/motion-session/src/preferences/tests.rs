//! What is remembered comes back, whatever happened to the file.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use motion_io::atomic_write::atomic_write;
use serde_json::{Value, json};

use super::*;

fn put(folder: &Path, text: &str) {
    atomic_write(&folder.join("settings.json"), text.as_bytes()).unwrap();
}

fn members(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("settings.json")).unwrap()).unwrap()
}

fn everything(folder: &Path) -> Preferences {
    let mut all = Preferences {
        theme: Theme::Light,
        navigation: NavigationScheme::Industry,
        ui_scale: 1.25,
        follow_best: true,
        follow_character: true,
        window_size_pt: Some([1234.5, 800.0]),
        last_folder: Some("walks".to_owned()),
        welcome_seen: true,
        reduced_motion: true,
        autosave_secs: 3.0,
        own_file_dialog: true,
        ..Preferences::default()
    };
    all.set_panel("timeline", PanelLayout { open: false, size_pt: Some(216.0) });
    all.show.insert("ghosts".to_owned(), true);
    all.recent.note(&folder.join("a.gaitway"));
    all
}

#[test]
fn everything_comes_back() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("not/there/yet");
    let all = everything(dir.path());
    let mut file = PreferencesFile::open(&folder);
    file.change(|preferences| *preferences = all.clone());
    file.save().unwrap();
    let mut again = PreferencesFile::open(&folder);
    assert_eq!(*again.get(), all);
    assert_eq!(again.take_remarks(), [""; 0]);
    assert!(!again.get().panel("timeline").open && again.get().panel("library").open);
    assert!(again.get().shows("ghosts", false) && again.get().shows("trail", true));
    assert_eq!(members(&folder)["theme"], "light");
    assert_eq!(members(&folder)["navigation"], "industry");
}

#[test]
fn a_broken_file_is_set_aside_with_a_word() {
    let dir = tempfile::tempdir().unwrap();
    for (broken, aside) in [("{\"theme\": ", "settings.broken"), ("[]", "settings.broken-2")] {
        put(dir.path(), broken);
        let mut file = PreferencesFile::open(dir.path());
        assert_eq!(*file.get(), Preferences::default());
        let remark = format!(
            "the settings could not be read and are the usual ones now; the file is kept as {aside}"
        );
        assert_eq!(file.take_remarks(), [remark]);
        assert_eq!(fs::read_to_string(dir.path().join(aside)).unwrap(), broken);
        file.change(|preferences| preferences.welcome_seen = true);
        file.save().unwrap();
        assert!(PreferencesFile::open(dir.path()).get().welcome_seen);
    }
}

#[test]
fn a_file_that_cannot_be_read_is_not_replaced() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("settings.json")).unwrap();
    let mut file = PreferencesFile::open(dir.path());
    assert_eq!(file.take_remarks().len(), 1);
    assert!(file.save().is_ok(), "nothing changed");
    file.change(|preferences| preferences.welcome_seen = true);
    file.poll(5.0);
    assert!(file.save().unwrap_err().to_string().contains("it is a folder"));
}

#[test]
fn one_wrong_word_costs_one_preference() {
    let dir = tempfile::tempdir().unwrap();
    put(
        dir.path(),
        r#"{"theme": "solarized", "ui_scale": 90, "autosave_secs": 0, "follow_best": true,
            "recent": ["relative.gaitway"], "window_size_pt": [1e30, 5]}"#,
    );
    let mut file = PreferencesFile::open(dir.path());
    let expected = Preferences {
        ui_scale: 2.0,
        autosave_secs: 1.0,
        follow_best: true,
        window_size_pt: Some([20_000.0, 200.0]),
        ..Preferences::default()
    };
    assert_eq!(*file.get(), expected);
    let remarks = file.take_remarks();
    assert_eq!(remarks.len(), 1);
    assert!(remarks[0].contains("\"theme\" says nothing that is known here"), "{remarks:?}");
    file.change(|preferences| preferences.ui_scale = f32::NAN);
    assert_eq!(file.get().ui_scale, Preferences::default().ui_scale);
}

#[test]
fn what_a_newer_version_wrote_stays() {
    let dir = tempfile::tempdir().unwrap();
    put(dir.path(), r#"{"theme": "solarized", "grid": {"step": 3}, "show": {"new": true}}"#);
    let mut file = PreferencesFile::open(dir.path());
    file.change(|preferences| preferences.follow_best = true);
    file.save().unwrap();
    let members = members(dir.path());
    assert_eq!(members["grid"], json!({"step": 3}));
    assert_eq!(members["theme"], "solarized", "it was not changed here");
    assert_eq!(members["show"], json!({"new": true}));
    assert_eq!(members["follow_best"], true);
}

#[test]
fn two_windows_do_not_undo_each_others_changes() {
    let dir = tempfile::tempdir().unwrap();
    let open = || PreferencesFile::open(dir.path());
    let (mut one, mut two) = (open(), open());
    one.change(|p| {
        p.theme = Theme::Light;
        p.recent.note(&dir.path().join("one.gaitway"));
    });
    two.change(|p| {
        p.follow_best = true;
        p.recent.note(&dir.path().join("two.gaitway"));
    });
    one.save().unwrap();
    two.save().unwrap();
    let both = open();
    assert_eq!((both.get().theme, both.get().follow_best), (Theme::Light, true));
    let recent = ["two.gaitway", "one.gaitway"].map(|name| dir.path().join(name));
    assert_eq!(both.get().recent.all(), recent);
}

#[test]
fn changes_are_written_once_it_is_quiet() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("settings.json");
    let mut file = PreferencesFile::open(dir.path());
    for nth in 0..100u8 {
        file.change(|preferences| preferences.ui_scale = 1.0 + 0.005 * f32::from(nth));
        file.poll(0.5);
        assert!(!path.exists());
    }
    for _ in 0..1000 {
        file.poll(0.5);
        if path.exists() {
            break;
        }
        thread::sleep(Duration::from_millis(5));
    }
    file.save().unwrap();
    assert_eq!(PreferencesFile::open(dir.path()).get(), file.get());
    assert_eq!(file.take_remarks(), [""; 0]);
}

const WRITER: &str = "GAITWAY_TEST_PREFERENCES_WRITER";

/// Not a test by itself: the other process of the next.
#[test]
fn writes_over_and_over() {
    let Some(folder) = std::env::var_os(WRITER) else { return };
    let mut file = PreferencesFile::open(Path::new(&folder));
    for nth in 0..40 {
        file.change(|p| {
            p.follow_best = !p.follow_best;
            p.recent.note(Path::new(&format!("{}-{nth}.gaitway", std::process::id())));
        });
        file.save().unwrap();
        assert_eq!(file.take_remarks(), [""; 0]);
    }
}

#[test]
fn processes_that_write_at_once_never_break_the_file() {
    let dir = tempfile::tempdir().unwrap();
    let start = || {
        let program = std::env::current_exe().unwrap();
        Command::new(program)
            .args(["--exact", "preferences::tests::writes_over_and_over"])
            .env(WRITER, dir.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap()
    };
    let mut writers = [start(), start(), start()];
    let mut n_read = 0;
    while writers.iter_mut().any(|writer| writer.try_wait().unwrap().is_none()) {
        let mut file = PreferencesFile::open(dir.path());
        assert_eq!(file.take_remarks(), [""; 0]);
        n_read += usize::from(!file.get().recent.all().is_empty());
    }
    for writer in &mut writers {
        assert!(writer.wait().unwrap().success());
    }
    assert!(n_read > 0);
    let names: Vec<_> =
        fs::read_dir(dir.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["settings.json"], "nothing was set aside, nothing is left over");
}
