//! A joint at a place at a frame (head high: a jump). Soft.

use glam::Vec3;

use super::TOLERANCE_M;
use crate::ids::JointIdx;

/// One tolerance of a joint's velocity, metres per second.
pub const TOLERANCE_M_S: f32 = 1.0;

/// A joint's wished place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointConstraint {
    /// When.
    pub frame: u32,
    /// Which joint.
    pub joint: JointIdx,
    /// Where, metres, in the world.
    pub position_m: Vec3,
    /// How fast, metres per second, where that is asked for.
    pub velocity_m_s: Option<Vec3>,
    /// Factor of the squared error.
    pub weight: f32,
    /// How far off is well, metres; above 0.
    pub tolerance_m: f32,
}

impl JointConstraint {
    /// A wish for a place with the usual weight and tolerance.
    pub fn new(frame: u32, joint: JointIdx, position_m: Vec3) -> Self {
        let (weight, tolerance_m) = (1.0, TOLERANCE_M);
        Self { frame, joint, position_m, velocity_m_s: None, weight, tolerance_m }
    }

    /// How far a joint at `position_m` that moves with `velocity_m_s` misses it.
    pub fn error(&self, position_m: Vec3, velocity_m_s: Vec3) -> JointError {
        JointError {
            position_m: position_m.distance(self.position_m),
            velocity_m_s: self.velocity_m_s.map_or(0.0, |wish| velocity_m_s.distance(wish)),
        }
    }

    /// The weighted sum of squares in tolerances.
    pub fn cost(&self, error: JointError) -> f32 {
        let place = (error.position_m / self.tolerance_m).powi(2);
        self.weight * (place + (error.velocity_m_s / TOLERANCE_M_S).powi(2))
    }

    /// Whether both parts lie within one tolerance.
    pub fn is_within_tolerance(&self, error: JointError) -> bool {
        error.position_m <= self.tolerance_m && error.velocity_m_s <= TOLERANCE_M_S
    }
}

/// How far a joint constraint is missed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointError {
    /// Distance, metres.
    pub position_m: f32,
    /// Difference of velocities, metres per second; 0 where none is asked for.
    pub velocity_m_s: f32,
}
