//! Two bodies on their ways: how much too near they come.

use glam::Vec2;

use crate::constraint::OtherBody;
use crate::constraint::clearance::CLEARANCE_TOLERANCE_M;
use crate::constraint::obstacle::OBSTACLE_STRIDE;

/// What the nearness of somebody on `track_m` to `other` costs, counted as the search counts it:
/// squared tolerances times seconds, on every few frames.
pub(super) fn nearness_cost(track_m: &[Vec2], other: &OtherBody, frame_secs: f32) -> f32 {
    let secs = frame_secs * OBSTACLE_STRIDE as f32;
    let frames = (0u32..).zip(track_m).step_by(OBSTACLE_STRIDE as usize);
    let costs = frames.map(|(frame, &ground_m)| {
        (other.too_near_m(frame, ground_m) / CLEARANCE_TOLERANCE_M).powi(2) * secs
    });
    costs.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_passes_at_a_distance_costs_nothing_and_who_is_meant_to_be_near_neither() {
        let along = |x: f32| (0..90).map(|f| Vec2::new(x, 0.04 * f as f32)).collect::<Vec<_>>();
        let other = |x, together| OtherBody { ground_m: along(x), together };
        assert_eq!(nearness_cost(&along(0.0), &other(0.61, vec![]), 1.0 / 30.0), 0.0);
        let beside = nearness_cost(&along(0.0), &other(0.56, vec![]), 1.0 / 30.0);
        assert!((beside - 3.0).abs() < 0.1, "one tolerance for three seconds: {beside}");
        assert_eq!(nearness_cost(&along(0.0), &other(0.4, vec![(0, 90)]), 1.0 / 30.0), 0.0);
    }
}
