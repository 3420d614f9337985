//! A body for any other skeleton: a dog, a robot arm, a tree.

use glam::Vec3;

use crate::body_plan::BodyPlan;

use super::field::Layer;
use super::grid::Detail;
use super::shape::Shape;
use super::weights::Weights;

/// A bone with flesh: what `joint` moves.
#[derive(Clone, Copy, Debug)]
struct Bone {
    joint: usize,
    from_m: Vec3,
    to_m: Vec3,
    radii_m: [f32; 2],
}

impl Bone {
    /// How far `p` is from the flesh, and where along the bone, 0 to 1.
    fn distance_m(&self, p: Vec3) -> f32 {
        let axis = self.to_m - self.from_m;
        let t = ((p - self.from_m).dot(axis) / axis.length_squared().max(1e-12)).clamp(0.0, 1.0);
        let radius = self.radii_m[0] + (self.radii_m[1] - self.radii_m[0]) * t;
        p.distance(self.from_m + axis * t) - radius
    }
}

/// Tapered limbs around every bone.
pub(super) struct Generic {
    pub(super) body: Layer,
    bones: Vec<Bone>,
    parents: Vec<Option<usize>>,
    scale: f32,
}

/// More bones than this are drawn by the longest of them.
const MAX_BONES: usize = 256;

impl Generic {
    /// A body around the bones between `positions_m`, which are finite.
    pub(super) fn new(plan: &BodyPlan, positions_m: &[Vec3]) -> Self {
        let n = positions_m.len();
        let parents: Vec<Option<usize>> =
            (0..n).map(|i| plan.joints[i].parent.filter(|&p| p < i)).collect();
        let low = positions_m.iter().copied().reduce(Vec3::min).unwrap_or(Vec3::ZERO);
        let high = positions_m.iter().copied().reduce(Vec3::max).unwrap_or(Vec3::ZERO);
        let size_m = low.distance(high);
        let size_m = if size_m > 1e-6 { size_m } else { 0.1 };
        // How much hangs on a joint: trunks are thicker than twigs.
        let mut below = vec![0.0_f32; n];
        for i in (0..n).rev() {
            let end_m = plan.joints[i].end_m.filter(|end| end.is_finite());
            below[i] += end_m.map_or(0.0, |end| end.distance(positions_m[i]));
            if let Some(parent) = parents[i] {
                below[parent] += below[i] + positions_m[i].distance(positions_m[parent]);
            }
        }
        let radius = |joint: usize, length_m: f32| {
            let load = (below[joint] / size_m).clamp(0.0, 4.0).sqrt();
            (0.016 * size_m + 0.030 * size_m * load).min(0.24 * length_m + 0.010 * size_m)
        };
        let mut bones: Vec<Bone> = Vec::new();
        for i in 0..n {
            let mut add = |joint: usize, from_m: Vec3, to_m: Vec3, far: Option<usize>| {
                let length_m = from_m.distance(to_m);
                if length_m > 1e-3 * size_m {
                    let near_m = radius(joint, length_m);
                    let far_m =
                        far.map_or(0.6 * near_m, |far| radius(far, length_m).max(0.6 * near_m));
                    bones.push(Bone { joint, from_m, to_m, radii_m: [near_m, far_m.min(near_m)] });
                }
            };
            if let Some(parent) = parents[i] {
                add(parent, positions_m[parent], positions_m[i], Some(i));
            }
            if let Some(end_m) = plan.joints[i].end_m.filter(|end| end.is_finite()) {
                add(i, positions_m[i], end_m, None);
            }
        }
        if bones.is_empty() {
            let at = positions_m.first().copied().unwrap_or(Vec3::ZERO);
            let r = 0.25 * size_m;
            bones.push(Bone { joint: 0, from_m: at, to_m: at + Vec3::Y * r, radii_m: [r, r] });
        }
        if bones.len() > MAX_BONES {
            bones.sort_by(|a, b| {
                let length = |bone: &Bone| bone.from_m.distance(bone.to_m);
                length(b).total_cmp(&length(a)).then(a.joint.cmp(&b.joint))
            });
            bones.truncate(MAX_BONES);
        }
        let mut body = Layer::default();
        for bone in &bones {
            let rod = Shape::Rod { a_m: bone.from_m, b_m: bone.to_m, radii_m: bone.radii_m };
            body.add(0.4 * bone.radii_m[0], vec![rod]);
        }
        Self { body, bones, parents, scale: size_m / 1.75 }
    }

    /// 1 for a body as large as a person.
    pub(super) fn scale(&self) -> f32 {
        self.scale
    }

    /// Finer steps around thin bones.
    pub(super) fn details(&self) -> Vec<Detail> {
        self.bones
            .iter()
            .map(|bone| {
                let r = bone.radii_m[1];
                let (low_m, high_m) =
                    (bone.from_m.min(bone.to_m) - r, bone.from_m.max(bone.to_m) + r);
                Detail { low_m, high_m, step_m: (0.45 * r).max(0.006 * self.scale) }
            })
            .collect()
    }

    /// Which joints move the skin at `p`: the nearest bone's, and those of bones that meet it.
    pub(super) fn weights(&self, p: Vec3) -> Weights {
        let mut weights = Weights::default();
        let nearest = self
            .bones
            .iter()
            .map(|bone| (bone.distance_m(p), bone))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((least_m, nearest)) = nearest else { return weights };
        let parent = |joint: usize| self.parents[joint];
        for bone in &self.bones {
            let (a, b) = (bone.joint, nearest.joint);
            let meets = a == b
                || parent(a) == Some(b)
                || parent(b) == Some(a)
                || bone.from_m.distance(nearest.to_m) < 1e-6
                || bone.to_m.distance(nearest.from_m) < 1e-6;
            if meets {
                let reach_m = 0.8 * nearest.radii_m[0].max(bone.radii_m[0]);
                let off = (bone.distance_m(p) - least_m) / reach_m.max(1e-9);
                let share = (1.0 - off).clamp(0.0, 1.0);
                let had = weights.of(&[a]);
                // A joint's bones are one body: the nearest counts, not their number.
                weights.add(a, (share * share - had).max(0.0));
            }
        }
        weights
    }
}
