//! A part of a library that is built by several machines, `.gwpart`: the edges that one of them
//! found, and in the first part the clips.
//!
//! It is a container like the library, with the sections `part` and `found`.

use std::path::Path;

use motion_core::clip::ClipSet;
use motion_core::graph::GraphPart;
use motion_core::similarity::{DirectedEdges, Shard};

use super::{FORMAT_VERSION, clips};
use crate::atomic_write::atomic_write;
use crate::bytes::{ByteReader, ByteWriter, Fault};
use crate::container::{Container, ContainerWriter};
use crate::content_hash::ContentHash;
use crate::diagnostic::FileError;
use crate::limits::MAX_LIBRARY_FILE_BYTES;
use crate::read_file::read_file;

/// A part as a file holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryPart {
    /// The edges that were found.
    pub graph: GraphPart,
    /// Whether the library will have bridges.
    pub bridges: bool,
    /// The clips and the hash of the file that each came from; in the first part only.
    pub clips: Option<(ClipSet, Vec<ContentHash>)>,
}

impl LibraryPart {
    /// Writes the part to `path`, whole or not at all.
    pub fn save(&self, path: &Path) -> Result<(), FileError> {
        let mut container = ContainerWriter::new();
        let mut part = ByteWriter::new();
        part.u32(self.graph.shard.nth());
        part.u32(self.graph.shard.n());
        part.f64(self.graph.tau);
        part.f64(self.graph.tau_used);
        part.u64(self.graph.fingerprint);
        part.u8(u8::from(self.bridges));
        part.u8(u8::from(self.clips.is_some()));
        container.add("part", part.into_bytes());
        let (starts, to, costs) = self.graph.edges.columns();
        let mut found = ByteWriter::new();
        found.u32_slice(starts);
        found.u32_slice(to);
        found.f32_slice(costs);
        container.add("found", found.into_bytes());
        if let Some((set, hashes)) = &self.clips {
            clips::add_clips(&mut container, set, hashes);
        }
        atomic_write(path, &container.finish(FORMAT_VERSION).0)
    }

    /// Reads the part at `path`. Damage of any kind is refused, and so is a library.
    pub fn load(path: &Path) -> Result<Self, FileError> {
        let bytes = read_file(path, MAX_LIBRARY_FILE_BYTES)?;
        let container = Container::read(&bytes, path, FORMAT_VERSION)?;
        if container.find("part").is_none() {
            let what = "it is a library and not a part of one";
            return Err(FileError::new(path, what, "name what `library build --shard` wrote"));
        }
        let (mut graph, bridges, has_clips) = container.section("part", read_part)?;
        graph.edges = container.section("found", read_edges)?;
        let clips = if has_clips { Some(clips::read_clips(&container)?) } else { None };
        Ok(Self { graph, bridges, clips })
    }
}

fn read_part(reader: &mut ByteReader<'_>) -> Result<(GraphPart, bool, bool), Fault> {
    let shard = Shard::new(reader.u32()?, reader.u32()?).ok_or(Fault::Value("share"))?;
    let (tau, tau_used) = (reader.f64()?, reader.f64()?);
    if !(tau.is_finite() && tau_used > 0.0 && tau_used <= tau) {
        return Err(Fault::Value("threshold"));
    }
    let fingerprint = reader.u64()?;
    let edges = DirectedEdges::default();
    let graph = GraphPart { shard, tau, tau_used, fingerprint, edges };
    Ok((graph, reader.u8()? != 0, reader.u8()? != 0))
}

fn read_edges(reader: &mut ByteReader<'_>) -> Result<DirectedEdges, Fault> {
    let columns = (reader.u32_vec()?, reader.u32_vec()?, reader.f32_vec()?);
    DirectedEdges::from_columns(columns.0, columns.1, columns.2).ok_or(Fault::Value("edges"))
}

#[cfg(test)]
mod tests {
    use super::super::tests::small;
    use super::*;

    #[test]
    fn parts_come_back_and_libraries_are_told() {
        let dir = tempfile::tempdir().unwrap();
        let library = small();
        let n_rows = library.clips.n_frames();
        let edges = DirectedEdges::collect(n_rows, |row, list| {
            list.push(((row as u32 + 3) % n_rows as u32, row as f32));
        });
        let shard = Shard::new(1, 3).unwrap();
        let graph = GraphPart { shard, tau: 0.5, tau_used: 0.25, fingerprint: 7, edges };
        let path = dir.path().join("a.gwpart");
        for clips in [None, Some((library.clips.clone(), library.content_hashes.clone()))] {
            let part = LibraryPart { graph: graph.clone(), bridges: true, clips };
            part.save(&path).unwrap();
            assert_eq!(LibraryPart::load(&path).unwrap(), part);
        }
        library.save(&path).unwrap();
        let error = LibraryPart::load(&path).unwrap_err();
        assert_eq!(error.what, "it is a library and not a part of one");
    }
}
