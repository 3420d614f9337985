//! Where the torso shall be on the ground, and which way it shall look, at a frame.

use glam::Vec2;

use super::Tolerance;
use crate::planar::PlanarTransform;

/// A checkpoint. The first of a character is always met (it places the motion); the last is read
/// at the motion's last frame and only it can be early or late; those between are read at their
/// own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyConstraint {
    /// When.
    pub frame: u32,
    /// Ground position `(x, z)`, metres.
    pub position_m: Vec2,
    /// Heading, radians: 0 looks along +Z, π/2 along +X.
    pub heading_rad: f32,
    /// Height of what the body stands on, metres, where that is asked for.
    pub height_m: Option<f32>,
    /// Factor of the squared error.
    pub weight: f32,
    /// How far off is well, of each part.
    pub tolerance: Tolerance,
}

/// How far a body constraint is missed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyError {
    /// Distance on the ground, metres.
    pub position_m: f32,
    /// Difference of headings, radians, within [0, π].
    pub heading_rad: f32,
    /// Difference of heights, metres; 0 where no height is asked for.
    pub height_m: f32,
    /// Frames too late (positive) or too early.
    pub frames: i32,
}

impl BodyError {
    /// Whether every part lies within `tolerance`.
    pub fn is_within(&self, tolerance: &Tolerance) -> bool {
        self.position_m <= tolerance.position_m
            && self.heading_rad <= tolerance.heading_rad
            && self.height_m.abs() <= tolerance.position_m
            && self.frames.unsigned_abs() as f32 <= tolerance.frames
    }

    /// The sum of squares in units of `tolerance`.
    pub fn squared(&self, tolerance: &Tolerance) -> f32 {
        (self.position_m / tolerance.position_m).powi(2)
            + (self.height_m / tolerance.position_m).powi(2)
            + (self.heading_rad / tolerance.heading_rad).powi(2)
            + (self.frames as f32 / tolerance.frames).powi(2)
    }
}

impl BodyConstraint {
    /// The torso frame that meets the constraint.
    pub fn world_from_torso(&self) -> PlanarTransform {
        PlanarTransform::new(self.heading_rad, self.position_m, self.height_m.unwrap_or(0.0))
    }

    /// How far `world_from_torso`, `frames_late` after the wished frame, misses it.
    pub fn error(&self, world_from_torso: PlanarTransform, frames_late: i32) -> BodyError {
        let target = self.world_from_torso();
        let turn = target.inverse() * world_from_torso;
        BodyError {
            position_m: (world_from_torso.ground_m() - self.position_m).length(),
            heading_rad: turn.heading_rad().abs(),
            height_m: self.height_m.map_or(0.0, |height| world_from_torso.level_m - height),
            frames: frames_late,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_tolerance_of_each_part_counts_one() {
        let tolerance = Tolerance { position_m: 0.2, heading_rad: 0.1, frames: 5.0 };
        let constraint = BodyConstraint {
            frame: 0,
            position_m: Vec2::ZERO,
            heading_rad: 0.0,
            height_m: Some(1.0),
            weight: 1.0,
            tolerance,
        };
        let there = |heading, x, level| PlanarTransform::new(heading, Vec2::new(x, 0.0), level);
        for (at, late) in [
            (there(0.0, 0.2, 1.0), 0),
            (there(0.1, 0.0, 1.0), 0),
            (there(0.0, 0.0, 1.2), 0),
            (there(0.0, 0.0, 1.0), -5),
        ] {
            let error = constraint.error(at, late);
            assert!((error.squared(&tolerance) - 1.0).abs() < 1e-4, "{error:?}");
        }
    }

    #[test]
    fn what_is_not_asked_does_not_count() {
        let anywhere = f32::INFINITY;
        let tolerance = Tolerance { position_m: anywhere, ..Tolerance::default() };
        let error = BodyError { position_m: 70.0, ..BodyError::default() };
        assert!(error.is_within(&tolerance), "any place is well");
        assert_eq!(error.squared(&tolerance), 0.0);
    }
}
