//! Things with a shape and no skin: obstacles, targets.

use glam::{Mat4, Vec3};

use crate::body::{Emphasis, PickId};
use crate::color::{ColorRole, LinearRgba, Theme};

/// A shape in its own space, before [`Solid::world_from_solid`] stretches and places it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// From −½ to ½ along each axis.
    Box,
    /// Of diameter 1 about Y, from −½ to ½.
    Cylinder,
    /// Of diameter 1.
    Sphere,
}

/// A shape in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Which shape.
    pub shape: Shape,
    /// Stretches, turns and places it.
    pub world_from_solid: Mat4,
    /// Its surface; with an alpha under 1 it is see-through and stops no light.
    pub color: LinearRgba,
    /// Whether it is outlined.
    pub emphasis: Emphasis,
    /// What picking it returns.
    pub pick: Option<PickId>,
}

impl Solid {
    /// A box that stands on or floats over the floor: `center_m` is its middle, `heading_rad`
    /// turns it about the vertical.
    pub fn obstacle_box(center_m: Vec3, size_m: Vec3, heading_rad: f32, theme: Theme) -> Self {
        Self::obstacle(Shape::Box, center_m, size_m, heading_rad, theme)
    }

    /// An upright cylinder; `center_m` is its middle.
    pub fn obstacle_cylinder(center_m: Vec3, radius_m: f32, height_m: f32, theme: Theme) -> Self {
        let size_m = Vec3::new(2.0 * radius_m, height_m, 2.0 * radius_m);
        Self::obstacle(Shape::Cylinder, center_m, size_m, 0.0, theme)
    }

    /// A height limit: a thin see-through plate whose lower side is at `center_m`.
    pub fn ceiling(
        center_m: Vec3,
        width_m: f32,
        depth_m: f32,
        heading_rad: f32,
        theme: Theme,
    ) -> Self {
        const THICKNESS_M: f32 = 0.03;
        let size_m = Vec3::new(width_m, THICKNESS_M, depth_m);
        let center_m = center_m + Vec3::Y * 0.5 * THICKNESS_M;
        let mut plate = Self::obstacle(Shape::Box, center_m, size_m, heading_rad, theme);
        plate.color = plate.color.with_alpha(0.45);
        plate
    }

    /// A ball.
    pub fn ball(center_m: Vec3, radius_m: f32, color: LinearRgba) -> Self {
        let scale = Vec3::splat(2.0 * radius_m);
        Self {
            shape: Shape::Sphere,
            world_from_solid: Mat4::from_translation(center_m) * Mat4::from_scale(scale),
            color,
            emphasis: Emphasis::None,
            pick: None,
        }
    }

    fn obstacle(
        shape: Shape,
        center_m: Vec3,
        size_m: Vec3,
        heading_rad: f32,
        theme: Theme,
    ) -> Self {
        Self {
            shape,
            world_from_solid: Mat4::from_translation(center_m)
                * Mat4::from_rotation_y(heading_rad)
                * Mat4::from_scale(size_m),
            color: ColorRole::Obstacle.color(theme),
            emphasis: Emphasis::None,
            pick: None,
        }
    }

    /// Whether it stops light.
    pub fn casts_shadow(&self) -> bool {
        self.color.0[3] >= 1.0
    }
}
