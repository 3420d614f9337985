//! Help, completions, manual pages, and what is said about a wrong command line.

use motion_tests::cli::Dir;

use crate::gaitway;

#[test]
fn a_wrong_command_line_is_refused_in_one_line() {
    let dir = Dir::new();
    gaitway(&dir, "dance").refused(
        "gaitway: unrecognized subcommand 'dance'; `gaitway --help` says what can be given",
    );
    gaitway(&dir, "--quiet --verbose").refused(
        "gaitway: the argument '--quiet' cannot be used with '--verbose'; \
         `gaitway --help` says what can be given",
    );
}

#[test]
fn help_and_version_are_no_failure() {
    let dir = Dir::new();
    let help = gaitway(&dir, "--help").ok();
    assert!(help.stdout.starts_with("Say where a person must be"), "{}", help.stdout);
    assert_eq!(help.stderr, "");
    let version = gaitway(&dir, "--version").ok();
    assert_eq!(version.stdout, format!("gaitway {}\n", env!("CARGO_PKG_VERSION")));
}

/// What a person reads first; a change here is a change of what users know.
#[test]
fn the_help_of_every_command() {
    let dir = Dir::new();
    for command in [
        "",
        "library",
        "library build",
        "library info",
        "library coverage",
        "library edges",
        "solve",
        "convert",
        "measure",
        "render",
        "completions",
        "man",
    ] {
        let name =
            if command.is_empty() { "gaitway".to_owned() } else { command.replace(' ', "_") };
        let help = gaitway(&dir, &format!("{command} --help")).ok().stdout;
        insta::assert_snapshot!(format!("help_{name}"), help);
    }
}

#[test]
fn a_command_of_commands_needs_one() {
    let dir = Dir::new();
    let ran = gaitway(&dir, "library");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert_eq!(ran.stderr, "gaitway: a command is missing; `gaitway library --help` lists them\n");
}

/// `gaitway … | head -1` ends without a complaint.
#[test]
fn a_reader_who_has_seen_enough_is_no_error() {
    use std::process::Stdio;
    let dir = crate::dir_with_library();
    let args = ["library", "edges", "small.gwlib", "--from", "walk", "--to", "walk"];
    let mut child = motion_tests::cli::command(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}

#[test]
fn completions_name_every_command() {
    let script = gaitway(&Dir::new(), "completions bash").ok().stdout;
    for word in ["library", "solve", "convert", "measure", "--threads", "--json"] {
        assert!(script.contains(word), "{word} is not completed");
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let dir = Dir::new();
    gaitway(&dir, "man -o pages/man1").ok();
    for page in ["gaitway.1", "gaitway-solve.1", "gaitway-library-build.1"] {
        assert!(dir.join("pages/man1").join(page).is_file(), "{page} is missing");
    }
}
