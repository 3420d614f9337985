//! Words at places in the world, of even size on the picture.

use glam::{Vec2, Vec3};

use crate::color::LinearRgba;
use crate::line::Occlusion;

/// Which part of the words is at the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Anchor {
    /// The middle.
    #[default]
    Center,
    /// The middle of the lower edge.
    Below,
    /// The middle of the left edge.
    Left,
}

/// Where words are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LabelPlace {
    /// At a point of the world, metres.
    World(Vec3),
    /// On the picture, points from its upper left corner.
    Picture(Vec2),
}

/// A line of words.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it says; one line.
    pub text: String,
    /// Where.
    pub place: LabelPlace,
    /// Which part of it is there.
    pub anchor: Anchor,
    /// Radius of a disc on the floor around the place that the words keep clear of, metres.
    pub clear_m: f32,
    /// Whether bodies hide it.
    pub occlusion: Occlusion,
    /// Height of the letters from ascent to descent, points.
    pub size_pt: f32,
    /// Of the letters.
    pub color: LinearRgba,
    /// Of a plate behind them, if any.
    pub plate: Option<LinearRgba>,
}

/// Letters of labels in the view, points.
pub const LABEL_PT: f32 = 13.0;
