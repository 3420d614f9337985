//! Things in the way: every joint keeps out of them along the whole motion. Soft.

use glam::{Vec2, Vec3};

use crate::bodies::{Columns, LANES};
use crate::planar::PlanarTransform;

/// Joints keep this far from obstacles: about the thickness of a body around them, metres.
pub const BODY_MARGIN_M: f32 = 0.10;

/// A joint this deep within the margin for a second counts 1, metres: where it reaches the obstacle
/// itself.
pub const OBSTACLE_TOLERANCE_M: f32 = 0.10;

/// Frames between those that are looked at when a motion is scored.
pub const OBSTACLE_STRIDE: u32 = 3;

/// How high above its underside a ceiling reaches, metres: higher than anyone jumps.
const CEILING_THICKNESS_M: f32 = 20.0;

/// Something solid. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A box, turned about +Y.
    Box {
        /// Its middle.
        center_m: Vec3,
        /// Its edges along its own axes.
        size_m: Vec3,
        /// Its turn, radians.
        heading_rad: f32,
    },
    /// An upright cylinder.
    Cylinder {
        /// Its middle.
        center_m: Vec3,
        /// Its radius.
        radius_m: f32,
        /// Its height.
        height_m: f32,
    },
    /// A level rectangle that nothing may rise above; solid from its height upwards.
    Ceiling {
        /// The middle of its underside.
        center_m: Vec3,
        /// Its edges along its own x and z.
        size_m: Vec2,
        /// Its turn, radians.
        heading_rad: f32,
    },
}

impl Obstacle {
    /// How deep a point lies within it and the margin around it, metres; 0 outside.
    pub fn depth_m(&self, world: Vec3) -> f32 {
        Solid::new(self).depth_m(world)
    }

    /// Whether every number is one and every size above 0.
    pub fn is_valid(&self) -> bool {
        match *self {
            Self::Box { center_m, size_m, heading_rad } => {
                center_m.is_finite()
                    && size_m.is_finite()
                    && size_m.min_element() > 0.0
                    && heading_rad.is_finite()
            }
            Self::Cylinder { center_m, radius_m, height_m } => {
                center_m.is_finite()
                    && radius_m.is_finite()
                    && radius_m > 0.0
                    && height_m.is_finite()
                    && height_m > 0.0
            }
            Self::Ceiling { center_m, size_m, heading_rad } => {
                center_m.is_finite()
                    && size_m.is_finite()
                    && size_m.min_element() > 0.0
                    && heading_rad.is_finite()
            }
        }
    }
}

/// An [`Obstacle`] prepared for many questions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solid {
    /// Ground and turn of the middle, out of which points come into its own axes.
    own_from_world: PlanarTransform,
    /// Half the edges along its own x and z, or the radius twice.
    half_m: Vec2,
    is_round: bool,
    bottom_m: f32,
    top_m: f32,
    /// Radius of the circle around it on the ground.
    around_m: f32,
    middle_m: Vec2,
}

impl Solid {
    pub(crate) fn new(obstacle: &Obstacle) -> Self {
        let (center_m, half_m, heading_rad, is_round, bottom_m, top_m) = match *obstacle {
            Obstacle::Box { center_m, size_m, heading_rad } => {
                let half = 0.5 * size_m;
                let ends = (center_m.y - half.y, center_m.y + half.y);
                (center_m, Vec2::new(half.x, half.z), heading_rad, false, ends.0, ends.1)
            }
            Obstacle::Cylinder { center_m, radius_m, height_m } => {
                let ends = (center_m.y - 0.5 * height_m, center_m.y + 0.5 * height_m);
                (center_m, Vec2::splat(radius_m), 0.0, true, ends.0, ends.1)
            }
            Obstacle::Ceiling { center_m, size_m, heading_rad } => {
                let top = center_m.y + CEILING_THICKNESS_M;
                (center_m, 0.5 * size_m, heading_rad, false, center_m.y, top)
            }
        };
        let middle_m = Vec2::new(center_m.x, center_m.z);
        Self {
            own_from_world: PlanarTransform::new(heading_rad, middle_m, 0.0).inverse(),
            half_m,
            is_round,
            bottom_m,
            top_m,
            around_m: if is_round { half_m.x } else { half_m.length() },
            middle_m,
        }
    }

    /// Whether a body at `ground_m` whose joints reach `reach_m` sideways and `top_m` up can touch it
    /// at all.
    #[inline]
    pub(crate) fn is_near(&self, ground_m: Vec2, reach_m: f32, top_m: f32) -> bool {
        let far = reach_m + BODY_MARGIN_M;
        let around = self.around_m + far;
        top_m + BODY_MARGIN_M > self.bottom_m
            && self.middle_m.distance_squared(ground_m) < around * around
            && self.sideways_m(self.own_ground_m(ground_m)) < far
    }

    fn own_ground_m(&self, ground_m: Vec2) -> Vec2 {
        self.own_from_world.turn_ground(ground_m) + self.own_from_world.ground_m()
    }

    /// How far a point on the ground, in the solid's own axes, is outside of it; negative within.
    #[inline]
    fn sideways_m(&self, p: Vec2) -> f32 {
        if self.is_round {
            return p.length() - self.half_m.x;
        }
        let out = p.abs() - self.half_m;
        out.max(Vec2::ZERO).length() + out.max_element().min(0.0)
    }

    /// How deep a point lies within the solid and the margin around it, metres; 0 outside.
    #[inline]
    pub(crate) fn depth_m(&self, world: Vec3) -> f32 {
        self.own_depth_m(self.own_from_world.apply(world))
    }

    /// How deep the deepest of the joints lies, which stand in the torso frame at `world_from_torso`.
    ///
    /// [`Self::depth_m`] of all of them, without a branch for any.
    #[inline]
    pub(crate) fn deepest_m(
        &self,
        world_from_torso: PlanarTransform,
        Columns { x, y, z }: &Columns<'_>,
    ) -> f32 {
        let own_from_torso = self.own_from_world * world_from_torso;
        let mut deepest_m = [0.0f32; LANES];
        let [x, y, z] = [x, y, z].map(|column| column.as_chunks::<LANES>().0);
        for ((x, y), z) in x.iter().zip(y).zip(z) {
            let own_m = |lane: usize| own_from_torso.apply(Vec3::new(x[lane], y[lane], z[lane]));
            for (lane, deepest_m) in deepest_m.iter_mut().enumerate() {
                *deepest_m = deepest_m.max(self.signed_depth_m(own_m(lane)));
            }
        }
        deepest_m.into_iter().fold(0.0, f32::max)
    }

    /// The depth of a point in the solid's own axes.
    #[inline]
    fn own_depth_m(&self, p: Vec3) -> f32 {
        let upright = (self.bottom_m - p.y).max(p.y - self.top_m);
        let beside = (p.x.abs() - self.half_m.x).max(p.z.abs() - self.half_m.y);
        // Most points are far out along one axis.
        if upright.max(beside) >= BODY_MARGIN_M {
            return 0.0;
        }
        self.signed_depth_m(p).max(0.0)
    }

    /// The same; negative outside.
    #[inline(always)]
    fn signed_depth_m(&self, p: Vec3) -> f32 {
        let upright_m = (self.bottom_m - p.y).max(p.y - self.top_m);
        let sideways_m = self.sideways_m(Vec2::new(p.x, p.z));
        let (out_m, up_m) = (sideways_m.max(0.0), upright_m.max(0.0));
        let distance_m = (out_m * out_m + up_m * up_m).sqrt() + sideways_m.max(upright_m).min(0.0);
        BODY_MARGIN_M - distance_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_counts_from_the_margin_inwards() {
        let size_m = Vec3::new(2.0, 2.0, 1.0);
        let heading_rad = std::f32::consts::FRAC_PI_2;
        let solid = Solid::new(&Obstacle::Box { center_m: Vec3::Y, size_m, heading_rad });
        // Turned by a quarter: one metre along x is now its short side.
        for (at, depth) in [
            (Vec3::new(0.55, 1.0, 0.0), 0.05),
            (Vec3::new(0.5, 1.0, 0.9), 0.10),
            (Vec3::new(0.7, 1.0, 0.0), 0.0),
            (Vec3::new(0.0, 2.05, 0.0), 0.05),
            (Vec3::new(0.0, 1.0, 0.0), 0.6),
        ] {
            assert!((solid.depth_m(at) - depth).abs() < 1e-5, "{at}: {}", solid.depth_m(at));
        }
        let round = Obstacle::Cylinder { center_m: Vec3::Y, radius_m: 0.5, height_m: 2.0 };
        let depth_m = Solid::new(&round).depth_m(Vec3::new(0.3, 1.0, 0.4));
        assert!((depth_m - 0.10).abs() < 1e-5, "on its side: {depth_m}");
    }

    #[test]
    fn a_ceiling_is_solid_upwards_and_nothing_below() {
        let center_m = Vec3::new(0.0, 1.4, 5.0);
        let size_m = Vec2::new(2.0, 1.0);
        let solid = Solid::new(&Obstacle::Ceiling { center_m, size_m, heading_rad: 0.0 });
        assert_eq!(solid.depth_m(Vec3::new(0.0, 1.2, 5.0)), 0.0);
        assert!(solid.depth_m(Vec3::new(0.0, 1.7, 5.0)) > 0.35);
        assert!(!solid.is_near(Vec2::new(0.0, 5.0), 0.5, 1.2), "who ducks passes");
        assert!(solid.is_near(Vec2::new(0.0, 5.0), 0.5, 1.6));
    }

    #[test]
    fn the_deepest_joint_of_columns_is_that_of_joints_one_by_one() {
        let shapes = [
            Obstacle::Box { center_m: Vec3::Y, size_m: Vec3::new(0.8, 1.2, 0.5), heading_rad: 0.4 },
            Obstacle::Cylinder { center_m: Vec3::new(0.3, 0.9, 0.1), radius_m: 0.4, height_m: 1.1 },
            Obstacle::Ceiling {
                center_m: Vec3::new(0.0, 1.3, 0.0),
                size_m: Vec2::ONE,
                heading_rad: 1.0,
            },
        ];
        // A lattice of joints through everything, eleven to a frame: not a multiple of the lanes.
        let joints: Vec<Vec3> = (0..11 * 60)
            .map(|n| Vec3::new((n % 11) as f32, (n / 11 % 10) as f32, (n / 110) as f32) * 0.2 - 0.9)
            .collect();
        let bodies = crate::bodies::Bodies::new(&joints, 11);
        let world_from_torso = PlanarTransform::new(0.7, Vec2::new(0.2, -0.1), 0.3);
        let mut n_deep = 0;
        for shape in &shapes {
            let solid = Solid::new(shape);
            for (frame, joints) in joints.chunks(11).enumerate() {
                let slow = joints.iter().map(|&p| solid.depth_m(world_from_torso.apply(p)));
                let slow = slow.fold(0.0, f32::max);
                let fast = solid.deepest_m(world_from_torso, &bodies.columns(frame as u32));
                assert!((slow - fast).abs() < 1e-5, "{shape:?}, frame {frame}: {slow} {fast}");
                n_deep += usize::from(slow > 0.0);
            }
        }
        assert!(n_deep > 20, "{n_deep}");
    }
}
