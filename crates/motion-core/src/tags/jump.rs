//! `jump`: both feet leave the ground, higher and for longer than between the steps of a run.
//!
//! * **Flight**: no foot is planted and the lower toe joint is more than 0.05 legs above its lowest
//!   level, for 0.2–1.2 s; for at least 0.3 s at the speed of a run (2.1 m/s), whose steps fly too.
//!   (Who sits on a high stool has his feet off the ground for longer.)
//! * **Height**: within the flight the lower toe joint comes to at least 0.12 legs, or the hips
//!   rise by at least 0.10 legs over where they were when the feet left the ground; at the speed
//!   of a run the hips must.
//! * **A body upright**: the back leans less than 70° in the middle of the flight (cartwheels and
//!   rolls are none).
//! * The stretch begins where the hips are lowest in the 0.5 s before the flight and ends where
//!   they are lowest in the 0.4 s behind it: taking off and landing belong to a jump.

use super::gait::RUN;
use super::signals::{Signals, UPRIGHT_RAD};
use super::span::{TagSpan, lasting, tagged};

const TOE_CLEAR: f32 = 0.05;
const FLIGHT_SECS: f64 = 0.2;
const RUNNING_FLIGHT_SECS: f64 = 0.3;
const MAX_FLIGHT_SECS: f64 = 1.2;
const TOE_APEX: f32 = 0.12;
const HIP_RISE: f32 = 0.10;
const TAKE_OFF_SECS: f64 = 0.5;
const LANDING_SECS: f64 = 0.4;

/// The stretches of jumping.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let last = signals.n_frames().saturating_sub(1);
    let lowest = |from: usize, to: usize| {
        let heights = &signals.hip_height;
        (from..=to).min_by(|a, b| heights[*a].total_cmp(&heights[*b])).unwrap_or(from)
    };
    let mut is_jump = vec![false; signals.n_frames()];
    for (from, to) in flights(signals) {
        let rise = {
            let start = signals.hip_height[from];
            signals.hip_height[from..=to].iter().map(|height| height - start).fold(0.0, f32::max)
        };
        let clearance = signals.toe_height[from..=to].iter().copied().fold(0.0, f32::max);
        let is_upright = signals.lean_rad[usize::midpoint(from, to)] < UPRIGHT_RAD;
        let is_high = rise >= HIP_RISE || (clearance >= TOE_APEX && !runs(signals, from, to));
        if is_upright && is_high {
            let before = from.saturating_sub(signals.fps.frames_in_secs(TAKE_OFF_SECS));
            let after = (to + signals.fps.frames_in_secs(LANDING_SECS)).min(last);
            is_jump[lowest(before, from)..=lowest(to, after)].fill(true);
        }
    }
    tagged("jump", lasting(&is_jump, 0.0, FLIGHT_SECS, signals.fps)).collect()
}

/// The stretches in which no foot touches the ground, as long as those of jumps are.
pub(crate) fn flights(signals: &Signals) -> Vec<(usize, usize)> {
    let flies = |frame: usize| !signals.is_planted[frame] && signals.toe_height[frame] > TOE_CLEAR;
    let mask: Vec<bool> = (0..signals.n_frames()).map(flies).collect();
    let frames = |secs| signals.fps.frames_in_secs(secs);
    let mut found = super::span::stretches(mask);
    found.retain(|&(from, to)| {
        let min = frames(if runs(signals, from, to) { RUNNING_FLIGHT_SECS } else { FLIGHT_SECS });
        (min..=frames(MAX_FLIGHT_SECS)).contains(&(to + 1 - from))
    });
    found
}

fn runs(signals: &Signals, from: usize, to: usize) -> bool {
    signals.travel_m_s[usize::midpoint(from, to)].length() >= RUN.enter
}
