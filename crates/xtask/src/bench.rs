//! `cargo xtask bench`: every benchmark, and one table of what they measured.
//!
//! Figures that are no time per run (candidates per second) are printed by the benchmarks themselves.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, ensure};

use crate::step::{cargo, root};

/// Runs the benchmarks and prints name, median and spread of each.
pub(crate) fn run(args: &[String]) -> anyhow::Result<()> {
    let mut command = cargo(&["bench", "--workspace", "--bench", "*"]);
    let status = command.args(args).status().context("cannot start cargo bench")?;
    ensure!(status.success(), "a benchmark failed");
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root().join("target"), std::path::PathBuf::from);
    let mut rows = Vec::new();
    collect(&target.join("criterion"), "", &mut rows)?;
    rows.sort_by(|a, b| a.name.cmp(&b.name));
    println!("\n{:<48} {:>12}   {:>25}", "benchmark", "median", "95 % interval");
    for Row { name, median_ns, low_ns, high_ns } in &rows {
        println!(
            "{name:<48} {:>12}   {:>12} {:>12}",
            time(*median_ns),
            time(*low_ns),
            time(*high_ns)
        );
    }
    Ok(())
}

struct Row {
    name: String,
    median_ns: f64,
    low_ns: f64,
    high_ns: f64,
}

/// Finds `…/NAME/new/estimates.json` below `folder`, as criterion lays them out.
fn collect(folder: &Path, name: &str, rows: &mut Vec<Row>) -> anyhow::Result<()> {
    let estimates = folder.join("new/estimates.json");
    if estimates.is_file() {
        let text = fs::read_to_string(&estimates)?;
        let numbers = median(&text)
            .with_context(|| format!("{}: not as criterion writes it", estimates.display()))?;
        let [low_ns, high_ns, median_ns] = numbers;
        rows.push(Row { name: name.to_owned(), median_ns, low_ns, high_ns });
        return Ok(());
    }
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry?.path();
        if path.is_dir() {
            let stem = path.file_name().map(|n| n.to_string_lossy().into_owned());
            let stem = stem.unwrap_or_default();
            let inner = if name.is_empty() { stem } else { format!("{name}/{stem}") };
            collect(&path, &inner, rows)?;
        }
    }
    Ok(())
}

/// The bounds and the value of the median, nanoseconds.
///
/// The file is small and its shape fixed, so three searches stand in for a JSON parser.
fn median(text: &str) -> Option<[f64; 3]> {
    let text = &text[text.find("\"median\"")?..];
    let number = |key: &str| -> Option<f64> {
        let rest = &text[text.find(key)? + key.len()..];
        let rest = rest.trim_start_matches(['"', ':', ' ']);
        rest[..rest.find([',', '}'])?].trim().parse().ok()
    };
    Some([number("lower_bound")?, number("upper_bound")?, number("point_estimate")?])
}

fn time(ns: f64) -> String {
    match ns {
        ns if ns < 1e3 => format!("{ns:.1} ns"),
        ns if ns < 1e6 => format!("{:.2} µs", ns / 1e3),
        ns if ns < 1e9 => format!("{:.2} ms", ns / 1e6),
        ns => format!("{:.3} s", ns / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_found_among_the_other_estimates() {
        let text = r#"{"mean":{"confidence_interval":{"confidence_level":0.95,"lower_bound":1.0,
            "upper_bound":2.0},"point_estimate":1.5,"standard_error":0.1},
            "median":{"confidence_interval":{"confidence_level":0.95,"lower_bound":10.5,
            "upper_bound":12.5},"point_estimate":11.25,"standard_error":0.2}}"#;
        assert_eq!(median(text), Some([10.5, 12.5, 11.25]));
    }
}
