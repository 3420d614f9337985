//! A curve on the ground that the body follows over a stretch of time. Soft.

use glam::Vec2;

use super::{TOLERANCE_M, TOLERANCE_RAD};

/// Frames between the places at which a followed curve is read.
pub const FOLLOW_STRIDE: u32 = 5;

/// A drawn curve, gone along evenly from its first point to its last.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowConstraint {
    /// First frame.
    pub from: u32,
    /// Last frame, after the first.
    pub to: u32,
    /// Points of the curve on the ground `(x, z)`, metres; at least two.
    pub points_m: Vec<Vec2>,
    /// Whether the body looks along the curve.
    pub looks_along: bool,
    /// Factor of the mean squared distance.
    pub weight: f32,
    /// How far off is well, metres.
    pub tolerance_m: f32,
    /// How far from the curve's direction is well, radians.
    pub tolerance_rad: f32,
}

/// Where the body should be on a followed curve at a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// When.
    pub frame: u32,
    /// Where, metres.
    pub position_m: Vec2,
    /// The curve's direction there, radians: 0 is +Z, π/2 is +X.
    pub heading_rad: f32,
}

/// How far a followed curve is missed, as root mean squares over the places at which it is read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FollowError {
    /// Distance from where the body should be at its time, metres.
    pub position_m: f32,
    /// Angle to the curve's direction, radians; 0 where it is not asked for.
    pub heading_rad: f32,
}

impl FollowConstraint {
    /// A wish to go along a curve, looking along it, with the usual weight and tolerances.
    pub fn new(from: u32, to: u32, points_m: Vec<Vec2>) -> Self {
        let (weight, tolerance_m, tolerance_rad) = (1.0, TOLERANCE_M, TOLERANCE_RAD);
        Self { from, to, points_m, looks_along: true, weight, tolerance_m, tolerance_rad }
    }

    /// Where the body should be at every [`FOLLOW_STRIDE`]-th frame and at the last.
    pub fn waypoints(&self) -> Vec<Waypoint> {
        let mut reached_m = vec![0.0f32];
        for pair in self.points_m.windows(2) {
            reached_m.push(reached_m[reached_m.len() - 1] + pair[0].distance(pair[1]));
        }
        let length_m = reached_m[reached_m.len() - 1];
        let n_frames = self.to.saturating_sub(self.from);
        let mut frames: Vec<u32> = (self.from..self.to).step_by(FOLLOW_STRIDE as usize).collect();
        frames.push(self.to);
        let mut waypoints = Vec::with_capacity(frames.len());
        for frame in frames {
            let at_m = length_m * (frame - self.from) as f32 / n_frames.max(1) as f32;
            // The stretch that this lies on: the last one that begins before it.
            let after = reached_m.partition_point(|&m| m < at_m).clamp(1, self.points_m.len() - 1);
            let (a, b) = (self.points_m[after - 1], self.points_m[after]);
            let stretch_m = reached_m[after] - reached_m[after - 1];
            let t = if stretch_m > 0.0 { (at_m - reached_m[after - 1]) / stretch_m } else { 0.0 };
            let way = b - a;
            let heading_rad = way.x.atan2(way.y);
            waypoints.push(Waypoint { frame, position_m: a.lerp(b, t), heading_rad });
        }
        waypoints
    }

    /// Whether the curve is followed within one tolerance on average.
    pub fn is_within_tolerance(&self, error: FollowError) -> bool {
        error.position_m <= self.tolerance_m
            && (!self.looks_along || error.heading_rad <= self.tolerance_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_gone_along_evenly() {
        let follow = FollowConstraint {
            from: 10,
            to: 40,
            points_m: vec![Vec2::ZERO, Vec2::new(0.0, 1.0), Vec2::new(2.0, 1.0)],
            looks_along: true,
            weight: 1.0,
            tolerance_m: 0.3,
            tolerance_rad: 0.2,
        };
        let waypoints = follow.waypoints();
        assert_eq!(waypoints.len(), 7, "every fifth frame and the last");
        for (nth, expected) in [(0, (0.0, 0.0)), (2, (0.0, 1.0)), (3, (0.5, 1.0)), (6, (2.0, 1.0))]
        {
            let found: Waypoint = waypoints[nth];
            let apart_m = found.position_m.distance(Vec2::from(expected));
            assert!(apart_m < 1e-5, "{found:?} is not {expected:?}");
        }
        assert_eq!((waypoints[0].heading_rad, waypoints[6].heading_rad), (0.0, 1.570_796_4));
    }
}
