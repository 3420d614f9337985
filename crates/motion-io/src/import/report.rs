//! What an import did, for a person.

use std::fmt;
use std::path::{Path, PathBuf};

/// Lines in the order in which each was first needed; a line is about one file or many.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    lines: Vec<ReportLine>,
}

/// Something that was done, and the files it was done to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportLine {
    /// What was done or recognised.
    pub text: String,
    /// The files, in the import's order; at least one.
    pub files: Vec<PathBuf>,
}

impl Report {
    /// Adds `text` about `path`, to the line of that text if there is one.
    pub fn add(&mut self, path: &Path, text: impl Into<String>) {
        let text = text.into();
        match self.lines.iter_mut().find(|line| line.text == text) {
            Some(line) => line.files.push(path.to_owned()),
            None => self.lines.push(ReportLine { text, files: vec![path.to_owned()] }),
        }
    }

    /// The lines so far.
    pub fn lines(&self) -> &[ReportLine] {
        &self.lines
    }
}

impl fmt::Display for ReportLine {
    /// `16_15.bvh and 57 more: what was done`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(first) = self.files.first() {
            write!(f, "{}", first.display())?;
        }
        if self.files.len() > 1 {
            write!(f, " and {} more", self.files.len() - 1)?;
        }
        write!(f, ": {}", self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_thing_is_said_once() {
        let mut report = Report::default();
        report.add(Path::new("a"), "one");
        report.add(Path::new("a"), "two");
        report.add(Path::new("b"), "one");
        let lines: Vec<String> = report.lines().iter().map(ToString::to_string).collect();
        assert_eq!(lines, ["a and 1 more: one", "a: two"]);
    }
}
