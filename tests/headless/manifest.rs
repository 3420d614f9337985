//! Just enough of a `Cargo.toml` to know who depends on whom.

use std::fs;

use motion_tests::workspace_root;

/// Where a dependency is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// By the crate itself.
    Normal,
    /// By its tests and benchmarks.
    Dev,
    /// By its build script.
    Build,
}

/// The dependencies that the manifest in `dir` names.
pub(crate) fn dependencies(dir: &str) -> Vec<(Kind, String)> {
    let path = workspace_root().join(dir).join("Cargo.toml");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    parse(&text)
}

/// Reads the tables whose header ends with `dependencies`, target-specific ones too, and headers
/// such as `[dependencies.name]`.
fn parse(text: &str) -> Vec<(Kind, String)> {
    let mut found = Vec::new();
    let mut table = None;
    for line in text.lines().map(str::trim) {
        if let Some(header) = line.strip_prefix('[') {
            let header = header.trim_end_matches(']');
            table = kind_of(header);
            if let Some((before, name)) = header.rsplit_once('.')
                && let Some(kind) = kind_of(before)
            {
                found.push((kind, name.to_owned()));
            }
        } else if let Some(kind) = table
            && let Some((key, _)) = line.split_once('=')
            && !line.starts_with('#')
        {
            let name = key.trim().split('.').next().unwrap_or_default();
            found.push((kind, name.trim_matches('"').to_owned()));
        }
    }
    found
}

fn kind_of(header: &str) -> Option<Kind> {
    match header.rsplit('.').next()? {
        "dependencies" => Some(Kind::Normal),
        "dev-dependencies" => Some(Kind::Dev),
        "build-dependencies" => Some(Kind::Build),
        _ => None,
    }
}

#[test]
fn all_ways_to_write_a_dependency_are_seen() {
    let text = "[package]\nname = \"x\"\n[dependencies]\n# no = 1\nglam.workspace = true\n\
        serde = { version = \"1\" }\n[dev-dependencies]\nproptest.workspace = true\n\
        [target.'cfg(unix)'.dependencies]\nlibc = \"0.2\"\n[dependencies.rand]\nversion = \"1\"\n";
    let names: Vec<(Kind, String)> = parse(text);
    let expected = [
        (Kind::Normal, "glam"),
        (Kind::Normal, "serde"),
        (Kind::Dev, "proptest"),
        (Kind::Normal, "libc"),
        (Kind::Normal, "rand"),
    ];
    let names: Vec<(Kind, &str)> = names.iter().map(|(k, n)| (*k, n.as_str())).collect();
    assert_eq!(names, expected);
}
