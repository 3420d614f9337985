//! The solids a body is modelled from, as signed distances: negative inside.
//!
//! Distances are those of the first order, f / |∇f|: exact on the surface, right to a few per
//! cent near it, and good enough far away to say that nothing is near.

use glam::Vec3;

/// Three directions at right angles and where they begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) origin_m: Vec3,
    /// Along the part.
    pub(super) u: Vec3,
    /// Across it.
    pub(super) v: Vec3,
    /// Across both.
    pub(super) w: Vec3,
}

impl Frame {
    /// A frame along `u` whose `w` is as near to `up` as may be, and `v = w × u`.
    pub(super) fn new(origin_m: Vec3, u: Vec3, up: Vec3) -> Self {
        let u = u.try_normalize().unwrap_or(Vec3::Y);
        let w = up.reject_from_normalized(u).try_normalize();
        let w = w.unwrap_or_else(|| u.any_orthonormal_vector());
        Self { origin_m, u, v: w.cross(u), w }
    }

    fn local(&self, p: Vec3) -> [f32; 3] {
        let q = p - self.origin_m;
        [q.dot(self.u), q.dot(self.v), q.dot(self.w)]
    }

    /// The point with these coordinates.
    pub(super) fn at(&self, u: f32, v: f32, w: f32) -> Vec3 {
        self.origin_m + self.u * u + self.v * v + self.w * w
    }
}

/// One cross-section of a [`Loft`]: four quarter ellipses around a centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Section {
    /// Where along the loft, 0 to 1.
    pub(super) t: f32,
    /// Radii towards +v, −v, +w, −w, then the centre's v and w; metres.
    pub(super) values: [f32; 6],
}

/// A section with its own radius towards every side.
pub(super) fn section(t: f32, v: [f32; 2], w: [f32; 2]) -> Section {
    Section { t, values: [v[0], v[1], w[0], w[1], 0.0, 0.0] }
}

impl Section {
    /// The same section with its centre elsewhere.
    pub(super) fn around(mut self, v: f32, w: f32) -> Self {
        self.values[4] = v;
        self.values[5] = w;
        self
    }
}

const N_SAMPLES: usize = 33;

/// A tube of varying, lopsided elliptic section with rounded ends: most of a body.
#[derive(Clone, Debug)]
pub(super) struct Loft {
    frame: Frame,
    length_m: f32,
    /// How far the ends are rounded beyond the first and the last section.
    caps_m: [f32; 2],
    /// Whether its sections are boxes with round edges, Σ|x|^2.5 = 1, not ellipses.
    is_squared: bool,
    samples: Vec<[f32; 6]>,
}

impl Loft {
    /// A tube through `sections`, whose `t` ascend; radii are multiplied by `scale`.
    pub(super) fn new(
        frame: Frame,
        length_m: f32,
        caps_m: [f32; 2],
        scale: f32,
        sections: &[Section],
    ) -> Self {
        let tiny = 1e-6 + 1e-4 * scale;
        let samples = (0..N_SAMPLES)
            .map(|i| {
                let t = i as f32 / (N_SAMPLES - 1) as f32;
                let mut sample = monotone(sections, t);
                for (channel, value) in sample.iter_mut().enumerate() {
                    *value *= scale;
                    if channel < 4 {
                        *value = value.max(tiny);
                    }
                }
                sample
            })
            .collect();
        let caps_m = caps_m.map(|cap| cap.max(tiny));
        Self { frame, length_m: length_m.max(tiny), caps_m, is_squared: false, samples }
    }

    /// The same tube with boxier sections.
    pub(super) fn squared(mut self) -> Self {
        self.is_squared = true;
        self
    }

    /// Quadratic B-spline through the samples: smooth in its first derivative.
    fn values(&self, t: f32) -> [f32; 6] {
        let last = (N_SAMPLES - 1) as f32;
        let x = (t * last).clamp(0.0, last);
        let i = (x + 0.5) as usize;
        let f = x - i as f32; // −0.5 to 0.5
        let a = &self.samples[i.saturating_sub(1)];
        let b = &self.samples[i];
        let c = &self.samples[(i + 1).min(N_SAMPLES - 1)];
        let (wa, wc) = (0.5 * (0.5 - f) * (0.5 - f), 0.5 * (0.5 + f) * (0.5 + f));
        let wb = 1.0 - wa - wc;
        std::array::from_fn(|k| a[k] * wa + b[k] * wb + c[k] * wc)
    }

    fn distance_m(&self, p: Vec3) -> f32 {
        let [u, v, w] = self.frame.local(p);
        let [v_plus, v_minus, w_plus, w_minus, v_mid, w_mid] = self.values(u / self.length_m);
        let beyond = (u - self.length_m).max(0.0) + u.min(0.0);
        let (v, w) = (v - v_mid, w - w_mid);
        let radii = [
            if u < 0.0 { self.caps_m[0] } else { self.caps_m[1] },
            if v > 0.0 { v_plus } else { v_minus },
            if w > 0.0 { w_plus } else { w_minus },
        ];
        // Inside, the ends may be nearer than the sides.
        let end = (u - self.length_m - self.caps_m[1]).max(-u - self.caps_m[0]);
        let sides = if self.is_squared { squared_m } else { ellipsoid_m };
        sides([beyond, v, w], radii).max(end)
    }
}

/// First-order distance to Σ(xᵢ/rᵢ)² = 1; inside no more than the lesser of the last two radii.
fn ellipsoid_m(x: [f32; 3], r: [f32; 3]) -> f32 {
    let s: [f32; 3] = std::array::from_fn(|i| x[i] / r[i]);
    let g: [f32; 3] = std::array::from_fn(|i| s[i] / r[i]);
    let k0 = (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt();
    let k1 = (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]).sqrt();
    let depth = r[1].min(r[2]);
    if k1 < 1e-12 { -depth } else { (k0 * (k0 - 1.0) / k1).max(-depth) }
}

/// The same for Σ|xᵢ/rᵢ|^2.5 = 1.
fn squared_m(x: [f32; 3], r: [f32; 3]) -> f32 {
    let s: [f32; 3] = std::array::from_fn(|i| (x[i] / r[i]).abs());
    let depth = r[1].min(r[2]);
    let f = s.iter().map(|&s| s * s * s.sqrt()).sum::<f32>().powf(0.4);
    if f < 1e-6 {
        return -depth;
    }
    let g: [f32; 3] = std::array::from_fn(|i| {
        let share = s[i] / f;
        share * share.sqrt() / r[i]
    });
    ((f - 1.0) / (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]).sqrt()).max(-depth)
}

/// Monotone cubic interpolation (Fritsch and Carlson 1980): no bulge that the table does not name.
fn monotone(sections: &[Section], t: f32) -> [f32; 6] {
    let Some((first, last)) = sections.first().zip(sections.last()) else { return [0.0; 6] };
    if t <= first.t {
        return first.values;
    }
    if t >= last.t {
        return last.values;
    }
    let i = sections.partition_point(|s| s.t <= t) - 1;
    let (a, b) = (&sections[i], &sections[i + 1]);
    let h = (b.t - a.t).max(1e-6);
    let x = (t - a.t) / h;
    std::array::from_fn(|k| {
        let chord = |i: usize| {
            let (a, b) = (&sections[i], &sections[i + 1]);
            (b.values[k] - a.values[k]) / (b.t - a.t).max(1e-6)
        };
        let slope = |at: usize| {
            if at == 0 || at + 1 == sections.len() {
                return if at == 0 { chord(0) } else { chord(at - 1) };
            }
            let (l, r) = (chord(at - 1), chord(at));
            // The harmonic mean; zero at a turning point.
            if l * r <= 0.0 { 0.0 } else { 2.0 * l * r / (l + r) }
        };
        let (m0, m1) = (slope(i) * h, slope(i + 1) * h);
        let (y0, y1) = (a.values[k], b.values[k]);
        let (x2, x3) = (x * x, x * x * x);
        y0 * (2.0 * x3 - 3.0 * x2 + 1.0)
            + m0 * (x3 - 2.0 * x2 + x)
            + y1 * (3.0 * x2 - 2.0 * x3)
            + m1 * (x3 - x2)
    })
}

/// One solid.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A tube.
    Loft(Loft),
    /// An ellipsoid with radii along its frame's u, v, w.
    Ball(Frame, [f32; 3]),
    /// A straight rod, thicker at one end, round at both.
    Rod {
        /// The middle of the first end.
        a_m: Vec3,
        /// The middle of the other.
        b_m: Vec3,
        /// Radii at both.
        radii_m: [f32; 2],
    },
}

impl Shape {
    /// Signed distance.
    pub(super) fn distance_m(&self, p: Vec3) -> f32 {
        match self {
            Self::Loft(loft) => loft.distance_m(p),
            Self::Ball(frame, radii) => ellipsoid_m(frame.local(p), *radii),
            Self::Rod { a_m, b_m, radii_m } => {
                let axis = *b_m - *a_m;
                let t = (p - *a_m).dot(axis) / axis.length_squared().max(1e-12);
                let t = t.clamp(0.0, 1.0);
                let radius = radii_m[0] + (radii_m[1] - radii_m[0]) * t;
                p.distance(*a_m + axis * t) - radius
            }
        }
    }

    /// A box around it: its corners of least and greatest coordinates.
    pub(super) fn bounds_m(&self) -> [Vec3; 2] {
        let around = |center: Vec3, frame: &Frame, half: [f32; 3]| {
            let half = frame.u.abs() * half[0] + frame.v.abs() * half[1] + frame.w.abs() * half[2];
            [center - half, center + half]
        };
        match self {
            Self::Loft(loft) => {
                let most =
                    |pick: fn(&[f32; 6]) -> f32| loft.samples.iter().map(pick).fold(0.0, f32::max);
                let v = most(|s| (s[4] + s[0]).abs().max((s[4] - s[1]).abs()));
                let w = most(|s| (s[5] + s[2]).abs().max((s[5] - s[3]).abs()));
                let cap = loft.caps_m[0].max(loft.caps_m[1]);
                let center = loft.frame.at(0.5 * loft.length_m, 0.0, 0.0);
                around(center, &loft.frame, [0.5 * loft.length_m + cap, v, w])
            }
            Self::Ball(frame, radii) => around(frame.origin_m, frame, *radii),
            Self::Rod { a_m, b_m, radii_m } => {
                let r = radii_m[0].max(radii_m[1]);
                [a_m.min(*b_m) - r, a_m.max(*b_m) + r]
            }
        }
    }
}

/// The lesser of two distances with the crease between them filled over a reach of `k`
/// (quadratic polynomial; Quílez, "smooth minimum"). Commutative to the last bit.
pub(super) fn smooth_min(a: f32, b: f32, k: f32) -> f32 {
    let h = (k - (a - b).abs()).max(0.0);
    if h > 0.0 { a.min(b) - h * h / (4.0 * k) } else { a.min(b) }
}
