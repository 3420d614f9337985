//! `turn left` and `turn right`: where the heading changes.
//!
//! Faster than 25°/s, until slower than 12°/s, by at least 30° in all, for at least 0.3 s.

use super::signals::Signals;
use super::span::{Hysteresis, TagSpan, lasting, tagged};

/// Rate of a turn, radians per second: 25 and 12 degrees.
const TURN: Hysteresis = Hysteresis { enter: 0.436, leave: 0.209 };
/// What a turn comes to, radians: 30 degrees.
const WHOLE_RAD: f32 = 0.524;
const GAP_SECS: f64 = 0.1;
const MIN_SECS: f64 = 0.3;

/// The stretches of turning.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let turns = |side: f32| {
        let mask = TURN.mask(signals.turn_rad_s.iter().map(|rate| side * rate));
        let mut found = lasting(&mask, GAP_SECS, MIN_SECS, signals.fps);
        let heading = &signals.heading_rad;
        found.retain(|&(from, to)| side * (heading[to] - heading[from]) >= WHOLE_RAD);
        found
    };
    tagged("turn left", turns(1.0)).chain(tagged("turn right", turns(-1.0))).collect()
}
