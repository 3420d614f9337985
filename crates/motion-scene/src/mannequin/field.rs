//! A body as one signed distance: solids that flow into each other along the bone tree.

use glam::Vec3;

use super::shape::{Shape, smooth_min};

/// What far away is.
const FAR_M: f32 = 1e9;

/// One step of modelling: solids added to, or carved from, what was there before.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// One solid, or a left one and a right one, which are joined first so that neither comes
    /// before the other.
    shapes: Vec<Shape>,
    /// How far the pair flows together.
    pair_blend_m: f32,
    /// How far it flows into what was there.
    blend_m: f32,
    is_carved: bool,
    bounds_m: [Vec3; 2],
}

/// Limbs that grow from a layer: left and right ones do not blend with each other, and with what
/// carries them only near their root.
#[derive(Clone, Debug)]
pub(super) struct Limbs {
    layers: Vec<Layer>,
    blend_m: f32,
    roots_m: Vec<Vec3>,
    /// Where the blend has faded to a tenth.
    reach_m: f32,
}

/// A plane, such as a sole's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) point_m: Vec3,
    /// Unit length.
    pub(super) normal: Vec3,
}

impl Plane {
    /// How far `p` is on the side of the normal.
    pub(super) fn above_m(&self, p: Vec3) -> f32 {
        (p - self.point_m).dot(self.normal)
    }
}

/// A part of a body: steps, then limbs, then the floor it stands on.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    steps: Vec<Step>,
    limbs: Vec<Limbs>,
    /// What it stands on.
    sole: Option<(Plane, f32)>,
}

fn bounds_of(boxes: impl Iterator<Item = [Vec3; 2]>) -> [Vec3; 2] {
    boxes.fold([Vec3::splat(FAR_M), Vec3::splat(-FAR_M)], |all, one| {
        [all[0].min(one[0]), all[1].max(one[1])]
    })
}

impl Layer {
    /// Adds solids that flow over `blend_m` into what is there.
    pub(super) fn add(&mut self, blend_m: f32, shapes: Vec<Shape>) {
        self.step(blend_m, 0.6 * blend_m, shapes, false);
    }

    /// Takes solids away.
    pub(super) fn carve(&mut self, blend_m: f32, shapes: Vec<Shape>) {
        self.step(blend_m, 0.6 * blend_m, shapes, true);
    }

    fn step(&mut self, blend_m: f32, pair_blend_m: f32, shapes: Vec<Shape>, is_carved: bool) {
        let bounds_m = bounds_of(shapes.iter().map(Shape::bounds_m));
        if !shapes.is_empty() {
            self.steps.push(Step { shapes, pair_blend_m, blend_m, is_carved, bounds_m });
        }
    }

    /// Lets limbs grow, each a layer and where it is rooted.
    pub(super) fn grow(&mut self, blend_m: f32, reach_m: f32, limbs: Vec<(Self, Vec3)>) {
        let (layers, roots_m) = limbs.into_iter().unzip();
        self.limbs.push(Limbs { layers, blend_m, roots_m, reach_m });
    }

    /// Cuts away what is below a plane, with an edge rounded over `edge_m`.
    pub(super) fn stand_on(&mut self, plane: Plane, edge_m: f32) {
        self.sole = Some((plane, edge_m));
    }

    /// How many steps it has with its limbs.
    pub(super) fn n_steps(&self) -> usize {
        let limbs = self.limbs.iter().flat_map(|limbs| &limbs.layers);
        self.steps.len() + limbs.map(Self::n_steps).sum::<usize>()
    }

    /// A box around everything.
    pub(super) fn bounds_m(&self) -> [Vec3; 2] {
        let limbs = self.limbs.iter().flat_map(|limbs| &limbs.layers).map(Self::bounds_m);
        let steps = self.steps.iter().filter(|step| !step.is_carved).map(|step| step.bounds_m);
        bounds_of(steps.chain(limbs))
    }

    /// The signed distance with all steps.
    pub(super) fn distance_m(&self, p: Vec3) -> f32 {
        self.distance_of_near_m(p, None, &mut 0)
    }

    /// The signed distance of the steps that are `near`, which are numbered from `next` on.
    fn distance_of_near_m(&self, p: Vec3, near: Option<&[bool]>, next: &mut usize) -> f32 {
        let mut d = FAR_M;
        for (idx, step) in self.steps.iter().enumerate() {
            if near.is_some_and(|near| !near[*next + idx]) {
                continue;
            }
            let added = step
                .shapes
                .iter()
                .map(|shape| shape.distance_m(p))
                .reduce(|a, b| smooth_min(a, b, step.pair_blend_m))
                .unwrap_or(FAR_M);
            d = if step.is_carved {
                -smooth_min(-d, added, step.blend_m)
            } else {
                smooth_min(d, added, step.blend_m)
            };
        }
        *next += self.steps.len();
        for limbs in &self.limbs {
            let mut all = FAR_M;
            let mut root_m = FAR_M;
            for (layer, root) in limbs.layers.iter().zip(&limbs.roots_m) {
                all = all.min(layer.distance_of_near_m(p, near, next));
                root_m = root_m.min(p.distance(*root));
            }
            let fade = root_m / limbs.reach_m;
            let blend_m = limbs.blend_m / (1.0 + 9.0 * fade * fade * fade * fade);
            d = smooth_min(d, all, blend_m);
        }
        if let Some((plane, edge_m)) = self.sole {
            d = -smooth_min(-d, plane.above_m(p), edge_m);
        }
        d
    }

    /// Says for each step whether it can matter to points within `radius_m` of `p`, where the
    /// whole distance is at most `d_m`. Only what was near in `before` is asked.
    fn mark_near(
        &self,
        p: Vec3,
        radius_m: f32,
        d_m: f32,
        near: &mut [bool],
        next: &mut usize,
        blend_m: f32,
    ) {
        for (idx, step) in self.steps.iter().enumerate() {
            let at = *next + idx;
            if near[at] {
                let [low, high] = step.bounds_m;
                let outside = (low - p).max(p - high).max(Vec3::ZERO).length();
                // 1.4 and 0.75: first-order distances may grow faster than way does.
                let reach = step.blend_m.max(blend_m) + d_m.max(0.0) + 1.4 * radius_m;
                near[at] = 0.75 * (outside - radius_m) < reach;
            }
        }
        *next += self.steps.len();
        for limbs in &self.limbs {
            for layer in &limbs.layers {
                layer.mark_near(p, radius_m, d_m, near, next, blend_m.max(limbs.blend_m));
            }
        }
    }
}

/// A layer seen from one region of space: steps too far to matter there are left out.
#[derive(Clone, Debug)]
pub(super) struct Field<'a> {
    layer: &'a Layer,
    near: Vec<bool>,
}

impl<'a> Field<'a> {
    /// The field everywhere.
    pub(super) fn new(layer: &'a Layer) -> Self {
        Self { layer, near: vec![true; layer.n_steps()] }
    }

    /// The field within `radius_m` of `p`, where it is `d_m`.
    pub(super) fn within(&self, p: Vec3, radius_m: f32, d_m: f32) -> Self {
        let mut near = self.near.clone();
        self.layer.mark_near(p, radius_m, d_m, &mut near, &mut 0, 0.0);
        Self { layer: self.layer, near }
    }

    /// The signed distance.
    pub(super) fn distance_m(&self, p: Vec3) -> f32 {
        self.layer.distance_of_near_m(p, Some(&self.near), &mut 0)
    }

    /// Its gradient by central differences over `step_m`.
    pub(super) fn gradient(&self, p: Vec3, step_m: f32) -> Vec3 {
        let along = |axis: Vec3| {
            (self.distance_m(p + axis * step_m) - self.distance_m(p - axis * step_m))
                / (2.0 * step_m)
        };
        Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z))
    }
}
