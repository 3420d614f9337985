//! Several characters: what they do together, and how they keep out of each other's way.

use std::path::Path;

use glam::Vec2;
use motion_core::ground::yaw_series_rad;
use motion_core::motion::Motion;
use motion_core::planar::{PlanarTransform, wrap_angle_rad};
use motion_io::bvh;
use motion_io::diagnostic::Warnings;
use motion_tests::cli::Dir;
use motion_tests::shared_dir;
use serde_json::{Value, json};

use crate::{dir_with_library, gaitway, json};

/// A motion that was written.
fn motion(dir: &Dir, name: &str) -> Motion {
    let bytes = std::fs::read(dir.join(name)).expect("it was written");
    let mut warnings = Warnings::new();
    let file = bvh::read(&bytes, Path::new(name), &mut warnings).expect("what we write we read");
    // Files are in centimetres.
    file.to_motion(0.01, Path::new(name), &mut warnings).expect("a motion").1
}

/// Where the body is at every frame.
fn torsos(motion: &Motion) -> Vec<PlanarTransform> {
    let yaw_rad = yaw_series_rad(motion);
    let roots = motion.root_positions_m().iter();
    roots.zip(yaw_rad).map(|(p, yaw)| PlanarTransform::new(yaw, Vec2::new(p.x, p.z), 0.0)).collect()
}

/// The least distance of the two at equal times, outside `together`, metres.
fn least_distance_m(a: &Motion, b: &Motion, together: std::ops::Range<usize>) -> f32 {
    let pairs = a.root_positions_m().iter().zip(b.root_positions_m()).enumerate();
    pairs
        .filter(|(frame, _)| !together.contains(frame))
        .map(|(_, (a, b))| Vec2::new(a.x - b.x, a.z - b.z).length())
        .fold(f32::INFINITY, f32::min)
}

/// Two who come from `apart_m` to each side of the origin and face each other at 1 m at a frame.
fn handshake(library: &str, frame: u32, poses: [(&str, u32); 2], apart_m: f64) -> Value {
    let character = |name: &str, x: f64, heading: f64| {
        json!({"name": name, "length": {"frames": frame + 60}, "constraints": [
            {"id": format!("start-{name}"), "kind": "body", "frame": 0, "position": [x, 0.0],
             "heading": heading}]})
    };
    let member = |name: &str, (clip, clip_frame): (&str, u32)| json!({"character": name, "clip": clip, "clip_frame": clip_frame});
    json!({
        "gaitway": 1, "name": "handshake", "fps": 30, "library": library,
        "characters": [character("A", -apart_m, 90.0), character("B", apart_m, 270.0)],
        "interactions": [{
            "id": "shake", "frame": frame, "weight": 4,
            "members": [member("A", poses[0]), member("B", poses[1])],
            "relative": [{"position": [0, 0], "heading": 0},
                         {"position": [0, 1], "heading": 180}]}],
        "search": {"seed": 1, "alternatives": 3}
    })
}

/// Whether both are at their places to each other in every alternative, and show their poses.
#[track_caller]
fn check_handshake(dir: &Dir, report: &Value, frame: usize, poses: [(&str, u32); 2]) {
    let n_together = report["together"].as_array().map_or(0, Vec::len);
    assert!(n_together > 0, "they were found together: {report}");
    for rank in 0..n_together {
        for (character, (clip, clip_frame)) in
            report["characters"].as_array().expect("both").iter().zip(poses)
        {
            let alternative = &character["alternatives"][rank];
            let mut at = 0;
            let shown =
                alternative["pieces"].as_array().expect("pieces").iter().find_map(|piece| {
                    let (from, to) = (piece["from"].as_u64()?, piece["to"].as_u64()?);
                    let starts = at;
                    at += to + 1 - from;
                    let is_it = (starts..at).contains(&(frame as u64));
                    is_it.then(|| (piece["clip"].clone(), from + frame as u64 - starts))
                });
            assert_eq!(shown, Some((clip.into(), u64::from(clip_frame))), "the pose at its frame");
            let met = alternative["final"]
                .as_array()
                .expect("all")
                .iter()
                .find(|c| c["constraint"] == "shake");
            let met = met.expect("the interaction is reported");
            assert!(met["position_error_m"].as_f64().is_some_and(|m| m < 1e-3), "{met}");
            assert!(met["heading_error_deg"].as_f64().is_some_and(|deg| deg < 0.1), "{met}");
        }
        let at = |name: &str| torsos(&motion(dir, &format!("out/{name}-{}.bvh", rank + 1)))[frame];
        let (a, b) = (at("A"), at("B"));
        let b_in_a = a.inverse() * b;
        let off_m = b_in_a.ground_m().distance(Vec2::new(0.0, 1.0));
        assert!(off_m < 2e-3, "B stands a metre before A: {b_in_a:?}");
        let turn = wrap_angle_rad(b_in_a.heading_rad() - std::f32::consts::PI);
        assert!(turn.abs().to_degrees() < 0.2, "and looks at A: {b_in_a:?}");
    }
}

#[test]
fn two_take_their_poses_at_their_places_to_each_other() {
    let dir = dir_with_library();
    let poses = [("walk", 60), ("slow", 30)];
    let project = handshake("small.gwlib", 75, poses, 3.0);
    dir.file("shake.gaitway", project.to_string());
    let args = "solve shake.gaitway -o out --iterations 24 --json -q";
    let report = json(&gaitway(&dir, args).ok().stdout);
    check_handshake(&dir, &report, 75, poses);
    let together = &report["together"][0];
    let sum: f64 = report["characters"]
        .as_array()
        .expect("both")
        .iter()
        .filter_map(|character| character["alternatives"][0]["score"].as_f64())
        .sum();
    let score = together["score"].as_f64().expect("a score");
    assert!((score - sum).abs() < 0.05 * (1.0 + sum), "{sum} {together}");
    assert_eq!(together["interactions"][0]["interaction"], "shake");
}

#[test]
fn equal_casts_come_of_equal_seeds_on_any_number_of_threads() {
    let dir = dir_with_library();
    let project = handshake("small.gwlib", 60, [("walk", 50), ("left", 40)], 2.5);
    dir.file("shake.gaitway", project.to_string());
    let mut outcomes = [1, 2, 8].map(|threads| {
        let args =
            format!("solve shake.gaitway -o out{threads} --iterations 12 -q --threads {threads}");
        gaitway(&dir, &args).ok();
        let mut files = dir.files();
        files.retain(|(name, _)| {
            name.starts_with(&format!("out{threads}")) && !name.ends_with("timing.json")
        });
        files.into_iter().map(|(_, bytes)| bytes).collect::<Vec<_>>()
    });
    let first = outcomes[0].clone();
    assert!(first.len() > 2, "motions of both and a report");
    assert!(outcomes.iter_mut().all(|outcome| *outcome == first), "the same bytes");
}

#[test]
fn an_interaction_that_cannot_be_is_one_line_with_its_name() {
    let dir = dir_with_library();
    for (poses, line) in [
        (
            [("walk", 60), ("wave", 30)],
            "gaitway: shake.gaitway: interaction \"shake\" shows clip \"wave\", which is not in the library; \
             import the clip, or choose one of the library's",
        ),
        (
            [("walk", 600), ("slow", 30)],
            "gaitway: shake.gaitway: interaction \"shake\" shows frame 600 of clip \"walk\", which ends at \
             frame 89; choose a frame from 0 to 89",
        ),
    ] {
        dir.file("shake.gaitway", handshake("small.gwlib", 75, poses, 3.0).to_string());
        gaitway(&dir, "solve shake.gaitway -o out --iterations 2 -q").refused(line);
    }
    let mut twice = handshake("small.gwlib", 75, [("walk", 60), ("slow", 30)], 3.0);
    twice["interactions"][0]["members"][1]["character"] = "A".into();
    dir.file("shake.gaitway", twice.to_string());
    gaitway(&dir, "solve shake.gaitway -o out --iterations 2 -q").refused(
        "gaitway: shake.gaitway: interaction \"shake\" has \"A\" in it twice; take one of the two out",
    );
}

/// A folder with some of the real clips, and the shared folder.
fn real_clips() -> Option<(Dir, std::path::PathBuf)> {
    let shared = shared_dir()?;
    let dir = Dir::new();
    for clip in ["16_11", "16_12", "16_15", "16_16", "16_17", "16_18", "16_22", "16_33", "16_34"] {
        let name = format!("{clip}.bvh");
        let Ok(text) = std::fs::read(shared.join("mocap/cmu").join(&name)) else { continue };
        dir.file(&format!("clips/{name}"), text);
    }
    gaitway(&dir, "library build clips -o walks.gwlib -q").ok();
    Some((dir, shared))
}

#[test]
fn two_people_pass_each_other() {
    let Some((dir, shared)) = real_clips() else { return };
    let problem = shared.join("problems/10-two-meet.gaitway");
    std::fs::copy(problem, dir.join("meet.gaitway")).expect("the problems are there too");
    let args = "solve meet.gaitway --library walks.gwlib -o out --iterations 24 --json -q";
    let report = json(&gaitway(&dir, args).ok().stdout);
    let (a, b) = (motion(&dir, "out/A-1.bvh"), motion(&dir, "out/B-1.bvh"));
    let least_m = least_distance_m(&a, &b, 0..0);
    assert!(least_m > 0.4, "they walk into each other: {least_m} m");
    let (a, b) = (torsos(&a)[90], torsos(&b)[90]);
    assert!(a.ground_m().distance(Vec2::new(-0.5, 0.0)) < 1e-2, "{a:?}");
    assert!(b.ground_m().distance(Vec2::new(0.5, 0.0)) < 1e-2, "{b:?}");
    assert!(!report["together"].as_array().expect("a list").is_empty());
}

#[test]
fn two_people_stand_before_each_other_as_asked() {
    let Some((dir, _)) = real_clips() else { return };
    let poses = [("16_33", 60), ("16_34", 72)];
    dir.file("shake.gaitway", handshake("walks.gwlib", 90, poses, 3.0).to_string());
    let args = "solve shake.gaitway -o out --iterations 16 --json -q";
    let report = json(&gaitway(&dir, args).ok().stdout);
    check_handshake(&dir, &report, 90, poses);
}
