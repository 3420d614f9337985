//! What lights the scene: one key light with shadows and the light of the sky.

use glam::Vec3;

use crate::color::Theme;

/// One far light and an even light from above and below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// From the world towards the key light, unit length.
    pub towards_key: Vec3,
    /// Of the key light; may exceed 1.
    pub key: [f32; 3],
    /// What falls on surfaces that look up.
    pub sky: [f32; 3],
    /// What falls on surfaces that look down: light from the floor.
    pub bounce: [f32; 3],
    /// How much full shadow takes from the floor's stored colour, 0 to 1.
    pub shadow: f32,
}

impl Light {
    /// A warm key light from the front left, above, and a cool fill.
    pub fn of(theme: Theme) -> Self {
        let towards_key = Vec3::new(0.62, 0.85, 0.42).normalize_or(Vec3::Y);
        match theme {
            Theme::Dark => Self {
                towards_key,
                key: [3.0, 2.85, 2.6],
                sky: [0.30, 0.34, 0.42],
                bounce: [0.13, 0.12, 0.115],
                shadow: 0.42,
            },
            Theme::Light => Self {
                towards_key,
                key: [2.6, 2.5, 2.35],
                sky: [0.62, 0.66, 0.72],
                bounce: [0.42, 0.41, 0.40],
                shadow: 0.26,
            },
        }
    }
}
