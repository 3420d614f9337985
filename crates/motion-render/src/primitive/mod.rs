//! What can be drawn, one kind a file.
//!
//! Each kind has a renderer that owns its pipelines and buffers: `new` makes the pipelines once,
//! `prepare` turns the scene's data into buffers for one picture, and `draw` functions record it
//! into a pass. A new kind is a file here, a shader of the same name, a line in
//! `shader_source.rs`, and its place in the order of [`crate::renderer`].

pub(crate) mod flats;
pub(crate) mod ground;
pub(crate) mod ground_shade;
pub(crate) mod labels;
pub(crate) mod lines;
pub(crate) mod outline;
pub(crate) mod skinned_mesh;
pub(crate) mod sky;
pub(crate) mod solids;
