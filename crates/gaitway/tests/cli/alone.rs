//! The program without a command, where there is no display.

use motion_tests::cli::{Dir, command};

use crate::json;

/// Runs the program as on a machine without a screen. Only on Linux is that said by the environment.
fn without_display(dir: &Dir, args: &[&str]) -> (String, String) {
    let mut alone = command(env!("CARGO_BIN_EXE_gaitway"), dir.path(), args);
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        alone.env_remove(name);
    }
    let output = alone.output().expect("the program was built before its tests");
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("what is printed is text");
    assert!(output.status.success(), "{}", text(&output.stderr));
    (text(&output.stdout), text(&output.stderr))
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_display_the_sample_is_authored() {
    let dir = Dir::new();
    let (stdout, stderr) = without_display(&dir, &[]);
    let first = stderr.lines().next().unwrap_or_default();
    let why = if cfg!(feature = "editor") {
        "gaitway: there is no display to open a window on ("
    } else {
        "gaitway: this program was built without a window"
    };
    assert!(first.starts_with(why), "{stderr}");
    let then = "; authoring the built-in sample without one (`gaitway --help` lists the commands)";
    assert!(first.ends_with(then), "{stderr}");
    assert!(stdout.contains("gaitway-out"), "{stdout}");
    let names: Vec<String> = dir.files().into_iter().map(|(name, _)| name).collect();
    for wanted in ["gaitway-out/A-1.bvh", "gaitway-out/report.json"] {
        assert!(names.iter().any(|name| name == wanted), "{names:?}");
    }
}

/// Whoever asks for a document is not answered by a window, on any system.
#[test]
fn a_document_is_answered_without_a_window() {
    let dir = Dir::new();
    let (stdout, _) = without_display(&dir, &["--json", "-q"]);
    assert!(json(&stdout).is_object(), "{stdout}");
    assert!(dir.join("gaitway-out/A-1.bvh").is_file());
}
