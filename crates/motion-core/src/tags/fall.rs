//! `fall`: the body goes down fast and is on the ground then.
//!
//! * **Down**: the hip joints are below 0.5 legs and the back leans more than 50°, for at least
//!   0.1 s.
//! * **Fast**: within the 0.9 s before, the hips were above 0.8 legs. Sitting down or lying down
//!   takes longer.
//! * The stretch begins where the hips were last above 0.8 legs and ends when the body is up again,
//!   at most 1.5 s after it came down.

use super::signals::Signals;
use super::span::{TagSpan, lasting, tagged};

const DOWN: f32 = 0.5;
const DOWN_LEAN_RAD: f32 = 0.87;
const UP: f32 = 0.8;
const DESCENT_SECS: f64 = 0.9;
const LIE_SECS: f64 = 1.5;
const MIN_SECS: f64 = 0.1;

/// The stretches of falling.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let fps = signals.fps;
    let is_down =
        |frame: usize| signals.hip_height[frame] < DOWN && signals.lean_rad[frame] > DOWN_LEAN_RAD;
    let down: Vec<bool> = (0..signals.n_frames()).map(is_down).collect();
    let mut found = Vec::new();
    for (from, to) in lasting(&down, 0.2, MIN_SECS, fps) {
        let earliest = from.saturating_sub(fps.frames_in_secs(DESCENT_SECS));
        let stood = (earliest..from).rev().find(|&frame| signals.hip_height[frame] > UP);
        if let Some(stood) = stood {
            found.push((stood, to.min(from + fps.frames_in_secs(LIE_SECS))));
        }
    }
    tagged("fall", found).collect()
}
