//! Draws scenes with wgpu.
//!
//! [`motion_scene::scene::Scene`] (what) and [`view::View`] (from where, how large) go into
//! [`renderer::Renderer::draw`], which writes buffers and records passes; the picture is in
//! [`targets::Targets`]. [`offscreen::Offscreen`] does all of it without a window and gives bytes;
//! [`picking::Picker`] says what is under a pointer.
//!
//! Who owns what: [`gpu::Gpu`] is a device, made here or by a window; a renderer holds pipelines,
//! uploaded models and buffers, for as long as the device lives; targets belong to a picture's
//! size. Nothing is made on the device in steady state, which [`gpu::Created`] counts.
//!
//! Shaders are in `/shaders`, one file for each file in `primitive`, with shared parts in
//! `/shaders/common`.
//!
//! It knows nothing of clips, graphs or constraints, and of no window library.

pub mod offscreen;
pub mod picking;
pub mod picture;
pub mod renderer;
pub mod view;

pub mod gpu;
pub mod targets;

pub mod skinning_check;

mod primitive;

mod frame_uniform;
mod frustum;
mod glyph_atlas;
mod mesh_cache;
mod mipmaps;
mod shadow;
mod shared_bindings;
mod solid_shapes;

mod buffers;
mod pipeline;
mod readback;
mod shader_source;
