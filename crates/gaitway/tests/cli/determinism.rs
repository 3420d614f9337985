//! The same input and seed give the same bytes, whatever the number of threads.

use motion_tests::cli::Dir;

use crate::{dir_with_clips, gaitway};

/// Everything a run wrote but for the clocks.
fn files(dir: &Dir, folder: &str) -> Vec<(String, Vec<u8>)> {
    let prefix = format!("{folder}/");
    let files = dir.files().into_iter().filter_map(|(name, bytes)| {
        let name = name.strip_prefix(&prefix)?.to_owned();
        (name != "timing.json").then_some((name, bytes))
    });
    files.collect()
}

#[test]
fn libraries_and_motions_are_the_same_bytes() {
    let dir = dir_with_clips();
    for threads in [1, 2, 8] {
        let build =
            format!("library build clips -o lib{threads}.gwlib --mirror -q --threads {threads}");
        gaitway(&dir, &build).ok();
        let solve = format!(
            "solve corner.gaitway -o out{threads} --library lib1.gwlib --iterations 15 --threads {threads}"
        );
        gaitway(&dir, &solve).ok();
    }
    let read = |name: &str| std::fs::read(dir.join(name)).unwrap();
    let first = files(&dir, "out1");
    assert!(first.len() >= 2, "motions and a report");
    for threads in [2, 8] {
        assert_eq!(read(&format!("lib{threads}.gwlib")), read("lib1.gwlib"), "{threads} threads");
        assert_eq!(files(&dir, &format!("out{threads}")), first, "{threads} threads");
    }
    gaitway(&dir, "solve corner.gaitway -o other --library lib1.gwlib --iterations 15 --seed 4")
        .ok();
    assert_ne!(files(&dir, "other"), first, "another seed is another search");
}

#[test]
fn a_library_from_a_file_gives_what_the_clips_give() {
    let dir = dir_with_clips();
    gaitway(&dir, "library build clips -o small.gwlib -q").ok();
    gaitway(&dir, "solve corner.gaitway -o a --iterations 8 -q").ok();
    gaitway(&dir, "solve corner.gaitway -o b --iterations 8 -q --library clips").ok();
    assert_eq!(files(&dir, "a"), files(&dir, "b"));
}
