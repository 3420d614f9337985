//! The program as a person runs it.

mod alone;
mod bad_motion;
mod bad_project;
mod cast;
mod creatures;
mod determinism;
mod library;
mod motions;
mod real_clips;
#[cfg(feature = "render")]
mod render;
mod solve;
mod words;

use motion_tests::cli::{Dir, Ran};
use motion_tests::walker::small_library;

/// Runs the program in `dir`; the arguments are separated by single spaces.
fn gaitway(dir: &Dir, args: &str) -> Ran {
    let args: Vec<&str> = args.split(' ').filter(|arg| !arg.is_empty()).collect();
    motion_tests::cli::run(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args)
}

/// A folder with the small library's clips in `clips/` and a project in `corner.gaitway`.
fn dir_with_clips() -> Dir {
    let dir = Dir::new();
    for (name, walk) in small_library() {
        dir.file(&format!("clips/{name}.bvh"), walk.bvh());
    }
    dir.file("corner.gaitway", CORNER);
    dir
}

/// The same with the library built.
fn dir_with_library() -> Dir {
    let dir = dir_with_clips();
    gaitway(&dir, "library build clips -o small.gwlib -q").ok();
    dir
}

/// Three seconds round a corner.
const CORNER: &str = r#"{
  "gaitway": 1,
  "name": "corner",
  "fps": 30,
  "library": "small.gwlib",
  "characters": [{
    "name": "A",
    "length": {"frames": 90},
    "constraints": [
      {"id": "start", "kind": "body", "frame": 0, "position": [0, 0], "heading": 0},
      {"id": "end", "kind": "body", "frame": 89, "position": [1.5, 2.5], "heading": 60}
    ]
  }],
  "search": {"seed": 3, "alternatives": 3}
}
"#;

/// The value at a path of keys and indices in a JSON text.
fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("one JSON document")
}
