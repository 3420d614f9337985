//! `gaitway measure`.

use std::fmt::Write as _;

use motion_core::measure::DEFINITIONS;
use motion_io::diagnostic::Warnings;
use motion_io::import::read_motion_file;
use motion_session::quality::measure_report;
use serde_json::{Map, Value};

use crate::args::Measure;
use crate::output::{Console, Failure};
use crate::plan;

/// Prints the figures of a motion, the definitions, or both.
pub(crate) fn run(console: &Console, args: &Measure) -> Result<(), Failure> {
    let mut document = Map::new();
    let mut text = String::new();
    if let Some(path) = &args.motion {
        let mut warnings = Warnings::new();
        let file = read_motion_file(path, &plan::read_options(&args.reading)?, &mut warnings)?;
        console.warnings(&warnings);
        let report = measure_report(&file.skeleton, &file.motion);
        let report = serde_json::to_value(&report).map_err(anyhow::Error::from)?;
        if let Value::Object(figures) = report {
            for (name, value) in &figures {
                // Writing to a string cannot fail.
                let _ok = writeln!(text, "{name:<30} {}", shown(value));
            }
            document = figures;
        }
    }
    if args.explain {
        let definitions = DEFINITIONS.iter().map(|&(name, definition)| {
            let _ok = writeln!(text, "\n{name}\n    {definition}");
            (name.to_owned(), Value::from(definition))
        });
        let definitions: Map<String, Value> = definitions.collect();
        document.insert("definitions".to_owned(), Value::Object(definitions));
    }
    console.answer(&document, || text.trim_start().to_owned())
}

fn shown(value: &Value) -> String {
    match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
