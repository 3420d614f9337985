//! The forms that obstacles have, and how one becomes another.

use motion_session::Shape;

use crate::state::moving::{rounded, wrapped_deg};

/// A form to choose from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ObstacleForm {
    /// A box that stands on the floor.
    #[default]
    Box,
    /// A column.
    Cylinder,
    /// A level that nobody rises above.
    Ceiling,
}

/// How high a new box or cylinder is, metres: too high to step over.
const NEW_HEIGHT_M: f64 = 1.0;
/// How high a new ceiling hangs, metres: people must duck.
const NEW_CEILING_M: f64 = 1.5;

impl ObstacleForm {
    /// Every form.
    pub const ALL: [Self; 3] = [Self::Box, Self::Cylinder, Self::Ceiling];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "Box",
            Self::Cylinder => "Cylinder",
            Self::Ceiling => "Ceiling",
        }
    }

    /// The one after this, the first after the last.
    pub fn next(self) -> Self {
        match self {
            Self::Box => Self::Cylinder,
            Self::Cylinder => Self::Ceiling,
            Self::Ceiling => Self::Box,
        }
    }

    /// The form of a shape.
    pub fn of(shape: &Shape) -> Self {
        match shape {
            Shape::Box { .. } => Self::Box,
            Shape::Cylinder { .. } => Self::Cylinder,
            Shape::Ceiling { .. } => Self::Ceiling,
        }
    }

    /// A new one drawn from a place on the floor to another: from corner to corner, a cylinder from
    /// its middle to its rim. `None` while it is too small to be meant.
    pub fn drawn(self, from: [f64; 2], to: [f64; 2]) -> Option<Shape> {
        const LEAST_M: f64 = 0.1;
        let (dx, dz) = ((to[0] - from[0]).abs(), (to[1] - from[1]).abs());
        let (x, z) = (rounded(0.5 * (from[0] + to[0])), rounded(0.5 * (from[1] + to[1])));
        let (width, depth) = (rounded(dx), rounded(dz));
        if dx.hypot(dz) < LEAST_M || (self != Self::Cylinder && dx.min(dz) < 0.5 * LEAST_M) {
            return None;
        }
        Some(match self {
            Self::Box => Shape::Box {
                center_m: [x, 0.5 * NEW_HEIGHT_M, z],
                size_m: [width, NEW_HEIGHT_M, depth],
                heading_deg: 0.0,
            },
            Self::Cylinder => Shape::Cylinder {
                center_m: [rounded(from[0]), 0.5 * NEW_HEIGHT_M, rounded(from[1])],
                radius_m: rounded(dx.hypot(dz)),
                height_m: NEW_HEIGHT_M,
            },
            Self::Ceiling => Shape::Ceiling {
                center_m: [x, NEW_CEILING_M, z],
                size_m: [width, 0.0, depth],
                heading_deg: 0.0,
            },
        })
    }

    /// A shape of this form as large as another and at its place.
    pub fn made_of(self, shape: &Shape) -> Shape {
        if Self::of(shape) == self {
            return shape.clone();
        }
        let [x, _, z] = center_m(shape);
        let ([width, depth], (bottom, top)) = (floor_m(shape), levels_m(shape));
        let height = if top > bottom { top - bottom } else { NEW_HEIGHT_M };
        let heading_deg = heading_deg(shape).unwrap_or_default();
        match self {
            Self::Box => Shape::Box {
                center_m: [x, 0.5 * height, z],
                size_m: [width, height, depth],
                heading_deg,
            },
            Self::Cylinder => Shape::Cylinder {
                center_m: [x, 0.5 * height, z],
                radius_m: rounded(0.25 * (width + depth)),
                height_m: height,
            },
            Self::Ceiling => Shape::Ceiling {
                center_m: [x, NEW_CEILING_M.max(top), z],
                size_m: [width, 0.0, depth],
                heading_deg,
            },
        }
    }
}

/// A shape's middle, `[x, y, z]` metres.
pub fn center_m(shape: &Shape) -> [f64; 3] {
    match shape {
        Shape::Box { center_m, .. }
        | Shape::Cylinder { center_m, .. }
        | Shape::Ceiling { center_m, .. } => *center_m,
    }
}

/// How it is turned, degrees; a cylinder is not.
pub fn heading_deg(shape: &Shape) -> Option<f64> {
    match shape {
        Shape::Box { heading_deg, .. } | Shape::Ceiling { heading_deg, .. } => Some(*heading_deg),
        Shape::Cylinder { .. } => None,
    }
}

/// How much room it takes on the floor, along its own x and z, metres.
pub fn floor_m(shape: &Shape) -> [f64; 2] {
    match shape {
        Shape::Box { size_m: [x, _, z], .. } | Shape::Ceiling { size_m: [x, _, z], .. } => [*x, *z],
        Shape::Cylinder { radius_m, .. } => [2.0 * radius_m; 2],
    }
}

/// Its lower and its upper end, metres; the same for a ceiling.
pub fn levels_m(shape: &Shape) -> (f64, f64) {
    let [_, y, _] = center_m(shape);
    let half = match shape {
        Shape::Box { size_m: [_, height, _], .. } => 0.5 * height,
        Shape::Cylinder { height_m, .. } => 0.5 * height_m,
        Shape::Ceiling { .. } => 0.0,
    };
    (y - half, y + half)
}

/// The same with its middle elsewhere.
pub fn at(shape: &Shape, to_m: [f64; 3]) -> Shape {
    let mut new = shape.clone();
    match &mut new {
        Shape::Box { center_m, .. }
        | Shape::Cylinder { center_m, .. }
        | Shape::Ceiling { center_m, .. } => *center_m = to_m,
    }
    new
}

/// The same from a level to another; a ceiling at the upper one.
pub fn with_levels(shape: &Shape, (bottom, top): (f64, f64)) -> Shape {
    let [x, _, z] = center_m(shape);
    let height = rounded((top - bottom).max(0.0));
    let mut new = match shape {
        Shape::Ceiling { .. } => at(shape, [x, rounded(top), z]),
        _ => at(shape, [x, bottom + 0.5 * height, z]),
    };
    match &mut new {
        Shape::Box { size_m, .. } => size_m[1] = height,
        Shape::Cylinder { height_m, .. } => *height_m = height,
        Shape::Ceiling { .. } => {}
    }
    new
}

/// The same with other edges along its own x and z; a cylinder with the first as its diameter.
pub fn with_floor(shape: &Shape, [width, depth]: [f64; 2]) -> Shape {
    let mut new = shape.clone();
    match &mut new {
        Shape::Box { size_m, .. } | Shape::Ceiling { size_m, .. } => {
            (size_m[0], size_m[2]) = (width, depth);
        }
        Shape::Cylinder { radius_m, .. } => *radius_m = 0.5 * width,
    }
    new
}

/// The same turned to the left.
pub fn turned(shape: &Shape, by_deg: f64) -> Shape {
    let mut new = shape.clone();
    if let Shape::Box { heading_deg, .. } | Shape::Ceiling { heading_deg, .. } = &mut new {
        *heading_deg = wrapped_deg(*heading_deg + by_deg);
    }
    new
}

/// Its own x and z in the world, `[x, z]`.
pub fn axes(shape: &Shape) -> [[f64; 2]; 2] {
    // Heading 0 is +Z and grows towards +X.
    let (sin, cos) = heading_deg(shape).unwrap_or_default().to_radians().sin_cos();
    [[cos, -sin], [sin, cos]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_are_drawn_and_become_each_other() {
        let (from, to) = ([1.0, 1.0], [3.0, 2.0]);
        let wall = ObstacleForm::Box.drawn(from, to).expect("large enough");
        assert_eq!((center_m(&wall), floor_m(&wall)), ([2.0, 0.5, 1.5], [2.0, 1.0]));
        assert_eq!(levels_m(&wall), (0.0, 1.0));
        let column = ObstacleForm::Cylinder.drawn(from, [4.0, 5.0]).expect("large enough");
        assert_eq!((center_m(&column)[0], floor_m(&column)), (1.0, [10.0, 10.0]));
        for form in ObstacleForm::ALL {
            assert_eq!(form.drawn(from, from), None);
            let other = form.made_of(&wall);
            assert_eq!(ObstacleForm::of(&other), form);
            assert_eq!((center_m(&other)[0], center_m(&other)[2]), (2.0, 1.5), "{form:?}");
            assert_eq!(form.next().next().next(), form);
        }
    }

    #[test]
    fn edges_and_levels_are_set() {
        let wall = ObstacleForm::Box.drawn([0.0, 0.0], [2.0, 1.0]).expect("large enough");
        assert_eq!(levels_m(&with_levels(&wall, (0.25, 2.0))), (0.25, 2.0));
        assert_eq!(floor_m(&with_floor(&wall, [3.0, 0.5])), [3.0, 0.5]);
        let turned = turned(&wall, 90.0);
        let [x, z] = axes(&turned);
        assert!((x[1] + 1.0).abs() < 1e-9 && (z[0] - 1.0).abs() < 1e-9, "{x:?} {z:?}");
        let roof = ObstacleForm::Ceiling.made_of(&wall);
        assert_eq!(levels_m(&with_levels(&roof, (0.0, 1.7))), (1.7, 1.7));
    }
}
