//! The whole way on real motion capture, where there is some.

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
