//! From a spec to a motion: travel → foot plan → feet → hips → whole body.

use std::f32::consts::PI;

use glam::{Quat, Vec3};
use motion_core::ground::Contacts;
use motion_core::motion::{Motion, MotionError};
use motion_core::units::Fps;

use crate::body::joint;
use crate::foot_plan::stances;
use crate::foot_pose::FootPose;
use crate::pelvis::{leads, over};
use crate::pose::{Pose, lower_to_reach};
use crate::signal::gaussian;
use crate::swing::FootTrack;
use crate::travel::{GRID_HZ, Performance, SpecError, Travel};
use motion_core::contacts::Side;

/// Frames per second of what is performed.
const FRAME_HZ: usize = 30;
/// Planned samples per frame.
const SAMPLES_PER_FRAME: usize = GRID_HZ / FRAME_HZ;
/// The hips begin to come down this long before a leg would be too short.
const LOWERING_S: f32 = 0.09;
/// Eyes look where the body will be looking this much later.
const LOOK_AHEAD_S: f32 = 0.30;
const LOOK_SIGMA_S: f32 = 0.12;
/// The head is held this much below the level gaze of the rest pose.
pub(crate) const HEAD_DIP_RAD: f32 = 0.05;
/// The spine gives back this share of a sideways lean.
const SPINE_UPRIGHT: f32 = 0.35;

/// A motion of the built-in skeleton with its feet's contacts.
#[derive(Clone, Debug, PartialEq)]
pub struct Performed {
    /// What the body does, 30 frames per second.
    pub motion: Motion,
    /// Which feet are planted, per frame: the toe joint stands still on the floor. Known from
    /// the foot plan, not found out.
    pub contacts: Vec<Contacts>,
}

/// Poses at the planning rate, and which of them are shown.
#[derive(Clone, Debug)]
pub(crate) struct Take {
    pub(crate) poses: Vec<Pose>,
    pub(crate) first: usize,
    pub(crate) n_shown: usize,
}

/// Why a spec cannot be performed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PerformError {
    /// One of the rules of [`Performance`].
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A speed or heading that is not a number leads nowhere.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// Performs a stretch of gait. The same spec always gives the same motion.
pub fn perform(spec: &Performance) -> Result<Performed, PerformError> {
    spec.check()?;
    Ok(gait_take(spec).performed()?)
}

pub(crate) fn gait_take(spec: &Performance) -> Take {
    let travel = Travel::new(spec);
    let forward = travel.drift_rad.cos();
    let plan = Side::BOTH.map(|side| stances(&travel, side));
    let feet = Side::BOTH.map(|side| {
        let other = &plan[1 - side.idx()];
        let track = FootTrack::new(side, plan[side.idx()].clone(), forward, other);
        (0..travel.moments.len())
            .map(|i| track.pose(i as f32 / GRID_HZ as f32))
            .collect::<Vec<FootPose>>()
    });
    let leads = leads(&travel, &feet);
    let gaze = gaze_rad(&travel);

    // What is out of reach of the shown frames' lowering need not be posed.
    let reach = (LOWERING_S * GRID_HZ as f32) as usize;
    let from = travel.first.saturating_sub(2 * reach);
    let to = (travel.first + travel.n_shown + 2 * reach).min(travel.moments.len());
    let poses = (from..to).map(|i| {
        let (moment, lead) = (&travel.moments[i], &leads[i]);
        // Sideways and backwards the arms have less to balance.
        let upper = moment.gait().upper_body(moment.phase, 0.4 + 0.6 * forward.max(0.0));
        let ahead = glam::Vec2::new(moment.heading_rad.sin(), moment.heading_rad.cos());
        let hips_m = over(lead.ground_m + ahead * upper.surge_m, upper.hips_height_m);
        let head = Quat::from_rotation_y(gaze[i]) * Quat::from_rotation_x(HEAD_DIP_RAD);
        let foot_poses = [feet[0][i], feet[1][i]];
        let mut pose = Pose::new(hips_m, lead.world_from_lean, &upper, head, foot_poses);
        pose.spine[1] *= Quat::from_rotation_z(-SPINE_UPRIGHT * lead.roll_rad);
        pose
    });
    let mut poses: Vec<Pose> = poses.collect();
    lower_to_reach(&mut poses, reach);
    Take { poses, first: travel.first - from, n_shown: travel.n_shown }
}

/// Where the eyes look, moment by moment: ahead of the body's heading, but never over the
/// shoulder.
fn gaze_rad(travel: &Travel) -> Vec<f32> {
    let ahead = (LOOK_AHEAD_S * GRID_HZ as f32) as usize;
    let last = travel.moments.len() - 1;
    let raw: Vec<f32> = (0..=last)
        .map(|i| {
            let now = travel.moments[i].heading_rad;
            let then = travel.moments[(i + ahead).min(last)].heading_rad;
            now + (then - now).clamp(-0.4 * PI, 0.4 * PI)
        })
        .collect();
    gaussian(&raw, LOOK_SIGMA_S * GRID_HZ as f32)
}

impl Take {
    /// The same with left and right exchanged.
    pub(crate) fn mirrored(self) -> Self {
        Self { poses: self.poses.iter().map(Pose::mirrored).collect(), ..self }
    }

    /// Shown frames as a motion with its contacts.
    pub(crate) fn performed(&self) -> Result<Performed, MotionError> {
        let shown = self.poses.iter().skip(self.first).take(self.n_shown);
        let frames: Vec<&Pose> = shown.step_by(SAMPLES_PER_FRAME).collect();
        let mut rotations = Vec::with_capacity(frames.len() * joint::COUNT);
        for pose in &frames {
            pose.write_rotations(&mut rotations);
        }
        let positions: Vec<Vec3> = frames.iter().map(|pose| pose.hips_m).collect();
        let contacts = frames
            .iter()
            .map(|pose| Contacts { left: pose.feet[0].planted, right: pose.feet[1].planted })
            .collect();
        let motion = Motion::new(Fps::THIRTY, joint::COUNT, positions, rotations)?;
        Ok(Performed { motion, contacts })
    }
}
