//! Motions and reports on disk.

use std::fs;
use std::path::{Path, PathBuf};

use motion_io::atomic_write::atomic_write;
use motion_io::bvh::{self, BvhWriteOptions};
use motion_io::diagnostic::FileError;
use motion_io::report_file::{self, Report};

use crate::project_job::Solved;

/// Whether wall-clock figures stand in the report or apart from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clocks {
    /// In `report.json`.
    InReport,
    /// In `timing.json` alone, so that everything else is the same bytes every time.
    Apart,
}

const REPORT: &str = "report.json";
const TIMING: &str = "timing.json";

/// Writes every motion and the report to `dir`, which is made if it is missing. Returns the
/// motions' files, best first for each character.
///
/// Motions that an earlier report in `dir` names and this one does not write again are removed:
/// they would pass for this project's.
pub fn write_results(
    solved: &mut Solved,
    dir: &Path,
    clocks: Clocks,
) -> Result<Vec<PathBuf>, FileError> {
    fs::create_dir_all(dir).map_err(|error| FileError::writing(dir, &error))?;
    let old_files = files_of_report(&dir.join(REPORT));
    let mut written = Vec::new();
    for (character, report) in solved.characters.iter().zip(&mut solved.report.characters) {
        let skeleton = character.library.clips.skeleton();
        for (motion, alternative) in character.motions.iter().zip(&mut report.alternatives) {
            let name = format!("{}-{}.bvh", report.name, alternative.rank);
            let text = bvh::write(skeleton, motion, &BvhWriteOptions::default());
            let path = dir.join(&name);
            atomic_write(&path, text.as_bytes())?;
            alternative.files = vec![name];
            written.push(path);
        }
    }
    let timing = match clocks {
        Clocks::InReport => None,
        Clocks::Apart => Some(solved.report.take_timing()),
    };
    report_file::save(&solved.report, &dir.join(REPORT))?;
    match timing {
        Some(timing) => report_file::save(&timing, &dir.join(TIMING))?,
        // One of an earlier run would not belong to this report.
        None => drop(fs::remove_file(dir.join(TIMING))),
    }
    for name in old_files {
        let path = dir.join(name);
        if !written.contains(&path) {
            // Best effort: a file that cannot be removed does no harm beyond being old.
            drop(fs::remove_file(path));
        }
    }
    Ok(written)
}

/// The files that a report names, as far as they lie beside it.
fn files_of_report(path: &Path) -> Vec<String> {
    let Ok(text) = fs::read_to_string(path) else { return Vec::new() };
    let Ok(report) = serde_json::from_str::<Report>(&text) else { return Vec::new() };
    let alternatives = report.characters.into_iter().flat_map(|c| c.alternatives);
    let is_plain = |name: &String| Path::new(name).file_name().is_some_and(|n| n == name.as_str());
    alternatives.flat_map(|a| a.files).filter(is_plain).collect()
}
