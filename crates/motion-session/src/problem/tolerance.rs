//! How far off is still well: what the file says, and the usual where it says nothing.

use motion_core::constraint::{TOLERANCE_M, TOLERANCE_RAD, Tolerance};
use motion_io::project_file;

/// A tolerance of 0 is taken as this, metres: nothing is off by less than 0.
const LEAST_M: f32 = 1e-3;
/// A tolerance of 0 is taken as this, radians: a tenth of a degree.
const LEAST_RAD: f32 = 0.1 * std::f32::consts::PI / 180.0;
/// A tolerance of 0 is taken as this, frames.
const LEAST_FRAMES: f32 = 0.1;

/// The tolerance of a place: 10 frames, 0.30 m and 10° where the file says nothing.
pub(super) fn tolerance(asked: Option<&project_file::Tolerance>) -> Tolerance {
    let usual = Tolerance::default();
    let Some(asked) = asked else { return usual };
    Tolerance {
        position_m: position_m(Some(asked)),
        heading_rad: heading_rad(Some(asked)),
        frames: asked.frames.map_or(usual.frames, |frames| (frames as f32).max(LEAST_FRAMES)),
    }
}

/// The part of a tolerance that is about places, metres.
pub(super) fn position_m(asked: Option<&project_file::Tolerance>) -> f32 {
    asked.and_then(|asked| asked.position_m).map_or(TOLERANCE_M, |m| (m as f32).max(LEAST_M))
}

/// The part of a tolerance that is about headings, radians.
pub(super) fn heading_rad(asked: Option<&project_file::Tolerance>) -> f32 {
    let asked_deg = asked.and_then(|asked| asked.heading_deg);
    asked_deg.map_or(TOLERANCE_RAD, |deg| (deg.to_radians() as f32).max(LEAST_RAD))
}
