//! The arrows of `ARCHITECTURE.md`, held by reading manifests and sources.

use motion_tests::sources::{crate_dirs, source_files};

use crate::manifest::{Kind, dependencies};

/// What each library may use of ours. A crate that is not listed may use everything.
const ARROWS: &[(&str, &[&str])] = &[
    ("crates/motion-core", &[]),
    ("crates/motion-performer", &["motion-core"]),
    ("crates/motion-io", &["motion-core"]),
    ("crates/motion-scene", &[]),
    ("crates/motion-render", &["motion-scene"]),
    ("crates/motion-session", &["motion-core", "motion-io", "motion-performer", "motion-scene"]),
    ("crates/motion-editor", &["motion-core", "motion-render", "motion-scene", "motion-session"]),
    ("crates/xtask", &[]),
];

/// What a crate must not name, even indirectly by its own manifest, and why.
const NEVER: &[(&str, &[&str], &str)] = &[
    (
        "crates/motion-core",
        &["serde", "serde_json", "anyhow", "tracing", "indicatif", "tempfile"],
        "results depend on arguments alone; formats are motion-io's",
    ),
    ("crates/motion-io", &["anyhow", "rand"], "its errors are its own; it invents nothing"),
    ("crates/motion-performer", &["serde", "anyhow"], "it is mathematics, like motion-core"),
    ("crates/motion-scene", &["serde", "anyhow", "rand"], "it is plain data and mathematics"),
    ("crates/motion-render", &["winit", "egui", "eframe"], "it draws for windows and without one"),
    ("crates/motion-session", &["anyhow", "clap", "indicatif"], "it has no terminal"),
    ("crates/motion-editor", &["anyhow", "clap", "indicatif"], "it has a window, and no terminal"),
];

/// Windows and graphics, which only crates made for them may touch.
const GRAPHICS: &[&str] = &["wgpu", "winit", "egui", "eframe"];
const WITHOUT_GRAPHICS: &[&str] = &[
    "crates/motion-core",
    "crates/motion-performer",
    "crates/motion-io",
    "crates/motion-scene",
    "crates/motion-session",
];

#[test]
fn arrows_point_one_way() {
    for (dir, may_use) in ARROWS {
        for (kind, name) in of(dir) {
            let ours = name.starts_with("motion-") || name == "gaitway" || name == "xtask";
            let fine =
                may_use.contains(&name.as_str()) || (kind == Kind::Dev && name == "motion-tests");
            assert!(!ours || fine, "{dir} must not depend on {name}");
        }
    }
}

#[test]
fn what_a_crate_must_never_reach() {
    for (dir, never, why) in NEVER {
        for (kind, name) in of(dir) {
            let hit = kind != Kind::Dev && never.contains(&name.as_str());
            assert!(!hit, "{dir} must not depend on {name}: {why}");
        }
    }
    for dir in WITHOUT_GRAPHICS {
        for (_, name) in of(dir) {
            let hit = GRAPHICS.iter().any(|g| name == *g || name.starts_with(&format!("{g}-")));
            assert!(!hit, "{dir} works without a window and must not depend on {name}");
        }
    }
}

#[test]
fn tests_and_tasks_are_not_depended_on() {
    for dir in crate_dirs() {
        for (kind, name) in dependencies(&dir) {
            assert_ne!(name, "xtask", "{dir} depends on xtask");
            assert_ne!(name, "motion-bench", "{dir} depends on benchmarks");
            // Benchmarks are no product either; they look for the same clips.
            let product = dir != "crates/motion-bench";
            let test_helper_in_product = name == "motion-tests" && kind != Kind::Dev && product;
            assert!(!test_helper_in_product, "{dir} ships motion-tests");
        }
    }
}

/// No clock, no file, no terminal and no ambient randomness where results must depend on arguments
/// alone.
#[test]
fn the_core_only_computes() {
    const NEVER_SAID: &[&str] = &[
        "std::fs",
        "std::env",
        "std::net",
        "std::process",
        "Instant::now",
        "SystemTime",
        "thread_rng",
        "rand::rng(",
        "println!",
        "eprintln!",
        "serde::",
    ];
    for file in source_files(&["rs"]) {
        let core = ["crates/motion-core/src/", "crates/motion-performer/src/"]
            .iter()
            .any(|dir| file.path.starts_with(dir));
        if !core {
            continue;
        }
        for (line_no, line) in file.text.lines().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            for word in NEVER_SAID {
                let at = format!("{}:{}", file.path, line_no + 1);
                assert!(!code.contains(word), "{at}: {word} has no place in this crate");
            }
        }
    }
}

/// Dependencies of a crate, none where it does not exist yet.
fn of(dir: &str) -> Vec<(Kind, String)> {
    if crate_dirs().iter().any(|d| d == dir) { dependencies(dir) } else { Vec::new() }
}
