//! Pictures and films of motions, without a window.
//!
//! [`input`] puts a file on a stage, in a body from the [`wardrobe`]; [`painter`] draws it; [`sheet`]
//! lays many pictures out as one, [`film`] makes them follow each other. What is shown, and from where, is motion-session's to say.

pub(crate) mod input;
pub(crate) mod wardrobe;

pub(crate) mod painter;

pub(crate) mod canvas;
pub(crate) mod sheet;
pub(crate) mod sheet_layout;

pub(crate) mod film;
pub(crate) mod film_frames;

pub(crate) mod format;
pub(crate) mod png;

pub(crate) mod delays;
pub(crate) mod gif_film;
pub(crate) mod palette;

pub(crate) mod video;
