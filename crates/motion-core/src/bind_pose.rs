//! How a body stands when it does nothing: the pose in which two bodies are compared.
//!
//! A skeleton's rest pose (every rotation at identity) is where its file put it. Most files put it
//! upright with the arms out or down; some put every bone along one axis, so that at rest the legs
//! point up. [`BindPose::of`] finds a pose that a person would stand in either way.

use glam::{Mat3, Quat, Vec3};

use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::skeleton::{JointRole, Skeleton};

/// A bone within this of where it belongs (cosine) makes a pose a standing one: 37°.
const STANDING_COS: f32 = 0.8;

/// An arm that points up by more than this (cosine to the vertical) is raised.
const RAISED_COS: f32 = 0.6;

/// A frame of a motion is a standing pose where legs and back are this close to the vertical
/// (cosine): 26°.
const UPRIGHT_COS: f32 = 0.9;

/// At most so many frames of a motion are looked at.
const MAX_FRAMES: usize = 2000;

/// The natural standing pose of a skeleton: upright, facing +Z, its sole on the ground.
///
/// Invariants: a rotation and a position per joint; rotations are of unit length; the lowest point
/// of the feet (of the body, where feet are not recognised) is at the height
/// [`sole_below_feet_m`](Self::sole_below_feet_m), above the origin of the root joint.
#[derive(Clone, Debug, PartialEq)]
pub struct BindPose {
    world_from_joint: Vec<Quat>,
    positions_m: Vec<Vec3>,
    sole_below_feet_m: f32,
}

impl BindPose {
    /// The standing pose of `skeleton`.
    ///
    /// 1. The rest pose, where it stands: legs down, back up, arms not raised, its left at +X. Also
    ///    where too few parts are recognised to tell.
    /// 2. Else the frame of `motion` with the most upright back and the straightest legs, turned to
    ///    face +Z, where one is upright.
    /// 3. Else every limb swung from the rest pose by the smallest rotation: legs down, feet
    ///    ahead, back and head up, arms out.
    ///
    /// # Panics
    /// When the motion is another skeleton's.
    pub fn of(skeleton: &Skeleton, motion: Option<&Motion>) -> Self {
        let rest = vec![Quat::IDENTITY; skeleton.n_joints()];
        let stands = Stance::of(skeleton, &positions_m(skeleton, &rest))
            .is_none_or(|stance| stance.stands_ahead());
        if stands {
            return Self::new(skeleton, rest);
        }
        let seen = motion.and_then(|motion| most_upright(skeleton, motion));
        Self::new(skeleton, seen.unwrap_or_else(|| swung(skeleton)))
    }

    /// The rest pose itself.
    pub fn rest(skeleton: &Skeleton) -> Self {
        Self::new(skeleton, vec![Quat::IDENTITY; skeleton.n_joints()])
    }

    /// The same pose with the sole `sole_below_feet_m` below the lowest joint or end site of the
    /// feet: a mesh's sole, or the height at which toe joints stand in captured clips.
    #[must_use]
    pub fn with_sole(mut self, sole_below_feet_m: f32) -> Self {
        let lift_m = sole_below_feet_m - self.sole_below_feet_m;
        for position in &mut self.positions_m {
            position.y += lift_m;
        }
        self.sole_below_feet_m = sole_below_feet_m;
        self
    }

    /// World rotation of every joint.
    pub fn world_from_joint(&self) -> &[Quat] {
        &self.world_from_joint
    }

    /// World position of every joint, metres; the sole is at height 0.
    pub fn positions_m(&self) -> &[Vec3] {
        &self.positions_m
    }

    /// How far the sole is below the lowest joint or end site of the feet, metres; 0 unless said.
    pub fn sole_below_feet_m(&self) -> f32 {
        self.sole_below_feet_m
    }

    fn new(skeleton: &Skeleton, world_from_joint: Vec<Quat>) -> Self {
        let mut positions_m = positions_m(skeleton, &world_from_joint);
        let low_m = lowest_foot_m(skeleton, &positions_m, &world_from_joint);
        for position in &mut positions_m {
            position.y -= low_m;
        }
        Self { world_from_joint, positions_m, sole_below_feet_m: 0.0 }
    }
}

/// The joints at which the bone of a role may end, best first.
pub(crate) fn bone_ends(role: JointRole) -> &'static [JointRole] {
    use JointRole as R;
    match role {
        R::Hips => &[R::Spine, R::Spine1, R::Spine2, R::Neck, R::Head],
        R::Spine => &[R::Spine1, R::Spine2, R::Neck, R::Head],
        R::Spine1 => &[R::Spine2, R::Neck, R::Head],
        R::Spine2 => &[R::Neck, R::Head],
        R::Neck => &[R::Head],
        R::LeftShoulder => &[R::LeftArm],
        R::LeftArm => &[R::LeftForeArm, R::LeftHand],
        R::LeftForeArm => &[R::LeftHand],
        R::RightShoulder => &[R::RightArm],
        R::RightArm => &[R::RightForeArm, R::RightHand],
        R::RightForeArm => &[R::RightHand],
        R::LeftUpLeg => &[R::LeftLeg],
        R::LeftLeg => &[R::LeftFoot],
        R::LeftFoot => &[R::LeftToeBase],
        R::RightUpLeg => &[R::RightLeg],
        R::RightLeg => &[R::RightFoot],
        R::RightFoot => &[R::RightToeBase],
        R::Head | R::LeftHand | R::RightHand | R::LeftToeBase | R::RightToeBase => &[],
    }
}

/// Direction of the bone of `role` in a pose; `None` where its ends are not recognised or meet.
pub(crate) fn bone_direction(
    skeleton: &Skeleton,
    positions_m: &[Vec3],
    role: JointRole,
) -> Option<Vec3> {
    let from = skeleton.by_role(role)?;
    let to = bone_ends(role).iter().find_map(|&end| skeleton.by_role(end))?;
    (positions_m[to.idx()] - positions_m[from.idx()]).try_normalize()
}

/// Positions of all joints for world rotations, the root at the origin, metres.
pub(crate) fn positions_m(skeleton: &Skeleton, world_from_joint: &[Quat]) -> Vec<Vec3> {
    assert_eq!(world_from_joint.len(), skeleton.n_joints(), "another skeleton's pose");
    let mut positions: Vec<Vec3> = Vec::with_capacity(skeleton.n_joints());
    for joint in skeleton.joints() {
        positions.push(match joint.parent {
            None => Vec3::ZERO,
            Some(parent) => {
                positions[parent.idx()] + world_from_joint[parent.idx()] * joint.offset_m
            }
        });
    }
    positions
}

/// Height of the lowest joint or end site of the feet (of the whole body, without recognised
/// feet), metres.
pub(crate) fn lowest_foot_m(
    skeleton: &Skeleton,
    positions_m: &[Vec3],
    world_from_joint: &[Quat],
) -> f32 {
    let ankles = [JointRole::LeftFoot, JointRole::RightFoot].map(|role| skeleton.by_role(role));
    let mut is_foot = vec![false; skeleton.n_joints()];
    for (idx, joint) in skeleton.joints().iter().enumerate() {
        let below = joint.parent.is_some_and(|parent| is_foot[parent.idx()]);
        is_foot[idx] = below || ankles.contains(&Some(JointIdx::from_idx(idx)));
    }
    let any_foot = is_foot.contains(&true);
    let mut low_m = f32::INFINITY;
    for (idx, joint) in skeleton.joints().iter().enumerate() {
        if any_foot && !is_foot[idx] {
            continue;
        }
        let end_m = joint.end_site_m.map_or(0.0, |end| (world_from_joint[idx] * end).y);
        low_m = low_m.min(positions_m[idx].y + end_m.min(0.0));
    }
    if low_m.is_finite() { low_m } else { 0.0 }
}

/// From the right side of a body to its left: by its thighs, where these begin apart, else by its
/// arms.
pub(crate) fn left_of(skeleton: &Skeleton, positions_m: &[Vec3]) -> Option<Vec3> {
    use JointRole as R;
    let at = |role| skeleton.by_role(role).map(|joint| positions_m[joint.idx()]);
    let across = |left, right| Some(at(left)? - at(right)?);
    let size_m = positions_m.iter().map(|at| at.distance(positions_m[0])).fold(0.0, f32::max);
    let apart = |across: &Vec3| across.length() > APART_SHARE * size_m;
    let thighs = across(R::LeftUpLeg, R::RightUpLeg).filter(apart);
    thighs.or_else(|| across(R::LeftArm, R::RightArm).filter(apart))?.try_normalize()
}

/// Joints that are closer than this share of the body are at one place.
const APART_SHARE: f32 = 0.01;

/// How upright a pose is, as cosines to the vertical.
#[derive(Clone, Copy, Debug)]
struct Stance {
    /// Of the back, from the hips to the highest part of it that is recognised.
    back: f32,
    /// The least of all thighs and shins, to straight down.
    legs: f32,
    /// The most of both arms.
    arms: f32,
    /// From the right side of the body to its left.
    left: Vec3,
}

impl Stance {
    /// `None` where hips, a back or legs are not recognised.
    fn of(skeleton: &Skeleton, positions_m: &[Vec3]) -> Option<Self> {
        use JointRole as R;
        let at = |role| skeleton.by_role(role).map(|joint| positions_m[joint.idx()]);
        let direction = |role| bone_direction(skeleton, positions_m, role);
        let top = [R::Neck, R::Head, R::Spine2, R::Spine1, R::Spine].into_iter().find_map(at)?;
        let back = (top - at(R::Hips)?).try_normalize()?.y;
        let mut legs = f32::INFINITY;
        for role in [R::LeftUpLeg, R::RightUpLeg] {
            legs = legs.min(-direction(role)?.y);
        }
        for shin in [R::LeftLeg, R::RightLeg].into_iter().filter_map(direction) {
            legs = legs.min(-shin.y);
        }
        let arms = [R::LeftArm, R::RightArm].into_iter().filter_map(direction);
        let arms = arms.map(|arm| arm.y).fold(-1.0, f32::max);
        Some(Self { back, legs, arms, left: left_of(skeleton, positions_m)? })
    }

    /// Whether a person would stand so, facing +Z.
    fn stands_ahead(self) -> bool {
        let upright = self.back.min(self.legs) > STANDING_COS;
        upright && self.arms < RAISED_COS && self.left.x > STANDING_COS
    }

    /// The more the better a pose to compare bodies in; raised arms count against it.
    fn merit(self) -> f32 {
        self.back + 2.0 * self.legs - 0.5 * self.arms.max(0.0)
    }
}

/// World rotations of the best standing pose of a motion, turned to face +Z; `None` without one.
fn most_upright(skeleton: &Skeleton, motion: &Motion) -> Option<Vec<Quat>> {
    assert_eq!(motion.n_joints(), skeleton.n_joints(), "another skeleton's motion");
    let step = motion.n_frames().div_ceil(MAX_FRAMES).max(1);
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    let mut best: Option<(usize, Stance)> = None;
    for frame in (0..motion.n_frames()).step_by(step) {
        motion.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
        let stance = Stance::of(skeleton, &positions)?;
        if best.is_none_or(|(_, known)| stance.merit() > known.merit()) {
            best = Some((frame, stance));
        }
    }
    let (frame, stance) = best?;
    if stance.back.min(stance.legs) < UPRIGHT_COS {
        return None;
    }
    motion.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
    let left = Vec3::new(stance.left.x, 0.0, stance.left.z).try_normalize()?;
    let ahead_from_seen = Quat::from_rotation_y(left.z.atan2(left.x));
    Some(rotations.iter().map(|&q| (ahead_from_seen * q).normalize()).collect())
}

/// World rotations that swing every recognised bone where it belongs.
fn swung(skeleton: &Skeleton) -> Vec<Quat> {
    let rest = positions_m(skeleton, &vec![Quat::IDENTITY; skeleton.n_joints()]);
    let upright = upright_from_rest(skeleton, &rest);
    let mut world: Vec<Quat> = Vec::with_capacity(skeleton.n_joints());
    for (idx, joint) in skeleton.joints().iter().enumerate() {
        let role = skeleton.roles().role_of(JointIdx::from_idx(idx));
        let swing = role.and_then(|role| {
            let from = upright * bone_direction(skeleton, &rest, role)?;
            Some(arc(from, usual_direction(role)?) * upright)
        });
        let inherited = joint.parent.map_or(upright, |parent| world[parent.idx()]);
        world.push(swing.unwrap_or(inherited).normalize());
    }
    world
}

/// The turn that brings the hips' sides to ±X and, as far as that lets it, the back up.
fn upright_from_rest(skeleton: &Skeleton, rest: &[Vec3]) -> Quat {
    let left = left_of(skeleton, rest);
    let up = bone_direction(skeleton, rest, JointRole::Hips);
    let (Some(left), Some(up)) = (left, up) else { return Quat::IDENTITY };
    let Some(up) = up.reject_from_normalized(left).try_normalize() else { return Quat::IDENTITY };
    Quat::from_mat3(&Mat3::from_cols(left, up, left.cross(up)).transpose())
}

/// Where the bone of a role points when a person stands; `None` for hips and ends of limbs.
pub(crate) fn usual_direction(role: JointRole) -> Option<Vec3> {
    use JointRole as R;
    match role {
        R::Spine | R::Spine1 | R::Spine2 | R::Neck => Some(Vec3::Y),
        R::LeftShoulder | R::LeftArm | R::LeftForeArm => Some(Vec3::X),
        R::RightShoulder | R::RightArm | R::RightForeArm => Some(Vec3::NEG_X),
        R::LeftUpLeg | R::LeftLeg | R::RightUpLeg | R::RightLeg => Some(Vec3::NEG_Y),
        // An ankle is above the ball of its foot by half the distance between them.
        R::LeftFoot | R::RightFoot => Vec3::new(0.0, -0.5, 0.87).try_normalize(),
        R::Hips | R::Head | R::LeftHand | R::RightHand | R::LeftToeBase | R::RightToeBase => None,
    }
}

/// The smallest rotation from one unit vector to another; half a turn is made about X as far as
/// possible, so that legs swing down without changing sides.
fn arc(from: Vec3, to: Vec3) -> Quat {
    if from.dot(to) > -0.9999 {
        return Quat::from_rotation_arc(from, to);
    }
    let axis = Vec3::X.reject_from_normalized(from).try_normalize().unwrap_or(Vec3::Z);
    Quat::from_axis_angle(axis, std::f32::consts::PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::angle_between_rad;
    use crate::testing::bodies::{a_pose, along_one_axis, standing_motion, t_pose};

    /// Checks that the pose stands, looks ahead and has its sole at 0.
    #[track_caller]
    fn check_stands(skeleton: &Skeleton, pose: &BindPose) {
        let stance = Stance::of(skeleton, pose.positions_m()).expect("a person");
        assert!(stance.stands_ahead(), "{stance:?}");
        let low = lowest_foot_m(skeleton, pose.positions_m(), pose.world_from_joint());
        assert!(low.abs() < 1e-6, "{low}");
        let toe = bone_direction(skeleton, pose.positions_m(), JointRole::LeftFoot).expect("toes");
        assert!(toe.z > 0.7, "feet point ahead: {toe}");
    }

    #[test]
    fn a_rest_pose_that_stands_is_the_pose() {
        for body in [t_pose(1.0), a_pose(1.0)] {
            let pose = BindPose::of(&body, None);
            assert_eq!(pose, BindPose::rest(&body));
            check_stands(&body, &pose);
        }
    }

    #[test]
    fn bones_along_one_axis_are_swung() {
        let body = along_one_axis();
        let stance = Stance::of(&body, &positions_m(&body, &[Quat::IDENTITY; 22])).unwrap();
        assert!(stance.legs < 0.0, "legs point up at rest: {stance:?}");
        let pose = BindPose::of(&body, None);
        check_stands(&body, &pose);
        let arm = bone_direction(&body, pose.positions_m(), JointRole::RightArm).unwrap();
        assert!(arm.x < -0.99, "{arm}");
    }

    #[test]
    fn a_standing_frame_is_found_and_turned_ahead() {
        let body = along_one_axis();
        let motion = standing_motion(&body, 2.0);
        let pose = BindPose::of(&body, Some(&motion));
        check_stands(&body, &pose);
        // Frame 7 is the upright one, up to its heading.
        let (mut positions, mut rotations) = (Vec::new(), Vec::new());
        motion.forward_kinematics(&body, 7, &mut positions, &mut rotations);
        let knee = body.by_role(JointRole::LeftLeg).unwrap().idx();
        let relative = |q: &[Quat]| q[0].inverse() * q[knee];
        let found = relative(pose.world_from_joint());
        assert!(angle_between_rad(found, relative(&rotations)) < 1e-3);
    }

    #[test]
    fn a_body_without_parts_keeps_its_rest_pose() {
        use crate::testing::joint;
        let worm = [joint("a", None, [0.0; 3]), joint("b", Some(0), [0.0, -1.0, 0.0])];
        let worm = Skeleton::new(worm.to_vec()).unwrap();
        let pose = BindPose::of(&worm, None);
        assert_eq!(pose.positions_m(), [Vec3::Y, Vec3::ZERO]);
    }

    #[test]
    fn a_sole_lifts_the_body() {
        let body = t_pose(1.0);
        let flat = BindPose::of(&body, None);
        let shod = flat.clone().with_sole(0.05);
        assert!((shod.positions_m()[0].y - flat.positions_m()[0].y - 0.05).abs() < 1e-6);
        assert_eq!(shod.with_sole(0.0).positions_m()[0].y, flat.positions_m()[0].y);
    }
}
