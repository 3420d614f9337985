//! What a file does not say and its body shows: the unit of length, which way is up, where the
//! rest pose looks, and whether the first frames are a T-pose.
//!
//! Every guess says whether it is sure, has a word for the report, and can be overridden.

mod conform;
mod facing;
mod scale;
#[cfg(test)]
pub(crate) mod test_body;
mod tpose;
mod up_axis;

pub use conform::{Conform, conform, conform_skeleton};
pub use facing::canonical_from_rest;
pub use scale::{LengthUnit, guess_unit, hip_height_units};
pub use tpose::n_leading_tpose_frames;
pub use up_axis::{UpAxis, guess_up_axis};

/// A value that was recognised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess<T> {
    /// What it is taken for.
    pub value: T,
    /// Whether little else is possible; otherwise a person should look.
    pub sure: bool,
}
