//! The library file, `.gwlib`: clips and their graph, ready for use, checked to the last bit when it is opened.
//!
//! It holds no times and no paths of the machine, so the same clips give the same bytes.

mod clips;
mod graph;
pub mod part;

use std::path::Path;

use motion_core::clip::ClipSet;
use motion_core::graph::MotionGraph;

use crate::atomic_write::atomic_write;
use crate::container::{Container, ContainerWriter};
use crate::content_hash::ContentHash;
use crate::diagnostic::FileError;
use crate::limits::MAX_LIBRARY_FILE_BYTES;
use crate::read_file::read_file;

/// The version that is written, and the newest that is read.
pub const FORMAT_VERSION: u32 = 1;

/// A library as a file holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryFile {
    /// The clips, floors calibrated.
    pub clips: ClipSet,
    /// Hash of the file that each clip came from, in the order of the clips.
    pub content_hashes: Vec<ContentHash>,
    /// The graph that was built from the clips.
    pub graph: MotionGraph,
}

impl LibraryFile {
    /// The bytes of the file and its content hash. The same library gives the same bytes.
    pub fn to_bytes(&self) -> (Vec<u8>, ContentHash) {
        let mut container = ContainerWriter::new();
        clips::add_clips(&mut container, &self.clips, &self.content_hashes);
        graph::add_graph(&mut container, &self.graph);
        container.finish(FORMAT_VERSION)
    }

    /// Reads the bytes of a library file and its content hash; `path` is named in messages.
    pub fn from_bytes(bytes: &[u8], path: &Path) -> Result<(Self, ContentHash), FileError> {
        let container = Container::read(bytes, path, FORMAT_VERSION)?;
        let (clips, content_hashes) = clips::read_clips(&container)?;
        let graph = graph::read_graph(&container, &clips)?;
        Ok((Self { clips, content_hashes, graph }, container.content_hash()))
    }

    /// Writes the library to `path`, whole or not at all; returns its content hash.
    pub fn save(&self, path: &Path) -> Result<ContentHash, FileError> {
        let (bytes, content_hash) = self.to_bytes();
        atomic_write(path, &bytes)?;
        Ok(content_hash)
    }

    /// Reads the library at `path` and its content hash. Damage of any kind is refused.
    pub fn load(path: &Path) -> Result<(Self, ContentHash), FileError> {
        Self::from_bytes(&read_file(path, MAX_LIBRARY_FILE_BYTES)?, path)
    }
}

#[cfg(test)]
mod tests;
