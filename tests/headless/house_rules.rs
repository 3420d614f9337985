//! What a source file looks like here, where clippy has no word for it.

use motion_tests::sources::{SourceFile, crate_dirs, source_files};
use motion_tests::workspace_root;

/// A file is one nameable thing: 100–300 lines as a rule, and never more than this.
const MAX_LINES: usize = 800;

/// Every line of the files, with its place.
fn lines(files: &[SourceFile]) -> impl Iterator<Item = (String, &str)> {
    files.iter().flat_map(|file| {
        let at = move |i: usize| format!("{}:{}", file.path, i + 1);
        file.text.lines().enumerate().map(move |(i, line)| (at(i), line))
    })
}

#[test]
fn a_file_is_one_nameable_thing() {
    for file in source_files(&["rs", "wgsl"]) {
        let n = file.text.lines().count();
        assert!(n <= MAX_LINES, "{} has {n} lines; split it at its second idea", file.path);
    }
}

#[test]
fn open_work_has_a_name() {
    let words = [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("XX", "X")];
    for (at, line) in lines(&source_files(&["rs", "wgsl", "toml"])) {
        for word in words {
            let named = line.contains(&format!("{word}(")) && word == words[0];
            assert!(named || !line.contains(word), "{at}: say whose it is, {}(name)", words[0]);
        }
    }
}

#[test]
fn no_path_of_one_machine() {
    let roots = [concat!("/ro", "ot/"), concat!("/ho", "me/"), concat!("/Us", "ers/")];
    let folders = [concat!("/wo", "rk/"), concat!("/fa", "rm/"), concat!("/tm", "p/")];
    for (at, line) in lines(&source_files(&["rs", "wgsl", "toml", "md", "gaitway", "json"])) {
        for path in roots.into_iter().chain(folders) {
            assert!(!line.contains(path), "{at}: {path} exists on one machine only");
        }
    }
}

#[test]
fn an_exception_says_why() {
    let files = source_files(&["rs"]);
    for file in &files {
        for (start, _) in file
            .text
            .match_indices(concat!("allow", "("))
            .chain(file.text.match_indices(concat!("expect", "(clippy")))
        {
            let before = &file.text[..start];
            if !before.ends_with("#[") && !before.ends_with("#![") {
                continue;
            }
            let end = file.text[start..].find(")]").map_or(file.text.len(), |end| start + end);
            let line = before.lines().count() + 1;
            let says_why = file.text[start..end].contains("reason");
            assert!(says_why, "{}:{line}: an exception needs a reason", file.path);
        }
    }
}

/// Only the program and developers' tools speak to a terminal; libraries return what they have to
/// say. (Tests may print why they skip.)
#[test]
fn libraries_do_not_print() {
    let speakers = ["crates/gaitway/", "crates/motion-bench/", "crates/xtask/", "tests/"];
    for file in source_files(&["rs"]) {
        let library =
            file.path.contains("/src/") && !speakers.iter().any(|s| file.path.starts_with(s));
        if !library {
            continue;
        }
        if file.path.ends_with("/tests.rs") {
            continue;
        }
        // Unit tests close a file.
        let code = file.text.split("#[cfg(test)]").next().unwrap_or_default();
        for word in ["println!(", "print!("] {
            let hit = code.lines().find(|l| l.contains(word) && !l.trim_start().starts_with("//"));
            assert!(hit.is_none(), "{}: {:?} prints", file.path, hit.unwrap_or_default());
        }
    }
}

#[test]
fn every_crate_introduces_itself() {
    for dir in crate_dirs() {
        let readme = workspace_root().join(&dir).join("README.md");
        let text = std::fs::read_to_string(&readme).unwrap_or_default();
        assert!(text.trim().lines().count() >= 3, "{dir}/README.md says what the crate is for");
    }
}

/// Comments send readers to `docs/…`; the page must be there.
#[test]
fn pages_that_are_named_exist() {
    for (at, line) in lines(&source_files(&["rs", "md", "toml"])) {
        for (start, _) in line.match_indices("docs/") {
            let name: String = line[start..]
                .chars()
                .take_while(|c| c.is_ascii_alphanumeric() || "/_-.".contains(*c))
                .collect();
            let is_page = name.ends_with(".md");
            assert!(!is_page || workspace_root().join(&name).is_file(), "{at}: there is no {name}");
        }
    }
}
