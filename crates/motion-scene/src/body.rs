//! One body in a pose.

use std::num::NonZeroU32;

use glam::Mat4;

use crate::color::{ColorRole, LinearRgba, Theme};
use crate::mesh::MeshId;

/// Names a thing under the pointer. What it means is known to whoever made the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PickId(pub NonZeroU32);

impl PickId {
    /// The `n`th name, from 0; `None` past the last.
    pub const fn nth(n: u32) -> Option<Self> {
        match NonZeroU32::new(n.wrapping_add(1)) {
            Some(name) => Some(Self(name)),
            None => None,
        }
    }
}

/// Whether a thing is marked with an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Emphasis {
    /// It is not.
    #[default]
    None,
    /// The pointer is over it.
    Hovered,
    /// It is selected.
    Selected,
}

/// What a body looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// Solid, with its own material multiplied by a colour.
    Solid(LinearRgba),
    /// See-through with a bright rim, in one colour: another time or another take.
    Ghost(LinearRgba),
}

/// How much of a ghost covers what is behind it.
pub const GHOST_ALPHA: f32 = 0.25;

impl Look {
    /// The neutral body of a theme.
    pub fn neutral(theme: Theme) -> Self {
        Self::Solid(ColorRole::Body.color(theme))
    }

    /// The mesh's own colours.
    pub fn own_colors() -> Self {
        Self::Solid(LinearRgba::WHITE)
    }

    /// A ghost in the colour of a meaning.
    pub fn ghost(role: ColorRole, theme: Theme) -> Self {
        Self::Ghost(role.color(theme).with_alpha(GHOST_ALPHA))
    }
}

/// A body: a model that the renderer knows, in a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Which model.
    pub model: MeshId,
    /// Where each joint of the model is; rotation and position, parents need not be known.
    pub world_from_joint: Vec<Mat4>,
    /// What it looks like.
    pub look: Look,
    /// Whether it is outlined.
    pub emphasis: Emphasis,
    /// What picking it returns; what has none is looked through.
    pub pick: Option<PickId>,
}

impl Body {
    /// A body that cannot be picked and is not outlined.
    pub fn new(model: MeshId, world_from_joint: Vec<Mat4>, look: Look) -> Self {
        Self { model, world_from_joint, look, emphasis: Emphasis::None, pick: None }
    }

    /// Whether it stops light.
    pub fn casts_shadow(&self) -> bool {
        matches!(self.look, Look::Solid(_))
    }
}
