//! The table of figures: what was promised, what is measured here and now.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for developers' terminals"
)]

mod effort;
mod figures;
mod machine;
mod table;

use std::process::ExitCode;

use anyhow::ensure;
use clap::Parser;
use motion_bench::clips::Source;

use effort::Effort;
use figures::{Bench, FIGURES};

/// Measures every figure that Gaitway promises and prints one table.
#[derive(Parser)]
#[command(name = "figures")]
struct Args {
    /// Few seeds and short runs: a look, not a result
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Best known scores from 10 runs of 60 s a problem (hours, on a quiet machine)
    #[arg(long)]
    full: bool,
    /// Only these figures: build, mirrored, scale, load, leaf-edges, candidates, first, alternatives,
    /// score, problems, score1s, versus, candidates-all-kinds, errand, alternatives2s, random,
    /// rescore, threads, correction, seams, assembly, picture, film, tags, editor
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Builds the library once and prints what that took; a process of its own has its own peak
    /// memory
    #[arg(long, value_name = "plain|mirrored", hide = true)]
    build_once: Option<String>,
    /// Builds a library of so many frames once and prints what that took
    #[arg(long, value_name = "FRAMES", hide = true)]
    scale_once: Option<usize>,
    /// Works in the editor once and prints what that took
    #[arg(long, value_name = "sample|cmu", hide = true)]
    editor_once: Option<String>,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("figures: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> anyhow::Result<()> {
    let source = Source::find();
    if let Some(which) = &args.build_once {
        return figures::build::build_once(&source, which == "mirrored");
    }
    if let Some(n_frames) = args.scale_once {
        return figures::scale::scale_once(&source, n_frames);
    }
    if let Some(which) = &args.editor_once {
        return figures::editor::editor_once(&source, which);
    }
    let names: Vec<&str> = FIGURES.iter().map(|figure| figure.name).collect();
    for name in &args.only {
        ensure!(names.contains(&name.as_str()), "no figure is {name:?}; {}", names.join(", "));
    }
    let effort = Effort::of(args.quick, args.full);
    let mut bench = Bench::new(source, effort);
    println!("{}\nclips: {}; {effort}\n", machine::describe(), bench.source);
    // What is promised is promised for the motion capture.
    let is_promised = matches!(bench.source, Source::Cmu(_));
    let mut rows = Vec::new();
    for figure in FIGURES {
        if args.only.is_empty() || args.only.iter().any(|name| name == figure.name) {
            eprintln!("measuring {} …", figure.name);
            let measured = (figure.measure)(&mut bench)?;
            // At once too: the others may take hours.
            eprint!("{}", table::render(&measured, is_promised));
            rows.extend(measured);
        }
    }
    print!("{}", table::render(&rows, is_promised));
    Ok(())
}
