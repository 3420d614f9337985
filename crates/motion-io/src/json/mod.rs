//! JSON with line numbers in, and JSON that a person can read out.

mod locate;
mod node;
mod pretty;

use std::path::Path;

use serde_json::Value;

use crate::diagnostic::FileError;

pub(crate) use node::{Document, Node, Object};
pub use pretty::to_pretty;

/// The value that the text is; fails with the line of the first fault.
///
/// A UTF-8 byte order mark is skipped. Values nested more than 127 deep are refused.
pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Value, FileError> {
    let text = without_mark(bytes);
    if text.trim_ascii().is_empty() {
        return Err(FileError::new(path, "the file is empty", "check that it is the right file"));
    }
    if let Err(error) = std::str::from_utf8(text) {
        let line = locate::line_at(text, error.valid_up_to());
        return Err(FileError::new(path, "the text is not UTF-8", "save it as UTF-8").at_line(line));
    }
    serde_json::from_slice(text).map_err(|error| {
        let line = u32::try_from(error.line()).unwrap_or(u32::MAX).max(1);
        let said = error.to_string();
        // The line stands in front already.
        let what = said.split(" at line ").next().unwrap_or(&said);
        FileError::new(
            path,
            format!("the JSON is broken at column {}: {what}", error.column()),
            "mend it, or restore an older copy",
        )
        .at_line(line)
    })
}

/// `bytes` behind a UTF-8 byte order mark.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
