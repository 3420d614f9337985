//! `cargo xtask bench`: every benchmark, and the table of figures.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, bail, ensure};

use crate::step::{cargo, root};

/// What `--only` calls the benchmarks, beside the names of figures.
const BENCHES: &str = "benches";

/// What was typed after `bench`.
#[derive(Debug, PartialEq)]
struct Wanted<'a> {
    /// `--quick` or `--full`.
    effort: Option<&'a str>,
    /// Names after `--only`; everything where there are none.
    only: Vec<&'a str>,
}

/// Runs the benchmarks and prints median and spread of each; then measures the figures and prints
/// what was promised beside them.
pub(crate) fn run(args: &[String]) -> anyhow::Result<()> {
    let Wanted { effort, only } = read(args)?;
    let of_figures: Vec<&str> = only.iter().copied().filter(|name| *name != BENCHES).collect();
    if only.is_empty() || only.contains(&BENCHES) {
        benches(effort == Some("--quick"))?;
    }
    if only.is_empty() || !of_figures.is_empty() {
        let command = ["run", "--release", "--package", "motion-bench", "--bin", "figures", "--"];
        let mut command = cargo(&command);
        command.args(effort).args(of_figures.into_iter().flat_map(|name| ["--only", name]));
        let status = command.status().context("cannot start the figures")?;
        ensure!(status.success(), "the figures could not be measured");
    }
    Ok(())
}

fn read(args: &[String]) -> anyhow::Result<Wanted<'_>> {
    let mut wanted = Wanted { effort: None, only: Vec::new() };
    let mut args = args.iter().map(String::as_str);
    while let Some(arg) = args.next() {
        match arg {
            "--quick" | "--full" => wanted.effort = Some(arg),
            "--only" => wanted.only.push(args.next().context("--only needs a name")?),
            _ => bail!("bench does not know {arg:?}; it takes --quick, --full and --only NAME"),
        }
    }
    Ok(wanted)
}

/// Criterion's benchmarks and a table of them.
fn benches(quick: bool) -> anyhow::Result<()> {
    let mut command = cargo(&["bench", "--workspace", "--bench", "*"]);
    if quick {
        command.args(["--", "--quick"]);
    }
    let status = command.status().context("cannot start cargo bench")?;
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
    println!();
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
    fn what_is_wanted_is_read() {
        let wanted = |text: &str| -> Option<(Option<String>, Vec<String>)> {
            let args: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
            let Wanted { effort, only } = read(&args).ok()?;
            Some((effort.map(str::to_owned), only.into_iter().map(str::to_owned).collect()))
        };
        assert_eq!(wanted(""), Some((None, vec![])));
        let quick = Some("--quick".to_owned());
        assert_eq!(wanted("--only seams --quick"), Some((quick, vec!["seams".to_owned()])));
        assert_eq!(wanted("--only"), None);
        assert_eq!(wanted("seams"), None);
    }

    #[test]
    fn the_median_is_found_among_the_other_estimates() {
        let text = r#"{"mean":{"confidence_interval":{"confidence_level":0.95,"lower_bound":1.0,
            "upper_bound":2.0},"point_estimate":1.5,"standard_error":0.1},
            "median":{"confidence_interval":{"confidence_level":0.95,"lower_bound":10.5,
            "upper_bound":12.5},"point_estimate":11.25,"standard_error":0.2}}"#;
        assert_eq!(median(text), Some([10.5, 12.5, 11.25]));
    }
}
