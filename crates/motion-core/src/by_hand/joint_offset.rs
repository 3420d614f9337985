//! A joint that is turned by hand.

use glam::Vec3;

use super::Stretch;
use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::rotation;

/// A joint turned about an axis of its own for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointOffset {
    /// Which joint; everything that it carries turns with it.
    pub joint: JointIdx,
    /// Axis times angle, radians, in the joint's own frame as it is posed: the joint's rotation `q`
    /// becomes `q · exp(weight · turn)`.
    pub turn_rad: Vec3,
    /// When.
    pub stretch: Stretch,
}

impl JointOffset {
    /// Turns the joint. A joint that the motion does not have is left out, and so is a turn that is
    /// no number.
    pub(super) fn apply(&self, motion: &mut Motion) {
        let joint = self.joint.idx();
        if joint >= motion.n_joints() || !self.turn_rad.is_finite() {
            return;
        }
        for frame in 0..motion.n_frames() {
            let weight = self.stretch.weight(frame);
            if weight > 0.0 {
                let local = &mut motion.rotations_mut(frame)[joint];
                *local = (*local * rotation::exp(weight * self.turn_rad)).normalize();
            }
        }
    }
}
