//! A curve on the ground that the body follows over a stretch of time. Soft.

use glam::Vec2;

/// A drawn curve, gone along evenly from its first point to its last.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowConstraint {
    /// First frame.
    pub from: u32,
    /// Last frame.
    pub to: u32,
    /// Points of the curve on the ground `(x, z)`, metres.
    pub points_m: Vec<Vec2>,
    /// Factor of the squared distance.
    pub weight: f32,
}
