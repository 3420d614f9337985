//! Time, defined once.
//!
//! A motion is a list of samples ("frames") at a fixed rate. Frames are counted from 0.
//! `n` frames span `n − 1` intervals, so they last `(n − 1) / fps` seconds:
//!
//! | frames | at 30 fps they last |
//! | --- | --- |
//! | 1 | 0 s: a pose, no duration |
//! | 2 | 1/30 s |
//! | 31 | 1 s |
//!
//! ```
//! use motion_core::units::Fps;
//! let fps = Fps::new(30.0).unwrap();
//! assert_eq!(fps.duration_secs(1), 0.0);
//! assert_eq!(fps.duration_secs(2), 1.0 / 30.0);
//! assert_eq!(fps.duration_secs(31), 1.0);
//! ```

use std::fmt;

/// A frame of a clip or of a motion, counted from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FrameIdx(pub u32);

impl FrameIdx {
    /// The index as an array index.
    #[inline]
    pub fn idx(self) -> usize {
        self.0 as usize
    }

    /// The frame at array index `idx`.
    ///
    /// Clips are limited to far fewer than 2³² frames at import, so the cast never truncates.
    #[inline]
    pub fn from_idx(idx: usize) -> Self {
        debug_assert!(u32::try_from(idx).is_ok(), "frame index {idx} out of range");
        Self(idx as u32)
    }
}

impl fmt::Display for FrameIdx {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A sampling rate in frames per second.
///
/// Invariant: finite and within [`Fps::MIN`]..=[`Fps::MAX`]. Fractions (29.97) are allowed.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Fps(f64);

/// A rate that is not a number between [`Fps::MIN`] and [`Fps::MAX`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{0} frames per second is not a rate; use a number from 1 to 1000")]
pub struct BadFps(pub f64);

impl Fps {
    /// The lowest rate that is accepted.
    pub const MIN: f64 = 1.0;
    /// The highest rate that is accepted.
    pub const MAX: f64 = 1000.0;
    /// The library's rate unless the user says otherwise.
    pub const THIRTY: Self = Self(30.0);

    /// A rate; fails unless it is finite and within the limits.
    pub fn new(frames_per_sec: f64) -> Result<Self, BadFps> {
        if (Self::MIN..=Self::MAX).contains(&frames_per_sec) {
            Ok(Self(frames_per_sec))
        } else {
            Err(BadFps(frames_per_sec))
        }
    }

    /// Frames per second.
    #[inline]
    pub fn get(self) -> f64 {
        self.0
    }

    /// Seconds between neighbouring frames.
    #[inline]
    pub fn frame_secs(self) -> f64 {
        1.0 / self.0
    }

    /// How long `n_frames` frames last: `(n_frames − 1) / fps`, 0 for none or one.
    #[inline]
    pub fn duration_secs(self, n_frames: usize) -> f64 {
        n_frames.saturating_sub(1) as f64 / self.0
    }

    /// The whole number of frames nearest to `secs` (0 for negative times).
    #[inline]
    pub fn frames_in_secs(self, secs: f64) -> usize {
        (secs * self.0).round().max(0.0) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_against_intervals() {
        for (n_frames, secs) in [(0, 0.0), (1, 0.0), (2, 1.0 / 30.0), (31, 1.0), (61, 2.0)] {
            assert_eq!(Fps::THIRTY.duration_secs(n_frames), secs, "{n_frames} frames");
        }
    }

    #[test]
    fn rates_outside_the_limits_are_refused() {
        for bad in [0.0, -30.0, f64::NAN, f64::INFINITY, 1000.1] {
            assert!(Fps::new(bad).is_err(), "{bad} must be refused");
        }
        assert_eq!(Fps::new(29.97).map(Fps::get), Ok(29.97));
    }
}
