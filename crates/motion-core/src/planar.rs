//! `PlanarTransform`: what may be changed about where a person moves without changing the
//! motion: a turn about the vertical, a move on the ground, and the level of the ground itself
//! (`docs/method.md`, A1).
//!
//! The group laws hold, and each is a test below: composition is associative, [`IDENTITY`] is
//! neutral, `t * t.inverse()` is the identity, and `exp(log t) = t` for headings within (−π, π].
//!
//! Names read from right to left as in `world_from_torso * torso_from_clip`.
//!
//! [`IDENTITY`]: PlanarTransform::IDENTITY

use std::f32::consts::PI;
use std::ops::Mul;

use glam::{Quat, Vec2, Vec3};

/// A rotation about +Y, a translation on the ground and a level.
///
/// Invariant: `(cos, sin)` has unit length (up to rounding). The rotation is stored as its
/// cosine and sine because the search composes millions of these and never needs the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarTransform {
    cos: f32,
    sin: f32,
    /// Ground translation along +X, metres.
    pub x_m: f32,
    /// Ground translation along +Z, metres.
    pub z_m: f32,
    /// Height of the supporting ground, metres.
    pub level_m: f32,
}

impl PlanarTransform {
    /// No turn, no move.
    pub const IDENTITY: Self = Self { cos: 1.0, sin: 0.0, x_m: 0.0, z_m: 0.0, level_m: 0.0 };

    /// A turn by `heading_rad` (0 looks along +Z, π/2 along +X: a left turn is positive), then a
    /// move to `ground_m = (x, z)` on ground that is `level_m` high.
    #[inline]
    pub fn new(heading_rad: f32, ground_m: Vec2, level_m: f32) -> Self {
        let (sin, cos) = heading_rad.sin_cos();
        Self { cos, sin, x_m: ground_m.x, z_m: ground_m.y, level_m }
    }

    /// The transform of these very numbers, for reading back what was stored: `new` would round
    /// them once more. `None` unless `(cos, sin)` has unit length (within 1e-3) and all is finite.
    pub fn from_cos_sin(cos: f32, sin: f32, ground_m: Vec2, level_m: f32) -> Option<Self> {
        let is_unit = (cos * cos + sin * sin - 1.0).abs() < 2e-3;
        let valid = is_unit && ground_m.is_finite() && level_m.is_finite();
        valid.then_some(Self { cos, sin, x_m: ground_m.x, z_m: ground_m.y, level_m })
    }

    /// The heading within (−π, π].
    #[inline]
    pub fn heading_rad(self) -> f32 {
        self.sin.atan2(self.cos)
    }

    /// Cosine of the heading.
    #[inline]
    pub fn cos(self) -> f32 {
        self.cos
    }

    /// Sine of the heading.
    #[inline]
    pub fn sin(self) -> f32 {
        self.sin
    }

    /// Ground translation `(x, z)` in metres.
    #[inline]
    pub fn ground_m(self) -> Vec2 {
        Vec2::new(self.x_m, self.z_m)
    }

    /// The translation as a point: `(x, level, z)`.
    #[inline]
    pub fn translation_m(self) -> Vec3 {
        Vec3::new(self.x_m, self.level_m, self.z_m)
    }

    /// The turn alone, as a rotation about +Y.
    #[inline]
    pub fn rotation(self) -> Quat {
        Quat::from_rotation_y(self.heading_rad())
    }

    /// The transform that undoes this one.
    #[inline]
    pub fn inverse(self) -> Self {
        Self {
            cos: self.cos,
            sin: -self.sin,
            x_m: -(self.cos * self.x_m - self.sin * self.z_m),
            z_m: -(self.sin * self.x_m + self.cos * self.z_m),
            level_m: -self.level_m,
        }
    }

    /// The same placement in the mirror at x = 0: heading and x negated. Its own inverse.
    #[inline]
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { sin: -self.sin, x_m: -self.x_m, ..self }
    }

    /// A vector on the ground, turned.
    #[inline]
    pub fn turn_ground(self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }

    /// A direction (velocity, offset), turned about +Y.
    #[inline]
    pub fn turn(self, v: Vec3) -> Vec3 {
        let g = self.turn_ground(Vec2::new(v.x, v.z));
        Vec3::new(g.x, v.y, g.y)
    }

    /// A point, turned and moved; its height rises by the level.
    #[inline]
    pub fn apply(self, p: Vec3) -> Vec3 {
        self.turn(p) + self.translation_m()
    }

    /// A point on the ground, turned and moved.
    #[inline]
    pub fn apply_ground(self, p: Vec2) -> Vec2 {
        self.turn_ground(p) + self.ground_m()
    }

    /// The logarithm: the constant velocity `(turn, ground, level)` that reaches this transform
    /// from the identity in unit time. The inverse of [`PlanarTwist::exp`].
    ///
    /// Near a half turn the ground velocity stays bounded (π/2 times the distance at most).
    pub fn log(self) -> PlanarTwist {
        let turn_rad = self.heading_rad();
        let half = 0.5 * turn_rad;
        // V⁻¹ of SE(2): (θ/2)·cot(θ/2) on the diagonal and θ/2 beside it; 1 − θ²/12 where the
        // quotient loses its digits.
        let diagonal = if half.abs() < 1e-3 { 1.0 - half * half / 3.0 } else { half / half.tan() };
        PlanarTwist {
            turn_rad,
            ground_m: Vec2::new(
                diagonal * self.x_m - half * self.z_m,
                half * self.x_m + diagonal * self.z_m,
            ),
            level_m: self.level_m,
        }
    }
}

impl Default for PlanarTransform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Mul for PlanarTransform {
    type Output = Self;

    /// `a_from_c = a_from_b * b_from_c`.
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self {
            cos: self.cos * b.cos - self.sin * b.sin,
            sin: self.sin * b.cos + self.cos * b.sin,
            x_m: self.cos * b.x_m + self.sin * b.z_m + self.x_m,
            z_m: self.cos * b.z_m - self.sin * b.x_m + self.z_m,
            level_m: self.level_m + b.level_m,
        }
    }
}

/// A constant planar velocity over unit time: the Lie algebra of [`PlanarTransform`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarTwist {
    /// Turn about +Y, radians.
    pub turn_rad: f32,
    /// Ground velocity `(x, z)` in the moving frame, metres.
    pub ground_m: Vec2,
    /// Change of level, metres.
    pub level_m: f32,
}

impl PlanarTwist {
    /// The same motion for a fraction `t` of the time.
    #[inline]
    pub fn scaled(self, t: f32) -> Self {
        Self { turn_rad: self.turn_rad * t, ground_m: self.ground_m * t, level_m: self.level_m * t }
    }

    /// Where the constant velocity leads in unit time.
    pub fn exp(self) -> PlanarTransform {
        let theta = self.turn_rad;
        let (sin, cos) = theta.sin_cos();
        let (s_over, one_minus_c_over) = if theta.abs() < 1e-3 {
            (1.0 - theta * theta / 6.0, 0.5 * theta)
        } else {
            // 1 − cos θ = 2 sin²(θ/2), which keeps its digits for small turns.
            let half_sin = (0.5 * theta).sin();
            (sin / theta, 2.0 * half_sin * half_sin / theta)
        };
        PlanarTransform {
            cos,
            sin,
            x_m: s_over * self.ground_m.x + one_minus_c_over * self.ground_m.y,
            z_m: s_over * self.ground_m.y - one_minus_c_over * self.ground_m.x,
            level_m: self.level_m,
        }
    }
}

/// `angle_rad` brought within [−π, π] by whole turns.
#[inline]
pub fn wrap_angle_rad(angle_rad: f32) -> f32 {
    let turns = (angle_rad / (2.0 * PI)).round();
    angle_rad - turns * 2.0 * PI
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn transform() -> impl Strategy<Value = PlanarTransform> {
        (-3.1f32..3.1, -20f32..20.0, -20f32..20.0, -2f32..2.0)
            .prop_map(|(a, x, z, l)| PlanarTransform::new(a, Vec2::new(x, z), l))
    }

    #[track_caller]
    fn assert_close(a: PlanarTransform, b: PlanarTransform) {
        let error = (a.cos - b.cos).abs()
            + (a.sin - b.sin).abs()
            + (a.x_m - b.x_m).abs()
            + (a.z_m - b.z_m).abs()
            + (a.level_m - b.level_m).abs();
        assert!(error < 3e-4, "{a:?} is not {b:?}");
    }

    proptest! {
        #[test]
        fn composition_is_associative(a in transform(), b in transform(), c in transform()) {
            assert_close((a * b) * c, a * (b * c));
        }

        #[test]
        fn the_inverse_undoes(a in transform()) {
            assert_close(a * a.inverse(), PlanarTransform::IDENTITY);
            assert_close(a.inverse() * a, PlanarTransform::IDENTITY);
        }

        #[test]
        fn applying_a_product_is_applying_twice(a in transform(), b in transform()) {
            let p = Vec3::new(0.3, 1.0, -0.7);
            prop_assert!((a * b).apply(p).distance(a.apply(b.apply(p))) < 2e-4);
        }

        #[test]
        fn apply_is_the_rotation_and_the_translation(a in transform()) {
            let p = Vec3::new(0.3, 1.0, -0.7);
            prop_assert!(a.apply(p).distance(a.rotation() * p + a.translation_m()) < 1e-4);
        }

        #[test]
        fn exp_undoes_log(a in transform()) {
            assert_close(a.log().exp(), a);
        }

        #[test]
        fn halves_of_a_twist_compose(a in transform()) {
            let half = a.log().scaled(0.5).exp();
            assert_close(half * half, a);
        }
    }

    #[test]
    fn stored_numbers_come_back_to_the_last_bit() {
        let a = PlanarTransform::new(1.234, Vec2::new(2.0, 3.0), 0.5);
        let again = PlanarTransform::from_cos_sin(a.cos(), a.sin(), a.ground_m(), a.level_m);
        assert_eq!(again, Some(a));
        assert_eq!(PlanarTransform::from_cos_sin(0.5, 0.5, Vec2::ZERO, 0.0), None);
        assert_eq!(PlanarTransform::from_cos_sin(f32::NAN, 0.0, Vec2::ZERO, 0.0), None);
    }

    #[test]
    fn identity_is_neutral() {
        let a = PlanarTransform::new(1.0, Vec2::new(2.0, 3.0), 0.5);
        assert_eq!(a * PlanarTransform::IDENTITY, a);
        assert_close(PlanarTransform::IDENTITY * a, a);
    }

    #[test]
    fn a_left_turn_is_positive_and_looks_along_x() {
        let left = PlanarTransform::new(PI / 2.0, Vec2::ZERO, 0.0);
        assert!(left.turn(Vec3::Z).distance(Vec3::X) < 1e-6, "90° looks along +X");
    }

    #[test]
    fn angles_wrap_by_whole_turns() {
        for (angle, wrapped) in [(0.5, 0.5), (2.0 * PI + 0.5, 0.5), (-2.0 * PI - 0.5, -0.5)] {
            assert!((wrap_angle_rad(angle) - wrapped).abs() < 1e-5, "{angle}");
        }
    }
}
