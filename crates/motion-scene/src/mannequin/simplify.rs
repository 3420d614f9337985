//! Fewer triangles for the same shape: edges collapse where that moves the surface least
//! (Garland and Heckbert 1997), and only where it stays a closed surface without folds.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;

use super::needle::is_needle;
use super::quadric::Quadric;
use super::surface::RawMesh;

/// What a collapse would cost, and the edge with the ages of its ends.
type Candidate = Reverse<(u64, u32, u32, u32, u32)>;

/// A surface on its way to fewer triangles.
pub(super) struct Simplifier {
    points_m: Vec<DVec3>,
    quadrics: Vec<Quadric>,
    /// Triangles at each vertex; empty where the vertex is gone.
    fans: Vec<Vec<u32>>,
    ages: Vec<u32>,
    triangles: Vec<Option<[u32; 3]>>,
    n_triangles: usize,
    heap: BinaryHeap<Candidate>,
    /// Vertices with this x are a border: the other half is the mirror image.
    mirror_x_m: Option<f64>,
}

/// How strong the pull to the old vertices is.
const PULL: f64 = 2e-3;

/// What a collapse may do to the triangles around it.
#[derive(Clone, Copy, Debug)]
struct Care {
    /// The least of twice the area over the square of the longest side.
    least_area: f64,
    /// The least cosine of the angle by which a triangle turns.
    least_cos: f64,
}

/// The most careful first. A body stays with that; thin limbs that lie anywhere cannot all come
/// down to the coarsest level's triangles so, and there it is better to fold than to be too many.
const CARES: [Care; 4] = [
    Care { least_area: 0.08, least_cos: 0.3 },
    Care { least_area: 0.04, least_cos: 0.0 },
    Care { least_area: 0.02, least_cos: -0.7 },
    Care { least_area: 0.005, least_cos: -1.0 },
];

impl Simplifier {
    /// Begins with a mesh. Where `importance` is high at a vertex, its neighbourhood keeps more
    /// triangles.
    pub(super) fn new(mesh: &RawMesh, mirror_x_m: Option<f32>, importance: &[f32]) -> Self {
        let points_m: Vec<DVec3> = mesh.positions_m.iter().map(|p| p.as_dvec3()).collect();
        let n = points_m.len();
        let mut simplifier = Self {
            points_m,
            quadrics: vec![Quadric::default(); n],
            fans: vec![Vec::with_capacity(8); n],
            ages: vec![0; n],
            triangles: mesh.triangles.iter().copied().map(Some).collect(),
            n_triangles: mesh.triangles.len(),
            heap: BinaryHeap::new(),
            mirror_x_m: mirror_x_m.map(f64::from),
        };
        for (idx, t) in mesh.triangles.iter().enumerate() {
            simplifier.add_planes(idx as u32, *t, importance);
        }
        simplifier.line_up();
        simplifier
    }

    /// Every edge is a candidate.
    fn line_up(&mut self) {
        let mut edges: Vec<[u32; 2]> = self
            .triangles
            .iter()
            .flatten()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let candidates: Vec<Candidate> =
            edges.iter().filter_map(|&[a, b]| self.candidate(a, b)).collect();
        self.heap = candidates.into();
    }

    fn add_planes(&mut self, idx: u32, t: [u32; 3], importance: &[f32]) {
        let [a, b, c] = t.map(|v| self.points_m[v as usize]);
        let cross = (b - a).cross(c - a);
        let area = 0.5 * cross.length();
        let Some(normal) = cross.try_normalize() else {
            for v in t {
                self.fans[v as usize].push(idx);
            }
            return;
        };
        for v in t {
            let at = v as usize;
            self.fans[at].push(idx);
            let p = self.points_m[at];
            let weight = area * f64::from(importance[at]) / 3.0;
            let mut quadric = Quadric::plane(normal, a, weight);
            quadric.add(&Quadric::point(p, PULL * weight));
            self.quadrics[at].add(&quadric);
            if let Some(x) = self.mirror_x_m
                && self.is_border(v)
            {
                let image = DVec3::new(-normal.x, normal.y, normal.z);
                let on_image = DVec3::new(2.0 * x - a.x, a.y, a.z);
                let mut quadric = Quadric::plane(image, on_image, weight);
                quadric.add(&Quadric::point(p, PULL * weight));
                self.quadrics[at].add(&quadric);
            }
        }
    }

    fn is_border(&self, v: u32) -> bool {
        self.mirror_x_m.is_some_and(|x| self.points_m[v as usize].x == x)
    }

    /// Where the collapse of an edge would put its vertex, and what it would cost.
    fn collapsed(&self, a: u32, b: u32) -> (DVec3, f64) {
        let mut sum = self.quadrics[a as usize];
        sum.add(&self.quadrics[b as usize]);
        let (pa, pb) = (self.points_m[a as usize], self.points_m[b as usize]);
        match (self.is_border(a), self.is_border(b)) {
            (true, false) => return (pa, sum.at(pa)),
            (false, true) => return (pb, sum.at(pb)),
            _ => {}
        }
        let middle = 0.5 * (pa + pb);
        let reach = pa.distance(pb);
        let mut best = sum.best().filter(|p| p.distance(middle) < 1.5 * reach).unwrap_or(middle);
        if let Some(x) = self.mirror_x_m {
            if self.is_border(a) {
                best.x = x;
            } else if best.x <= x {
                best = middle;
            }
        }
        (best, sum.at(best))
    }

    fn candidate(&self, a: u32, b: u32) -> Option<Candidate> {
        let (_, cost) = self.collapsed(a, b);
        let age = |v: u32| self.ages[v as usize];
        cost.is_finite().then(|| Reverse((cost.to_bits(), a, b, age(a), age(b))))
    }

    fn neighbours(&self, v: u32) -> Vec<u32> {
        let fan = &self.fans[v as usize];
        let mut around: Vec<u32> = fan
            .iter()
            .filter_map(|&t| self.triangles[t as usize])
            .flatten()
            .filter(|&other| other != v)
            .collect();
        around.sort_unstable();
        around.dedup();
        around
    }

    /// Collapses edges until at most `n_triangles` are left, or none can collapse. Of a mirrored
    /// half, its own triangles are counted.
    pub(super) fn reduce_to(&mut self, n_triangles: usize) {
        for (nth, care) in CARES.into_iter().enumerate() {
            if self.n_triangles <= n_triangles {
                return;
            }
            if nth > 0 {
                self.line_up();
            }
            self.reduce_with(care, n_triangles);
        }
    }

    /// Collapses what triangles without area the surface had from the start, where it can.
    pub(super) fn drop_needles(&mut self) {
        for t in 0..self.triangles.len() {
            for side in 0..3 {
                let Some(corners) = self.triangles[t] else { break };
                if !is_needle(corners.map(|v| self.points_m[v as usize])) {
                    break;
                }
                let (a, b) = (corners[side], corners[(side + 1) % 3]);
                self.try_collapse(a.min(b), a.max(b), CARES[CARES.len() - 1]);
            }
        }
    }

    fn reduce_with(&mut self, care: Care, n_triangles: usize) {
        while self.n_triangles > n_triangles {
            let Some(Reverse((_, a, b, age_a, age_b))) = self.heap.pop() else { return };
            let is_current = self.ages[a as usize] == age_a && self.ages[b as usize] == age_b;
            if is_current && !self.fans[a as usize].is_empty() && !self.fans[b as usize].is_empty()
            {
                self.try_collapse(a, b, care);
            }
        }
    }

    fn try_collapse(&mut self, a: u32, b: u32, care: Care) {
        let (around_a, around_b) = (self.neighbours(a), self.neighbours(b));
        if !self.stays_manifold(a, b, &around_a, &around_b) {
            return;
        }
        let (to, _) = self.collapsed(a, b);
        if self.folds(a, b, to, care) || self.folds(b, a, to, care) {
            return;
        }
        let fan_b = std::mem::take(&mut self.fans[b as usize]);
        for t in fan_b {
            let Some(mut triangle) = self.triangles[t as usize] else { continue };
            if triangle.contains(&a) {
                self.triangles[t as usize] = None;
                self.n_triangles -= 1;
                for v in triangle {
                    self.fans[v as usize].retain(|&other| other != t);
                }
            } else {
                for v in &mut triangle {
                    if *v == b {
                        *v = a;
                    }
                }
                self.triangles[t as usize] = Some(triangle);
                self.fans[a as usize].push(t);
            }
        }
        let quadric_b = self.quadrics[b as usize];
        self.quadrics[a as usize].add(&quadric_b);
        self.points_m[a as usize] = to;
        self.ages[a as usize] += 1;
        self.ages[b as usize] += 1;
        for v in self.neighbours(a) {
            let candidate = self.candidate(a.min(v), a.max(v));
            self.heap.extend(candidate);
        }
    }

    /// The link condition (Dey et al. 1999): the ends share no neighbours but those across the
    /// edge; and the border stays the only thing on the mirror.
    fn stays_manifold(&self, a: u32, b: u32, around_a: &[u32], around_b: &[u32]) -> bool {
        let shared: Vec<u32> =
            around_a.iter().copied().filter(|v| around_b.binary_search(v).is_ok()).collect();
        let n_across = self.fans[a as usize]
            .iter()
            .filter(|&&t| self.triangles[t as usize].is_some_and(|t| t.contains(&b)))
            .count();
        if shared.len() != n_across || around_a.len().min(around_b.len()) < 3 {
            // A border's corner may have two neighbours and a triangle; it stays as it is.
            return false;
        }
        // Vertices of three triangles across the edge would leave two triangles back to back.
        if shared.iter().any(|&v| !self.is_border(v) && self.fans[v as usize].len() <= 3) {
            return false;
        }
        match (self.is_border(a), self.is_border(b)) {
            (true, true) => n_across == 1,
            (false, false) => n_across == 2,
            (a_is_border, _) => {
                let (border, inner) =
                    if a_is_border { (around_a, around_b) } else { (around_b, around_a) };
                let other = if a_is_border { a } else { b };
                n_across == 2
                    && inner.iter().all(|&v| {
                        v == other || !self.is_border(v) || border.binary_search(&v).is_ok()
                    })
            }
        }
    }

    /// Whether a triangle at `v`, not at `gone`, would turn too far or become a needle when `v`
    /// goes to `to`.
    fn folds(&self, v: u32, gone: u32, to: DVec3, care: Care) -> bool {
        self.fans[v as usize].iter().any(|&t| {
            let Some(t) = self.triangles[t as usize] else { return false };
            if t.contains(&gone) {
                return false;
            }
            let before = t.map(|i| self.points_m[i as usize]);
            let after = t.map(|i| if i == v { to } else { self.points_m[i as usize] });
            let cross = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
            let (n0, n1) = (cross(before), cross(after));
            let longest = (0..3).map(|i| after[i].distance_squared(after[(i + 1) % 3]));
            let longest = longest.fold(0.0, f64::max);
            n1.length() < care.least_area * longest
                || n0.dot(n1) < care.least_cos * n0.length() * n1.length()
        })
    }

    /// What is left, without gaps in its numbering.
    pub(super) fn mesh(&self) -> RawMesh {
        let mut number = vec![u32::MAX; self.points_m.len()];
        let mut mesh = RawMesh::default();
        for triangle in self.triangles.iter().flatten() {
            let renumbered = triangle.map(|v| {
                let at = v as usize;
                if number[at] == u32::MAX {
                    number[at] = mesh.positions_m.len() as u32;
                    mesh.positions_m.push(self.points_m[at].as_vec3());
                }
                number[at]
            });
            mesh.triangles.push(renumbered);
        }
        mesh
    }
}
