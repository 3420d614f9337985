//! How far off is still well, in human units.

use super::{TOLERANCE_FRAMES, TOLERANCE_M, TOLERANCE_RAD};

/// An error of this much counts 1 (times its weight) and is the last that is well.
///
/// An infinite tolerance means that nothing is asked: a body constraint with an infinite heading
/// tolerance is one for a place alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of place and height, metres; above 0.
    pub position_m: f32,
    /// Of heading, radians; above 0.
    pub heading_rad: f32,
    /// Of time, frames; above 0.
    pub frames: f32,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { position_m: TOLERANCE_M, heading_rad: TOLERANCE_RAD, frames: TOLERANCE_FRAMES }
    }
}

impl Tolerance {
    /// Whether every part is a number above 0 (infinity is one).
    pub fn is_valid(&self) -> bool {
        self.position_m > 0.0 && self.heading_rad > 0.0 && self.frames > 0.0
    }
}
