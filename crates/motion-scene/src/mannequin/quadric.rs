//! How far a point is from the planes of a surface (Garland and Heckbert 1997).

use glam::DVec3;

/// The sum of squared distances to planes, as a quadratic form; and a little pull to where the
/// vertices were, without which a flat place has no best point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadric {
    /// xx, xy, xz, yy, yz, zz.
    a: [f64; 6],
    b: DVec3,
    c: f64,
}

impl Quadric {
    pub(super) fn plane(normal: DVec3, point: DVec3, weight: f64) -> Self {
        let (n, d) = (normal, -normal.dot(point));
        let a = [n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z];
        Self { a: a.map(|x| x * weight), b: n * (d * weight), c: d * d * weight }
    }

    pub(super) fn point(p: DVec3, weight: f64) -> Self {
        let a = [weight, 0.0, 0.0, weight, 0.0, weight];
        Self { a, b: -p * weight, c: p.length_squared() * weight }
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (a, b) in self.a.iter_mut().zip(&other.a) {
            *a += b;
        }
        self.b += other.b;
        self.c += other.c;
    }

    pub(super) fn at(&self, p: DVec3) -> f64 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let ap = DVec3::new(
            xx * p.x + xy * p.y + xz * p.z,
            xy * p.x + yy * p.y + yz * p.z,
            xz * p.x + yz * p.y + zz * p.z,
        );
        (p.dot(ap) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }

    /// Where it is least.
    pub(super) fn best(&self) -> Option<DVec3> {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let (c0, c1, c2) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let det = xx * c0 + xy * c1 + xz * c2;
        let scale = (xx + yy + zz) / 3.0;
        if det.abs() <= 1e-9 * scale * scale * scale {
            return None;
        }
        let (d1, d2, e2) = (xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy);
        let b = -self.b;
        Some(DVec3::new(
            (c0 * b.x + c1 * b.y + c2 * b.z) / det,
            (c1 * b.x + d1 * b.y + d2 * b.z) / det,
            (c2 * b.x + d2 * b.y + e2 * b.z) / det,
        ))
    }
}
