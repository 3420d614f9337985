//! The file taken apart: its JSON and its buffers.

use std::path::{Path, PathBuf};

use ::gltf::json::Root;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::content_hash::ContentHash;
use crate::diagnostic::{FileError, quoted};
use crate::limits::{MAX_GLTF_ITEMS, MAX_MOTION_FILE_BYTES};
use crate::read_file::read_file;

/// Extensions that may be required: they change how a surface looks, or are understood.
const KNOWN_EXTENSIONS: [&str; 14] = [
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_materials_specular",
    "KHR_materials_ior",
    "KHR_materials_clearcoat",
    "KHR_materials_sheen",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_emissive_strength",
    "KHR_materials_iridescence",
    "KHR_materials_anisotropy",
    "KHR_materials_variants",
];

/// A glTF file: what it says, and the bytes that it points to.
pub(super) struct Document {
    /// The file, as the user named it.
    pub(super) path: PathBuf,
    /// Its JSON. Indices in it may lead anywhere: use `get`.
    pub(super) root: Root,
    buffers: Vec<Vec<u8>>,
}

impl Document {
    /// Takes apart the bytes of a `.glb` or `.gltf` at `path`, and reads the files it names.
    pub(super) fn new(bytes: &[u8], path: &Path) -> Result<Self, FileError> {
        let (json, bin) = split(bytes, path)?;
        let root = Root::from_slice(json).map_err(|error| {
            let what = format!("it is no glTF 2.0 ({error})");
            let is_text = bin.is_none();
            let error = FileError::new(path, what, "export it again");
            // A binary file has no lines to look at.
            if is_text { error.at_line(1) } else { error }
        })?;
        if !root.asset.version.starts_with("2.") {
            let what = format!("it is glTF {}", quoted(root.asset.version.as_bytes()));
            return Err(FileError::new(path, what, "export it as glTF 2.0"));
        }
        check_extensions(&root, path)?;
        check_counts(&root, path)?;
        let mut document = Self { path: path.to_owned(), root, buffers: Vec::new() };
        document.load_buffers(bin)?;
        Ok(document)
    }

    /// Hash of the file's bytes and of those of the files it names.
    pub(super) fn content_hash(&self, bytes: &[u8]) -> ContentHash {
        let has_files = self.root.buffers.iter().any(|buffer| buffer.uri.is_some());
        if !has_files {
            return ContentHash::of(bytes);
        }
        let mut all = bytes.to_vec();
        for buffer in &self.buffers {
            all.extend_from_slice(buffer);
        }
        ContentHash::of(&all)
    }

    /// An error about this file.
    pub(super) fn error(&self, what: impl Into<String>) -> FileError {
        FileError::new(&self.path, what, "the file is damaged: export it again")
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, view: usize) -> Result<&[u8], FileError> {
        let bad = || self.error(format!("buffer view {view} leads beyond its buffer"));
        let view = self.root.buffer_views.get(view).ok_or_else(bad)?;
        let buffer = self.buffers.get(view.buffer.value()).ok_or_else(bad)?;
        let from = view.byte_offset.map_or(0, |offset| offset.0);
        let to = from.checked_add(view.byte_length.0).ok_or_else(bad)?;
        let range = usize::try_from(from).ok().zip(usize::try_from(to).ok());
        range.and_then(|(from, to)| buffer.get(from..to)).ok_or_else(bad)
    }

    /// The bytes that a URI means: those in it, or those of a file beside this one.
    pub(super) fn resource(&self, uri: &str) -> Result<Vec<u8>, FileError> {
        if let Some(data) = uri.strip_prefix("data:") {
            let bad = || self.error("data within the file is not in base64");
            let (_, text) = data.split_once(";base64,").ok_or_else(bad)?;
            return STANDARD.decode(text).map_err(|_error| bad());
        }
        let name = quoted(uri.as_bytes());
        let relative = PathBuf::from(percent_decoded(uri));
        if uri.contains("://") || relative.is_absolute() {
            let what = format!("it names {name}, which is not a file beside it");
            return Err(FileError::new(&self.path, what, "export it as one .glb"));
        }
        let file = self.path.parent().unwrap_or(Path::new("")).join(relative);
        read_file(&file, MAX_MOTION_FILE_BYTES).map_err(|error| {
            FileError::new(
                &self.path,
                format!("it needs the file {name}: {}", error.what),
                "put that file beside it, or export it as one .glb",
            )
        })
    }

    fn load_buffers(&mut self, bin: Option<&[u8]>) -> Result<(), FileError> {
        let mut n_bytes = 0_u64;
        for idx in 0..self.root.buffers.len() {
            let buffer = &self.root.buffers[idx];
            let mut bytes = match (&buffer.uri, bin) {
                (Some(uri), _) => self.resource(uri)?,
                (None, Some(bin)) if idx == 0 => bin.to_vec(),
                (None, _) => return Err(self.error(format!("buffer {idx} is nowhere"))),
            };
            n_bytes += bytes.len() as u64;
            if n_bytes > MAX_MOTION_FILE_BYTES {
                let what = format!("its data exceeds {} MiB", MAX_MOTION_FILE_BYTES >> 20);
                return Err(FileError::new(&self.path, what, "export less into one file"));
            }
            let claimed = buffer.byte_length.0;
            if (bytes.len() as u64) < claimed {
                let what =
                    format!("buffer {idx} has {} bytes and should have {claimed}", bytes.len());
                return Err(self.error(what));
            }
            bytes.truncate(usize::try_from(claimed).unwrap_or(usize::MAX));
            self.buffers.push(bytes);
        }
        Ok(())
    }
}

/// The JSON of a file and the binary chunk of a `.glb`.
fn split<'a>(bytes: &'a [u8], path: &Path) -> Result<(&'a [u8], Option<&'a [u8]>), FileError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let word = |at: usize| -> Option<u32> {
        Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
    };
    let truncated = || FileError::new(path, "the file ends too early", "copy or export it again");
    let version = word(4).ok_or_else(truncated)?;
    if version != 2 {
        let what = format!("it is a binary glTF of version {version}");
        return Err(FileError::new(path, what, "export it as glTF 2.0"));
    }
    let (mut at, mut json, mut bin) = (12, None, None);
    while at < bytes.len() {
        let length = word(at).ok_or_else(truncated)? as usize;
        let kind = word(at + 4).ok_or_else(truncated)?;
        let end = (at + 8).checked_add(length).ok_or_else(truncated)?;
        let chunk = bytes.get(at + 8..end).ok_or_else(truncated)?;
        match &kind.to_le_bytes() {
            b"JSON" => json = json.or(Some(chunk)),
            b"BIN\0" => bin = bin.or(Some(chunk)),
            // Readers pass over chunks of other kinds.
            _ => {}
        }
        at = end;
    }
    Ok((json.ok_or_else(truncated)?, Some(bin.unwrap_or_default())))
}

fn check_extensions(root: &Root, path: &Path) -> Result<(), FileError> {
    for name in &root.extensions_required {
        let way_out = match name.as_str() {
            "KHR_draco_mesh_compression" => "export it without Draco compression",
            "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
                "export it without meshopt compression (gltfpack -noq and no -c)"
            }
            name if KNOWN_EXTENSIONS.contains(&name) => continue,
            _ => "export it without that extension",
        };
        let what = format!("it needs the extension {}", quoted(name.as_bytes()));
        return Err(FileError::new(path, what, way_out));
    }
    Ok(())
}

/// Lists that loops go over; what they describe has limits of its own.
fn check_counts(root: &Root, path: &Path) -> Result<(), FileError> {
    let counts = [
        ("nodes", root.nodes.len()),
        ("meshes", root.meshes.len()),
        ("accessors", root.accessors.len()),
        ("skins", root.skins.len()),
        ("animations", root.animations.len()),
        ("images", root.images.len()),
        ("buffers", root.buffers.len()),
    ];
    for (what, n) in counts {
        if n > MAX_GLTF_ITEMS {
            let what = format!("it has {n} {what}, more than {MAX_GLTF_ITEMS}");
            return Err(FileError::new(path, what, "export the character alone"));
        }
    }
    Ok(())
}

/// `%20` and the like as the bytes they mean.
fn percent_decoded(uri: &str) -> String {
    let bytes = uri.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let digits = bytes.get(at + 1..at + 3).and_then(|digits| std::str::from_utf8(digits).ok());
        let byte = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        match (bytes[at], byte) {
            (b'%', Some(byte)) => {
                decoded.push(byte);
                at += 3;
            }
            (byte, _) => {
                decoded.push(byte);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&decoded).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_decoded() {
        assert_eq!(percent_decoded("a%20b%C3%A9.bin"), "a bé.bin");
        assert_eq!(percent_decoded("100%"), "100%");
    }
}
