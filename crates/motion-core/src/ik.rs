//! Two-bone inverse kinematics: where the knee goes when hip and ankle are given.
//!
//! The law of cosines has a closed form for a limb of two bones, so there is no iteration and
//! nothing to converge. [`TwoBone::solve`] works on positions; [`bone_rotation`] turns a
//! solution into rotations for a limb with a hinge (a body that is posed from nothing), and
//! [`reach_for`] turns an existing limb pose towards a new target with the least change (a foot
//! that is held where it stands).
//!
//! ```
//! use glam::Vec3;
//! use motion_core::ik::TwoBone;
//!
//! let leg = TwoBone::new(0.4, 0.4).unwrap();
//! let bent = leg.solve(Vec3::new(0.0, 0.8, 0.0), Vec3::new(0.0, 0.1, 0.0), Vec3::Z);
//! assert!(bent.reached && bent.mid_m.z > 0.0, "the knee points ahead");
//! ```

use glam::{Mat3, Quat, Vec3};

/// Directions shorter than this (metres, or the sine of an angle) point nowhere.
const DEGENERATE: f32 = 1e-6;

/// The lengths of a limb's two bones.
///
/// Invariant: both are finite and above zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBone {
    upper_m: f32,
    lower_m: f32,
}

/// A limb bent so that its end lies where it should.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The knee or elbow.
    pub mid_m: Vec3,
    /// The end of the limb: the target, or the nearest point on the line to it within reach.
    pub end_m: Vec3,
    /// The unit axis that the limb bends about: `pole × (root → end)`.
    pub hinge: Vec3,
    /// Whether the end lies on the target.
    pub reached: bool,
}

impl TwoBone {
    /// A limb; `None` unless both lengths are finite and above zero.
    pub fn new(upper_m: f32, lower_m: f32) -> Option<Self> {
        let ok = |len: f32| len.is_finite() && len > 0.0;
        (ok(upper_m) && ok(lower_m)).then_some(Self { upper_m, lower_m })
    }

    /// The farthest the end can be from the root: both bones in line.
    #[inline]
    pub fn max_reach_m(self) -> f32 {
        self.upper_m + self.lower_m
    }

    /// The nearest the end can be to the root: the limb folded.
    #[inline]
    pub fn min_reach_m(self) -> f32 {
        (self.upper_m - self.lower_m).abs()
    }

    /// The angle between the bones' directions when root and end are `distance_m` apart: 0 for a
    /// straight limb, towards π for a folded one. Distances out of reach count as the nearest
    /// one within.
    pub fn flexion_rad(self, distance_m: f32) -> f32 {
        let d = distance_m.clamp(self.min_reach_m(), self.max_reach_m());
        let (u, l) = (self.upper_m, self.lower_m);
        (((d * d - u * u - l * l) / (2.0 * u * l)).clamp(-1.0, 1.0)).acos()
    }

    /// A distance within reach for a wish that may not be, without a corner: distances up to
    /// `max_reach − softness` are kept, larger ones approach `max_reach` exponentially (value
    /// and slope are continuous).
    ///
    /// A limb driven straight by a plain clamp snaps: near full reach the knee moves with the
    /// square root of the distance that is left. A softness of 2–4 % of the limb hides that.
    pub fn soft_reach_m(self, distance_m: f32, softness_m: f32) -> f32 {
        let knee = self.max_reach_m() - softness_m;
        if softness_m <= 0.0 || distance_m <= knee {
            return distance_m.min(self.max_reach_m());
        }
        knee + softness_m * (1.0 - (-(distance_m - knee) / softness_m).exp())
    }

    /// Bends the limb at `root_m` so that its end lies on `target_m` and its middle lies on the
    /// side of `pole` (a direction, of any length).
    ///
    /// Law of cosines in f64; bone lengths come out within 1e-6 relative, also for straight and
    /// folded limbs. Cases without one answer, each with a fixed one:
    /// * target out of reach: the end goes to the nearest point within reach on the line from
    ///   the root, and `reached` is false (beyond 1e-5 of the reach);
    /// * target on the root: the limb folds along some direction square to the pole (when the
    ///   bones are equally long both ends meet and `reached` is true);
    /// * pole along the limb, or zero: some fixed direction square to the limb takes its place.
    ///   Close to this case the knee turns fast; choose a pole that stays away from the limb.
    pub fn solve(self, root_m: Vec3, target_m: Vec3, pole: Vec3) -> Bend {
        let to_target = target_m - root_m;
        let wished_m = to_target.length();
        let pole = pole.try_normalize().unwrap_or(Vec3::Z);
        let dir = if wished_m > DEGENERATE {
            to_target / wished_m
        } else {
            pole.any_orthonormal_vector()
        };
        let square = pole - dir * pole.dot(dir);
        let square = if square.length() > DEGENERATE.sqrt() {
            square.normalize_or_zero()
        } else {
            dir.any_orthonormal_vector()
        };

        let distance_m = wished_m.clamp(self.min_reach_m(), self.max_reach_m());
        let (u, l, d) = (f64::from(self.upper_m), f64::from(self.lower_m), f64::from(distance_m));
        // With equal bones and the target on the root, the middle stands square to the line.
        let along =
            if d > f64::from(DEGENERATE) { (d * d + u * u - l * l) / (2.0 * d) } else { 0.0 };
        let aside = (u * u - along * along).max(0.0).sqrt();
        let slack_m = 1e-5 * self.max_reach_m();
        Bend {
            mid_m: root_m + dir * along as f32 + square * aside as f32,
            end_m: root_m + dir * distance_m,
            hinge: square.cross(dir),
            reached: (wished_m - distance_m).abs() <= slack_m,
        }
    }
}

/// The rotation that lays a bone along `direction` and its hinge along `hinge`, for a bone that
/// lies along `rest_direction` with its hinge along `rest_hinge` before.
///
/// Directions are made square to their hinges and may have any length; `None` where one of the
/// pairs is parallel or zero and so no single rotation is meant.
pub fn bone_rotation(
    rest_direction: Vec3,
    rest_hinge: Vec3,
    direction: Vec3,
    hinge: Vec3,
) -> Option<Quat> {
    let rest = frame(rest_direction, rest_hinge)?;
    let posed = frame(direction, hinge)?;
    Some(Quat::from_mat3(&(posed * rest.transpose())).normalize())
}

/// Right-handed axes: the direction, the hinge squared to it, and their product.
fn frame(direction: Vec3, hinge: Vec3) -> Option<Mat3> {
    let along = direction.try_normalize()?;
    let hinge = hinge - along * hinge.dot(along);
    if hinge.length() < DEGENERATE {
        return None;
    }
    let hinge = hinge.try_normalize()?;
    Some(Mat3::from_cols(along, hinge, along.cross(hinge)))
}

/// World rotations that bring a posed limb's end to a new target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbTurn {
    /// To be multiplied from the left to the upper bone's world rotation.
    pub upper: Quat,
    /// To be multiplied from the left to the lower bone's world rotation.
    pub lower: Quat,
    /// Whether the target was within reach.
    pub reached: bool,
}

/// The least turn of a posed limb (`root`, `mid`, `end`: world positions) that brings its end to
/// `target_m`.
///
/// The limb bends in the plane that it is bent in; a limb straighter than 1e-3 of its length has
/// no such plane and takes `fallback_pole`. Both bones are turned about the world, the whole
/// limb by the shortest way first, so that twist along the bones is not invented. Reach limits
/// and degenerate targets are those of [`TwoBone::solve`]; a limb without length is not turned.
pub fn reach_for(
    root_m: Vec3,
    mid_m: Vec3,
    end_m: Vec3,
    target_m: Vec3,
    fallback_pole: Vec3,
) -> LimbTurn {
    let (upper, lower) = (mid_m - root_m, end_m - mid_m);
    let Some(limb) = TwoBone::new(upper.length(), lower.length()) else {
        return LimbTurn { upper: Quat::IDENTITY, lower: Quat::IDENTITY, reached: false };
    };
    let old = (end_m - root_m).normalize_or_zero();
    let new = (target_m - root_m).normalize_or_zero();
    let swing = Quat::from_rotation_arc(nonzero_or(old, upper), nonzero_or(new, old));
    // How far the middle lies off the line from root to end.
    let off_line = upper - old * upper.dot(old);
    let bent = off_line.length() > 1e-3 * limb.max_reach_m();
    let pole = if bent { swing * off_line } else { fallback_pole };
    let bend = limb.solve(root_m, target_m, pole);
    let turn = |from: Vec3, to: Vec3| {
        let swung = (swing * from).normalize_or_zero();
        Quat::from_rotation_arc(swung, nonzero_or(to.normalize_or_zero(), swung)) * swing
    };
    LimbTurn {
        upper: turn(upper, bend.mid_m - root_m),
        lower: turn(lower, bend.end_m - bend.mid_m),
        reached: bend.reached,
    }
}

/// `v`, or `other` made unit where `v` is the zero vector that stands for no direction.
fn nonzero_or(v: Vec3, other: Vec3) -> Vec3 {
    if v == Vec3::ZERO { other.try_normalize().unwrap_or(Vec3::Y) } else { v }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = Vec3> {
        (-1f32..1.0, -1f32..1.0, -1f32..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z))
    }

    fn limb() -> impl Strategy<Value = TwoBone> {
        (0.1f32..0.6, 0.1f32..0.6).prop_map(|(u, l)| TwoBone::new(u, l).unwrap())
    }

    #[track_caller]
    fn check_lengths(limb: TwoBone, root: Vec3, bend: Bend) {
        let upper = root.distance(bend.mid_m);
        let lower = bend.mid_m.distance(bend.end_m);
        assert!((upper - limb.upper_m).abs() < 2e-6, "upper bone {upper}, not {limb:?}");
        assert!((lower - limb.lower_m).abs() < 2e-6, "lower bone {lower}, not {limb:?}");
    }

    proptest! {
        #[test]
        fn bones_keep_their_lengths(l in limb(), root in point(), target in point(), pole in point()) {
            check_lengths(l, root, l.solve(root, target, pole));
        }

        #[test]
        fn the_end_is_the_target_or_as_near_as_can_be(
            l in limb(), root in point(), target in point(), pole in point(),
        ) {
            let bend = l.solve(root, target, pole);
            let d = root.distance(target);
            let out_of_reach = (d - l.max_reach_m()).max(l.min_reach_m() - d).max(0.0);
            prop_assert!((bend.end_m.distance(target) - out_of_reach).abs() < 3e-6);
            prop_assert_eq!(bend.reached, out_of_reach <= 1e-5 * l.max_reach_m());
        }

        #[test]
        fn the_knee_lies_on_the_side_of_the_pole(
            l in limb(), root in point(), target in point(), pole in point(),
        ) {
            let bend = l.solve(root, target, pole);
            let dir = (target - root).normalize_or_zero();
            let side = pole - dir * pole.dot(dir);
            prop_assume!(side.length() > 0.01);
            let knee = bend.mid_m - root;
            let aside = knee - dir * knee.dot(dir);
            prop_assert!(aside.dot(side) >= -1e-6);
            prop_assert!(aside.cross(side).length() < 1e-4, "knee leaves the plane");
            prop_assert!(bend.hinge.dot(pole).abs() < 1e-4 && bend.hinge.dot(dir).abs() < 1e-4);
        }

        #[test]
        fn flexion_is_the_angle_between_the_bones(l in limb(), target in point()) {
            let bend = l.solve(Vec3::ZERO, target, Vec3::new(0.3, 0.5, 0.9));
            let angle = bend.mid_m.angle_between(bend.end_m - bend.mid_m);
            prop_assert!((angle - l.flexion_rad(target.length())).abs() < 5e-3);
        }

        #[test]
        fn bone_rotation_lays_direction_and_hinge(a in point(), b in point(), c in point(), d in point()) {
            prop_assume!(a.cross(b).length() > 0.05 && c.cross(d).length() > 0.05);
            let q = bone_rotation(a, b, c, d).unwrap();
            prop_assert!((q * a).angle_between(c) < 2e-3);
            // The hinge may lean towards the direction, but not out of their common plane.
            prop_assert!((q * a.cross(b)).angle_between(c.cross(d)) < 2e-3);
        }

        #[test]
        fn reaching_turns_an_existing_limb_onto_the_target(
            mid in point(), end in point(), target in point(),
        ) {
            prop_assume!(mid.length() > 0.1 && mid.distance(end) > 0.1);
            prop_assume!(end.length() > 0.05 && target.length() > 0.05);
            let turn = reach_for(Vec3::ZERO, mid, end, target, Vec3::Z);
            let reached = turn.upper * mid + turn.lower * (end - mid);
            let limb = TwoBone::new(mid.length(), mid.distance(end)).unwrap();
            let expected = limb.solve(Vec3::ZERO, target, Vec3::Z).end_m;
            prop_assert!(reached.distance(expected) < 2e-3, "{reached} is not {expected}");
        }

        #[test]
        fn reaching_for_where_the_end_is_changes_nothing(mid in point(), end in point()) {
            prop_assume!(mid.length() > 0.1 && mid.distance(end) > 0.1 && end.length() > 0.1);
            prop_assume!(mid.cross(end).length() > 0.05);
            let turn = reach_for(Vec3::ZERO, mid, end, end, Vec3::Z);
            for q in [turn.upper, turn.lower] {
                prop_assert!(crate::rotation::log(q).length() < 5e-3);
            }
        }

        #[test]
        fn soft_reach_is_monotone_and_never_beyond(l in limb(), d in 0f32..2.0) {
            let softness = 0.04 * l.max_reach_m();
            let (a, b) = (l.soft_reach_m(d, softness), l.soft_reach_m(d + 0.01, softness));
            prop_assert!(a <= b + 1e-6 && b <= l.max_reach_m() && a <= d + 1e-6);
        }
    }

    #[test]
    fn degenerate_cases_have_a_fixed_answer() {
        let equal = TwoBone::new(0.4, 0.4).unwrap();
        let folded = equal.solve(Vec3::Y, Vec3::Y, Vec3::Z);
        check_lengths(equal, Vec3::Y, folded);
        assert!(folded.reached && folded.mid_m.distance(Vec3::new(0.0, 1.0, 0.4)) < 1e-6);

        let unequal = TwoBone::new(0.4, 0.3).unwrap();
        let too_near = unequal.solve(Vec3::Y, Vec3::Y, Vec3::Z);
        check_lengths(unequal, Vec3::Y, too_near);
        assert!(!too_near.reached, "bones of 0.4 and 0.3 do not meet");

        for pole in [Vec3::NEG_Y, Vec3::ZERO] {
            let along = equal.solve(Vec3::Y, Vec3::new(0.0, 0.5, 0.0), pole);
            check_lengths(equal, Vec3::Y, along);
            assert!(along.reached && along.mid_m.is_finite());
        }

        assert_eq!(TwoBone::new(0.0, 0.4), None);
        assert_eq!(TwoBone::new(0.4, f32::NAN), None);
        assert_eq!(bone_rotation(Vec3::Y, Vec3::Y, Vec3::Z, Vec3::X), None);
    }

    #[test]
    fn out_of_reach_straightens_towards_the_target() {
        let leg = TwoBone::new(0.4, 0.4).unwrap();
        let bend = leg.solve(Vec3::Y, Vec3::new(0.0, -5.0, 0.0), Vec3::Z);
        assert!(!bend.reached);
        assert!(bend.end_m.distance(Vec3::new(0.0, 0.2, 0.0)) < 1e-6, "{bend:?}");
        assert!(bend.mid_m.distance(Vec3::new(0.0, 0.6, 0.0)) < 1e-3, "{bend:?}");
    }
}
