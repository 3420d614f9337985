//! How long the motion shall be.

use motion_core::constraint::{LengthMode, LengthWish};
use motion_io::project_file;

/// The wish of a length; none where no number is said.
pub(super) fn wish(length: &project_file::Length) -> Option<LengthWish> {
    let mode = match length.mode {
        project_file::LengthMode::Free => LengthMode::Free,
        project_file::LengthMode::Preferred => LengthMode::Preferred,
        project_file::LengthMode::Exact => LengthMode::Exact,
    };
    let weight = length.weight.unwrap_or(1.0) as f32;
    length.frames.map(|frames| LengthWish { frames, mode, weight })
}
