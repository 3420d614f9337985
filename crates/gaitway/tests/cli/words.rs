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
        "gaitway: the argument '--quiet' cannot be used with '--verbose...'; \
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

#[test]
fn completions_name_every_command() {
    let script = gaitway(&Dir::new(), "completions bash").ok().stdout;
    for word in ["completions", "man", "--threads", "--json"] {
        assert!(script.contains(word), "{word} is not completed");
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let dir = Dir::new();
    gaitway(&dir, "man -o pages/man1").ok();
    for page in ["gaitway.1", "gaitway-completions.1"] {
        assert!(dir.join("pages/man1").join(page).is_file(), "{page} is missing");
    }
}
