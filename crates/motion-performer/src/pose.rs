//! One instant of the whole body, before it becomes joint rotations.

use glam::{Quat, Vec3};
use motion_core::ik::{TwoBone, bone_rotation};
use motion_core::rotation;

use crate::body::{LEFT_HIP_M, SHIN_M, THIGH_M, joint, sign};
use crate::foot_pose::FootPose;
use crate::gait_curves::UpperBody;
use crate::signal::{dilated, gaussian};
use motion_core::contacts::Side;

/// The straightest a leg gets, as a share of its length: 13.6° of knee flexion. Beyond, the knee
/// moves with the square root of what is left and pops.
const STRAIGHTEST: f32 = 0.993;
/// How much knees point outwards, against 2 for ahead: they must not meet in turns.
const KNEES_OUT: f32 = 0.2;

/// What the body does at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    /// The hips joint in the world.
    pub(crate) hips_m: Vec3,
    pub(crate) hips: Quat,
    /// Spine, spine1, spine2: local.
    pub(crate) spine: [Quat; 3],
    /// The head's rotation in the world.
    pub(crate) gaze: Quat,
    /// Arm and forearm, left and right: local.
    pub(crate) arms: [[Quat; 2]; 2],
    /// Left and right.
    pub(crate) feet: [FootPose; 2],
}

impl Pose {
    /// The pose with trunk and arms of `upper`, hips relative to `world_from_lean`.
    pub(crate) fn new(
        hips_m: Vec3,
        world_from_lean: Quat,
        upper: &UpperBody,
        gaze: Quat,
        feet: [FootPose; 2],
    ) -> Self {
        let [hips, spine @ ..] = upper.trunk.map(rotation::exp);
        Self {
            hips_m,
            hips: world_from_lean * hips,
            spine,
            gaze,
            arms: upper.arms.map(|arm| arm.map(rotation::exp)),
            feet,
        }
    }

    /// The hip joint of a leg in the world.
    fn hip_m(&self, side: Side) -> Vec3 {
        let offset = Vec3::new(sign(side) * LEFT_HIP_M.x, LEFT_HIP_M.y, LEFT_HIP_M.z);
        self.hips_m + self.hips * offset
    }

    /// How much the hips must come down for both legs to reach their feet; below 0 where they
    /// reach them anyway.
    fn excess_height_m(&self) -> f32 {
        let reach_m = STRAIGHTEST * (THIGH_M + SHIN_M);
        let excess = |side: Side| {
            let hip_m = self.hip_m(side);
            let ankle_m = self.feet[side.idx()].ankle_m;
            let (dx, dz) = (hip_m.x - ankle_m.x, hip_m.z - ankle_m.z);
            let highest_m = (reach_m * reach_m - dx * dx - dz * dz).max(0.0).sqrt();
            hip_m.y - ankle_m.y - highest_m
        };
        excess(Side::Left).max(excess(Side::Right))
    }

    /// The body mirrored at the plane x = 0.
    pub(crate) fn mirrored(&self) -> Self {
        let flip = Vec3::new(-1.0, 1.0, 1.0);
        let foot = |f: FootPose| FootPose { ankle_m: f.ankle_m * flip, yaw_rad: -f.yaw_rad, ..f };
        let [left, right] = self.arms.map(|arm| arm.map(rotation::mirrored));
        Self {
            hips_m: self.hips_m * flip,
            hips: rotation::mirrored(self.hips),
            spine: self.spine.map(rotation::mirrored),
            gaze: rotation::mirrored(self.gaze),
            arms: [right, left],
            feet: [foot(self.feet[1]), foot(self.feet[0])],
        }
    }

    /// Appends the local rotations of all joints, in the skeleton's order.
    ///
    /// Knees bend in the plane of the leg that looks where hips and foot look on average, a
    /// little outwards. A foot
    /// out of reach is approached as far as the leg goes; [`lower_to_reach`] has seen to it that
    /// this does not happen to a planted one.
    pub(crate) fn write_rotations(&self, rotations: &mut Vec<Quat>) {
        let first = rotations.len();
        rotations.resize(first + joint::COUNT, Quat::IDENTITY);
        let pose = &mut rotations[first..];

        pose[joint::HIPS] = self.hips;
        let mut chest = self.hips;
        for (i, &spine) in self.spine.iter().enumerate() {
            pose[joint::SPINE + i] = spine;
            chest *= spine;
        }
        // The neck takes half of what the head turns against the chest.
        let turn = rotation::log(chest.inverse() * self.gaze);
        pose[joint::NECK] = rotation::exp(turn * 0.5);
        pose[joint::HEAD] = rotation::exp(turn * 0.5);

        for side in Side::BOTH {
            let [arm, fore_arm] = self.arms[side.idx()];
            let shoulder = joint::SHOULDER[side.idx()];
            pose[shoulder + 1] = arm;
            pose[shoulder + 2] = fore_arm;
            let leg = self.leg_rotations(side);
            let up_leg = joint::UP_LEG[side.idx()];
            pose[up_leg..up_leg + 4].copy_from_slice(&leg);
        }
    }

    /// Local rotations of thigh, shin, foot and toes.
    fn leg_rotations(&self, side: Side) -> [Quat; 4] {
        let foot = self.feet[side.idx()];
        let toes = Quat::from_rotation_x(foot.toe_bend_rad);
        let outwards = self.hips * Vec3::X * sign(side);
        let pole = self.hips * Vec3::Z
            + Quat::from_rotation_y(foot.yaw_rad) * Vec3::Z
            + outwards * KNEES_OUT;
        let Some(leg) = TwoBone::new(THIGH_M, SHIN_M) else {
            return [Quat::IDENTITY, Quat::IDENTITY, Quat::IDENTITY, toes];
        };
        let hip_m = self.hip_m(side);
        let bend = leg.solve(hip_m, foot.ankle_m, pole);
        let bone = |along: Vec3| {
            bone_rotation(Vec3::NEG_Y, Vec3::X, along, bend.hinge).unwrap_or(self.hips)
        };
        let thigh = bone(bend.mid_m - hip_m);
        let shin = bone(bend.end_m - bend.mid_m);
        [
            self.hips.inverse() * thigh,
            thigh.inverse() * shin,
            shin.inverse() * foot.rotation(),
            toes,
        ]
    }
}

/// Lowers the hips, smoothly in time, where a leg would not reach its foot.
///
/// `poses` are samples at a fixed rate and `reach_samples` is how early the lowering begins. The
/// largest excess within reach, smoothed by a kernel no wider than the reach, is never below the
/// excess itself, so afterwards every foot is within reach.
pub(crate) fn lower_to_reach(poses: &mut [Pose], reach_samples: usize) {
    let excess: Vec<f32> = poses.iter().map(|p| p.excess_height_m().max(0.0)).collect();
    let lowered = gaussian(&dilated(&excess, reach_samples), reach_samples as f32 / 3.0);
    for (pose, lower_m) in poses.iter_mut().zip(lowered) {
        pose.hips_m.y -= lower_m;
    }
}
