//! A leg as foot locking needs it: where its joints are, and how to bring its toe elsewhere.

use glam::{Quat, Vec3};

use crate::contacts::{self, Side};
use crate::ids::JointIdx;
use crate::ik::TwoBone;
use crate::motion::Motion;
use crate::skeleton::{JointRole, Skeleton};

/// The most that a lock may change a knee's bend, radians; approached smoothly.
const MAX_KNEE_CHANGE_RAD: f32 = 0.35;

/// Within this share of its full length a leg counts as nearly straight.
///
/// There the knee's bend goes with the square root of the length that is left and would pop; the
/// share sets how early changes of length stop to count in full.
const SOFT_REACH_SHARE: f32 = 0.03;

/// A leg whose thigh, shin and foot follow one another without joints between.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Joints from the root's first descendant to the thigh's parent; empty where the thigh hangs
    /// from the root itself.
    to_hip: Vec<JointIdx>,
    up_leg: JointIdx,
    shin: JointIdx,
    foot: JointIdx,
    /// The toe joint; the foot itself on bodies without toes.
    toe: JointIdx,
}

/// World positions and rotations along a leg in one frame.
#[derive(Clone, Copy, Debug)]
pub struct LegPose {
    parent_rotation: Quat,
    hip_m: Vec3,
    thigh: Quat,
    knee_m: Vec3,
    shin: Quat,
    ankle_m: Vec3,
    foot: Quat,
    /// Position of the toe joint.
    pub toe_m: Vec3,
}

impl Leg {
    /// The leg of that side; `None` where the skeleton has no leg of two bones there.
    pub fn new(skeleton: &Skeleton, side: Side) -> Option<Self> {
        use JointRole as R;
        let (up_leg, shin, foot) = match side {
            Side::Left => (R::LeftUpLeg, R::LeftLeg, R::LeftFoot),
            Side::Right => (R::RightUpLeg, R::RightLeg, R::RightFoot),
        };
        let up_leg = skeleton.by_role(up_leg)?;
        let (shin, foot) = (skeleton.by_role(shin)?, skeleton.by_role(foot)?);
        let toe = contacts::toe_joint(skeleton, side)?;
        let parent = |joint: JointIdx| skeleton.joint(joint).parent;
        let jointed = parent(shin) == Some(up_leg)
            && parent(foot) == Some(shin)
            && (toe == foot || parent(toe) == Some(foot));
        let (thigh_m, shin_m) =
            (skeleton.joint(shin).offset_m.length(), skeleton.joint(foot).offset_m.length());
        TwoBone::new(thigh_m, shin_m)?;
        let mut to_hip = Vec::new();
        let mut link = parent(up_leg)?;
        while let Some(above) = parent(link) {
            to_hip.push(link);
            link = above;
        }
        to_hip.reverse();
        jointed.then_some(Self { to_hip, up_leg, shin, foot, toe })
    }

    /// The leg in `frame`.
    pub fn pose(&self, skeleton: &Skeleton, motion: &Motion, frame: usize) -> LegPose {
        let local = motion.rotations(frame);
        let offset = |joint: JointIdx| skeleton.joint(joint).offset_m;
        let mut at = motion.root_positions_m()[frame];
        let mut world = local[0];
        for &joint in &self.to_hip {
            at += world * offset(joint);
            world *= local[joint.idx()];
        }
        let hip_m = at + world * offset(self.up_leg);
        let thigh = world * local[self.up_leg.idx()];
        let knee_m = hip_m + thigh * offset(self.shin);
        let shin = thigh * local[self.shin.idx()];
        let ankle_m = knee_m + shin * offset(self.foot);
        let foot = shin * local[self.foot.idx()];
        let toe_m = if self.toe == self.foot { ankle_m } else { ankle_m + foot * offset(self.toe) };
        LegPose { parent_rotation: world, hip_m, thigh, knee_m, shin, ankle_m, foot, toe_m }
    }

    /// Moves the toe joint by `shift_m` as far as the leg allows, the foot's attitude and the
    /// root kept. A shift of zero changes nothing.
    ///
    /// The knee's bend changes by no more than about 20°, and changes that would drive the leg
    /// straight fade out: what cannot be reached is left, smoothly.
    pub fn shift_toe(&self, motion: &mut Motion, frame: usize, pose: &LegPose, shift_m: Vec3) {
        let (upper, lower) = (pose.knee_m - pose.hip_m, pose.ankle_m - pose.knee_m);
        let Some(limb) = TwoBone::new(upper.length(), lower.length()) else { return };
        let wished = pose.ankle_m + shift_m - pose.hip_m;
        let Some(direction) = wished.try_normalize() else { return };

        let softness_m = SOFT_REACH_SHARE * limb.max_reach_m();
        let bend = |distance_m: f32| limb.flexion_rad(limb.soft_reach_m(distance_m, softness_m));
        let now_m = (pose.ankle_m - pose.hip_m).length();
        let change = bend(wished.length()) - bend(now_m);
        let change = MAX_KNEE_CHANGE_RAD * (change / MAX_KNEE_CHANGE_RAD).tanh();
        let flexion = (limb.flexion_rad(now_m) + change).clamp(0.0, std::f32::consts::PI);
        let (u, l) = (upper.length(), lower.length());
        let reach_m = (u * u + l * l + 2.0 * u * l * flexion.cos()).max(0.0).sqrt();
        let bent = bend_knee(pose, limb, direction * reach_m);
        let turned = |bone: Quat, from: Vec3, to: Vec3| {
            let (from, to) = (from.normalize_or_zero(), to.normalize_or_zero());
            (Quat::from_rotation_arc(bent.swing * from, to) * bent.swing * bone).normalize()
        };
        let thigh = turned(pose.thigh, upper, bent.knee);
        let shin = turned(pose.shin, lower, direction * reach_m - bent.knee);
        let local = motion.rotations_mut(frame);
        local[self.up_leg.idx()] = (pose.parent_rotation.inverse() * thigh).normalize();
        local[self.shin.idx()] = (thigh.inverse() * shin).normalize();
        local[self.foot.idx()] = (shin.inverse() * pose.foot).normalize();
    }
}

/// A leg bent anew: vectors from the hip.
struct Bent {
    /// Turns the old line from hip to ankle onto the new one, by the shortest way.
    swing: Quat,
    knee: Vec3,
}

/// Bends the leg so that the ankle comes to `ankle`, seen from the hip.
///
/// The knee stays on the side on which it is; what it is bent more goes forwards. A leg that is
/// straight but for the noise of capture would otherwise bend to whichever side the noise points.
fn bend_knee(pose: &LegPose, limb: TwoBone, ankle: Vec3) -> Bent {
    let (knee, old_ankle) = (pose.knee_m - pose.hip_m, pose.ankle_m - pose.hip_m);
    let (old, new) = (old_ankle.normalize_or_zero(), ankle.normalize_or_zero());
    let swing = Quat::from_rotation_arc(old, new);
    let aside = swing * (knee - old * knee.dot(old));
    // Law of cosines: how far along the line the knee stands, and so how far aside.
    let (thigh_sq, reach_m) = (knee.length_squared(), ankle.length().max(1e-6));
    let shin_sq = (old_ankle - knee).length_squared();
    let along_m = (reach_m * reach_m + thigh_sq - shin_sq) / (2.0 * reach_m);
    let new_aside_m = (thigh_sq - along_m * along_m).max(0.0).sqrt();
    let more_m = (new_aside_m - aside.length()).max(0.0);
    let pole = aside + pose.thigh * Vec3::Z * more_m;
    Bent { swing, knee: limb.solve(Vec3::ZERO, ankle, pole).mid_m }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::rotation;
    use crate::testing::{Walk, joint, legs};

    fn walk() -> Motion {
        Walk { n_frames: 60, speed_m_s: 0.5, turn_rad_s: 0.3, phase: 0.0 }.motion()
    }

    proptest! {
        #[test]
        fn small_shifts_are_reached_and_the_foot_keeps_its_attitude(
            frame in 0usize..60, x in -0.04f32..0.04, y in -0.01f32..0.03, z in -0.04f32..0.04,
        ) {
            let (skeleton, mut motion) = (legs(), walk());
            for side in Side::BOTH {
                let leg = Leg::new(&skeleton, side).expect("a leg");
                let before = leg.pose(&skeleton, &motion, frame);
                let shift = Vec3::new(x, y, z);
                // Well inside the reach, where nothing is softened.
                prop_assume!((before.ankle_m + shift - before.hip_m).length() < 0.77);
                leg.shift_toe(&mut motion, frame, &before, shift);
                let after = leg.pose(&skeleton, &motion, frame);
                let miss = after.toe_m.distance(before.toe_m + shift);
                prop_assert!(miss < 0.25 * shift.length() + 1e-4, "{miss} m of {}", shift.length());
                prop_assert!(rotation::angle_between_rad(before.foot, after.foot) < 1e-3);
            }
        }

        #[test]
        fn no_wish_breaks_a_knee(
            frame in 0usize..60, x in -2f32..2.0, y in -2f32..2.0, z in -2f32..2.0,
        ) {
            let (skeleton, mut motion) = (legs(), walk());
            let leg = Leg::new(&skeleton, Side::Left).expect("a leg");
            let before = leg.pose(&skeleton, &motion, frame);
            leg.shift_toe(&mut motion, frame, &before, Vec3::new(x, y, z));
            let after = leg.pose(&skeleton, &motion, frame);
            let bend = |pose: &LegPose| {
                (pose.knee_m - pose.hip_m).angle_between(pose.ankle_m - pose.knee_m)
            };
            prop_assert!((bend(&after) - bend(&before)).abs() < MAX_KNEE_CHANGE_RAD + 5e-3);
            prop_assert!(motion.rotations(frame).iter().all(|q| q.is_normalized()));
        }

        #[test]
        fn nearer_wishes_are_met_nearer(frame in 0usize..60, scale in 0.1f32..0.9) {
            // Growing a shift never jumps: the miss is continuous in the wish.
            let (skeleton, motion) = (legs(), walk());
            let leg = Leg::new(&skeleton, Side::Right).expect("a leg");
            let pose = leg.pose(&skeleton, &motion, frame);
            let toe = |scale: f32| {
                let mut moved = motion.clone();
                leg.shift_toe(&mut moved, frame, &pose, Vec3::new(0.1, -0.1, 0.1) * scale);
                leg.pose(&skeleton, &moved, frame).toe_m
            };
            prop_assert!(toe(scale).distance(toe(scale + 0.01)) < 0.01);
        }
    }

    #[test]
    fn a_shift_of_zero_changes_nothing() {
        let (skeleton, mut motion) = (legs(), walk());
        let before = motion.clone();
        let leg = Leg::new(&skeleton, Side::Left).expect("a leg");
        for frame in 0..60 {
            let pose = leg.pose(&skeleton, &motion, frame);
            leg.shift_toe(&mut motion, frame, &pose, Vec3::ZERO);
            for (a, b) in before.rotations(frame).iter().zip(motion.rotations(frame)) {
                assert!(rotation::angle_between_rad(*a, *b) < 3e-3, "frame {frame}");
            }
        }
    }

    #[test]
    fn poses_agree_with_forward_kinematics() {
        let (skeleton, motion) = (legs(), walk());
        let all = motion.joint_positions_m(&skeleton);
        let leg = Leg::new(&skeleton, Side::Right).expect("a leg");
        for frame in 0..60 {
            let toe = leg.pose(&skeleton, &motion, frame).toe_m;
            assert!(toe.distance(all[frame * 9 + 8]) < 1e-5, "frame {frame}");
        }
    }

    #[test]
    fn bodies_without_such_legs_have_none() {
        let skeleton = Skeleton::new(vec![
            joint("Hips", None, [0.0; 3]),
            joint("LeftUpLeg", Some(0), [0.1, 0.0, 0.0]),
            joint("LeftThighTwist", Some(1), [0.0, -0.2, 0.0]),
            joint("LeftLeg", Some(2), [0.0, -0.2, 0.0]),
            joint("LeftFoot", Some(3), [0.0, -0.4, 0.0]),
        ])
        .expect("valid by construction");
        assert_eq!(Leg::new(&skeleton, Side::Left), None);
        assert_eq!(Leg::new(&skeleton, Side::Right), None);
    }
}
