//! What is wrong with a file, said so that a person can mend it.
//!
//! An error stops the work on its file and is one line:
//!
//! ```
//! use motion_io::diagnostic::FileError;
//! let error = FileError::new("walk.bvh", "the file ends before MOTION", "export it again")
//!     .at_line(12);
//! assert_eq!(error.to_string(), "walk.bvh:12: the file ends before MOTION; export it again");
//! ```
//!
//! A warning does not: it is collected in [`Warnings`] and the work goes on.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file cannot be used. Its text is `FILE[:LINE]: what is wrong; what to do`, on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file, as the user named it.
    pub path: PathBuf,
    /// The line, counted from 1, where there is one.
    pub line: Option<u32>,
    /// What is wrong.
    pub what: String,
    /// What the user can do about it.
    pub what_to_do: String,
}

impl FileError {
    /// An error about the file as a whole.
    pub fn new(
        path: impl Into<PathBuf>,
        what: impl Into<String>,
        what_to_do: impl Into<String>,
    ) -> Self {
        Self { path: path.into(), line: None, what: what.into(), what_to_do: what_to_do.into() }
    }

    /// The same error, at a line (counted from 1).
    #[must_use]
    pub fn at_line(mut self, line: u32) -> Self {
        self.line = Some(line);
        self
    }

    /// The error that `error` means when `path` was to be read.
    pub fn reading(path: &Path, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::new(path, "there is no such file", "check the path"),
            io::ErrorKind::PermissionDenied => {
                Self::new(path, "it may not be read", "change its permissions")
            }
            _ => Self::new(path, format!("it cannot be read ({error})"), "check the disk"),
        }
    }

    /// The error that `error` means when `path` was to be written.
    pub fn writing(path: &Path, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => {
                Self::new(path, "the folder it goes into does not exist", "create the folder first")
            }
            io::ErrorKind::PermissionDenied => Self::new(
                path,
                "it may not be written",
                "choose another place or change the folder's permissions",
            ),
            io::ErrorKind::StorageFull => {
                Self::new(path, "the disk is full", "free some space and try again")
            }
            _ => Self::new(path, format!("it cannot be written ({error})"), "check the disk"),
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_place(f, &self.path, self.line)?;
        write!(f, ": {}; {}", one_line(&self.what), one_line(&self.what_to_do))
    }
}

impl std::error::Error for FileError {}

/// Something odd in a file that was read all the same. Its text is `FILE[:LINE]: what`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The file, as the user named it.
    pub path: PathBuf,
    /// The line, counted from 1, where there is one.
    pub line: Option<u32>,
    /// What is odd and what was done about it.
    pub what: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_place(f, &self.path, self.line)?;
        write!(f, ": {}", one_line(&self.what))
    }
}

/// Warnings in the order in which they were found.
///
/// Readers take `&mut Warnings`; work that is split over threads gives each part its own and
/// [`append`](Self::append)s them in a fixed order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings {
    found: Vec<Warning>,
}

impl Warnings {
    /// No warnings yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a warning about `path`, at `line` where there is one.
    pub fn warn(&mut self, path: &Path, line: Option<u32>, what: impl Into<String>) {
        self.found.push(Warning { path: path.to_owned(), line, what: what.into() });
    }

    /// Adds those of `other` behind these.
    pub fn append(&mut self, mut other: Self) {
        self.found.append(&mut other.found);
    }

    /// The warnings so far.
    pub fn as_slice(&self) -> &[Warning] {
        &self.found
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }
}

fn write_place(f: &mut fmt::Formatter<'_>, path: &Path, line: Option<u32>) -> fmt::Result {
    f.write_str(&one_line(&path.to_string_lossy()))?;
    match line {
        Some(line) => write!(f, ":{line}"),
        None => Ok(()),
    }
}

/// `text` without line breaks and other control characters, which would break the promise of
/// one line (and let a file name write to a terminal).
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// A piece of a file as a message shows it: in quotes, at most 40 characters, nothing that a
/// terminal would obey.
pub(crate) fn quoted(bytes: &[u8]) -> String {
    const MAX_CHARS: usize = 40;
    // Only so many bytes are decoded: the piece may be a whole binary file.
    let head = &bytes[..bytes.len().min(4 * MAX_CHARS + 4)];
    let text = String::from_utf8_lossy(head);
    let mut shown: String = text
        .chars()
        .take(MAX_CHARS)
        .map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c })
        .collect();
    if text.chars().count() > MAX_CHARS {
        shown.push('…');
    }
    format!("\"{shown}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_is_left_out_where_there_is_none() {
        let error = FileError::new("a.bvh", "it is empty", "export it again");
        assert_eq!(error.to_string(), "a.bvh: it is empty; export it again");
    }

    #[test]
    fn an_error_is_one_line_whatever_the_file_is_called() {
        let error = FileError::new("a\nb\u{1b}[31m.bvh", "x\ny", "z").at_line(3);
        assert_eq!(error.to_string(), "a b [31m.bvh:3: x y; z");
    }

    #[test]
    fn quoted_pieces_are_short_and_harmless() {
        assert_eq!(quoted(b"Hips"), "\"Hips\"");
        assert_eq!(quoted(b"\x00\xff"), "\"\u{fffd}\u{fffd}\"");
        assert_eq!(quoted(&[b'a'; 1000]).chars().count(), 43);
    }

    #[test]
    fn warnings_keep_their_order() {
        let mut first = Warnings::new();
        first.warn(Path::new("a"), None, "one");
        let mut second = Warnings::new();
        second.warn(Path::new("b"), Some(2), "two");
        first.append(second);
        let lines: Vec<String> = first.as_slice().iter().map(ToString::to_string).collect();
        assert_eq!(lines, ["a: one", "b:2: two"]);
    }
}
