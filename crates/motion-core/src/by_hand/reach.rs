//! A limb of two bones, brought elsewhere with its end's attitude kept.
//!
//! As the legs of [`assemble`](crate::assemble) are, but for arms too, for joints between the
//! bones (a forearm's twist), and without their limit on how far a knee gives way: what is moved by
//! hand is meant.

use glam::{Quat, Vec3};

use super::Limb;
use crate::ids::JointIdx;
use crate::ik::TwoBone;
use crate::motion::Motion;
use crate::skeleton::Skeleton;

/// Up to this share of its full length a limb reaches exactly; what is left is approached.
const EXACT_SHARE: f32 = 0.98;
/// A limb folds to this share of its full length above the least that its bones allow, and
/// approaches a third of that: nobody's wrist goes into the shoulder.
const FOLD_SHARE: f32 = 0.15;

/// The joints of a limb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LimbChain {
    upper: JointIdx,
    lower: JointIdx,
    end: JointIdx,
    /// Where an outstretched limb bends to, in the upper joint's frame: knees ahead, elbows back.
    bends_to: Vec3,
}

/// Every joint of a body in the world.
#[derive(Clone, Debug, Default)]
pub(super) struct Posed {
    /// World positions, metres.
    pub(super) positions_m: Vec<Vec3>,
    /// World rotations.
    pub(super) rotations: Vec<Quat>,
}

impl LimbChain {
    /// The limb of that name; `None` where the skeleton has none of two bones.
    pub(super) fn new(skeleton: &Skeleton, limb: Limb) -> Option<Self> {
        let [upper, lower, end] = limb.roles().map(|role| skeleton.by_role(role));
        let (upper, lower, end) = (upper?, lower?, end?);
        let hangs = hangs_from(skeleton, lower, upper) && hangs_from(skeleton, end, lower);
        let bends_to = if limb.is_arm() { Vec3::NEG_Z } else { Vec3::Z };
        // A limb whose upper bone is the root has nothing to stay behind.
        (hangs && skeleton.joint(upper).parent.is_some()).then_some(Self {
            upper,
            lower,
            end,
            bends_to,
        })
    }

    /// Moves the limb's end by `shift_m` as far as it reaches. See [`HandOffset`] for the limits.
    ///
    /// [`HandOffset`]: super::HandOffset
    pub(super) fn shift(
        &self,
        skeleton: &Skeleton,
        motion: &mut Motion,
        frame: usize,
        posed: &Posed,
        shift_m: Vec3,
    ) {
        let at = |joint: JointIdx| posed.positions_m[joint.idx()];
        let (root_m, mid_m, end_m) = (at(self.upper), at(self.lower), at(self.end));
        let (upper, lower, old) = (mid_m - root_m, end_m - mid_m, end_m - root_m);
        let Some(limb) = TwoBone::new(upper.length(), lower.length()) else { return };
        let wished = old + shift_m;
        let Some(direction) = wished.try_normalize().or(old.try_normalize()) else { return };
        let new = direction * limited_reach_m(limb, old.length(), wished.length());

        let swing = Quat::from_rotation_arc(old.try_normalize().unwrap_or(direction), direction);
        let mid = self.mid(limb, posed, [upper, old, new], swing);
        let turn = |from: Vec3, to: Vec3| {
            let (from, to) = ((swing * from).normalize_or_zero(), to.normalize_or_zero());
            (Quat::from_rotation_arc(from, to) * swing).normalize()
        };
        let (turn_upper, turn_lower) = (turn(upper, mid), turn(lower, new - mid));

        // Joints between the bones keep their local rotations, so they go with the bone above.
        let world = |joint: JointIdx| posed.rotations[joint.idx()];
        let above = |joint: JointIdx| skeleton.joint(joint).parent.map_or(Quat::IDENTITY, world);
        let local = motion.rotations_mut(frame);
        let relative = |parent: Quat, child: Quat| (parent.inverse() * child).normalize();
        local[self.upper.idx()] = relative(above(self.upper), turn_upper * world(self.upper));
        local[self.lower.idx()] =
            relative(turn_upper * above(self.lower), turn_lower * world(self.lower));
        local[self.end.idx()] = relative(turn_lower * above(self.end), world(self.end));
    }

    /// Where the elbow or knee goes, from the limb's root, when the end goes from `old` to `new`.
    ///
    /// It stays on the side on which it is; what the limb bends more goes the usual way. A limb that
    /// is straight but for noise would otherwise bend to whichever side the noise points.
    fn mid(&self, limb: TwoBone, posed: &Posed, [upper, old, new]: [Vec3; 3], swing: Quat) -> Vec3 {
        let along = old.normalize_or_zero();
        let aside = swing * (upper - along * upper.dot(along));
        let straight = limb.solve(Vec3::ZERO, new, aside);
        let along = new.normalize_or_zero();
        let aside_m = (straight.mid_m - along * straight.mid_m.dot(along)).length();
        let more_m = (aside_m - aside.length()).max(0.0);
        let usual = swing * (posed.rotations[self.upper.idx()] * self.bends_to);
        limb.solve(Vec3::ZERO, new, aside + usual * more_m).mid_m
    }
}

/// The distance from root to end for a wish of `wished_m`, of a limb that now spans `now_m`.
///
/// Distances from the folded limb's to [`EXACT_SHARE`] of the full length are kept, and so is what
/// lies beyond these but not beyond `now_m`; farther ones approach the limit exponentially. Value
/// and slope are continuous, and a wish of `now_m` is always granted, so that nothing moves where
/// nothing is asked.
fn limited_reach_m(limb: TwoBone, now_m: f32, wished_m: f32) -> f32 {
    let (min_m, max_m) = (limb.min_reach_m(), limb.max_reach_m());
    let now_m = now_m.clamp(min_m, max_m);
    let far_m = now_m.max(EXACT_SHARE * max_m);
    let near_m = now_m.min((min_m + FOLD_SHARE * max_m).min(far_m));
    if wished_m > far_m {
        far_m + approach(wished_m - far_m, max_m - far_m)
    } else if wished_m < near_m {
        let least_m = near_m.min(min_m + FOLD_SHARE * max_m / 3.0);
        near_m - approach(near_m - wished_m, near_m - least_m)
    } else {
        wished_m
    }
}

/// `beyond` as it is at first, never more than `room`.
fn approach(beyond: f32, room: f32) -> f32 {
    if room <= 1e-6 { 0.0 } else { room * (1.0 - (-beyond / room).exp()) }
}

/// Whether `joint` is carried by `above`.
fn hangs_from(skeleton: &Skeleton, joint: JointIdx, above: JointIdx) -> bool {
    let mut link = skeleton.joint(joint).parent;
    while let Some(parent) = link {
        if parent == above {
            return true;
        }
        link = skeleton.joint(parent).parent;
    }
    false
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn reach_is_continuous_monotone_and_within_the_limb(
            lower in 0.1f32..0.5, now in 0.0f32..1.0, wished in 0.0f32..3.0,
        ) {
            let limb = TwoBone::new(0.3, lower).expect("lengths above zero");
            let now_m = limb.min_reach_m() + now * (limb.max_reach_m() - limb.min_reach_m());
            let reach = |wished| limited_reach_m(limb, now_m, wished);
            prop_assert!((reach(now_m) - now_m).abs() < 1e-6);
            prop_assert!(reach(wished) <= limb.max_reach_m() + 1e-6);
            prop_assert!(reach(wished) >= limb.min_reach_m() - 1e-6);
            let step = reach(wished + 1e-3) - reach(wished);
            prop_assert!((-1e-6..=1.01e-3).contains(&step), "{}", step);
        }
    }
}
