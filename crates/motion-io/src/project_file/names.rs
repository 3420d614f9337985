//! Names: of files that characters become, and of constraints without one.

use std::collections::HashSet;

use crate::diagnostic::{FileError, quoted};
use crate::json::Object;
use crate::limits::MAX_CHARACTER_NAME;

/// Names that Windows keeps for devices, whatever stands behind a dot.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

/// Why `name` cannot begin a file's name on every system, as a half sentence; `None` if it can.
pub fn fault_as_file_name(name: &str) -> Option<&'static str> {
    let stem = name.split('.').next().unwrap_or(name).to_lowercase();
    let is_port = matches!(stem.strip_prefix("com").or(stem.strip_prefix("lpt")),
        Some(number) if number.len() == 1 && number.as_bytes()[0].is_ascii_digit());
    if name.is_empty() {
        Some("is empty")
    } else if name.chars().count() > MAX_CHARACTER_NAME {
        Some("is too long")
    } else if name.chars().any(|c| c.is_control() || "/\\:*?\"<>|".contains(c)) {
        Some("has a character that file names must not have")
    } else if name.starts_with(['.', ' ', '-']) || name.ends_with(['.', ' ']) {
        Some("begins or ends with a character that file names must not")
    } else if DEVICES.contains(&stem.as_str()) || is_port {
        Some("means a device to Windows")
    } else {
        None
    }
}

/// The ids of one list: each at most once, and given where left out.
#[derive(Default)]
pub(super) struct Ids {
    taken: HashSet<String>,
}

impl Ids {
    /// The object's id, or an empty one to be [completed](Self::complete).
    pub(super) fn read(&mut self, object: &mut Object<'_>) -> Result<String, FileError> {
        let Some(node) = object.get("id") else { return Ok(String::new()) };
        let id = node.name()?;
        if !self.taken.insert(id.clone()) {
            return Err(node.error(
                format!("is {} again", quoted(id.as_bytes())),
                "give each its own id, or leave it out",
            ));
        }
        Ok(id)
    }

    /// Gives every empty id the first free `kind-1`, `kind-2`, ….
    ///
    /// Ids that the file has are left alone wherever they stand in it, so this comes last.
    pub(super) fn complete<'i>(
        mut self,
        ids: impl Iterator<Item = (&'i mut String, &'static str)>,
    ) {
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for (id, kind) in ids {
            if !id.is_empty() {
                continue;
            }
            let at = counts.iter().position(|(known, _)| *known == kind).unwrap_or_else(|| {
                counts.push((kind, 0));
                counts.len() - 1
            });
            loop {
                counts[at].1 += 1;
                let given = format!("{kind}-{}", counts[at].1);
                if self.taken.insert(given.clone()) {
                    *id = given;
                    break;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_that_every_system_takes_pass() {
        for name in ["A", "Ada", "Jürgen 2", "left-hand_man", "v1.2", "com", "console"] {
            assert_eq!(fault_as_file_name(name), None, "{name}");
        }
        let long = "x".repeat(65);
        for name in
            ["", "a/b", "..", ".a", "a.", " a", "-q", "a\\b", "a:b", "a\n", "NUL", "com1.x", &long]
        {
            assert!(fault_as_file_name(name).is_some(), "{name:?}");
        }
    }
}
