//! Bodies that are no people: what is made for a person must do for a dog and a robot arm, too.

use motion_tests::cli::Dir;
use motion_tests::creature::{dog, robot_arm};

use crate::{gaitway, json};

/// A folder with clips of a dog, or of a robot arm, and a project for them.
fn dir_of(clips: &[(&str, String)], end: [f64; 2], heading: f64) -> Dir {
    let dir = Dir::new();
    for (name, text) in clips {
        dir.file(&format!("clips/{name}.bvh"), text);
    }
    let [x, z] = end;
    dir.file(
        "go.gaitway",
        format!(
            r#"{{"gaitway": 1, "name": "go", "library": "lib.gwlib", "characters": [{{
              "name": "A", "length": {{"frames": 60}}, "constraints": [
              {{"kind": "body", "frame": 0, "position": [0, 0], "heading": 0}},
              {{"kind": "body", "frame": 59, "position": [{x}, {z}], "heading": {heading}}}]}}]}}"#
        ),
    );
    dir
}

fn dogs() -> Dir {
    let clips = [
        ("trot", dog(120, 1.4, 0.0, 0.0)),
        ("left", dog(90, 1.3, 50.0, 0.3)),
        ("right", dog(90, 1.3, -50.0, 0.6)),
        ("amble", dog(90, 0.6, 0.0, 0.1)),
    ];
    dir_of(&clips, [0.6, 2.4], 40.0)
}

fn arms() -> Dir {
    let clips = [
        ("swing", robot_arm(120, 60.0, 10.0, 0.5)),
        ("reach", robot_arm(120, 10.0, 50.0, 0.5)),
        ("fast", robot_arm(90, 60.0, 20.0, 1.0)),
    ];
    dir_of(&clips, [0.0, 0.0], 0.0)
}

/// Builds, looks into, solves; gives the report.
#[track_caller]
fn build_and_solve(dir: &Dir) -> serde_json::Value {
    gaitway(dir, "library build clips -o lib.gwlib --scale 0.01 --mirror -q").ok();
    let coverage = json(&gaitway(dir, "library coverage lib.gwlib --json").ok().stdout);
    assert_eq!(coverage["tags"], serde_json::json!([]), "no rule is about such a body");
    assert_eq!(coverage["heights"], serde_json::Value::Null, "nor are heights");
    let for_people = ["walk", "run", "jump", "crouch", "stand"];
    for wish in coverage["capture_list"].as_array().expect("a list") {
        let wish = wish.as_str().expect("a sentence");
        assert!(!for_people.iter().any(|word| wish.starts_with(&format!("no {word}"))), "{wish}");
    }
    gaitway(dir, "solve go.gaitway -o out --iterations 60 -q").ok();
    let report = json(&std::fs::read_to_string(dir.join("out/report.json")).expect("a report"));
    let best = report["characters"][0]["alternatives"][0].clone();
    assert!(best["frames"].as_u64().is_some_and(|n| n >= 40), "{best}");
    assert_eq!(best["quality"]["foot_slide_cm_per_s"], serde_json::Value::Null, "no feet");
    gaitway(dir, "measure out/A-1.bvh").ok();
    best
}

#[test]
fn a_dog_finds_its_way() {
    let dir = dogs();
    let best = build_and_solve(&dir);
    for miss in best["final"].as_array().expect("a list") {
        assert!(miss["position_error_m"].as_f64().is_some_and(|m| m < 0.05), "{miss}");
    }
    let coverage = gaitway(&dir, "library coverage lib.gwlib").ok().stdout;
    assert!(coverage.contains("the body has no legs that were recognised"), "{coverage}");
    draws(&dir);
}

#[test]
fn a_robot_arm_works_where_it_stands() {
    let dir = arms();
    build_and_solve(&dir);
    draws(&dir);
}

/// The motion and the project as pictures, where this machine can draw.
#[track_caller]
fn draws(dir: &Dir) {
    #[cfg(feature = "render")]
    if crate::render::can_draw() {
        gaitway(dir, "render out/A-1.bvh -o motion.png --size 640x360").ok();
        gaitway(dir, "render go.gaitway -o project.png --size 640x360 --iterations 60").ok();
        if let Some(folder) = std::env::var_os("GAITWAY_KEEP_PICTURES") {
            for name in ["motion.png", "project.png"] {
                let clips = std::fs::read_dir(dir.join("clips")).map_or(0, Iterator::count);
                let to = std::path::Path::new(&folder).join(format!("{clips}-{name}"));
                std::fs::copy(dir.join(name), to).expect("the folder is there");
            }
        }
    }
}
