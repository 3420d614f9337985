//! `convert` and `measure`.

use std::fs;

use motion_tests::cli::Dir;
use motion_tests::walker::Walk;

use crate::{gaitway, json};

#[test]
fn rate_and_unit_are_changed_and_nothing_else() {
    let dir = Dir::new();
    dir.file("walk.bvh", Walk { n_frames: 61, ..Walk::default() }.bvh());
    let ran = gaitway(&dir, "convert walk.bvh fast.bvh --fps 60 --unit m").ok();
    assert_eq!(ran.stdout, "fast.bvh: 121 frames at 60 per second, 19 joints\n");
    let text = fs::read_to_string(dir.join("fast.bvh")).unwrap();
    assert!(text.contains("Frames: 121\n"), "{}", head_of_motion(&text));
    let height_m: f64 = frames(&text)[0][1];
    assert!((height_m - 0.94).abs() < 0.02, "the hips in metres: {height_m}");
    let figure = |file: &str, name: &str| {
        json(&gaitway(&dir, &format!("measure {file} --json -q")).ok().stdout)[name]
            .as_f64()
            .unwrap()
    };
    let (slow, fast) = (figure("walk.bvh", "travel_m"), figure("fast.bvh", "travel_m"));
    assert!((slow - 2.4).abs() < 0.1, "two seconds at 1.2 m/s: {slow}");
    assert!((slow - fast).abs() < 0.01, "{slow} and {fast}");
}

#[test]
fn converting_back_changes_nothing_more() {
    let dir = Dir::new();
    dir.file("walk.bvh", Walk::default().bvh());
    gaitway(&dir, "convert walk.bvh a.bvh --unit m -q").ok();
    gaitway(&dir, "convert a.bvh b.bvh -q").ok();
    let read = |name: &str| frames(&fs::read_to_string(dir.join(name)).unwrap());
    for (frame, (a, b)) in read("walk.bvh").iter().zip(read("b.bvh")).enumerate() {
        // Channels are in the same order: positions first, then Z X Y for each joint.
        for (channel, (a, b)) in a.iter().zip(&b).enumerate() {
            assert!((a - b).abs() < 1e-3, "frame {frame}, channel {channel}: {a} and {b}");
        }
    }
}

fn head_of_motion(text: &str) -> &str {
    let motion = text.find("MOTION").expect("a BVH file");
    &text[motion..text.len().min(motion + 60)]
}

/// The numbers of every frame of a BVH file.
fn frames(text: &str) -> Vec<Vec<f64>> {
    let lines = text[text.find("MOTION").expect("a BVH file")..].lines().skip(3);
    lines
        .map(|line| line.split_whitespace().map(|w| w.parse().expect("a number")).collect())
        .collect()
}

#[test]
fn a_name_that_says_no_format() {
    let dir = Dir::new();
    gaitway(&dir, "convert walk.bvh walk.fbx")
        .refused("gaitway: walk.fbx: .fbx cannot be written; choose a name that ends in .bvh");
    gaitway(&dir, "convert walk.bvh walk").refused(
        "gaitway: walk: the name has no ending that says the format; \
         choose a name that ends in .bvh",
    );
}

#[test]
fn every_figure_is_explained() {
    let dir = Dir::new();
    dir.file("walk.bvh", Walk { turn_deg_s: 30.0, n_frames: 91, ..Walk::default() }.bvh());
    let measured = json(&gaitway(&dir, "measure walk.bvh --json --explain -q").ok().stdout);
    assert_eq!((&measured["frames"], &measured["fps"]), (&91.into(), &30.0.into()));
    assert!((measured["turn_deg"].as_f64().unwrap() - 90.0).abs() < 7.0, "{measured}");
    let described = ["frames", "fps", "skeleton", "definitions"];
    for name in measured.as_object().unwrap().keys() {
        let known = described.contains(&name.as_str()) || measured["definitions"][name].is_string();
        assert!(known, "{name} has no definition");
    }
    let text = gaitway(&dir, "measure --explain").ok().stdout;
    assert!(text.contains("foot_slide_cm_per_s"), "{text}");
}
