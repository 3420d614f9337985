//! A joint at a place at a frame (head high: a jump). Soft.

use glam::Vec3;

use crate::ids::JointIdx;

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
}
