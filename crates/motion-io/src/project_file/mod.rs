//! The project file, `.gaitway`: JSON, versioned, kept by people and programs alike.
//!
//! * Keys that are unknown here are warned about and kept when the project is saved.
//! * A file of a newer version is refused.
//! * Constraints without an `id` are given one when the file is read.
//! * What is saved can be read again: [`save`] checks as [`load`] does, before it writes.
//! * Saving what was loaded from a saved file gives the same bytes.

mod constraint;
mod decode;
mod encode;
mod model;
mod names;
mod tags;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use crate::atomic_write::atomic_write;
use crate::diagnostic::{FileError, Warnings};
use crate::json::{self, Document, Node};
use crate::limits::MAX_PROJECT_FILE_BYTES;
use crate::read_file::read_file;

pub use model::{
    Character, Constraint, ConstraintKind, Extra, Hashes, Interaction, Length, LengthMode,
    LockedPiece, Member, Obstacle, Palette, PathHeading, Placement, Project, Search, Shape,
    TagEntry, Tolerance,
};
pub use names::fault_as_file_name;

/// The version that is written, and the newest that is read.
pub const FORMAT_VERSION: u32 = 1;

/// Reads the project at `path`. Fails with the line of what is wrong in it.
pub fn load(path: &Path, warnings: &mut Warnings) -> Result<Project, FileError> {
    read(&read_file(path, MAX_PROJECT_FILE_BYTES)?, path, warnings)
}

/// Writes the project to `path`, whole or not at all.
///
/// Fails on a project that [`load`] would refuse, and leaves the old file alone then.
pub fn save(project: &Project, path: &Path) -> Result<(), FileError> {
    let text = write(project);
    // Unknown keys were warned about when they came in.
    read(text.as_bytes(), path, &mut Warnings::new())
        .map_err(|error| FileError { line: None, ..error })?;
    atomic_write(path, text.as_bytes())
}

/// Reads the text of a project; `path` is named in messages only.
pub fn read(bytes: &[u8], path: &Path, warnings: &mut Warnings) -> Result<Project, FileError> {
    let value = json::parse(bytes, path)?;
    let document =
        Document { path, text: json::without_mark(bytes), warnings: RefCell::new(warnings) };
    decode::decode_project(Node::root(&document, &value))
}

/// The text of a project. The same project gives the same bytes.
pub fn write(project: &Project) -> String {
    json::to_pretty(&encode::encode_project(project))
}

impl Project {
    /// Where the library is, for a project file at `project_path`; `None` for the built-in one.
    pub fn library_path(&self, project_path: &Path) -> Option<PathBuf> {
        relative_to(&self.library, project_path)
    }
}

/// A path written in a project file, as seen from here; `None` for `builtin`.
pub fn relative_to(written: &str, project_path: &Path) -> Option<PathBuf> {
    if written == "builtin" {
        return None;
    }
    let folder = project_path.parent().unwrap_or(Path::new(""));
    Some(folder.join(written))
}

#[cfg(test)]
mod tests;
