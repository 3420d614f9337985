//! Files in and out. Every failure names the file, the line and a way out; no input panics.
//!
//! | format | in | out |
//! | --- | --- | --- |
//! | `.bvh` | [`bvh::read`] | [`bvh::save`] |
//! | `.glb`, `.gltf` | [`gltf::read_character`], [`import::read_motion_file`] | |
//! | `.gaitway` | [`project_file::load`] | [`project_file::save`] |
//! | `.gwlib` | [`library_file::LibraryFile::load`] | [`library_file::LibraryFile::save`] |
//! | `report.json`, `timing.json` | | [`report_file::save`] |
//!
//! [`import::import_files`] makes a library's clips of files and folders; [`guess`] recognises what
//! files do not say.
//!
//! Reading begins with [`read_file`](read_file::read_file), which keeps to the [`limits`];
//! writing ends with [`atomic_write`](atomic_write::atomic_write) or, for what is too large to be
//! held at once, a [`PendingFile`](pending_file::PendingFile).

pub mod atomic_write;
pub mod bvh;
pub mod bytes;
pub mod container;
pub mod content_hash;
pub mod diagnostic;
pub mod gltf;
pub mod guess;
pub mod import;
pub mod json;
pub mod library_file;
pub mod limits;
pub mod pending_file;
pub mod project_file;
pub mod read_file;
pub mod report_file;
pub mod roles_file;
pub mod text;
