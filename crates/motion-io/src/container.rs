//! A file of named sections, each with its checksum: what a `.gwlib` is made of.
//!
//! All numbers are little-endian. The file begins with
//!
//! | bytes | what |
//! | --- | --- |
//! | 6 | `GWLIB\0` |
//! | 4 | version of what is in it (`u32`) |
//! | 4 | number of sections (`u32`) |
//! | 32 | BLAKE3 of the table |
//!
//! then the table: for each section its name (`u32` length and UTF-8), the length of its bytes
//! (`u64`) and their BLAKE3 (32 bytes); then the sections' bytes in the same order, and nothing
//! behind them. A length is believed only after it was compared with the bytes that are there, so
//! a damaged file costs an error and no memory.

use std::path::Path;

use rayon::prelude::*;

use crate::bytes::{ByteReader, ByteWriter, Fault};
use crate::content_hash::ContentHash;
use crate::diagnostic::FileError;
use crate::limits::MAX_SECTIONS;

const MAGIC: &[u8; 6] = b"GWLIB\0";
const MAKE_AGAIN: &str = "build the library again";

/// Builds the bytes of a container.
#[derive(Debug, Default)]
pub struct ContainerWriter {
    sections: Vec<(String, Vec<u8>)>,
}

impl ContainerWriter {
    /// No sections yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a section behind the others. Names are the caller's and must differ.
    pub fn add(&mut self, name: &str, bytes: Vec<u8>) {
        debug_assert!(self.sections.iter().all(|(known, _)| known != name), "{name:?} twice");
        self.sections.push((name.to_owned(), bytes));
    }

    /// The file's bytes and what identifies its content. The same sections give the same bytes.
    pub fn finish(self, version: u32) -> (Vec<u8>, ContentHash) {
        let mut table = ByteWriter::new();
        for (name, bytes) in &self.sections {
            table.str(name);
            table.u64(bytes.len() as u64);
            table.raw(blake3::hash(bytes).as_bytes());
        }
        let table = table.into_bytes();
        let n_bytes: usize = self.sections.iter().map(|(_, bytes)| bytes.len()).sum();
        let mut out = ByteWriter::with_capacity(n_bytes + table.len() + 64);
        out.raw(MAGIC);
        out.u32(version);
        out.u32(u32::try_from(self.sections.len()).unwrap_or(u32::MAX));
        let content_hash = ContentHash::of(&table);
        out.raw(&content_hash.0);
        out.raw(&table);
        // A section goes as soon as it is in its place, so that a large file is not there twice.
        for (_, bytes) in self.sections {
            out.raw(&bytes);
        }
        (out.into_bytes(), content_hash)
    }
}

/// A container whose table was read and whose checksums are right.
#[derive(Debug)]
pub struct Container<'a> {
    path: &'a Path,
    version: u32,
    content_hash: ContentHash,
    sections: Vec<(&'a str, &'a [u8])>,
}

impl<'a> Container<'a> {
    /// Reads the table of `file` and checks every section against its checksum.
    ///
    /// `path` is named in messages. Refuses other files, versions newer than `newest_version`,
    /// and any damage, however small.
    pub fn read(file: &'a [u8], path: &'a Path, newest_version: u32) -> Result<Self, FileError> {
        let damaged = |fault: Fault| {
            FileError::new(path, format!("the library file is damaged ({fault})"), MAKE_AGAIN)
        };
        let mut reader = ByteReader::new(file);
        if reader.raw(MAGIC.len()).ok() != Some(&MAGIC[..]) {
            return Err(FileError::new(
                path,
                "it is not a Gaitway library",
                "check the path, or build one with gaitway library build",
            ));
        }
        let version = reader.u32().map_err(damaged)?;
        if version > newest_version {
            return Err(FileError::new(
                path,
                format!(
                    "the library is version {version}, newer than the {newest_version} that is \
                     known here"
                ),
                "use a newer Gaitway, or build the library again",
            ));
        }
        let n_sections = reader.u32().map_err(damaged)?;
        if n_sections > MAX_SECTIONS {
            return Err(damaged(Fault::Value("number of sections")));
        }
        let (content_hash, sections) = read_sections(&mut reader, n_sections).map_err(damaged)?;
        Ok(Self { path, version, content_hash, sections })
    }

    /// The version of what is in it.
    pub fn version(&self) -> u32 {
        self.version
    }

    /// What identifies the content: the hash of the table, which holds the hashes of all sections.
    pub fn content_hash(&self) -> ContentHash {
        self.content_hash
    }

    /// The names of the sections, in order.
    pub fn names(&self) -> impl Iterator<Item = &'a str> {
        self.sections.iter().map(|&(name, _)| name)
    }

    /// The bytes of the section called `name`, if there is one.
    pub fn find(&self, name: &str) -> Option<&'a [u8]> {
        self.sections.iter().find(|(known, _)| *known == name).map(|&(_, bytes)| bytes)
    }

    /// Reads the section called `name` to its end with `read`.
    ///
    /// Fails where there is none, where `read` does, and where it leaves bytes unread.
    pub fn section<T>(
        &self,
        name: &str,
        read: impl FnOnce(&mut ByteReader<'a>) -> Result<T, Fault>,
    ) -> Result<T, FileError> {
        let Some(bytes) = self.find(name) else {
            let what = format!("the library file has no section {name:?}");
            return Err(FileError::new(self.path, what, MAKE_AGAIN));
        };
        let mut reader = ByteReader::new(bytes);
        let result = read(&mut reader).and_then(|value| reader.finish().map(|()| value));
        self.checked(name, result)
    }

    /// The result of a check on what was read from the section called `name`.
    pub fn checked<T>(
        &self,
        name: &str,
        result: Result<T, impl std::fmt::Display>,
    ) -> Result<T, FileError> {
        result.map_err(|fault| {
            let what = format!("section {name:?} of the library file is wrong ({fault})");
            FileError::new(self.path, what, MAKE_AGAIN)
        })
    }
}

type Sections<'a> = Vec<(&'a str, &'a [u8])>;

/// The table's hash and the sections, all checksums checked.
fn read_sections<'a>(
    reader: &mut ByteReader<'a>,
    n_sections: u32,
) -> Result<(ContentHash, Sections<'a>), Fault> {
    let table_hash = reader.raw(32)?;
    let table_start = reader.rest();
    let mut table = Vec::new();
    for _ in 0..n_sections {
        let name = reader.str()?;
        let len = usize::try_from(reader.u64()?).or(Err(Fault::Length))?;
        table.push((name, len, reader.raw(32)?));
    }
    let content_hash = ContentHash::of(&table_start[..table_start.len() - reader.rest().len()]);
    if content_hash.0 != table_hash {
        return Err(Fault::Checksum("its table".to_owned()));
    }
    let mut sections = Vec::with_capacity(table.len());
    for &(name, len, _) in &table {
        sections.push((name, reader.raw(len)?));
    }
    reader.finish()?;
    // Hashing is most of the time that opening a large library takes.
    let wrong = sections
        .par_iter()
        .zip(&table)
        .position_first(|(&(_, bytes), &(_, _, hash))| ContentHash::of(bytes).0 != hash);
    match wrong {
        Some(at) => Err(Fault::Checksum(format!("section {:?}", sections[at].0))),
        None => Ok((content_hash, sections)),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sample() -> Vec<u8> {
        let mut numbers = ByteWriter::new();
        numbers.u32_slice(&[1, 2, 3]);
        let mut writer = ContainerWriter::new();
        writer.add("numbers", numbers.into_bytes());
        writer.add("empty", Vec::new());
        writer.finish(3).0
    }

    fn error_of(bytes: &[u8]) -> String {
        Container::read(bytes, Path::new("a.gwlib"), 3).expect_err("must be refused").to_string()
    }

    #[test]
    fn sections_come_back() {
        let bytes = sample();
        let container = Container::read(&bytes, Path::new("a.gwlib"), 3).unwrap();
        assert_eq!(container.version(), 3);
        assert_eq!(container.names().collect::<Vec<_>>(), ["numbers", "empty"]);
        assert_eq!(container.section("numbers", |r| r.u32_vec()).unwrap(), [1, 2, 3]);
        assert_eq!(
            container.section("none", |_| Ok(())).unwrap_err().to_string(),
            "a.gwlib: the library file has no section \"none\"; build the library again"
        );
        assert_eq!(
            container.section("numbers", |r| r.u32()).unwrap_err().to_string(),
            "a.gwlib: section \"numbers\" of the library file is wrong (16 bytes are left over); \
             build the library again"
        );
    }

    #[test]
    fn other_files_and_newer_versions_are_refused() {
        assert_eq!(
            error_of(b"GWLI"),
            "a.gwlib: it is not a Gaitway library; check the path, or build one with gaitway \
             library build"
        );
        assert_eq!(
            error_of(&ContainerWriter::new().finish(4).0),
            "a.gwlib: the library is version 4, newer than the 3 that is known here; use a newer \
             Gaitway, or build the library again"
        );
    }

    #[test]
    fn every_flipped_bit_is_noticed() {
        let bytes = sample();
        for at in 0..bytes.len() {
            for bit in 0..8 {
                let mut damaged = bytes.clone();
                damaged[at] ^= 1 << bit;
                // An older version is for the reader of the sections to refuse.
                let is_version = (6..10).contains(&at);
                let read = Container::read(&damaged, Path::new("a.gwlib"), 3);
                assert!(read.is_err() || is_version, "byte {at}, bit {bit}");
            }
        }
    }

    #[test]
    fn every_cut_and_every_addition_is_noticed() {
        let bytes = sample();
        for len in 0..bytes.len() {
            error_of(&bytes[..len]);
        }
        assert_eq!(
            error_of(&[&bytes[..], &[0]].concat()),
            "a.gwlib: the library file is damaged (1 bytes are left over); build the library again"
        );
    }

    proptest! {
        #[test]
        fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            drop(Container::read(&bytes, Path::new("a"), 3));
            let with_magic = [&MAGIC[..], &[3, 0, 0, 0, 1, 0, 0, 0], &bytes].concat();
            drop(Container::read(&with_magic, Path::new("a"), 3));
        }
    }
}
