//! Where the torso shall be on the ground, and which way it shall look, at a frame.

use glam::Vec2;

use super::{TOLERANCE_FRAMES, TOLERANCE_M, TOLERANCE_RAD};
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
    /// Whether every part lies within one tolerance.
    pub fn is_within_tolerance(&self) -> bool {
        self.position_m <= TOLERANCE_M
            && self.heading_rad <= TOLERANCE_RAD
            && self.height_m.abs() <= TOLERANCE_M
            && self.frames.unsigned_abs() as f32 <= TOLERANCE_FRAMES
    }

    /// The sum of squares in tolerances.
    pub fn squared(&self) -> f32 {
        (self.position_m / TOLERANCE_M).powi(2)
            + (self.height_m / TOLERANCE_M).powi(2)
            + (self.heading_rad / TOLERANCE_RAD).powi(2)
            + (self.frames as f32 / TOLERANCE_FRAMES).powi(2)
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

/// A [`BodyConstraint`] prepared for scoring millions of candidates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyTarget {
    pub(crate) frame: u32,
    pub(crate) world_from_torso: PlanarTransform,
    has_height: bool,
    pub(crate) weight: f32,
}

impl BodyTarget {
    pub(crate) fn new(constraint: &BodyConstraint) -> Self {
        Self {
            frame: constraint.frame,
            world_from_torso: constraint.world_from_torso(),
            has_height: constraint.height_m.is_some(),
            weight: constraint.weight,
        }
    }

    /// Weighted square of the position and height error, in tolerances: no trigonometry.
    #[inline]
    pub(crate) fn place_cost(&self, at: PlanarTransform) -> f32 {
        let target = self.world_from_torso;
        let (dx, dz) = (at.x_m - target.x_m, at.z_m - target.z_m);
        let rise = if self.has_height { at.level_m - target.level_m } else { 0.0 };
        self.weight * (dx * dx + dz * dz + rise * rise) * (1.0 / (TOLERANCE_M * TOLERANCE_M))
    }

    /// Weighted square of the heading error, in tolerances.
    #[inline]
    pub(crate) fn heading_cost(&self, at: PlanarTransform) -> f32 {
        let target = self.world_from_torso;
        let cos = at.cos() * target.cos() + at.sin() * target.sin();
        let sin = at.sin() * target.cos() - at.cos() * target.sin();
        let angle = sin.atan2(cos);
        self.weight * angle * angle * (1.0 / (TOLERANCE_RAD * TOLERANCE_RAD))
    }

    /// A lower bound of [`Self::heading_cost`]: a chord is never longer than its arc.
    #[inline]
    pub(crate) fn heading_cost_at_least(&self, at: PlanarTransform) -> f32 {
        let target = self.world_from_torso;
        let cos = at.cos() * target.cos() + at.sin() * target.sin();
        self.weight * (2.0 - 2.0 * cos).max(0.0) * (1.0 / (TOLERANCE_RAD * TOLERANCE_RAD))
    }

    #[inline]
    pub(crate) fn cost(&self, at: PlanarTransform) -> f32 {
        self.place_cost(at) + self.heading_cost(at)
    }

    /// Weighted square of being early or late by so many frames, in tolerances.
    #[inline]
    pub(crate) fn frame_cost(&self, frames_late: f32) -> f32 {
        self.weight * (frames_late / TOLERANCE_FRAMES).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_fast_cost_is_the_squared_error(
            heading in -3f32..3.0, x in -5f32..5.0, z in -5f32..5.0, level in -1f32..1.0,
            at_heading in -3f32..3.0, at_x in -5f32..5.0, weight in 0f32..3.0, with_height: bool,
        ) {
            let constraint = BodyConstraint {
                frame: 10,
                position_m: Vec2::new(x, z),
                heading_rad: heading,
                height_m: with_height.then_some(0.2),
                weight,
            };
            let at = PlanarTransform::new(at_heading, Vec2::new(at_x, z), level);
            let slow = weight * constraint.error(at, 0).squared();
            let target = BodyTarget::new(&constraint);
            prop_assert!((target.cost(at) - slow).abs() <= 1e-4 * slow + 1e-3);
            prop_assert!(target.heading_cost_at_least(at) <= target.heading_cost(at) + 1e-3);
        }
    }

    #[test]
    fn one_tolerance_of_each_kind_counts_one() {
        let constraint = BodyConstraint {
            frame: 0,
            position_m: Vec2::ZERO,
            heading_rad: 0.0,
            height_m: None,
            weight: 1.0,
        };
        let there = |heading, x| PlanarTransform::new(heading, Vec2::new(x, 0.0), 0.0);
        for (at, late) in
            [(there(0.0, 0.3), 0), (there(TOLERANCE_RAD, 0.0), 0), (there(0.0, 0.0), -10)]
        {
            let error = constraint.error(at, late);
            assert!((error.squared() - 1.0).abs() < 1e-4, "{error:?}");
        }
    }
}
