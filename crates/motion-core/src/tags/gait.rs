//! `walk`, `run` and `idle`: by how fast the body travels.
//!
//! * **run**: faster than 2.1 m/s, until it is slower than 1.5; for at least 0.3 s. People change
//!   from walking to running at a Froude number of about 0.5, which is 2.0 m/s with the reference
//!   leg; who has begun to run is slower in turns.
//! * **walk**: faster than 0.45 m/s, until it is slower than 0.3, and neither a run nor a jump;
//!   for at least 0.4 s, whatever the direction.
//! * **idle**: no walk and no run, slower than 0.25 m/s, turning by less than 20°/s, head and hands
//!   no faster than 0.6 m/s, hips not as low as in a crouch, a foot on the ground; for at least
//!   0.3 s.
//!
//! Walks and runs are upright (the back leans less than 70°): cartwheels travel too. Gaps of up to
//! 0.2 s in which a rule does not hold are passed over.

use super::height::CROUCH;
use super::jump;
use super::signals::{Signals, UPRIGHT_RAD};
use super::span::{Hysteresis, TagSpan, lasting, tagged};
use crate::units::FrameIdx;

/// Speed of a run, metres per second.
pub(super) const RUN: Hysteresis = Hysteresis { enter: 2.1, leave: 1.5 };
/// Speed of a walk, metres per second.
const WALK: Hysteresis = Hysteresis { enter: 0.45, leave: 0.3 };
const IDLE_TRAVEL_M_S: f32 = 0.25;
const IDLE_TURN_RAD_S: f32 = 0.35;
const IDLE_GESTURE_M_S: f32 = 0.6;
const GAP_SECS: f64 = 0.2;
const RUN_SECS: f64 = 0.3;
const WALK_SECS: f64 = 0.4;
const IDLE_SECS: f64 = 0.3;

/// The stretches of walking, running and standing.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let speeds = || {
        let upright = signals.travel_m_s.iter().zip(&signals.lean_rad);
        upright.map(|(travel, lean)| if *lean < UPRIGHT_RAD { travel.length() } else { 0.0 })
    };
    let jumps = jump::find(signals);
    let low = |frame: usize| signals.hip_height[frame] < CROUCH.leave_below;
    let run = lasting(&RUN.mask(speeds()), GAP_SECS, RUN_SECS, signals.fps);
    let mut is_run = vec![false; signals.n_frames()];
    for &(from, to) in &run {
        is_run[from..=to].fill(true);
    }
    let mut walks = WALK.mask(speeds());
    for (frame, walks) in walks.iter_mut().enumerate() {
        let jumps = jumps.iter().any(|jump| jump.has(FrameIdx::from_idx(frame)));
        *walks &= !is_run[frame] && !jumps;
    }
    let walk = lasting(&walks, 0.0, WALK_SECS, signals.fps);
    let mut is_travel = is_run;
    for &(from, to) in &walk {
        is_travel[from..=to].fill(true);
    }
    let stands = |frame: usize| {
        !is_travel[frame]
            && signals.travel_m_s[frame].length() < IDLE_TRAVEL_M_S
            && signals.turn_rad_s[frame].abs() < IDLE_TURN_RAD_S
            && signals.gesture_m_s[frame] < IDLE_GESTURE_M_S
            && signals.is_planted[frame]
            && !low(frame)
    };
    let idles: Vec<bool> = (0..signals.n_frames()).map(stands).collect();
    let idle = lasting(&idles, 0.1, IDLE_SECS, signals.fps);
    tagged("walk", walk).chain(tagged("run", run)).chain(tagged("idle", idle)).collect()
}
