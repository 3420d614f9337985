//! Rotations as unit quaternions: log and exp map, shortest slerp, the twist about the vertical.
//!
//! Quaternions `q` and `−q` are the same rotation; every function here treats them so.

use glam::{Quat, Vec3};

/// The rotation vector (axis times angle, radians) of `q`, by the shorter way: its length is at
/// most π. The inverse of [`exp`].
///
/// Accurate to 1e-6 rad. At exactly half a turn either of the two axes may come out.
#[inline]
pub fn log(q: Quat) -> Vec3 {
    let q = if q.w < 0.0 { -q } else { q };
    let v = Vec3::new(q.x, q.y, q.z);
    let len = v.length();
    if len < 1e-7 {
        return 2.0 * v;
    }
    v * (2.0 * len.atan2(q.w) / len)
}

/// The rotation about `v` by `|v|` radians. `exp(0)` is the identity.
#[inline]
pub fn exp(v: Vec3) -> Quat {
    let angle_rad = v.length();
    let half = 0.5 * angle_rad;
    // sin(x)/x loses its digits near 0; its series does not.
    let scale =
        if angle_rad < 1e-4 { 0.5 - angle_rad * angle_rad / 48.0 } else { half.sin() / angle_rad };
    let v = v * scale;
    Quat::from_xyzw(v.x, v.y, v.z, half.cos())
}

/// The angle of the rotation that leads from `a` to `b`, within [0, π].
#[inline]
pub fn angle_between_rad(a: Quat, b: Quat) -> f32 {
    log(a.inverse() * b).length()
}

/// Spherical interpolation from `a` (t = 0) to `b` (t = 1) by the shorter way.
#[inline]
pub fn slerp(a: Quat, b: Quat, t: f32) -> Quat {
    let b = if a.dot(b) < 0.0 { -b } else { b };
    a.slerp(b, t)
}

/// The twist of `q` about +Y (swing–twist decomposition `q = swing · twist`).
///
/// Returns the angle in (−π, π] and `√(w² + y²)`, how well it is defined: 1 for a pure turn, 0
/// where the body is upside down and any angle would do.
#[inline]
pub fn twist_about_y(q: Quat) -> (f32, f32) {
    let certainty = (q.w * q.w + q.y * q.y).sqrt();
    let q = if q.w < 0.0 { -q } else { q };
    (2.0 * q.y.atan2(q.w), certainty)
}

/// `q` in the world mirrored at the plane x = 0.
#[inline]
pub fn mirrored(q: Quat) -> Quat {
    Quat::from_xyzw(q.x, -q.y, -q.z, q.w)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rotation_vector() -> impl Strategy<Value = Vec3> {
        (-1f32..1.0, -1f32..1.0, -1f32..1.0, 0f32..3.1).prop_map(|(x, y, z, angle)| {
            Vec3::new(x, y, z).try_normalize().unwrap_or(Vec3::Y) * angle
        })
    }

    proptest! {
        #[test]
        fn log_undoes_exp(v in rotation_vector()) {
            prop_assert!(log(exp(v)).distance(v) < 2e-5);
        }

        #[test]
        fn the_other_sign_is_the_same_rotation(v in rotation_vector()) {
            let q = exp(v);
            prop_assert!(log(-q).distance(log(q)) < 1e-5);
        }

        #[test]
        fn slerp_goes_at_constant_speed(a in rotation_vector(), b in rotation_vector(), t in 0f32..1.0) {
            let (a, b) = (exp(a), exp(b));
            let whole = angle_between_rad(a, b);
            prop_assume!(whole < 3.0);
            prop_assert!((angle_between_rad(a, slerp(a, b, t)) - t * whole).abs() < 2e-3);
        }

        #[test]
        fn a_turn_before_anything_adds_to_the_twist(v in rotation_vector(), turn in -1f32..1.0) {
            let q = exp(v);
            let (twist, certainty) = twist_about_y(q);
            prop_assume!(certainty > 0.3);
            let (turned, _) = twist_about_y(Quat::from_rotation_y(turn) * q);
            prop_assert!(crate::planar::wrap_angle_rad(turned - twist - turn).abs() < 1e-4);
        }

        #[test]
        fn mirroring_twice_is_nothing(v in rotation_vector()) {
            let q = exp(v);
            prop_assert_eq!(mirrored(mirrored(q)), q);
        }
    }

    #[test]
    fn a_mirrored_rotation_moves_mirrored_points() {
        let q = exp(Vec3::new(0.3, -0.8, 0.5));
        let p = Vec3::new(0.2, 1.0, -0.4);
        let flip = Vec3::new(-1.0, 1.0, 1.0);
        assert!((mirrored(q) * (p * flip)).distance((q * p) * flip) < 1e-6, "mirror law");
    }
}
