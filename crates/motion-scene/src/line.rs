//! Lines and dots of even width on the picture.

use glam::Vec3;

use crate::body::PickId;
use crate::color::LinearRgba;

/// Whether what is nearer hides a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Occlusion {
    /// As in the world.
    #[default]
    Hidden,
    /// It is seen through everything.
    Shown,
}

/// Straight pieces from point to point with round ends. One point, or twice the same, is a dot.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Where it goes, metres.
    pub points_m: Vec<Vec3>,
    /// Of one colour.
    pub color: LinearRgba,
    /// Thickness on the picture, points (pixels at scale 1).
    pub width_pt: f32,
    /// Whether bodies hide it.
    pub occlusion: Occlusion,
    /// What picking it returns.
    pub pick: Option<PickId>,
}

impl Line {
    /// A line that bodies hide and that cannot be picked.
    pub fn new(points_m: Vec<Vec3>, color: LinearRgba, width_pt: f32) -> Self {
        Self { points_m, color, width_pt, occlusion: Occlusion::Hidden, pick: None }
    }
}
