//! The whole way on real motion capture, where there is some.

use std::collections::BTreeMap;

use motion_tests::cli::Dir;
use motion_tests::shared_dir;

use crate::{gaitway, json};

#[test]
fn a_corner_on_clips_of_one_subject() {
    let Some(shared) = shared_dir() else { return };
    let dir = Dir::new();
    for clip in ["16_11", "16_12", "16_15", "16_16", "16_17", "16_18"] {
        let name = format!("{clip}.bvh");
        let Ok(text) = std::fs::read(shared.join("mocap/cmu").join(&name)) else { continue };
        dir.file(&format!("clips/{name}"), text);
    }
    let ran = gaitway(&dir, "library build clips -o walks.gwlib").ok();
    assert!(ran.stderr.contains("lengths are in the CMU unit"), "{}", ran.stderr);
    let project = shared.join("problems/02-left-corner.gaitway");
    std::fs::copy(project, dir.join("corner.gaitway")).expect("the problems are there too");
    let args = "solve corner.gaitway --library walks.gwlib -o out --iterations 10 --json -q";
    let report = json(&gaitway(&dir, args).ok().stdout);
    let best = &report["characters"][0]["alternatives"][0];
    let hips_height = json(&gaitway(&dir, "measure out/A-1.bvh --json -q").ok().stdout);
    assert!(hips_height["travel_m"].as_f64().is_some_and(|m| m > 5.0), "{hips_height}");
    assert!(best["final"][1]["position_error_m"].as_f64().is_some_and(|m| m < 1e-3), "{best}");
    let slide = best["quality"]["foot_slide_cm_per_s"].as_f64();
    assert!(slide.is_some_and(|cm| cm < 8.0), "feet stay where they are: {slide:?}");
}

/// A folder with these clips built into `clips.gwlib`, and these problems; `None` where there are none.
fn dir_with(clips: &[&str], problems: &[&str]) -> Option<Dir> {
    let shared = shared_dir()?;
    let dir = Dir::new();
    for clip in clips {
        let name = format!("{clip}.bvh");
        let text = std::fs::read(shared.join("mocap/cmu").join(&name)).expect("the clip is there");
        dir.file(&format!("clips/{name}"), text);
    }
    for problem in problems {
        let name = format!("{problem}.gaitway");
        let text =
            std::fs::read(shared.join("problems").join(&name)).expect("the problem is there");
        dir.file(&name, text);
    }
    gaitway(&dir, "library build clips -o clips.gwlib -q").ok();
    Some(dir)
}

/// What is reported of the best motion of a problem: its constraints in the finished motion by id.
fn final_of(dir: &Dir, problem: &str, n: u32) -> BTreeMap<String, serde_json::Value> {
    let args = format!(
        "solve {problem}.gaitway --library clips.gwlib -o {problem} --iterations {n} --json -q"
    );
    let report = json(&gaitway(dir, &args).ok().stdout);
    let best = report["characters"][0]["alternatives"][0].clone();
    let all = best["final"].as_array().expect("a list").iter();
    all.map(|one| (one["constraint"].as_str().unwrap_or_default().to_owned(), one.clone()))
        .collect()
}

#[test]
fn poses_of_real_clips_are_shown_and_the_impossible_is_refused() {
    let clips = ["16_11", "16_15", "16_31", "16_45", "127_04", "127_06", "127_17", "127_24"];
    let Some(dir) = dir_with(&clips, &["07-roll-in-the-middle"]) else { return };
    let roll = final_of(&dir, "07-roll-in-the-middle", 6);
    let pose = &roll["pose-1"];
    assert_eq!(pose["met"], true, "{pose}");
    assert!(pose["pose_error_m"].as_f64().is_some_and(|m| m < 0.01), "{pose}");
    let end = &roll["body-2"];
    assert!(end["position_error_m"].as_f64().is_some_and(|m| m < 1e-3), "{end}");
    let two = r#"{"gaitway": 1, "name": "two", "fps": 30, "library": "clips.gwlib", "characters": [{
        "name": "A", "length": {"frames": 120}, "constraints": [
        {"id": "start", "kind": "body", "frame": 0, "position": [0, 0], "heading": 0},
        {"id": "walk", "kind": "pose", "frame": 30, "clip": "16_15", "clip_frame": 20},
        {"id": "roll", "kind": "pose", "frame": 31, "clip": "127_24", "clip_frame": 33}]}]}"#;
    dir.file("two.gaitway", two);
    let ran = gaitway(&dir, "solve two.gaitway -o two --iterations 1");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    let expected = "gaitway: two.gaitway: character \"A\": from pose \"walk\" to pose \"roll\" it takes at least ";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
}

#[test]
fn obstacles_are_walked_around() {
    let clips = [
        "16_11", "16_12", "16_13", "16_14", "16_15", "16_16", "16_17", "16_18", "16_19", "16_20",
        "16_21", "16_22", "16_25", "16_26", "16_31", "16_32",
    ];
    let Some(dir) = dir_with(&clips, &["11-around-the-box"]) else { return };
    let around = final_of(&dir, "11-around-the-box", 20);
    let deepest = &around["obstacles"]["deepest_m"];
    assert!(deepest.as_f64().is_some_and(|m| m < 0.1), "it stays out of the box: {deepest}");
}
