//! `library build`, `info`, `coverage` and `edges` on clips that the tests make.

use std::collections::BTreeSet;

use crate::{dir_with_clips, dir_with_library, gaitway, json};

#[test]
fn what_was_done_is_said_and_the_library_described() {
    let dir = dir_with_clips();
    let ran = gaitway(&dir, "library build clips -o small.gwlib").ok();
    for line in ["clips              5, ", "frames             360 at 30 per second", "written to"]
    {
        assert!(ran.stdout.contains(line), "{line:?} is not in {}", ran.stdout);
    }
    let unit = "gaitway: clips/left.bvh and 4 more: lengths are in centimetres, by the body's size";
    assert!(ran.stderr.lines().any(|line| line == unit), "{}", ran.stderr);
}

#[test]
fn info_has_what_the_metric_needs() {
    let dir = dir_with_library();
    let info = json(&gaitway(&dir, "library info small.gwlib --json").ok().stdout);
    assert_eq!((&info["clips"], &info["frames"]), (&5.into(), &360.into()));
    let n_columns = info["metric"]["columns"].as_array().map_or(0, Vec::len);
    assert!(n_columns > 10, "{n_columns} columns");
    for list in ["M", "W", "O", "L"] {
        let numbers = info["metric"][list].as_array().expect("a list");
        assert_eq!(numbers.len(), n_columns, "{list}");
        assert!(numbers.iter().all(|n| n.as_f64().is_some_and(|n| n > 0.0)), "{list}");
    }
    assert!(info["tau"].as_f64().is_some_and(|tau| tau > 0.0), "{}", info["tau"]);
    assert_eq!(info["components"], 1, "bridges join what τ leaves apart");
    assert_eq!(info["build"], serde_json::Value::Null, "times are not in a library");
}

#[test]
fn edges_are_cheaper_than_tau_and_never_within_the_minimum_jump() {
    let dir = dir_with_library();
    let info = json(&gaitway(&dir, "library info small.gwlib --json").ok().stdout);
    let tau = info["tau"].as_f64().expect("a number");
    let min_jump = info["min_jump_frames"].as_i64().expect("a number");
    let text = gaitway(&dir, "library edges small.gwlib --from walk --to walk").ok().stdout;
    let mut seen = BTreeSet::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let [from, to, cost] = words[..] else { panic!("{line:?} has not three words") };
        let (from, to): (i64, i64) = (from.parse().unwrap(), to.parse().unwrap());
        let cost: f64 = cost.parse().unwrap();
        assert!((0.0..tau).contains(&cost), "{line}");
        assert!((from - to).abs() >= min_jump, "{line}");
        assert!(seen.insert((from, to)), "{line} comes twice");
    }
    assert!(!seen.is_empty(), "a walk is like itself a cycle later");
    assert!(seen.iter().all(|&(from, to)| seen.contains(&(to, from))), "the cost is symmetric");
    let document =
        json(&gaitway(&dir, "library edges small.gwlib --from walk --to walk --json").stdout);
    assert_eq!(document.as_array().map(Vec::len), Some(seen.len()), "the same as JSON");
}

#[test]
fn coverage_says_what_is_missing() {
    let dir = dir_with_library();
    let text = gaitway(&dir, "library coverage small.gwlib").ok().stdout;
    for part in ["no run: record 6–8 takes", "sharp left", "hips usually at", "to record"] {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
    assert!(!text.contains("no left turn while walking"), "{text}");
    let report = json(&gaitway(&dir, "library coverage small.gwlib --json").ok().stdout);
    let secs = |tag: &str| {
        let tags = report["tags"].as_array().expect("a list").iter();
        tags.filter(|t| t["tag"] == tag).find_map(|t| t["seconds"].as_f64()).unwrap_or(-1.0)
    };
    assert!(secs("walk") > 11.0 && secs("run") == 0.0, "{}", report["tags"]);
    assert!(secs("turn left") > 1.0 && secs("turn right") > 1.0, "{}", report["tags"]);
    let parts: u64 =
        report["parts"].as_array().expect("a list").iter().filter_map(|n| n.as_u64()).sum();
    assert_eq!(parts, 5, "each clip is in a part");
    gaitway(&dir, "library coverage none.gwlib")
        .refused("gaitway: none.gwlib: there is no such file; check the path");
}

#[test]
fn mirror_images_double_the_clips() {
    let dir = dir_with_clips();
    gaitway(&dir, "library build clips -o both.gwlib --mirror -q").ok();
    let info = json(&gaitway(&dir, "library info both.gwlib --json").ok().stdout);
    let ids: Vec<&str> =
        info["clip_list"].as_array().unwrap().iter().map(|c| c["id"].as_str().unwrap()).collect();
    assert_eq!(
        ids,
        [
            "left",
            "right",
            "slow",
            "walk",
            "walk_late",
            "left@mirror",
            "right@mirror",
            "slow@mirror",
            "walk@mirror",
            "walk_late@mirror",
        ]
    );
}

#[test]
fn a_build_that_would_take_too_much_memory_is_not_begun() {
    let dir = dir_with_clips();
    let ran = gaitway(&dir, "library build clips -o small.gwlib --memory 0.05 -q");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
    let says = |words: &str| ran.stderr.contains(words);
    assert!(says("may take 0.05 GiB") && says("--memory"), "{}", ran.stderr);
    assert!(!dir.join("small.gwlib").exists(), "nothing was begun");
    gaitway(&dir, "library build clips -o small.gwlib --memory 0.5 -q").ok();
}

#[test]
fn tau_and_bridges_can_be_set() {
    let dir = dir_with_clips();
    gaitway(&dir, "library build clips -o strict.gwlib --tau 1e-6 --no-bridges -q").ok();
    let info = json(&gaitway(&dir, "library info strict.gwlib --json").ok().stdout);
    assert_eq!((&info["tau"], &info["bridges"]), (&serde_json::json!(1e-6), &0.into()));
    assert_eq!(info["components"], info["components_by_tau"], "nothing joins the parts");
    gaitway(&dir, "library build clips -o joined.gwlib --tau 1e-6 -q").ok();
    let info = json(&gaitway(&dir, "library info joined.gwlib --json").ok().stdout);
    assert_eq!(info["components"], 1, "bridges join every part");
}

#[test]
fn parts_are_merged_to_the_library_of_one_build() {
    let dir = dir_with_library();
    for k in 1..=3 {
        gaitway(&dir, &format!("library build clips -o {k}.gwpart --shard {k}/3 -q")).ok();
    }
    gaitway(&dir, "library merge 3.gwpart 1.gwpart 2.gwpart -o merged.gwlib -q").ok();
    let bytes = |name: &str| std::fs::read(dir.join(name)).unwrap();
    assert!(bytes("merged.gwlib") == bytes("small.gwlib"), "the same bytes");

    gaitway(&dir, "library merge 1.gwpart 2.gwpart -o x.gwlib")
        .refused("gaitway: 1.gwpart: part 3 of 3 is missing; name every part of the build");
    gaitway(&dir, "library merge 1.gwpart 2.gwpart 1.gwpart -o x.gwlib")
        .refused("gaitway: 1.gwpart: part 1 of 3 is there twice; name every part once");
    gaitway(&dir, "library build clips -o 2.gwpart --shard 2/3 --tau 0.5 -q").ok();
    gaitway(&dir, "library merge 1.gwpart 2.gwpart 3.gwpart -o x.gwlib").refused(
        "gaitway: 2.gwpart: the part is not of the same build as the others; \
         build all parts from the same clips with the same options",
    );
    gaitway(&dir, "library merge small.gwlib -o x.gwlib").refused(
        "gaitway: small.gwlib: it is a library and not a part of one; \
         name what `library build --shard` wrote",
    );
    gaitway(&dir, "library build clips -o 1.gwlib --shard 1/3").refused(
        "gaitway: 1.gwlib: the name of a part of a library ends in .gwpart; \
         choose such a name, so that others know what it is",
    );
    gaitway(&dir, "library build clips -o 4.gwpart --shard 4/3").refused(
        "gaitway: invalid value '4/3' for '--shard <K/N>': use K/N with K from 1 to N, and N at \
         most 1000; `gaitway library build --help` says what can be given",
    );
}

#[test]
fn a_library_is_extended_on_its_own_terms() {
    let dir = dir_with_clips();
    gaitway(&dir, "library build clips/walk.bvh clips/left.bvh -o two.gwlib -q").ok();
    let ran = gaitway(&dir, "library build clips -o five.gwlib --extend two.gwlib").ok();
    for line in
        ["clip walk is in the library already", "3 clips added to 2; the metric and τ stay as they"]
    {
        assert!(ran.stderr.contains(line), "{line:?} is not in {}", ran.stderr);
    }
    let info =
        |name: &str| json(&gaitway(&dir, &format!("library info {name}.gwlib --json")).ok().stdout);
    let (two, five) = (info("two"), info("five"));
    assert_eq!(five["clips"], 5);
    assert_eq!((&two["tau"], &two["metric"]), (&five["tau"], &five["metric"]));
    let edges = |name: &str| {
        gaitway(&dir, &format!("library edges {name}.gwlib --from walk --to walk")).ok().stdout
    };
    assert_eq!(edges("two"), edges("five"), "what was known");
    let new = gaitway(&dir, "library edges five.gwlib --from walk --to walk_late").ok().stdout;
    assert!(new.lines().count() > 10, "{new}");

    gaitway(&dir, "library build clips -o x.gwlib --extend five.gwlib").refused(
        "gaitway: five.gwlib: all the clips are in it already; name clips that it does not have",
    );
    dir.file("other/walk.bvh", std::fs::read(dir.join("clips/slow.bvh")).unwrap());
    gaitway(&dir, "library build other -o x.gwlib --extend two.gwlib").refused(
        "gaitway: two.gwlib: it has another clip \"walk\" already; rename the new clip's file",
    );
}

#[test]
fn libraries_that_cannot_be() {
    let dir = dir_with_library();
    gaitway(&dir, "library info none.gwlib")
        .refused("gaitway: none.gwlib: there is no such file; check the path");
    gaitway(&dir, "library info clips").refused(
        "gaitway: clips: it is a folder and not a library; \
         build a library of it with `gaitway library build`",
    );
    gaitway(&dir, "library info clips/walk.bvh").refused(
        "gaitway: clips/walk.bvh: it is not a Gaitway library; \
         check the path, or build one with gaitway library build",
    );
    gaitway(&dir, "library edges small.gwlib --from wlk --to slow")
        .refused("gaitway: small.gwlib: it has no clip \"wlk\"; did you mean walk, slow, left?");
    gaitway(&dir, "library build clips -o small.lib").refused(
        "gaitway: small.lib: the name of a library ends in .gwlib; \
         choose such a name, so that others know what it is",
    );
    gaitway(&dir, "library build clips -o x.gwlib --tau -1").refused(
        "gaitway: invalid value '-1' for '--tau <COST>': use a number above 0; \
         `gaitway library build --help` says what can be given",
    );
    gaitway(&dir, "library build clips -o x.gwlib --fps 0").refused(
        "gaitway: invalid value '0' for '--fps <RATE>': use a number from 1 to 1000; \
         `gaitway library build --help` says what can be given",
    );
    let bytes = std::fs::read(dir.join("small.gwlib")).unwrap();
    dir.file("cut.gwlib", &bytes[..bytes.len() / 2]);
    gaitway(&dir, "library info cut.gwlib").refused(
        "gaitway: cut.gwlib: the library file is damaged (it ends too early); \
         build the library again",
    );
    let mut flipped = bytes;
    let middle = flipped.len() / 2;
    flipped[middle] ^= 1;
    dir.file("flipped.gwlib", &flipped);
    let ran = gaitway(&dir, "solve corner.gaitway -o out --library flipped.gwlib");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("flipped.gwlib: the library file is damaged"), "{}", ran.stderr);
    assert!(!dir.join("out").exists(), "nothing is written before everything is read");
}

#[test]
fn two_clips_of_one_name_are_refused_with_both_paths() {
    let dir = dir_with_clips();
    dir.file("more/walk.bvh", motion_tests::walker::Walk::default().bvh());
    gaitway(&dir, "library build clips more -o x.gwlib -q").refused(
        "gaitway: more/walk.bvh: its clip is called \"walk\", as that of clips/walk.bvh; \
         rename one of the files",
    );
}

#[test]
fn folders_below_rates_and_copies() {
    let dir = dir_with_clips();
    let walk = motion_tests::walker::Walk::default();
    dir.file("clips/below/jog.bvh", motion_tests::walker::Walk { speed_m_s: 1.9, ..walk }.bvh());
    let copy = std::fs::read(dir.join("clips/walk.bvh")).unwrap();
    dir.file("clips/copy.bvh", copy);
    let ids = |args: &str| {
        let ran = gaitway(&dir, &format!("library build clips -o x.gwlib {args}")).ok();
        let info = json(&gaitway(&dir, "library info x.gwlib --json").ok().stdout);
        let list = info["clip_list"].as_array().unwrap().clone();
        let ids: Vec<String> =
            list.iter().map(|clip| clip["id"].as_str().unwrap().to_owned()).collect();
        (ids.join(" "), info["frames"].as_u64().unwrap(), ran.stderr)
    };
    let (plain, frames, said) = ids("");
    assert_eq!(plain, "copy left right slow walk_late", "the files in the folder, not below");
    assert!(said.contains("walk.bvh: the same as clips/copy.bvh, imported once"), "{said}");
    assert!(ids("--recursive").0.contains("jog"), "and below where that is asked for");
    let half = ids("--fps 15").1;
    assert!((2 * half).abs_diff(frames) <= 10, "{half} frames at half the rate of {frames}");
}
