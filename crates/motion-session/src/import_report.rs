//! What an import did, file by file, for a person.

use std::fmt::Write as _;
use std::path::PathBuf;

use motion_io::import::{Fate, FileFate};

/// What an import did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportReport {
    /// A line for each file in the order of the inputs, and for each input that meant no file.
    pub lines: Vec<ImportLine>,
    /// What came of it all.
    pub totals: ImportTotals,
}

/// What became of one file.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportLine {
    /// The file.
    pub path: PathBuf,
    /// What became of it.
    pub outcome: ImportOutcome,
    /// What was odd in it, a sentence each.
    pub warnings: Vec<String>,
}

/// What became of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum ImportOutcome {
    /// It is a clip now.
    Imported {
        /// The clip's id.
        id: String,
        /// Frames at the library's rate.
        n_frames: usize,
        /// The file's own rate, frames per second.
        file_fps: f64,
        /// The unit of length that was taken; `None` where the format says it.
        unit: Option<String>,
        /// Whether the body was another one, to which the motion had to be brought.
        is_retargeted: bool,
        /// What was recognised and done, a sentence each.
        notes: Vec<String>,
    },
    /// Its content is a clip already, of this id.
    Skipped(String),
    /// Why it cannot be used, with a way out, in one sentence.
    Refused(String),
}

/// Sums of an import.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportTotals {
    /// Files that became clips.
    pub n_imported: usize,
    /// Files whose content was there already.
    pub n_skipped: usize,
    /// Files that could not be used.
    pub n_refused: usize,
    /// Clips of the library before that are in the new one, mirror images among them.
    pub n_kept: usize,
    /// Clips of the new library, mirror images among them; 0 where there is none.
    pub n_clips: usize,
    /// Frames of them.
    pub n_frames: usize,
    /// How long they are, seconds.
    pub motion_secs: f64,
    /// How long the import took, seconds.
    pub took_secs: f64,
    /// The new library's file, if there is one.
    pub file: Option<PathBuf>,
}

impl ImportReport {
    /// The report of these fates. What the new library has is for the caller to add.
    pub(crate) fn new(files: Vec<FileFate>) -> Self {
        let mut totals = ImportTotals::default();
        let lines = files.into_iter().map(|file| {
            let outcome = match file.fate {
                Fate::Imported { id, n_frames, facts, is_brought, notes } => {
                    totals.n_imported += 1;
                    ImportOutcome::Imported {
                        id,
                        n_frames,
                        file_fps: facts.fps.get(),
                        unit: facts.unit.map(|unit| {
                            let doubt = if unit.sure { "" } else { "?" };
                            format!("{}{doubt}", unit.value.name())
                        }),
                        is_retargeted: is_brought,
                        notes,
                    }
                }
                Fate::Same(id) => {
                    totals.n_skipped += 1;
                    ImportOutcome::Skipped(id)
                }
                Fate::Refused(error) => {
                    totals.n_refused += 1;
                    let line = error.line.map(|line| format!("line {line}: ")).unwrap_or_default();
                    ImportOutcome::Refused(format!("{line}{}; {}", error.what, error.what_to_do))
                }
            };
            ImportLine { path: file.path, outcome, warnings: file.warnings }
        });
        Self { lines: lines.collect(), totals }
    }

    /// What came of it, in a sentence.
    pub fn summary(&self) -> String {
        let ImportTotals { n_imported, n_skipped, n_refused, n_kept, n_clips, .. } = self.totals;
        let plural = |n: usize| if n == 1 { "" } else { "s" };
        let mut text = match n_imported {
            0 => "no new clips".to_owned(),
            n => format!("{n} new clip{}", plural(n)),
        };
        if n_kept > 0 {
            // Writing to a string cannot fail.
            let _ok = write!(text, " beside {n_kept} that were there");
        }
        if n_skipped > 0 {
            let _ok = write!(text, ", {n_skipped} file{} there already", plural(n_skipped));
        }
        if n_refused > 0 {
            let _ok = write!(text, ", {n_refused} refused");
        }
        if n_clips > 0 {
            let _ok = write!(text, "; the library has {n_clips} clip{}", plural(n_clips));
            let _ok = write!(text, ", {:.1} minutes", self.totals.motion_secs / 60.0);
        }
        text
    }

    /// Everything, a line for each file and the summary.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for line in &self.lines {
            let _ok = writeln!(text, "{}", line.text());
        }
        text + &self.summary() + "\n"
    }
}

impl ImportLine {
    /// The file and what became of it, on one line.
    pub fn text(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str()).to_string_lossy();
        let mut text = format!("{name}: ");
        match &self.outcome {
            ImportOutcome::Imported { id, n_frames, file_fps, unit, is_retargeted, .. } => {
                let _ok = write!(text, "clip {id}, {n_frames} frames, {file_fps:.4} per second");
                // Rates are mostly whole numbers.
                text = text.replace(".0000 per", " per");
                if let Some(unit) = unit {
                    let _ok = write!(text, ", {unit}");
                }
                if *is_retargeted {
                    text.push_str(", retargeted");
                }
            }
            ImportOutcome::Skipped(id) => {
                let _ok = write!(text, "skipped, the same as clip {id}");
            }
            ImportOutcome::Refused(sentence) => {
                let _ok = write!(text, "refused: {sentence}");
            }
        }
        for warning in &self.warnings {
            let _ok = write!(text, " ({warning})");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(name: &str, outcome: ImportOutcome) -> ImportLine {
        ImportLine { path: PathBuf::from(name), outcome, warnings: Vec::new() }
    }

    #[test]
    fn it_reads_as_lines() {
        let clip = ImportOutcome::Imported {
            id: "walk".to_owned(),
            n_frames: 40,
            file_fps: 120.0,
            unit: Some("centimetres".to_owned()),
            is_retargeted: true,
            notes: Vec::new(),
        };
        let mut first = line("a/walk.bvh", clip);
        first.warnings.push("line 3: odd".to_owned());
        let second = line("a/copy.bvh", ImportOutcome::Skipped("walk".to_owned()));
        let third = line("x.txt", ImportOutcome::Refused("it is none; give one".to_owned()));
        let totals = ImportTotals {
            n_imported: 1,
            n_skipped: 1,
            n_refused: 1,
            n_kept: 4,
            n_clips: 5,
            motion_secs: 90.0,
            ..ImportTotals::default()
        };
        let report = ImportReport { lines: vec![first, second, third], totals };
        assert_eq!(
            report.text(),
            "walk.bvh: clip walk, 40 frames, 120 per second, centimetres, retargeted (line 3: odd)\n\
             copy.bvh: skipped, the same as clip walk\n\
             x.txt: refused: it is none; give one\n\
             1 new clip beside 4 that were there, 1 file there already, 1 refused; the library has 5 \
             clips, 1.5 minutes\n"
        );
    }
}
