//! `crouch`: the hips are low over the feet.
//!
//! The middle of the hip joints is below 0.82 legs above what supports the body (standing is about
//! 1.1), until it is above 0.88, with a foot on the ground for half of the time or more; for at
//! least 0.3 s.

use super::signals::Signals;
use super::span::{Hysteresis, TagSpan, lasting, tagged};

/// Heights of the hip joints, legs.
pub(super) struct Below {
    pub(super) enter_below: f32,
    pub(super) leave_below: f32,
}

/// The height of a crouch, legs.
pub(super) const CROUCH: Below = Below { enter_below: 0.82, leave_below: 0.88 };
const GAP_SECS: f64 = 0.1;
const MIN_SECS: f64 = 0.3;

/// The stretches of crouching.
pub(super) fn find(signals: &Signals) -> Vec<TagSpan> {
    let low = Hysteresis { enter: -CROUCH.enter_below, leave: -CROUCH.leave_below };
    let mask = low.mask(signals.hip_height.iter().map(|height| -height));
    let mut found = lasting(&mask, GAP_SECS, MIN_SECS, signals.fps);
    found.retain(|&(from, to)| {
        let n_planted = signals.is_planted[from..=to].iter().filter(|planted| **planted).count();
        2 * n_planted > to - from
    });
    tagged("crouch", found).collect()
}
