//! Everything that is to be seen.

use crate::body::{Body, Emphasis};
use crate::bounds::Bounds;
use crate::color::Theme;
use crate::ground::Ground;
use crate::label::Label;
use crate::light::Light;
use crate::line::Line;
use crate::marker::{Checkpoint, Flat, JointTarget};
use crate::solid::Solid;
use crate::trail::Trail;

/// Everything that is to be seen at a moment, from wherever it is looked at.
///
/// It is made anew for every picture and holds no state; two equal scenes make equal pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What surroundings the colours are made for.
    pub theme: Theme,
    /// What lights it.
    pub light: Light,
    /// The floor, if there is one.
    pub ground: Option<Ground>,
    /// Characters and their ghosts.
    pub bodies: Vec<Body>,
    /// Obstacles.
    pub solids: Vec<Solid>,
    /// Where bodies must be.
    pub checkpoints: Vec<Checkpoint>,
    /// Where joints must be.
    pub joint_targets: Vec<JointTarget>,
    /// Where joints go.
    pub trails: Vec<Trail>,
    /// Other lines.
    pub lines: Vec<Line>,
    /// Other flat shapes.
    pub flats: Vec<Flat>,
    /// Words.
    pub labels: Vec<Label>,
}

impl Scene {
    /// A floor and nothing on it.
    pub fn empty(theme: Theme) -> Self {
        Self {
            theme,
            light: Light::of(theme),
            ground: Some(Ground::default()),
            bodies: Vec::new(),
            solids: Vec::new(),
            checkpoints: Vec::new(),
            joint_targets: Vec::new(),
            trails: Vec::new(),
            lines: Vec::new(),
            flats: Vec::new(),
            labels: Vec::new(),
        }
    }

    /// What holds all bodies; `None` without one.
    pub fn body_bounds(&self) -> Option<Bounds> {
        let each = self.bodies.iter().filter_map(|b| Bounds::of_joints(&b.world_from_joint));
        each.reduce(Bounds::union)
    }

    /// Whether anything is outlined.
    pub fn has_emphasis(&self) -> bool {
        let bodies = self.bodies.iter().map(|body| body.emphasis);
        bodies
            .chain(self.solids.iter().map(|solid| solid.emphasis))
            .chain(self.joint_targets.iter().map(|target| target.emphasis))
            .any(|emphasis| emphasis != Emphasis::None)
    }
}
