//! `backward` and `sideways`: where the body goes, seen from where it looks.
//!
//! Both need travel of at least 0.35 m/s (until 0.25), for at least 0.4 s; gaps of up to 0.2 s are
//! passed over. The back leans less than 70°.
//!
//! * **backward**: the travel is more than 120° off the heading (until less than 110°).
//! * **sideways**: it is 50–120° off the heading to either side (until less than 40° or more
//!   than 130°).

use super::signals::{Signals, UPRIGHT_RAD};
use super::span::{Hysteresis, TagSpan, lasting, tagged};

const TRAVEL: Hysteresis = Hysteresis { enter: 0.35, leave: 0.25 };
/// −cos of the angle off the heading: 120° and 110°.
const BACKWARD: Hysteresis = Hysteresis { enter: 0.5, leave: 0.342 };
/// How far the angle off the heading is within 85° ± 45°, degrees; 10° in and then out.
const SIDEWAYS: Hysteresis = Hysteresis { enter: 10.0, leave: 0.0 };
const SIDEWAYS_MIDDLE_DEG: f32 = 85.0;
const SIDEWAYS_HALF_DEG: f32 = 45.0;
const GAP_SECS: f64 = 0.2;
const MIN_SECS: f64 = 0.4;

/// The stretches of going backward and sideways.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let upright = signals.travel_m_s.iter().zip(&signals.lean_rad);
    let travels =
        TRAVEL.mask(upright.map(|(t, lean)| if *lean < UPRIGHT_RAD { t.length() } else { 0.0 }));
    let off_rad = || signals.travel_m_s.iter().map(|t| t.x.abs().atan2(t.y));
    let backward = BACKWARD.mask(off_rad().map(|off| -off.cos()));
    let sideways = SIDEWAYS.mask(
        off_rad().map(|off| SIDEWAYS_HALF_DEG - (off.to_degrees() - SIDEWAYS_MIDDLE_DEG).abs()),
    );
    let both = |mask: Vec<bool>| {
        let mask: Vec<bool> = mask.iter().zip(&travels).map(|(a, b)| *a && *b).collect();
        lasting(&mask, GAP_SECS, MIN_SECS, signals.fps)
    };
    tagged("backward", both(backward)).chain(tagged("sideways", both(sideways))).collect()
}
