//! `solve` and what it writes.

use std::fs;

use motion_tests::cli::Dir;

use crate::{CORNER, dir_with_library, gaitway, json};

fn report(dir: &Dir, folder: &str) -> serde_json::Value {
    json(&fs::read_to_string(dir.join(folder).join("report.json")).expect("a report"))
}

#[test]
fn motions_and_a_report_that_agree() {
    let dir = dir_with_library();
    let ran = gaitway(&dir, "solve corner.gaitway -o out --iterations 20").ok();
    assert!(ran.stdout.contains("motions and report.json are in out"), "{}", ran.stdout);
    let report = report(&dir, "out");
    assert_eq!((&report["gaitway"], &report["project"]), (&1.into(), &"corner".into()));
    assert_eq!((&report["seed"], &report["iterations"]), (&3.into(), &20.into()));
    let character = &report["characters"][0];
    let alternatives = character["alternatives"].as_array().expect("a list");
    assert!(!alternatives.is_empty() && alternatives.len() <= 3, "{}", alternatives.len());
    let mut last_score = 0.0;
    for (nth, alternative) in alternatives.iter().enumerate() {
        let number = |value: &serde_json::Value| value.as_f64().expect("a number");
        let score = number(&alternative["score"]);
        assert!(score >= last_score, "best first");
        last_score = score;
        let terms = alternative["terms"].as_object().expect("terms");
        let sum: f64 = terms.values().map(number).sum();
        assert!((sum - score).abs() < 1e-4 * (1.0 + score), "{sum} is not {score}");

        let frames = alternative["frames"].as_u64().expect("a number");
        let shown =
            |p: &serde_json::Value| p["to"].as_u64().unwrap() + 1 - p["from"].as_u64().unwrap();
        let pieces = alternative["pieces"].as_array().expect("pieces");
        assert_eq!(pieces.iter().map(shown).sum::<u64>(), frames, "pieces show every frame");
        let seams = alternative["seams"].as_array().expect("seams");
        let mut at = 0;
        for (piece, seam) in pieces.iter().zip(seams) {
            at += shown(piece);
            assert_eq!(seam["frame"], at, "a seam is the first frame of its piece");
        }
        assert_eq!(seams.len() + 1, pieces.len(), "a seam between pieces");

        for (which, constraint) in ["start", "end"].iter().enumerate() {
            let last = &alternative["final"][which];
            assert_eq!(last["constraint"], *constraint, "in the project's words");
            assert!(number(&last["position_error_m"]) < 1e-3, "{last}");
            assert!(number(&last["heading_error_deg"]) < 0.1, "{last}");
        }
        let file = format!("A-{}.bvh", nth + 1);
        assert_eq!(alternative["files"], serde_json::json!([file]), "named by rank");
        let measured = gaitway(&dir, &format!("measure out/{file} --json -q")).ok().stdout;
        assert_eq!(json(&measured)["frames"], frames, "the file has the frames");
    }
}

#[test]
fn clocks_are_apart_from_what_can_be_had_again() {
    let dir = dir_with_library();
    gaitway(&dir, "solve corner.gaitway -o out --iterations 5").ok();
    let text = fs::read_to_string(dir.join("out/report.json")).unwrap();
    for key in ["\"seconds\"", "\"s\"", "\"found_at_s\""] {
        assert!(!text.contains(key), "{key} depends on the machine");
    }
    let timing = json(&fs::read_to_string(dir.join("out/timing.json")).unwrap());
    assert!(timing["seconds"].as_f64().is_some_and(|s| s > 0.0), "{timing}");

    gaitway(&dir, "solve corner.gaitway -o out --time 0.05").ok();
    assert!(report(&dir, "out")["seconds"].as_f64().is_some_and(|s| s > 0.0), "in the report");
    assert!(!dir.join("out/timing.json").exists(), "the earlier run's clock is gone");
}

#[test]
fn the_command_line_overrides_the_project() {
    let dir = dir_with_library();
    gaitway(&dir, "library build clips -o both.gwlib --mirror -q").ok();
    let args = "solve corner.gaitway -o out --iterations 2 --seed 9 --library both.gwlib \
                --alternatives 1 --json";
    let document = json(&gaitway(&dir, args).ok().stdout);
    assert_eq!(document["seed"], 9);
    assert_eq!(document["library"]["clips"], 10);
    assert_eq!(document["characters"][0]["alternatives"].as_array().map(Vec::len), Some(1));
    assert_eq!(document, report(&dir, "out"), "stdout has the report");
    let args = "solve corner.gaitway -o mirrored --iterations 2 --mirror --json";
    let document = json(&gaitway(&dir, args).ok().stdout);
    assert_eq!(document["library"]["clips"], 10, "images are made where the library has none");
}

#[test]
fn what_has_changed_since_the_project_was_saved_is_said() {
    let dir = dir_with_library();
    let hashes = r#""hashes": {"library": "00", "clips": {"walk": "00", "gone": "00"}},"#;
    dir.file("old.gaitway", CORNER.replace("\"characters\"", &format!("{hashes} \"characters\"")));
    let said = gaitway(&dir, "solve old.gaitway -o out --iterations 1").ok().stderr;
    let expected = [
        "gaitway: warning: old.gaitway: the library has changed since the project was saved",
        "gaitway: warning: old.gaitway: clip \"walk\" has changed since the project was saved",
        "gaitway: warning: old.gaitway: clip \"gone\" is not in the library any more",
    ];
    assert_eq!(said.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn the_shortest_search_finds_something() {
    let dir = dir_with_library();
    gaitway(&dir, "solve corner.gaitway -o out --time 1e-9").ok();
    assert!(dir.join("out/A-1.bvh").is_file(), "one round is always done");
}

#[test]
fn results_need_a_folder() {
    let dir = dir_with_library();
    gaitway(&dir, "solve corner.gaitway -o corner.gaitway")
        .refused("gaitway: corner.gaitway: it is a file; name a folder for the results");
}

#[test]
fn a_folder_of_clips_is_a_library_too() {
    let dir = dir_with_library();
    let args = "solve corner.gaitway -o out --iterations 2 --library clips --json -q";
    let ran = gaitway(&dir, args).ok();
    assert_eq!(json(&ran.stdout)["library"]["clips"], 5);
}

#[test]
fn motions_of_an_earlier_run_do_not_stay() {
    let dir = dir_with_library();
    gaitway(&dir, "solve corner.gaitway -o out --iterations 20").ok();
    dir.file("out/notes.txt", "mine");
    dir.file("out/A-9.bvh", "not named by the report");
    gaitway(&dir, "solve corner.gaitway -o out --iterations 20 --alternatives 1").ok();
    let files: Vec<String> = fs::read_dir(dir.join("out"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    assert!(files.contains(&"A-1.bvh".to_owned()), "{files:?}");
    assert!(!files.contains(&"A-2.bvh".to_owned()), "{files:?}");
    assert!(files.contains(&"notes.txt".to_owned()), "others' files are left alone: {files:?}");
    assert!(files.contains(&"A-9.bvh".to_owned()), "{files:?}");
}

/// The corner with more constraints.
fn corner_with(constraints: &str) -> String {
    CORNER.replace("\"constraints\": [", &format!("\"constraints\": [{constraints},"))
}

#[test]
fn every_kind_of_constraint_is_asked_and_reported() {
    let dir = dir_with_library();
    let project = corner_with(
        r#"{"id": "look", "kind": "joint", "frame": 40, "joint": "Head", "position": [0, 2, 0]},
           {"id": "manner", "kind": "style", "from": 0, "to": 60, "tag": "walk"},
           {"id": "way", "kind": "path", "from": 0, "to": 60, "points": [[0, 0], [0.5, 1.5]]}"#,
    );
    let box_ =
        r#""obstacles": [{"shape": "cylinder", "center": [3, 1, 0], "radius": 0.3, "height": 2}],"#;
    dir.file("all.gaitway", project.replace("\"characters\"", &format!("{box_} \"characters\"")));
    gaitway(&dir, "solve all.gaitway -o out --iterations 5").ok();
    let report = report(&dir, "out");
    let character = &report["characters"][0];
    for alternative in character["alternatives"].as_array().expect("a list") {
        for which in ["raw", "final"] {
            let all = alternative[which].as_array().expect("a list").iter();
            let ids: Vec<&str> = all.filter_map(|one| one["constraint"].as_str()).collect();
            assert_eq!(ids, ["start", "end", "look", "manner", "way", "obstacles"], "{which}");
        }
        let last = &alternative["final"];
        assert!(
            last[2]["position_error_m"].is_f64() && last[3]["share_without"].is_number(),
            "{last}"
        );
        assert!(last[4]["position_error_m"].is_f64() && last[5]["deepest_m"].is_number(), "{last}");
        assert!(
            alternative["terms"]["joint"].as_f64().is_some_and(|cost| cost > 0.0),
            "{alternative}"
        );
    }
    let unmet = character["unmet"].to_string();
    assert!(!unmet.contains("not considered"), "{unmet}");
}

#[test]
fn what_cannot_be_shown_is_refused_by_its_id() {
    let dir = dir_with_library();
    dir.file(
        "kick.gaitway",
        corner_with(
            r#"{"id": "kick", "kind": "pose", "frame": 40, "clip": "135_04", "clip_frame": 150}"#,
        ),
    );
    gaitway(&dir, "solve kick.gaitway -o out --iterations 1").refused(
        "gaitway: kick.gaitway: character \"A\": pose constraint \"kick\" shows clip \"135_04\", \
         which is not in the library; import the clip, or choose one of the library's",
    );
    assert!(!dir.join("out").exists(), "nothing is written for what is refused");
}

#[test]
fn the_impossible_comes_with_its_reason() {
    let dir = dir_with_library();
    dir.file("far.gaitway", CORNER.replace("[1.5, 2.5]", "[0, 100]"));
    gaitway(&dir, "solve far.gaitway -o out --iterations 5").ok();
    let unmet = report(&dir, "out")["characters"][0]["unmet"].to_string();
    assert!(unmet.contains("the fastest clip in use goes 1.2 m/s"), "{unmet}");
}

#[test]
fn what_would_help_is_tried_and_said() {
    let dir = dir_with_library();
    dir.file("far.gaitway", CORNER.replace("[1.5, 2.5]", "[2.4, 3.6]"));
    let args = "solve far.gaitway -o out --iterations 30";
    let said = gaitway(&dir, args).ok().stdout;
    let report = report(&dir, "out");
    let character = &report["characters"][0];
    let suggestions = character["suggestions"].as_array().expect("a list");
    assert!((1..=3).contains(&suggestions.len()), "{character}");
    for one in suggestions {
        let sentence = one["sentence"].as_str().expect("a sentence");
        assert!(sentence.contains(": score −"), "{sentence}");
        assert!(said.contains(&format!("would help: {sentence}")), "{said}");
        assert!(character["unmet"].to_string().contains("what would help"), "{character}");
        let number = |key: &str| one[key].as_f64().expect("a number");
        assert!(number("score_after") < number("score_before"), "{one}");
    }
    gaitway(&dir, &args.replace("-o out", "-o again --threads 1")).ok();
    let again = fs::read(dir.join("again/report.json")).expect("a report");
    assert_eq!(
        again,
        fs::read(dir.join("out/report.json")).expect("a report"),
        "whatever the threads"
    );
}

/// Ctrl-C ends the search, not the work: what was found is written.
#[cfg(unix)]
#[test]
fn an_interrupted_search_writes_what_it_has() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let dir = dir_with_library();
    let args = ["solve", "corner.gaitway", "-o", "out", "--time", "600"];
    let program = env!("CARGO_BIN_EXE_gaitway");
    let mut child = motion_tests::cli::command(program, dir.path(), &args)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // Late enough for the handler to stand and the first round to be over, even on a busy machine.
    std::thread::sleep(Duration::from_secs(2));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let patience = Instant::now() + Duration::from_secs(60);
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if Instant::now() > patience {
            child.kill().unwrap();
            panic!("it does not stop");
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    assert!(status.success(), "{status}");
    assert!(dir.join("out/A-1.bvh").is_file(), "what was found is written");
}

#[test]
fn another_search_writes_the_same_kind_of_report() {
    let dir = dir_with_library();
    for (search, rounds) in [("af02", 3), ("astar", 40)] {
        let typed =
            format!("solve corner.gaitway -o {search} --iterations {rounds} --search {search}");
        gaitway(&dir, &typed).ok();
        let report = report(&dir, search);
        assert_eq!(report["iterations"], rounds, "{search}");
        let alternatives = report["characters"][0]["alternatives"].as_array().expect("a list");
        assert!(!alternatives.is_empty(), "{search} finds something");
    }
    let ran = gaitway(&dir, "solve corner.gaitway -o out --search best");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("af02"), "it says which there are: {}", ran.stderr);
}
