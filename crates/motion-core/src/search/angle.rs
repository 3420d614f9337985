//! Headings in a hurry: a search asks for millions of them a second.

use std::f32::consts::{FRAC_PI_2, PI};

use crate::planar::PlanarTransform;

/// The heading within [−π, π], right to within 1e-5 rad (Abramowitz and Stegun 4.4.49, a polynomial for the arc
/// tangent from 0 to 1), several times sooner than the system's arc tangent.
#[inline]
pub(crate) fn heading_rad(transform: PlanarTransform) -> f32 {
    let (cos, sin) = (transform.cos(), transform.sin());
    let (along, across) = (cos.abs(), sin.abs());
    let ratio = along.min(across) / along.max(across);
    let squared = ratio * ratio;
    let factors = [0.020_835_1, -0.085_133, 0.180_141, -0.330_299_5, 0.999_866];
    let arc = ratio * factors.into_iter().fold(0.0, |sum, factor| sum * squared + factor);
    let within_quarter = if across > along { FRAC_PI_2 - arc } else { arc };
    let upright = if cos < 0.0 { PI - within_quarter } else { within_quarter };
    upright.copysign(sin)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;

    #[test]
    fn it_is_right_to_a_hundred_thousandth() {
        for step in -31_416..=31_416 {
            let asked_rad = step as f32 * 1e-4;
            let transform = PlanarTransform::new(asked_rad, Vec2::ZERO, 0.0);
            let error_rad = heading_rad(transform) - transform.heading_rad();
            assert!(error_rad.abs() < 1.2e-5, "{asked_rad}: {error_rad}");
        }
        assert_eq!(heading_rad(PlanarTransform::IDENTITY), 0.0);
    }
}
