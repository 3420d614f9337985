//! A motion of one body, done by another one.
//!
//! Joints are matched by the part of the body they are ([`JointRole`]), so the bodies may differ
//! in names, number of joints, proportions and rest pose. What is kept is where bones point in the
//! world: with S and T the world rotations of a joint and its counterpart in the two
//! [standing poses](BindPose), R the source's at a frame, the target's is
//!
//! ```text
//! R · S⁻¹ · A · T
//! ```
//!
//! where A, for arms and legs, is the smallest rotation that takes the bone of the target's
//! standing pose to where the source's is in its own: arms at 45° follow arms that are out. Feet
//! are only turned about the vertical, so that soles stay flat. A back with more or fewer
//! links takes its rotations between those of the source's links.
//!
//! The hips' height is `h_T + k · (y − h_S)`, with k the ratio of leg lengths and h the heights of
//! the standing hips above the soles: a body that stands on the floor does so on other legs, and
//! bent knees lower it in proportion. Hands and feet are not pulled to where they were: contacts
//! with other bodies and objects are not kept.

use std::fmt;

use glam::{Quat, Vec3};

use crate::bind_pose::{BindPose, bone_direction, lowest_foot_m, positions_m, usual_direction};
use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::rotation;
use crate::skeleton::{JointRole, Skeleton};

/// What happens to the length of the way over the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathScale {
    /// It is scaled by the ratio of leg lengths about the first frame's place: feet do not slide.
    #[default]
    ByLegs,
    /// It stays: places are met, and feet slide where legs differ.
    Keep,
}

/// Why a motion cannot be brought from one body to another: parts that both must have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RetargetError {
    /// Parts that are not recognised on the body that moves.
    pub missing_in_source: Vec<JointRole>,
    /// Parts that are not recognised on the body that is to move.
    pub missing_in_target: Vec<JointRole>,
}

impl fmt::Display for RetargetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = |roles: &[JointRole]| {
            roles.iter().map(|role| role.name()).collect::<Vec<_>>().join(", ")
        };
        let sides = [("source", &self.missing_in_source), ("target", &self.missing_in_target)];
        let mut separator = "";
        for (side, missing) in sides.into_iter().filter(|(_, missing)| !missing.is_empty()) {
            write!(f, "{separator}the {side} has no {}", names(missing))?;
            separator = " and ";
        }
        Ok(())
    }
}

impl std::error::Error for RetargetError {}

/// Without these a body is not known to stand on two legs.
const NEEDED: [JointRole; 3] = [JointRole::Hips, JointRole::LeftUpLeg, JointRole::RightUpLeg];

/// Without these a body cannot show another one's legs where that one has them.
const SHINS: [JointRole; 2] = [JointRole::LeftLeg, JointRole::RightLeg];

/// How the motions of one skeleton become motions of another.
#[derive(Clone, Debug, PartialEq)]
pub struct Retarget {
    source: Skeleton,
    target: Skeleton,
    /// S⁻¹ of every joint of the source.
    joint_from_source_bind: Vec<Quat>,
    /// What every joint of the target follows.
    follows: Vec<Follow>,
    /// The standing pose of the target with its limbs as the source's (A · T).
    aligned: Vec<Quat>,
    /// For every joint its rotation relative to its parent in that pose.
    aligned_local: Vec<Quat>,
    source_hips: JointIdx,
    target_hips: JointIdx,
    /// From the hips up to the root.
    target_chain: Vec<JointIdx>,
    standing_source_m: f32,
    standing_target_m: f32,
    leg_ratio: f32,
    path: PathScale,
}

/// What a joint of the target follows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Follow {
    /// A joint of the source, or a mixture of two: the second counts by the number.
    Source(JointIdx, JointIdx, f32),
    /// Its parent, rigidly.
    Parent,
    /// The hips, which it carries, rigidly.
    Hips,
}

impl Retarget {
    /// From `source` to `target`, compared in their standing poses.
    ///
    /// Fails where hips or thighs are not recognised on either body, or shins on the source alone,
    /// unless the source has a joint of the same name for every joint of the target.
    ///
    /// # Panics
    /// When a pose is another skeleton's.
    pub fn new(
        source: &Skeleton,
        source_bind: &BindPose,
        target: &Skeleton,
        target_bind: &BindPose,
    ) -> Result<Self, RetargetError> {
        assert_eq!(source_bind.positions_m().len(), source.n_joints(), "another skeleton's pose");
        assert_eq!(target_bind.positions_m().len(), target.n_joints(), "another skeleton's pose");
        check_needed(source, target)?;
        let hips = |skeleton: &Skeleton| skeleton.by_role(JointRole::Hips);
        let (source_hips, target_hips) = match (hips(source), hips(target)) {
            (Some(source), Some(target)) => (source, target),
            _ => (JointIdx(0), JointIdx(0)),
        };
        let target_chain = chain(target, target_hips);
        let follows = follows(source, target, (source_hips, target_hips), &target_chain);
        let turns = Turns { source, source_bind, target, target_bind };
        let aligned = turns.aligned(&follows);
        let relative = |idx: usize| match target.joints()[idx].parent {
            Some(parent) => (aligned[parent.idx()].inverse() * aligned[idx]).normalize(),
            None => aligned[idx],
        };
        let aligned_local = (0..target.n_joints()).map(relative).collect();
        let positions = positions_m(target, &aligned);
        let sole_m = lowest_foot_m(target, &positions, &aligned) - target_bind.sole_below_feet_m();
        let standing_source_m = source_bind.positions_m()[source_hips.idx()].y;
        let standing_target_m = positions[target_hips.idx()].y - sole_m;
        let ratio = match (source.leg_length_m(), target.leg_length_m()) {
            (Some(source), Some(target)) => target / source,
            _ => standing_target_m / standing_source_m,
        };
        Ok(Self {
            source: source.clone(),
            target: target.clone(),
            joint_from_source_bind: source_bind
                .world_from_joint()
                .iter()
                .map(|q| q.inverse())
                .collect(),
            follows,
            aligned,
            aligned_local,
            source_hips,
            target_hips,
            target_chain,
            standing_source_m,
            standing_target_m,
            // A body without any extent has nothing to be scaled by.
            leg_ratio: if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 },
            path: PathScale::ByLegs,
        })
    }

    /// The same with another rule for the way over the ground.
    #[must_use]
    pub fn with_path(mut self, path: PathScale) -> Self {
        self.path = path;
        self
    }

    /// The target's leg length over the source's.
    pub fn leg_ratio(&self) -> f32 {
        self.leg_ratio
    }

    /// Joints of the target that follow no joint of the source: they stay as in the standing pose,
    /// relative to their parents.
    pub fn still_joints(&self) -> impl Iterator<Item = JointIdx> {
        let still = |follow: &Follow| !matches!(follow, Follow::Source(..));
        let joints = self.follows.iter().enumerate().filter(move |(_, follow)| still(follow));
        joints.map(|(idx, _)| JointIdx::from_idx(idx))
    }

    /// The motion on the target's skeleton, at the same rate.
    ///
    /// # Panics
    /// When the motion is not the source's.
    #[must_use]
    pub fn apply(&self, motion: &Motion) -> Motion {
        assert_eq!(motion.n_joints(), self.source.n_joints(), "another skeleton's motion");
        let n_joints = self.target.n_joints();
        let mut roots = Vec::with_capacity(motion.n_frames());
        let mut rotations = Vec::with_capacity(motion.n_frames() * n_joints);
        let (mut positions, mut turned) = (Vec::new(), Vec::new());
        let mut world = vec![Quat::IDENTITY; n_joints];
        let mut start = None;
        for frame in 0..motion.n_frames() {
            motion.forward_kinematics(&self.source, frame, &mut positions, &mut turned);
            for (turned, joint_from_bind) in turned.iter_mut().zip(&self.joint_from_source_bind) {
                *turned *= *joint_from_bind;
            }
            self.pose(&turned, &mut world);
            for (idx, joint) in self.target.joints().iter().enumerate() {
                let local = match joint.parent {
                    Some(parent) => world[parent.idx()].inverse() * world[idx],
                    None => world[idx],
                };
                rotations.push(local.normalize());
            }
            let hips = positions[self.source_hips.idx()];
            let hips = self.hips_m(hips, *start.get_or_insert(hips));
            roots.push(hips - self.hips_from_root_m(&world));
        }
        Motion::from_unit_parts(motion.fps(), n_joints, roots, rotations)
    }

    /// World rotations of the target, from what each joint of the source has turned since its
    /// standing pose.
    fn pose(&self, turned: &[Quat], world: &mut [Quat]) {
        let hips_turned = self.turned(turned, self.target_hips.idx());
        for idx in 0..world.len() {
            world[idx] = match (self.follows[idx], self.target.joints()[idx].parent) {
                (Follow::Source(..), _) => self.turned(turned, idx) * self.aligned[idx],
                (Follow::Parent, Some(parent)) => world[parent.idx()] * self.aligned_local[idx],
                (Follow::Hips, _) | (_, None) => hips_turned * self.aligned[idx],
            };
        }
    }

    fn turned(&self, turned: &[Quat], idx: usize) -> Quat {
        match self.follows[idx] {
            Follow::Source(a, b, _) if a == b => turned[a.idx()],
            Follow::Source(a, b, t) => rotation::slerp(turned[a.idx()], turned[b.idx()], t),
            Follow::Parent | Follow::Hips => Quat::IDENTITY,
        }
    }

    /// Where the target's hips are when the source's are at `hips`, having begun at `start`.
    fn hips_m(&self, hips: Vec3, start: Vec3) -> Vec3 {
        let y = self.standing_target_m + self.leg_ratio * (hips.y - self.standing_source_m);
        match self.path {
            PathScale::ByLegs if self.leg_ratio != 1.0 => {
                (start + self.leg_ratio * (hips - start)).with_y(y)
            }
            PathScale::ByLegs | PathScale::Keep => hips.with_y(y),
        }
    }

    fn hips_from_root_m(&self, world: &[Quat]) -> Vec3 {
        let links = self.target_chain.windows(2);
        links.map(|pair| world[pair[1].idx()] * self.target.joint(pair[0]).offset_m).sum()
    }
}

fn check_needed(source: &Skeleton, target: &Skeleton) -> Result<(), RetargetError> {
    let missing = |skeleton: &Skeleton| -> Vec<JointRole> {
        NEEDED.into_iter().filter(|&role| skeleton.by_role(role).is_none()).collect()
    };
    // Legs of one piece follow thighs; a knee needs something to follow.
    let unmoved =
        |&role: &JointRole| target.by_role(role).is_some() && source.by_role(role).is_none();
    let mut missing_in_source = missing(source);
    missing_in_source.extend(SHINS.into_iter().filter(unmoved));
    let error = RetargetError { missing_in_source, missing_in_target: missing(target) };
    let complete = error.missing_in_source.is_empty() && error.missing_in_target.is_empty();
    let all_named = || target.joints().iter().all(|joint| source.by_name(&joint.name).is_some());
    if complete || all_named() { Ok(()) } else { Err(error) }
}

/// `joint` and everything that carries it, up to the root.
fn chain(skeleton: &Skeleton, joint: JointIdx) -> Vec<JointIdx> {
    std::iter::successors(Some(joint), |&joint| skeleton.joint(joint).parent).collect()
}

/// What every joint of the target follows: roles first, then equal names.
fn follows(
    source: &Skeleton,
    target: &Skeleton,
    (source_hips, target_hips): (JointIdx, JointIdx),
    target_chain: &[JointIdx],
) -> Vec<Follow> {
    let mut follows = vec![Follow::Parent; target.n_joints()];
    let mut is_taken = vec![false; source.n_joints()];
    let mut follow = |target: JointIdx, a: JointIdx, b: JointIdx, t: f32| {
        follows[target.idx()] = Follow::Source(a, b, t);
        (is_taken[a.idx()], is_taken[b.idx()]) = (true, true);
    };
    for &role in JointRole::ALL {
        if let (Some(from), Some(to)) = (source.by_role(role), target.by_role(role)) {
            follow(to, from, from, 0.0);
        }
    }
    follow(target_hips, source_hips, source_hips, 0.0);
    let back = |skeleton: &Skeleton| -> Vec<JointIdx> {
        let links = [JointRole::Spine, JointRole::Spine1, JointRole::Spine2];
        links.into_iter().filter_map(|role| skeleton.by_role(role)).collect()
    };
    let (from, to) = (back(source), back(target));
    if !from.is_empty() && from.len() != to.len() {
        for (link, &joint) in to.iter().enumerate() {
            // The last link carries neck and arms, so it is the last one's image.
            let share = if to.len() > 1 { link as f32 / (to.len() - 1) as f32 } else { 1.0 };
            let at = share * (from.len() - 1) as f32;
            let a = at.floor() as usize;
            let b = (a + 1).min(from.len() - 1);
            follow(joint, from[a], from[b], at - a as f32);
        }
    }
    for (idx, joint) in target.joints().iter().enumerate() {
        let is_free = follows[idx] == Follow::Parent;
        if let Some(from) = source.by_name(&joint.name)
            && is_free
            && !is_taken[from.idx()]
        {
            follows[idx] = Follow::Source(from, from, 0.0);
            is_taken[from.idx()] = true;
        }
    }
    for &above in &target_chain[1..] {
        if follows[above.idx()] == Follow::Parent {
            follows[above.idx()] = Follow::Hips;
        }
    }
    follows
}

/// Two bodies in their standing poses.
struct Turns<'a> {
    source: &'a Skeleton,
    source_bind: &'a BindPose,
    target: &'a Skeleton,
    target_bind: &'a BindPose,
}

impl Turns<'_> {
    /// World rotations of the target's standing pose with its limbs as the source's (A · T).
    fn aligned(&self, follows: &[Follow]) -> Vec<Quat> {
        let mut turns: Vec<Quat> = Vec::with_capacity(follows.len());
        for (idx, joint) in self.target.joints().iter().enumerate() {
            let inherited = joint.parent.map_or(Quat::IDENTITY, |parent| turns[parent.idx()]);
            let role = self.target.roles().role_of(JointIdx::from_idx(idx));
            turns.push(match (role, follows[idx]) {
                (Some(role), Follow::Source(..)) => self.turn(role, inherited),
                _ => inherited,
            });
        }
        let bind = self.target_bind.world_from_joint();
        turns.iter().zip(bind).map(|(&turn, &bind)| (turn * bind).normalize()).collect()
    }

    /// A of one part; `inherited` is that of its parent, which ends of limbs keep.
    fn turn(&self, role: JointRole, inherited: Quat) -> Quat {
        use JointRole as R;
        let from = bone_direction(self.target, self.target_bind.positions_m(), role);
        let to = bone_direction(self.source, self.source_bind.positions_m(), role);
        match role {
            R::LeftArm
            | R::LeftForeArm
            | R::RightArm
            | R::RightForeArm
            | R::LeftUpLeg
            | R::LeftLeg
            | R::RightUpLeg
            | R::RightLeg => match (from, to) {
                (Some(from), Some(to)) => Quat::from_rotation_arc(from, to),
                // The limb is of one piece, so that nothing tells where it ends.
                (None, Some(to))
                    if matches!(role, R::LeftArm | R::RightArm | R::LeftUpLeg | R::RightUpLeg) =>
                {
                    usual_direction(role)
                        .map_or(inherited, |from| Quat::from_rotation_arc(from, to))
                }
                _ => inherited,
            },
            R::LeftFoot | R::RightFoot => match (from, to) {
                (Some(from), Some(to)) => {
                    let heading = |v: Vec3| v.x.atan2(v.z);
                    Quat::from_rotation_y(heading(to) - heading(from))
                }
                _ => Quat::IDENTITY,
            },
            R::LeftHand | R::RightHand | R::LeftToeBase | R::RightToeBase => inherited,
            R::Hips
            | R::Spine
            | R::Spine1
            | R::Spine2
            | R::Neck
            | R::Head
            | R::LeftShoulder
            | R::RightShoulder => Quat::IDENTITY,
        }
    }
}

#[cfg(test)]
mod tests;
