//! A hand or a foot that is moved by hand.

use glam::{Quat, Vec3};

use super::Stretch;
use super::reach::{LimbChain, Posed};
use crate::ground::yaw_series_rad;
use crate::motion::Motion;
use crate::skeleton::{JointRole, Skeleton};

/// What can be moved: the end of a limb of two bones. A hand is its wrist, a foot its ankle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Limb {
    /// The left arm's end.
    LeftHand,
    /// The right arm's end.
    RightHand,
    /// The left leg's end.
    LeftFoot,
    /// The right leg's end.
    RightFoot,
}

impl Limb {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::LeftHand, Self::RightHand, Self::LeftFoot, Self::RightFoot];

    /// The part of the body that is moved.
    pub fn end_role(self) -> JointRole {
        self.roles()[2]
    }

    /// The upper bone's joint, the lower one's, and the end.
    pub(super) fn roles(self) -> [JointRole; 3] {
        use JointRole as R;
        match self {
            Self::LeftHand => [R::LeftArm, R::LeftForeArm, R::LeftHand],
            Self::RightHand => [R::RightArm, R::RightForeArm, R::RightHand],
            Self::LeftFoot => [R::LeftUpLeg, R::LeftLeg, R::LeftFoot],
            Self::RightFoot => [R::RightUpLeg, R::RightLeg, R::RightFoot],
        }
    }

    pub(super) fn is_arm(self) -> bool {
        matches!(self, Self::LeftHand | Self::RightHand)
    }

    /// Whether a body of this skeleton has the limb.
    pub fn is_on(self, skeleton: &Skeleton) -> bool {
        LimbChain::new(skeleton, self).is_some()
    }
}

/// In which directions a shift is counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// The world's.
    World,
    /// Turned with the body's heading: x to its left, y up, z ahead.
    #[default]
    Torso,
}

/// A hand or a foot moved for a while; its attitude in the world and all of the body but the limb's
/// own joints stay.
///
/// **Reach.** Whatever lies within 98 % of the limb's full length from shoulder or hip, and no
/// nearer to it than a folded limb, is reached to a tenth of a millimetre. Beyond, the end goes on
/// in the direction of the wish and approaches the limit. Nothing moves where the weight is 0, also
/// on limbs that are stretched or folded further than that already. **Not guaranteed:** a target
/// that passes within a few centimetres of the shoulder swings the arm about it as fast as that
/// asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandOffset {
    /// What is moved.
    pub limb: Limb,
    /// By how much, metres.
    pub shift_m: Vec3,
    /// In which directions.
    pub space: Space,
    /// When.
    pub stretch: Stretch,
}

/// Moves hands and feet; all offsets of a limb are one move.
pub(super) fn move_hands(offsets: &[HandOffset], skeleton: &Skeleton, motion: &mut Motion) {
    let offsets: Vec<&HandOffset> = offsets.iter().filter(|o| o.shift_m.is_finite()).collect();
    if offsets.is_empty() {
        return;
    }
    let yaw_rad = yaw_series_rad(motion);
    let mut posed = Posed::default();
    for limb in Limb::ALL {
        let own: Vec<&&HandOffset> = offsets.iter().filter(|offset| offset.limb == limb).collect();
        let Some(chain) = LimbChain::new(skeleton, limb).filter(|_| !own.is_empty()) else {
            continue;
        };
        for (frame, &yaw_rad) in yaw_rad.iter().enumerate() {
            let in_world = |offset: &HandOffset| match offset.space {
                Space::World => offset.shift_m,
                Space::Torso => Quat::from_rotation_y(yaw_rad) * offset.shift_m,
            };
            let touching = own.iter().filter(|offset| offset.stretch.touches(frame));
            let shift_m: Vec3 =
                touching.map(|offset| offset.stretch.weight(frame) * in_world(offset)).sum();
            if shift_m == Vec3::ZERO {
                continue;
            }
            let Posed { positions_m, rotations } = &mut posed;
            motion.forward_kinematics(skeleton, frame, positions_m, rotations);
            chain.shift(skeleton, motion, frame, &posed, shift_m);
        }
    }
}
