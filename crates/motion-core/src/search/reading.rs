//! What a score reads of a motion at single frames: checkpoints, joints, places of poses and points of
//! followed curves, all in one shape.
//!
//! Each is a point that shall be somewhere, and perhaps a heading. So the cost of any number of them
//! under a planar move follows from a few sums ([`super::moments`]).

use glam::{Vec2, Vec3};

use super::angle::heading_rad;
use super::library::SearchLibrary;
use crate::constraint::joint::TOLERANCE_M_S;
use crate::constraint::{BodyConstraint, JointConstraint};
use crate::ids::{ClipId, JointIdx};
use crate::planar::{PlanarTransform, wrap_angle_rad};

/// What is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Subject {
    /// The torso frame's point on the ground, at the level of the support.
    Torso,
    /// A joint's position.
    Joint(JointIdx),
    /// A joint's velocity: turned with the motion, not moved.
    Velocity(JointIdx),
}

/// A wish about one frame, with the factors of its squared errors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    pub(crate) frame: u32,
    pub(crate) subject: Subject,
    /// Where the point should be, metres (metres per second for a velocity).
    pub(crate) wished: Vec3,
    /// Of the squared error on the ground.
    pub(crate) ground: f32,
    /// Of the squared error of the height.
    pub(crate) height: f32,
    /// The heading that is wished.
    pub(crate) heading_rad: f32,
    /// Of the squared error of the heading, radians.
    pub(crate) turn: f32,
}

/// `weight / tolerance²`; 0 for what is not asked.
fn factor(weight: f32, tolerance: f32) -> f32 {
    weight / (tolerance * tolerance)
}

impl Reading {
    /// A checkpoint's place and heading; being early or late is not in it.
    pub(crate) fn of_body(constraint: &BodyConstraint, weight: f32) -> Self {
        let weight = weight * constraint.weight;
        let place = factor(weight, constraint.tolerance.position_m);
        let level_m = constraint.height_m.unwrap_or(0.0);
        Self {
            frame: constraint.frame,
            subject: Subject::Torso,
            wished: Vec3::new(constraint.position_m.x, level_m, constraint.position_m.y),
            ground: place,
            height: if constraint.height_m.is_some() { place } else { 0.0 },
            heading_rad: constraint.heading_rad,
            turn: factor(weight, constraint.tolerance.heading_rad),
        }
    }

    /// A joint's place and, where it is asked for, its velocity.
    pub(crate) fn of_joint(constraint: &JointConstraint, weight: f32) -> [Option<Self>; 2] {
        let weight = weight * constraint.weight;
        let place = factor(weight, constraint.tolerance_m);
        let at = Self {
            frame: constraint.frame,
            subject: Subject::Joint(constraint.joint),
            wished: constraint.position_m,
            ground: place,
            height: place,
            heading_rad: 0.0,
            turn: 0.0,
        };
        let speed = factor(weight, TOLERANCE_M_S);
        let velocity = constraint.velocity_m_s.map(|wished| Self {
            subject: Subject::Velocity(constraint.joint),
            wished,
            ground: speed,
            height: speed,
            ..at
        });
        [Some(at), velocity]
    }

    /// A place on the ground and a direction, with the factors of both.
    pub(crate) fn of_waypoint(
        frame: u32,
        ground_m: Vec2,
        heading_rad: f32,
        (ground, turn): (f32, f32),
    ) -> Self {
        let wished = Vec3::new(ground_m.x, 0.0, ground_m.y);
        Self { frame, subject: Subject::Torso, wished, ground, height: 0.0, heading_rad, turn }
    }

    /// What is read at a frame of a clip that lies at `world_from_clip`: the point (or velocity) and
    /// the heading.
    #[inline]
    pub(crate) fn read(
        &self,
        library: &SearchLibrary,
        world_from_clip: PlanarTransform,
        clip: ClipId,
        clip_frame: u32,
    ) -> (Vec3, f32) {
        let torsos = library.torsos(clip);
        match self.subject {
            Subject::Torso => {
                let torso = world_from_clip * torsos[clip_frame as usize];
                let heading_rad = if self.turn > 0.0 { heading_rad(torso) } else { 0.0 };
                (torso.translation_m(), heading_rad)
            }
            Subject::Joint(joint) => {
                let at = joint_in_clip_m(library, clip, clip_frame, joint);
                (world_from_clip.apply(at), 0.0)
            }
            Subject::Velocity(joint) => {
                let last = torsos.len() as u32 - 1;
                let (before, after) = (clip_frame.saturating_sub(1), (clip_frame + 1).min(last));
                let frame_secs = library.clips().fps().frame_secs() as f32;
                let secs = (after - before).max(1) as f32 * frame_secs;
                let way = joint_in_clip_m(library, clip, after, joint)
                    - joint_in_clip_m(library, clip, before, joint);
                (world_from_clip.turn(way / secs), 0.0)
            }
        }
    }

    /// The cost of what was read.
    #[inline]
    pub(crate) fn cost_of(&self, (point, heading_rad): (Vec3, f32)) -> f32 {
        let off = point - self.wished;
        let mut cost = self.ground * (off.x * off.x + off.z * off.z) + self.height * off.y * off.y;
        if self.turn > 0.0 {
            let angle = wrap_angle_rad(heading_rad - self.heading_rad);
            cost += self.turn * angle * angle;
        }
        cost
    }

    /// The cost where `clip_frame` of a clip at `world_from_clip` is shown.
    #[inline]
    pub(crate) fn cost(
        &self,
        library: &SearchLibrary,
        world_from_clip: PlanarTransform,
        clip: ClipId,
        clip_frame: u32,
    ) -> f32 {
        self.cost_of(self.read(library, world_from_clip, clip, clip_frame))
    }
}

fn joint_in_clip_m(library: &SearchLibrary, clip: ClipId, frame: u32, joint: JointIdx) -> Vec3 {
    let in_torso = library.bodies(clip).joint_m(frame, joint);
    library.torsos(clip)[frame as usize].apply(in_torso)
}
