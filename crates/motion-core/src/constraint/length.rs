//! How long a motion shall be.

use super::TOLERANCE_FRAMES;

/// How strictly a length is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthMode {
    /// Any length will do.
    Free,
    /// Soft: the square of the difference in tolerances is added to the score.
    #[default]
    Preferred,
    /// Hard: other lengths are no solutions.
    Exact,
}

/// The wished number of frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthWish {
    /// Frames in all.
    pub frames: u32,
    /// How strictly.
    pub mode: LengthMode,
    /// Factor of the squared error.
    pub weight: f32,
}

impl LengthWish {
    /// What a motion of `n_frames` adds to the score; infinite where the length is exact and
    /// missed.
    #[inline]
    pub fn cost(&self, n_frames: u32) -> f32 {
        let error = n_frames as f32 - self.frames as f32;
        match self.mode {
            LengthMode::Free => 0.0,
            LengthMode::Preferred => self.weight * (error / TOLERANCE_FRAMES).powi(2),
            LengthMode::Exact if error == 0.0 => 0.0,
            LengthMode::Exact => f32::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_frames_are_one_tolerance() {
        let wish = |mode| LengthWish { frames: 100, mode, weight: 2.0 };
        for (mode, n_frames, cost) in [
            (LengthMode::Free, 500, 0.0),
            (LengthMode::Preferred, 110, 2.0),
            (LengthMode::Preferred, 80, 8.0),
            (LengthMode::Exact, 100, 0.0),
            (LengthMode::Exact, 101, f32::INFINITY),
        ] {
            assert_eq!(wish(mode).cost(n_frames), cost, "{mode:?} at {n_frames} frames");
        }
    }
}
