//! Several constraints and obstacles moved or turned together, from where they were when it began.

use motion_session::command::Command;
use motion_session::document::{ConstraintRef, Document, ObstacleIdx};
use motion_session::selection::Selectable;
use motion_session::{ConstraintKind, Shape};

use crate::obstacle_form;

/// Constraints and obstacles with their places as they were.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moving {
    items: Vec<Item>,
}

#[derive(Clone, Debug, PartialEq)]
struct Item {
    of: Of,
    place: Place,
}

/// What it is in the document.
#[derive(Clone, Debug, PartialEq)]
enum Of {
    Constraint(ConstraintRef),
    Obstacle(ObstacleIdx),
}

/// What of it can be moved.
#[derive(Clone, Debug, PartialEq)]
enum Place {
    /// On the floor, with where it looks; either may be left open.
    Floor(Option<[f64; 2]>, Option<f64>),
    /// In the air.
    Air([f64; 3]),
    /// A way over the floor.
    Way(Vec<[f64; 2]>),
    /// Something in the way.
    Solid(Shape),
}

impl Moving {
    /// What can be moved of these constraints.
    pub fn of<'a>(
        document: &Document,
        constraints: impl IntoIterator<Item = &'a ConstraintRef>,
    ) -> Self {
        let item = |at: &ConstraintRef| {
            let place = place_of(&document.constraint(at)?.kind)?;
            Some(Item { of: Of::Constraint(at.clone()), place })
        };
        Self { items: constraints.into_iter().filter_map(item).collect() }
    }

    /// What can be moved of these things.
    pub fn of_items<'a>(
        document: &Document,
        items: impl IntoIterator<Item = &'a Selectable>,
    ) -> Self {
        let mut all = Self::default();
        for item in items {
            match item {
                Selectable::Constraint(at) => all.items.extend(Self::of(document, [at]).items),
                Selectable::Obstacle(obstacle) => {
                    let shape = document.obstacle(*obstacle).map(|known| known.shape.clone());
                    all.items.extend(shape.map(|shape| Self::solid(*obstacle, shape)));
                }
                Selectable::Character(_) | Selectable::Interaction(_) | Selectable::Take(..) => {}
            }
        }
        all
    }

    /// An obstacle that is, or will be, at a place of the list.
    pub fn of_obstacle(obstacle: ObstacleIdx, shape: Shape) -> Self {
        Self { items: vec![Self::solid(obstacle, shape)] }
    }

    fn solid(obstacle: ObstacleIdx, shape: Shape) -> Item {
        Item { of: Of::Obstacle(obstacle), place: Place::Solid(shape) }
    }

    /// Whether both are about the same things.
    pub fn is_like(&self, other: &Self) -> bool {
        self.items.iter().map(|item| &item.of).eq(other.items.iter().map(|item| &item.of))
    }

    /// The same places under another name; for one constraint.
    #[must_use]
    pub fn renamed(mut self, to: &ConstraintRef) -> Self {
        self.items.iter_mut().for_each(|item| item.of = Of::Constraint(to.clone()));
        self
    }

    /// How many things it is about.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there is nothing to move.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Whether something of it is in the air.
    pub fn has_height(&self) -> bool {
        self.items.iter().any(|item| matches!(item.place, Place::Air(_)))
    }

    /// The middle of everything that has a place, `[x, y, z]`.
    pub fn middle_m(&self) -> Option<[f64; 3]> {
        let points: Vec<[f64; 3]> =
            self.items.iter().flat_map(|item| item.place.points()).collect();
        let n = points.len() as f64;
        (n > 0.0).then(|| [0, 1, 2].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / n))
    }

    /// Commands that bring everything `by_m` (`[x, y, z]`) away from where it was. Only what is in
    /// the air rises.
    pub fn moved(&self, by_m: [f64; 3]) -> Vec<Command> {
        let on_floor = |p: [f64; 2]| [rounded(p[0] + by_m[0]), rounded(p[1] + by_m[2])];
        let command = |item: &Item| match (&item.of, &item.place) {
            (Of::Obstacle(obstacle), Place::Solid(shape)) => {
                let [x, y, z] = obstacle_form::center_m(shape);
                let [x, z] = on_floor([x, z]);
                let shape = obstacle_form::at(shape, [x, y, z]);
                Some(Command::ChangeObstacle { obstacle: *obstacle, shape })
            }
            (Of::Constraint(at), place) => {
                let at = at.clone();
                Some(match place {
                    Place::Floor(position_m, _) => {
                        Command::Move { at, position_m: on_floor((*position_m)?) }
                    }
                    Place::Air(p) => {
                        let position_m = [0, 1, 2].map(|axis| rounded(p[axis] + by_m[axis]));
                        Command::MoveJointTarget { at, position_m }
                    }
                    Place::Way(points) => {
                        let points_m = points.iter().map(|p| on_floor(*p)).collect();
                        Command::Reshape { at, points_m }
                    }
                    Place::Solid(_) => return None,
                })
            }
            (Of::Obstacle(_), _) => None,
        };
        self.items.iter().filter_map(command).collect()
    }

    /// Commands that turn everything to the left by `by_deg`; several things go around their
    /// middle as well. An open heading stays open.
    pub fn turned(&self, by_deg: f64) -> Vec<Command> {
        // A way alone goes around its own middle.
        let is_wide = self.items.len() > 1 || self.items.iter().any(Item::is_way);
        let middle = self.middle_m().filter(|_| is_wide);
        // Heading 0 is +Z and grows towards +X.
        let (sin, cos) = by_deg.to_radians().sin_cos();
        let around = |[x, z]: [f64; 2]| {
            let Some([mx, _, mz]) = middle else { return [x, z] };
            let [x, z] = [x - mx, z - mz];
            [rounded(mx + cos * x + sin * z), rounded(mz - sin * x + cos * z)]
        };
        let mut commands = Vec::new();
        for item in &self.items {
            let at = match (&item.of, &item.place) {
                (Of::Constraint(at), _) => at,
                (Of::Obstacle(obstacle), Place::Solid(shape)) => {
                    let [x, y, z] = obstacle_form::center_m(shape);
                    let [x, z] = around([x, z]);
                    let shape = obstacle_form::at(shape, [x, y, z]);
                    let shape = obstacle_form::turned(&shape, by_deg);
                    commands.push(Command::ChangeObstacle { obstacle: *obstacle, shape });
                    continue;
                }
                (Of::Obstacle(_), _) => continue,
            };
            let at = || at.clone();
            match &item.place {
                Place::Floor(position_m, heading_deg) => {
                    if let (Some(from), Some(_)) = (position_m, middle) {
                        commands.push(Command::Move { at: at(), position_m: around(*from) });
                    }
                    if let Some(deg) = heading_deg {
                        let heading_deg = Some(wrapped_deg(deg + by_deg));
                        commands.push(Command::Turn { at: at(), heading_deg });
                    }
                }
                Place::Air([x, y, z]) if middle.is_some() => {
                    let [x, z] = around([*x, *z]);
                    commands.push(Command::MoveJointTarget { at: at(), position_m: [x, *y, z] });
                }
                Place::Way(points) => {
                    let points_m = points.iter().map(|p| around(*p)).collect();
                    commands.push(Command::Reshape { at: at(), points_m });
                }
                Place::Air(_) | Place::Solid(_) => {}
            }
        }
        commands
    }
}

impl Item {
    fn is_way(&self) -> bool {
        matches!(self.place, Place::Way(_))
    }
}

/// What of a constraint can be moved.
fn place_of(kind: &ConstraintKind) -> Option<Place> {
    Some(match kind {
        ConstraintKind::Body { position_m, heading_deg, .. } => {
            Place::Floor(Some(*position_m), *heading_deg)
        }
        ConstraintKind::Pose { position_m, heading_deg, .. } => {
            Place::Floor(*position_m, *heading_deg)
        }
        ConstraintKind::Joint { position_m, .. } => Place::Air(*position_m),
        ConstraintKind::Path { points_m, .. } => Place::Way(points_m.clone()),
        ConstraintKind::Style { .. } | ConstraintKind::Lock { .. } => return None,
    })
}

impl Place {
    fn points(&self) -> Vec<[f64; 3]> {
        let flat = |p: &[f64; 2]| [p[0], 0.0, p[1]];
        match self {
            Self::Floor(position_m, _) => position_m.iter().map(flat).collect(),
            Self::Air(p) => vec![*p],
            Self::Way(points) => points.iter().map(flat).collect(),
            Self::Solid(shape) => {
                let [x, _, z] = obstacle_form::center_m(shape);
                vec![[x, 0.0, z]]
            }
        }
    }
}

/// Millimetres are enough, and files stay readable.
pub fn rounded(metres: f64) -> f64 {
    let found = (metres * 1000.0).round() / 1000.0;
    // No minus in front of nothing.
    found + 0.0
}

/// The same heading over −180° and up to 180°, to a tenth.
pub fn wrapped_deg(deg: f64) -> f64 {
    let tenths = (deg * 10.0).round() / 10.0;
    let within = tenths.rem_euclid(360.0);
    ((if within > 180.0 { within - 360.0 } else { within }) * 10.0).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use motion_session::document::CharacterIdx;
    use motion_session::sample;

    use super::*;

    fn sample() -> Document {
        Document::from_project(sample::sample().unwrap())
    }

    fn at(id: &str) -> ConstraintRef {
        ConstraintRef::new(CharacterIdx(0), id)
    }

    #[test]
    fn headings_stay_within_half_a_turn() {
        for (deg, expected) in
            [(0.0, 0.0), (181.0, -179.0), (-180.0, 180.0), (540.0, 180.0), (-0.04, 0.0)]
        {
            assert_eq!(wrapped_deg(deg), expected, "{deg}");
        }
    }

    #[test]
    fn one_turns_on_the_spot_and_two_around_their_middle() {
        let document = sample();
        let one = Moving::of(&document, [&at("corner")]);
        let commands = one.turned(15.0);
        assert!(matches!(commands.as_slice(), [Command::Turn { .. }]), "{commands:?}");
        let two = Moving::of(&document, [&at("start"), &at("end")]);
        let middle = two.middle_m().unwrap();
        let Command::Move { position_m, .. } = two.turned(180.0).remove(0) else { panic!() };
        let ConstraintKind::Body { position_m: end, .. } =
            document.constraint(&at("end")).unwrap().kind
        else {
            panic!()
        };
        assert!((position_m[0] - end[0]).hypot(position_m[1] - end[1]) < 2e-3, "{middle:?}");
    }

    #[test]
    fn what_stands_on_the_floor_does_not_rise() {
        let moving = Moving::of(&sample(), [&at("start")]);
        let commands = moving.moved([0.25, 3.0, -0.1]);
        let expected = Command::Move { at: at("start"), position_m: [0.25, -0.1] };
        assert_eq!(commands, [expected]);
    }
}
