//! Changes by hand: a layer that is laid over a finished motion and can be taken off again.
//!
//! A layer turns joints and moves hands or feet over stretches of time, and says when what is
//! shown. The motion below it stays as it is, so that it can be found, refined and corrected anew
//! with the same layer on it.
//!
//! **Order.** Joints are turned first, in the order of the list; then hands and feet are moved from
//! where that has put them; both count the frames of the motion below. Last of all the motion is
//! retimed. So an offset stays with what the body does when its timing is changed.
//!
//! ```
//! # use glam::Vec3;
//! # use motion_core::{by_hand::*, ids::JointIdx, motion::Motion, skeleton::Skeleton};
//! # fn example(skeleton: &Skeleton, motion: &Motion) {
//! let stretch = Stretch { from: 20, to: 30, ease_in: 8, ease_out: 8 };
//! let nod = JointOffset { joint: JointIdx(3), turn_rad: 0.3 * Vec3::X, stretch };
//! let layer = ByHand { joints: vec![nod], ..ByHand::default() };
//! let nodding = apply(&layer, skeleton, motion);
//! assert_eq!(nodding.n_frames(), motion.n_frames());
//! # }
//! ```

pub mod hand_offset;
pub mod joint_offset;
mod reach;
mod resample;
pub mod retime;
pub mod stretch;

pub use hand_offset::{HandOffset, Limb, Space};
pub use joint_offset::JointOffset;
pub use resample::resample;
pub use retime::{Knot, Retime, RetimeError};
pub use stretch::Stretch;

use crate::motion::Motion;
use crate::skeleton::Skeleton;

/// What is changed by hand on a motion. The empty layer changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ByHand {
    /// Joints that are turned. Of one joint the later ones turn what the earlier ones have turned.
    pub joints: Vec<JointOffset>,
    /// Hands and feet that are moved. Those of one limb add up.
    pub hands: Vec<HandOffset>,
    /// When what is shown.
    pub retime: Retime,
}

impl ByHand {
    /// Whether there is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.joints.is_empty() && self.hands.is_empty() && self.retime.is_identity()
    }
}

/// The motion with the layer on it.
///
/// Frames that no offset has an effect on, joints that none speaks of, and a motion under an empty
/// layer are the same to the last bit. Deterministic; never fails: what the body does not have (a
/// joint out of range, an arm without an elbow) is left out.
///
/// # Panics
/// When the motion is another skeleton's.
pub fn apply(layer: &ByHand, skeleton: &Skeleton, motion: &Motion) -> Motion {
    let offset = offset(layer, skeleton, motion);
    if layer.retime.is_identity() {
        return offset;
    }
    resample(&offset, &layer.retime.source_frames(motion.n_frames()))
}

/// The motion with the layer's offsets on it, in its own time.
///
/// # Panics
/// When the motion is another skeleton's.
pub fn offset(layer: &ByHand, skeleton: &Skeleton, motion: &Motion) -> Motion {
    assert_eq!(skeleton.n_joints(), motion.n_joints(), "another skeleton's motion");
    let mut offset = motion.clone();
    for joint in &layer.joints {
        joint.apply(&mut offset);
    }
    hand_offset::move_hands(&layer.hands, skeleton, &mut offset);
    offset
}

#[cfg(test)]
mod tests;
