//! A handle on its way: what it changes with the pointer.

use egui::Pos2;
use glam::Vec3;
use motion_session::command::Command;
use motion_session::document::ObstacleIdx;
use motion_session::stage::wishes::VELOCITY_SECS;
use motion_session::{ConstraintKind, Shape, Tolerance};

use super::handle::{Handle, HandleOf};
use super::sight::Sight;
use super::snap::{GRID_M, HEIGHT_GRID_M, heading_deg, snapped};
use crate::obstacle_form;
use crate::state::EditorState;
use crate::state::moving::rounded;

/// An edge is not shorter than this, metres.
const LEAST_M: f64 = 0.05;

/// A handle that is held, and what it belongs to as it was.
#[derive(Clone, Debug)]
pub struct HandlePull {
    handle: Handle,
    grabbed: Pos2,
    before: Before,
}

#[derive(Clone, Debug)]
enum Before {
    Way(Vec<[f64; 2]>),
    Joint([f64; 3]),
    Near([f64; 2], Tolerance),
    Solid(Shape),
}

impl HandlePull {
    /// Takes hold of a handle.
    pub fn begin(handle: &Handle, grabbed: Pos2, state: &mut EditorState) -> Option<Self> {
        let document = state.session.document();
        let (before, label) = match &handle.of {
            HandleOf::Point(at, _) | HandleOf::Gap(at, _) => {
                let ConstraintKind::Path { points_m, .. } = &document.constraint(at)?.kind else {
                    return None;
                };
                (Before::Way(points_m.clone()), "Reshape path")
            }
            HandleOf::Velocity(at) => {
                let ConstraintKind::Joint { position_m, .. } = document.constraint(at)?.kind else {
                    return None;
                };
                (Before::Joint(position_m), "Change velocity")
            }
            HandleOf::Tolerance(at) => {
                let constraint = document.constraint(at)?;
                let ConstraintKind::Body { position_m, .. } = constraint.kind else { return None };
                let tolerance = constraint.tolerance.clone().unwrap_or_default();
                (Before::Near(position_m, tolerance), "Change tolerance")
            }
            HandleOf::Edge(obstacle, ..) | HandleOf::Top(obstacle) | HandleOf::Turn(obstacle) => {
                let shape = document.obstacle(*obstacle)?.shape.clone();
                (Before::Solid(shape), "Change obstacle")
            }
        };
        state.begin_gesture(label);
        Some(Self { handle: handle.clone(), grabbed, before })
    }

    /// The path without the point that a handle is of, if enough are left.
    pub fn without(of: &HandleOf, state: &EditorState) -> Option<Command> {
        let HandleOf::Point(at, nth) = of else { return None };
        let ConstraintKind::Path { points_m, .. } = &state.session.document().constraint(at)?.kind
        else {
            return None;
        };
        let mut points_m = points_m.clone();
        if points_m.len() <= 2 || *nth >= points_m.len() {
            return None;
        }
        points_m.remove(*nth);
        Some(Command::Reshape { at: at.clone(), points_m })
    }

    /// What it does with the pointer at a place.
    pub fn commands(
        &self,
        sight: &Sight,
        pointer: Pos2,
        is_lifting: bool,
        is_snapping: bool,
    ) -> Vec<Command> {
        self.command(sight, pointer, is_lifting, is_snapping).into_iter().collect()
    }

    fn command(
        &self,
        sight: &Sight,
        pointer: Pos2,
        is_lifting: bool,
        is_snapping: bool,
    ) -> Option<Command> {
        // Handles are grabbed beside their middle, and stay under the pointer as they were.
        let pointer = pointer + (self.handle.place - self.grabbed);
        let on_floor = || {
            let [x, z] = sight.level(pointer, self.handle.at_m.y)?;
            Some([x, z].map(|axis| rounded(snapped(axis, GRID_M, is_snapping))))
        };
        match (&self.handle.of, &self.before) {
            (HandleOf::Point(at, nth), Before::Way(points_m)) => {
                let mut points_m = points_m.clone();
                *points_m.get_mut(*nth)? = on_floor()?;
                Some(Command::Reshape { at: at.clone(), points_m })
            }
            (HandleOf::Gap(at, nth), Before::Way(points_m)) => {
                let mut points_m = points_m.clone();
                points_m.insert((nth + 1).min(points_m.len()), on_floor()?);
                Some(Command::Reshape { at: at.clone(), points_m })
            }
            (HandleOf::Velocity(at), Before::Joint(position_m)) => {
                let way = (self.handle.place, pointer);
                let tip_m = sight.dragged(self.handle.at_m, way, is_lifting);
                let from_m = Vec3::from_array(position_m.map(|x| x as f32));
                let v = ((tip_m - from_m) / VELOCITY_SECS).to_array().map(f64::from);
                let velocity_m_s =
                    v.map(|v| (snapped(v, GRID_M, is_snapping) * 100.0).round() / 100.0);
                Some(Command::SetVelocity { at: at.clone(), velocity_m_s: Some(velocity_m_s) })
            }
            (HandleOf::Tolerance(at), Before::Near(middle, tolerance)) => {
                let [x, z] = sight.level(pointer, self.handle.at_m.y)?;
                let metres = (x - middle[0]).hypot(z - middle[1]);
                let metres = snapped(metres, HEIGHT_GRID_M, is_snapping).max(0.01);
                let position_m = Some((metres * 100.0).round() / 100.0);
                let tolerance = Some(Tolerance { position_m, ..tolerance.clone() });
                Some(Command::SetTolerance { at: at.clone(), tolerance })
            }
            (HandleOf::Edge(obstacle, axis, is_far), Before::Solid(shape)) => {
                let to_m = sight.level(pointer, self.handle.at_m.y)?;
                let shape = stretched(shape, (*axis, *is_far), to_m, is_snapping);
                Some(changed(*obstacle, shape))
            }
            (HandleOf::Top(obstacle), Before::Solid(shape)) => {
                let way = (self.handle.place, pointer);
                let top_m = f64::from(sight.dragged(self.handle.at_m, way, true).y);
                let top_m = snapped(top_m, HEIGHT_GRID_M, is_snapping);
                let (bottom, _) = obstacle_form::levels_m(shape);
                let is_level = matches!(shape, Shape::Ceiling { .. });
                let least = if is_level { 0.0 } else { bottom + LEAST_M };
                let levels = (bottom, (top_m.max(least) * 100.0).round() / 100.0);
                Some(changed(*obstacle, obstacle_form::with_levels(shape, levels)))
            }
            (HandleOf::Turn(obstacle), Before::Solid(shape)) => {
                let to_m = sight.level(pointer, self.handle.at_m.y)?;
                let [x, _, z] = obstacle_form::center_m(shape);
                let to_deg = heading_deg([x, z], to_m, is_snapping)?;
                let by_deg = to_deg - obstacle_form::heading_deg(shape)?;
                Some(changed(*obstacle, obstacle_form::turned(shape, by_deg)))
            }
            _ => None,
        }
    }

    /// What it is of.
    pub fn of(&self) -> &HandleOf {
        &self.handle.of
    }

    /// What it is now, in words.
    pub fn words(&self, state: &EditorState) -> Option<String> {
        let document = state.session.document();
        Some(match &self.handle.of {
            HandleOf::Velocity(at) => {
                let ConstraintKind::Joint { velocity_m_s, .. } = document.constraint(at)?.kind
                else {
                    return None;
                };
                let [x, y, z] = velocity_m_s?;
                let speed = x.hypot(y).hypot(z);
                format!("{speed:.1} m/s · x {x:.1} · y {y:.1} · z {z:.1}")
            }
            HandleOf::Tolerance(at) => {
                let metres = document.constraint(at)?.tolerance.as_ref()?.position_m?;
                format!("Within {:.0} cm", 100.0 * metres)
            }
            HandleOf::Edge(obstacle, ..) => {
                let [width, depth] = obstacle_form::floor_m(&document.obstacle(*obstacle)?.shape);
                format!("{width:.2} × {depth:.2} m")
            }
            HandleOf::Top(obstacle) => {
                let (_, top) = obstacle_form::levels_m(&document.obstacle(*obstacle)?.shape);
                format!("Up to {top:.2} m")
            }
            HandleOf::Turn(obstacle) => {
                let shape = &document.obstacle(*obstacle)?.shape;
                format!("{:.0}°", obstacle_form::heading_deg(shape)?)
            }
            HandleOf::Point(..) | HandleOf::Gap(..) => return None,
        })
    }
}

fn changed(obstacle: ObstacleIdx, shape: Shape) -> Command {
    Command::ChangeObstacle { obstacle, shape }
}

/// A shape with an edge at a place; the other edge stays, and a cylinder keeps its middle.
fn stretched(
    shape: &Shape,
    (axis, is_far): (usize, bool),
    to_m: [f64; 2],
    is_snapping: bool,
) -> Shape {
    let [x, y, z] = obstacle_form::center_m(shape);
    let [ax, az] = obstacle_form::axes(shape)[axis];
    let mut size = obstacle_form::floor_m(shape);
    let sign = if is_far { 1.0 } else { -1.0 };
    let along = sign * ((to_m[0] - x) * ax + (to_m[1] - z) * az);
    if matches!(shape, Shape::Cylinder { .. }) {
        let radius = rounded(snapped(along, HEIGHT_GRID_M, is_snapping).max(LEAST_M));
        return obstacle_form::with_floor(shape, [2.0 * radius; 2]);
    }
    let half = 0.5 * size[axis];
    let new = rounded(snapped(along + half, HEIGHT_GRID_M, is_snapping).max(LEAST_M));
    let by = sign * (0.5 * new - half);
    size[axis] = new;
    let middle = [rounded(x + by * ax), y, rounded(z + by * az)];
    obstacle_form::with_floor(&obstacle_form::at(shape, middle), size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obstacle_form::ObstacleForm;

    #[test]
    fn the_other_edge_stays() {
        let wall = ObstacleForm::Box.drawn([0.0, 0.0], [2.0, 1.0]).expect("large enough");
        let longer = stretched(&wall, (0, true), [3.0, 0.2], false);
        assert_eq!(obstacle_form::floor_m(&longer), [3.0, 1.0]);
        assert_eq!(obstacle_form::center_m(&longer), [1.5, 0.5, 0.5]);
        let turned = obstacle_form::turned(&wall, 90.0);
        // Its own far z looks along +X now.
        let longer = stretched(&turned, (1, true), [2.5, 0.5], false);
        assert_eq!(obstacle_form::floor_m(&longer), [2.0, 2.0]);
        assert_eq!(obstacle_form::center_m(&longer), [1.5, 0.5, 0.5]);
        let none = stretched(&wall, (1, false), [0.0, 9.0], false);
        assert_eq!(obstacle_form::floor_m(&none)[1], LEAST_M);
    }

    #[test]
    fn a_cylinder_keeps_its_middle() {
        let column = ObstacleForm::Cylinder.drawn([1.0, 1.0], [1.5, 1.0]).expect("large enough");
        let wide = stretched(&column, (0, false), [0.0, 1.0], false);
        assert_eq!(obstacle_form::floor_m(&wide), [2.0, 2.0]);
        assert_eq!(obstacle_form::center_m(&wide), obstacle_form::center_m(&column));
    }
}
