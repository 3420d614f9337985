//! Words for what happens in a clip, from its file's name and a folder's `INDEX.tsv`.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::diagnostic::Warnings;
use crate::limits::MAX_INDEX_FILE_BYTES;
use crate::read_file::read_file;

/// Words that say nothing about a motion.
const STOP_WORDS: [&str; 14] = [
    "the", "and", "of", "to", "with", "in", "on", "at", "then", "an", "from", "for", "by", "degree",
];

/// The words of a name or a sentence: small letters, each once, numbers and single letters left
/// out. `walk_turnLeft2, 90-degree` has `walk`, `turn`, `left`.
pub fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut word = String::new();
    let mut was_small = false;
    // A blank at the end closes the last word.
    for c in text.chars().chain([' ']) {
        if !c.is_alphabetic() || (c.is_uppercase() && was_small) {
            let is_word = word.chars().count() > 1 && !STOP_WORDS.contains(&word.as_str());
            if is_word && !words.contains(&word) {
                words.push(word.clone());
            }
            word.clear();
        }
        if c.is_alphabetic() {
            word.extend(c.to_lowercase());
        }
        was_small = c.is_lowercase();
    }
    words
}

/// Descriptions of clips from the `INDEX.tsv` of their folders, each read once.
///
/// The file has a line per clip behind a line of column names: a column `file` and one whose name
/// ends in `description`. A folder without such a file describes nothing; one that cannot be read
/// is warned about.
#[derive(Clone, Debug, Default)]
pub struct ClipIndex {
    folders: HashMap<PathBuf, HashMap<String, String>>,
}

impl ClipIndex {
    /// The description of the motion file at `path`; empty where there is none.
    pub fn description(&mut self, path: &Path, warnings: &mut Warnings) -> &str {
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let index = self.folders.entry(folder).or_insert_with_key(|folder| {
            let path = folder.join("INDEX.tsv");
            if !path.exists() {
                return HashMap::new();
            }
            match read_file(&path, MAX_INDEX_FILE_BYTES) {
                Ok(bytes) => descriptions(&String::from_utf8_lossy(&bytes)),
                Err(error) => {
                    warnings.warn(
                        &path,
                        None,
                        format!("{}; clips get no words from it", error.what),
                    );
                    HashMap::new()
                }
            }
        });
        index.get(name.as_ref()).map_or("", String::as_str)
    }
}

fn descriptions(text: &str) -> HashMap<String, String> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap_or_default().split('\t').collect();
    let file = header.iter().position(|name| name.trim() == "file");
    let description = header.iter().position(|name| name.trim().ends_with("description"));
    let (Some(file), Some(description)) = (file, description) else { return HashMap::new() };
    lines
        .filter_map(|line| {
            let cells: Vec<&str> = line.split('\t').collect();
            Some((cells.get(file)?.trim().to_owned(), cells.get(description)?.trim().to_owned()))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_plain() {
        assert_eq!(words("walk_turnLeft2, 90-degree"), ["walk", "turn", "left"]);
        assert_eq!(words("16_15"), [""; 0]);
        assert_eq!(words("run/jog, veer right"), ["run", "jog", "veer", "right"]);
        assert_eq!(words("Run Jump Over a run"), ["run", "jump", "over"]);
    }

    #[test]
    fn an_index_is_read_by_its_column_names() {
        let text = "subject\tfile\tcmu_description\tx\n1\ta.bvh\twalk\t2\n2\tb.bvh\n";
        let index = descriptions(text);
        assert_eq!(index.get("a.bvh").map(String::as_str), Some("walk"));
        assert_eq!(index.len(), 1);
        assert!(descriptions("a\tb\n1\t2").is_empty());
        assert!(descriptions("").is_empty());
    }
}
