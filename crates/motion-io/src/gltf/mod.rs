//! glTF 2.0: characters with their meshes, and animations as motions.
//!
//! [`read_character`] gives a [`Character`]: our skeleton and a mesh in its rest pose. Animations are
//! read with [`read_motion_file`](crate::import::read_motion_file) like any other motion; a
//! character and the motions of one file have the same skeleton.
//!
//! How the file is understood:
//!
//! * The rest pose is the one in which the mesh was bound (the inverse of its inverse bind
//!   matrices), whatever places, rotations and scales its nodes have; see `body.rs`.
//! * Several skins, meshes and nodes are one character. A mesh without a skin that hangs on a
//!   joint follows it rigidly; others are left out with a warning.
//! * Lengths are metres, as the format says, where that makes a person; else they are
//!   [guessed](crate::guess) like those of other files.
//! * Of more than four influences of a vertex the four strongest count. Shapes that are blended
//!   (morph targets) stay at rest.
//! * Compressed data (Draco, meshopt) is refused with a word on what to do.

mod accessor;
mod animation;
mod body;
mod bound;
mod character;
mod document;
mod fit;
mod material;
mod mesh;
mod motion;
mod nodes;
#[cfg(test)]
mod test_file;
#[cfg(test)]
mod tests;

pub use character::{Character, CharacterOptions, read_character};
pub use material::{Alpha, Material, Texture};
pub use mesh::{Mesh, Part};

pub(crate) use fit::guess_metres;
pub(crate) use motion::read_raw_motion;

/// Extensions of glTF files, in small letters.
pub const GLTF_EXTENSIONS: [&str; 2] = ["glb", "gltf"];

/// Whether a path is that of a glTF file, by its extension.
pub fn is_gltf(path: &std::path::Path) -> bool {
    path.extension()
        .is_some_and(|extension| GLTF_EXTENSIONS.iter().any(|e| extension.eq_ignore_ascii_case(e)))
}
