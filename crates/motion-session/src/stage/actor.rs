//! A character that moves.

use std::sync::Arc;

use glam::Vec3;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_scene::body::{Body, Look};
use motion_scene::bounds::Bounds;

use super::figure::Figure;
use super::pose::{pose_at, root_at_m};

/// A character with its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// What the project calls it.
    pub name: String,
    /// What it looks like.
    pub figure: Arc<Figure>,
    /// Its joints: the figure's, in the same order.
    pub skeleton: Arc<Skeleton>,
    /// What it does.
    pub motion: Arc<Motion>,
    /// How it is painted.
    pub look: Look,
}

/// Over the floor, so that lines do not fight with it for the same depth, metres.
const LIFT_M: f32 = 0.006;

impl Actor {
    /// It at a frame, which may lie between two; ends are held.
    pub fn body_at(&self, frame: f64, look: Look) -> Body {
        Body::new(self.figure.mesh, pose_at(&self.skeleton, &self.motion, frame), look)
    }

    /// What holds it at a frame, metres.
    pub fn bounds_at(&self, frame: f64) -> Option<Bounds> {
        self.figure.bounds(&pose_at(&self.skeleton, &self.motion, frame))
    }

    /// Points that reach as far as it does at a frame, metres.
    pub fn reach_at_m(&self, frame: f64) -> Vec<Vec3> {
        self.figure.reach_m(&pose_at(&self.skeleton, &self.motion, frame))
    }

    /// Where its root is at a frame, metres.
    pub fn root_at_m(&self, frame: f64) -> Vec3 {
        root_at_m(&self.motion, frame)
    }

    /// How many frames it has.
    pub fn n_frames(&self) -> usize {
        self.motion.n_frames()
    }

    /// The way of its root over the floor, a point for every frame, metres.
    pub fn ground_path_m(&self) -> Vec<Vec3> {
        self.motion.root_positions_m().iter().map(|at| at.with_y(LIFT_M)).collect()
    }
}
