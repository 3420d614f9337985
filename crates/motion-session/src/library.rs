//! A library: clips and the graph over them.

use std::sync::Arc;

use motion_core::clip::ClipSet;
use motion_core::graph::MotionGraph;
use motion_io::content_hash::ContentHash;
use motion_io::library_file::LibraryFile;

/// Clips and their graph. Cheap to clone, so that jobs can have a snapshot.
#[derive(Clone, Debug)]
pub struct Library {
    /// The clips.
    pub clips: Arc<ClipSet>,
    /// Where they may be cut.
    pub graph: Arc<MotionGraph>,
    /// Hash of the file that each clip came from.
    pub content_hashes: Arc<[ContentHash]>,
    /// Hash of the whole, known once it was saved or loaded: two libraries with the same one are
    /// the same.
    pub hash: Option<ContentHash>,
}

impl Library {
    /// The library of `file`, whose bytes have this hash.
    pub fn new(file: LibraryFile, hash: Option<ContentHash>) -> Self {
        let LibraryFile { clips, content_hashes, graph } = file;
        Self {
            clips: Arc::new(clips),
            graph: Arc::new(graph),
            content_hashes: content_hashes.into(),
            hash,
        }
    }

    /// Every cut from one clip to another, bridges among them, by `(from, to)` frame.
    ///
    /// Fails with the id that is no clip.
    pub fn edges(&self, from: &str, to: &str) -> Result<Vec<CutLine>, String> {
        let id = |name: &str| self.clips.by_id(name).ok_or_else(|| name.to_owned());
        let (from, to) = (id(from)?, id(to)?);
        let tau = self.graph.leaf_edges(from, to).into_iter().map(|edge| (edge, false));
        let bridges = self.graph.bridges(from, to).into_iter().map(|edge| (edge, true));
        let mut lines: Vec<CutLine> = tau
            .chain(bridges)
            .map(|(edge, bridge)| CutLine {
                from_frame: edge.from_frame.0,
                to_frame: edge.to_frame.0,
                cost: edge.cost,
                bridge,
            })
            .collect();
        lines.sort_by_key(|line| (line.from_frame, line.to_frame));
        Ok(lines)
    }

    /// The clip ids most like `name`, for a message about one that is not there.
    pub fn similar_ids(&self, name: &str) -> Vec<&str> {
        let name = name.to_lowercase();
        let mut scored: Vec<(usize, &str)> = self
            .clips
            .clips()
            .iter()
            .map(|clip| (edit_distance(&name, &clip.id.to_lowercase()), clip.id.as_str()))
            .collect();
        scored.sort_unstable();
        scored.into_iter().take(3).map(|(_, id)| id).collect()
    }
}

/// One cut of `library edges`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct CutLine {
    /// The frame that is not shown any more.
    pub from_frame: u32,
    /// The frame that is shown in its place.
    pub to_frame: u32,
    /// What the cut costs.
    pub cost: f32,
    /// Whether it is there only because τ leaves parts apart.
    pub bridge: bool,
}

/// Letters to insert, delete or replace until `a` is `b` (Levenshtein).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_between_names() {
        for (a, b, n) in [("", "abc", 3), ("walk", "walk", 0), ("wlak", "walk", 2), ("a", "b", 1)] {
            assert_eq!(edit_distance(a, b), n, "{a} to {b}");
        }
    }
}
