//! `turn left` and `turn right`: where the heading changes.
//!
//! Faster than 25°/s, until slower than 12°/s, by at least 30° in all, for at least 0.3 s; and the
//! body looks another way for it: the mean heading of the 0.7 s behind it is at least 15° off that
//! of the 0.7 s before it (hips that swing to and fro with each punch do not turn). Only while the
//! back leans less than 70°.

use super::signals::{Signals, UPRIGHT_RAD};
use super::span::{Hysteresis, TagSpan, lasting, tagged};

/// Rate of a turn, radians per second: 25 and 12 degrees.
const TURN: Hysteresis = Hysteresis { enter: 0.436, leave: 0.209 };
/// What a turn comes to, radians: 30 degrees.
const WHOLE_RAD: f32 = 0.524;
/// How far the body looks another way than before, radians: 15 degrees.
const LASTING_RAD: f32 = 0.262;
const BESIDE_SECS: f64 = 0.7;
const GAP_SECS: f64 = 0.1;
const MIN_SECS: f64 = 0.3;

/// The stretches of turning.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let beside = signals.fps.frames_in_secs(BESIDE_SECS);
    let last = signals.n_frames().saturating_sub(1);
    let mean = |from: usize, to: usize| {
        signals.heading_rad[from..=to].iter().sum::<f32>() / (to + 1 - from) as f32
    };
    let turns = |side: f32| {
        let upright = signals.turn_rad_s.iter().zip(&signals.lean_rad);
        let mask =
            TURN.mask(upright.map(|(r, lean)| if *lean < UPRIGHT_RAD { side * r } else { 0.0 }));
        let mut found = lasting(&mask, GAP_SECS, MIN_SECS, signals.fps);
        let heading = &signals.heading_rad;
        found.retain(|&(from, to)| {
            let before = mean(from.saturating_sub(beside), from);
            let after = mean(to, (to + beside).min(last));
            side * (heading[to] - heading[from]) >= WHOLE_RAD
                && side * (after - before) >= LASTING_RAD
        });
        found
    };
    tagged("turn left", turns(1.0)).chain(tagged("turn right", turns(-1.0))).collect()
}
