//! Triangles without area: they have no side to look at and no normal.

use glam::{DVec3, Vec3};

use super::surface::RawMesh;

/// Twice a triangle's area over the square of its longest side, below which it counts as having
/// none. A tenth of that is what positions of 32 bits leave of it at worst.
const LEAST_AREA: f64 = 1e-5;

/// Whether a triangle has no area to speak of, whatever its size.
pub(super) fn is_needle([a, b, c]: [DVec3; 3]) -> bool {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    let double_area = (b - a).cross(c - a).length();
    double_area.is_nan() || double_area <= LEAST_AREA * longest
}

/// Puts the corners of triangles that lost their area when vertices were moved back to where these
/// were `before`. Where no triangle was a needle then, none is now: what is put back only grows.
pub(super) fn put_back(mesh: &mut RawMesh, before_m: &[Vec3]) {
    loop {
        let mut is_done = true;
        for t in &mesh.triangles {
            let corners = t.map(|v| v as usize);
            if !is_needle(corners.map(|v| mesh.positions_m[v].as_dvec3())) {
                continue;
            }
            for v in corners {
                is_done &= mesh.positions_m[v] == before_m[v];
                mesh.positions_m[v] = before_m[v];
            }
        }
        if is_done {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lost_its_area_goes_back_and_the_rest_stays() {
        let before_m = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0), Vec3::Z];
        let mut positions_m = before_m.to_vec();
        // The first triangle is pressed flat, the second only becomes smaller.
        positions_m[2] = Vec3::new(0.5, 0.0, 0.0);
        positions_m[4] = Vec3::new(1.0, 0.9, 0.1);
        let mut mesh = RawMesh { positions_m, triangles: vec![[0, 1, 2], [1, 3, 4]] };
        put_back(&mut mesh, &before_m);
        assert_eq!(mesh.positions_m[..4], before_m[..4]);
        assert_eq!(mesh.positions_m[4], Vec3::new(1.0, 0.9, 0.1));
    }

    #[test]
    fn size_does_not_matter() {
        for size in [1e-6, 1.0, 1e6] {
            let at = |x: f64, y: f64| DVec3::new(x, y, 0.0) * size;
            assert!(!is_needle([at(0.0, 0.0), at(1.0, 0.0), at(0.5, 0.01)]));
            assert!(is_needle([at(0.0, 0.0), at(1.0, 0.0), at(0.5, 1e-6)]));
            assert!(is_needle([at(0.0, 0.0), at(0.0, 0.0), at(0.0, 0.0)]));
        }
    }
}
