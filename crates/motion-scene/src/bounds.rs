//! Boxes along the axes that hold things.

use glam::{Mat4, Vec3};

/// A box along the world's axes; never empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least of each coordinate, metres.
    pub min_m: Vec3,
    /// The greatest of each coordinate, metres.
    pub max_m: Vec3,
}

impl Bounds {
    /// The box of one point.
    pub fn of_point(point_m: Vec3) -> Self {
        Self { min_m: point_m, max_m: point_m }
    }

    /// The least box that holds all points; `None` for no points. Points that are not finite do
    /// not count.
    pub fn of_points<'a>(points_m: impl IntoIterator<Item = &'a Vec3>) -> Option<Self> {
        points_m.into_iter().filter(|p| p.is_finite()).fold(None, |bounds, &point| {
            Some(match bounds {
                None => Self::of_point(point),
                Some(bounds) => bounds.union(Self::of_point(point)),
            })
        })
    }

    /// The least box that holds both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min_m: self.min_m.min(other.min_m), max_m: self.max_m.max(other.max_m) }
    }

    /// Larger by `by_m` on every side.
    #[must_use]
    pub fn grown(self, by_m: f32) -> Self {
        Self { min_m: self.min_m - by_m, max_m: self.max_m + by_m }
    }

    /// Its middle.
    pub fn center(&self) -> Vec3 {
        0.5 * (self.min_m + self.max_m)
    }

    /// Its edges' lengths.
    pub fn size(&self) -> Vec3 {
        self.max_m - self.min_m
    }

    /// Its eight corners.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|corner| {
            let pick = |axis: usize| {
                if corner >> axis & 1 == 0 { self.min_m[axis] } else { self.max_m[axis] }
            };
            Vec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// The box that holds a body whose joints are at `world_from_joint`, with flesh around.
    pub fn of_joints(world_from_joint: &[Mat4]) -> Option<Self> {
        /// From a joint to the skin furthest from it: a crown above the head joint.
        const FLESH_M: f32 = 0.22;
        let points: Vec<Vec3> =
            world_from_joint.iter().map(|world| world.w_axis.truncate()).collect();
        Self::of_points(&points).map(|bounds| bounds.grown(FLESH_M))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_hold_what_they_are_made_of() {
        let points = [Vec3::new(1.0, -2.0, 3.0), Vec3::new(-1.0, 4.0, 0.0), Vec3::NAN];
        let bounds = Bounds::of_points(&points).unwrap();
        assert_eq!(bounds.min_m, Vec3::new(-1.0, -2.0, 0.0));
        assert_eq!(bounds.max_m, Vec3::new(1.0, 4.0, 3.0));
        assert_eq!(bounds.center(), Vec3::new(0.0, 1.0, 1.5));
        assert_eq!(bounds.grown(1.0).size(), bounds.size() + 2.0);
        assert_eq!(Bounds::of_points(&bounds.corners()), Some(bounds));
        assert_eq!(Bounds::of_points(&[]), None);
        assert_eq!(Bounds::of_points(&[Vec3::INFINITY]), None);
    }
}
