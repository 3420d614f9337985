//! The floor.

use crate::color::{LinearRgba, Theme};

/// An endless floor at height 0 with a grid in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Whether lines are drawn on it.
    pub has_grid: bool,
    /// Whether every so many metres along the axes are numbered.
    pub has_metre_marks: bool,
}

impl Default for Ground {
    fn default() -> Self {
        Self { has_grid: true, has_metre_marks: true }
    }
}

/// Colours of what surrounds the figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// At the top of the picture.
    pub sky_top: LinearRgba,
    /// At the horizon, where the floor fades into it.
    pub horizon: LinearRgba,
    /// The lit floor near by.
    pub floor: LinearRgba,
    /// Lines every metre; every fifth is stronger.
    pub grid: LinearRgba,
    /// The line z = 0, along X.
    pub x_axis: LinearRgba,
    /// The line x = 0, along Z.
    pub z_axis: LinearRgba,
}

impl Surroundings {
    /// Those of a theme: the floor a little lighter than the horizon, so that feet read.
    pub fn of(theme: Theme) -> Self {
        let hex = LinearRgba::from_srgb_hex;
        match theme {
            Theme::Dark => Self {
                sky_top: hex(0x14161A),
                horizon: hex(0x2A2F37),
                floor: hex(0x3A3F47),
                grid: hex(0x59606B).with_alpha(0.55),
                x_axis: hex(0xA0565A).with_alpha(0.8),
                z_axis: hex(0x4F7FB8).with_alpha(0.8),
            },
            Theme::Light => Self {
                sky_top: hex(0xC9D2DC),
                horizon: hex(0xE4E8EC),
                floor: hex(0xD8DCE0),
                grid: hex(0x98A0AA).with_alpha(0.6),
                x_axis: hex(0xB5484E).with_alpha(0.8),
                z_axis: hex(0x3B6FB0).with_alpha(0.8),
            },
        }
    }
}
