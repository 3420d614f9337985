//! Small handles on what is selected: points of a path, edges of an obstacle, a joint target's
//! velocity, how far off a checkpoint may be.
//!
//! Where they are is plain data; they are found by their distance from the pointer in the window.

use egui::{Color32, Pos2, Stroke, Ui};
use glam::Vec3;
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;
use motion_session::document::{ConstraintRef, ObstacleIdx};
use motion_session::selection::Selectable;
use motion_session::stage::wishes::velocity_tip_m;

use super::sight::Sight;
use crate::obstacle_form;
use crate::state::EditorState;
use crate::theme;

/// A handle further from the pointer than this is not meant, points.
const REACH_PT: f32 = 10.0;
/// How large handles are, points.
const HALF_PT: f32 = 4.0;
/// A velocity that is left open has its handle so far beside its target, metres.
const OPEN_VELOCITY_M: Vec3 = Vec3::new(0.0, 0.0, 0.22);
/// What turns an obstacle stands so far before it, metres.
const TURN_M: f64 = 0.35;

/// What a handle is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HandleOf {
    /// A point of a path.
    Point(ConstraintRef, usize),
    /// The way from a point of a path to the next: a new point.
    Gap(ConstraintRef, usize),
    /// How fast a joint goes, and where to.
    Velocity(ConstraintRef),
    /// How far off is near enough.
    Tolerance(ConstraintRef),
    /// An edge of an obstacle: along which of its own axes (0 is x, 1 is z), and whether at the
    /// farther end.
    Edge(ObstacleIdx, usize, bool),
    /// The upper end of an obstacle.
    Top(ObstacleIdx),
    /// Where an obstacle looks.
    Turn(ObstacleIdx),
}

/// A handle as it is to be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// What it changes.
    pub of: HandleOf,
    /// Where it is, metres.
    pub at_m: Vec3,
    /// Where that is in the window.
    pub place: Pos2,
    /// Where a thin line to it begins, if it is not on what it belongs to.
    pub from: Option<Pos2>,
}

/// The handles of what was selected last.
pub fn handles(state: &EditorState, sight: &Sight) -> Vec<Handle> {
    let mut found: Vec<(HandleOf, Vec3, Option<Vec3>)> = Vec::new();
    match state.selected() {
        Some(Selectable::Constraint(at)) => of_constraint(at, state, &mut found),
        Some(Selectable::Obstacle(obstacle)) => of_obstacle(*obstacle, state, &mut found),
        _ => {}
    }
    let seen = found.into_iter().filter_map(|(of, at_m, from_m)| {
        let place = sight.place(at_m).filter(|place| sight.rect.contains(*place))?;
        let from = from_m.and_then(|from_m| sight.place(from_m));
        Some(Handle { of, at_m, place, from })
    });
    seen.collect()
}

fn of_constraint(
    at: &ConstraintRef,
    state: &EditorState,
    found: &mut Vec<(HandleOf, Vec3, Option<Vec3>)>,
) {
    let Some(constraint) = state.session.document().constraint(at) else { return };
    let on_floor = |[x, z]: [f64; 2]| Vec3::new(x as f32, 0.0, z as f32);
    match &constraint.kind {
        ConstraintKind::Path { points_m, .. } => {
            for (nth, pair) in points_m.windows(2).enumerate() {
                let middle = 0.5 * (on_floor(pair[0]) + on_floor(pair[1]));
                found.push((HandleOf::Gap(at.clone(), nth), middle, None));
            }
            // Last, so that they win where a way is short.
            for (nth, point) in points_m.iter().enumerate() {
                found.push((HandleOf::Point(at.clone(), nth), on_floor(*point), None));
            }
        }
        ConstraintKind::Joint { position_m, velocity_m_s, .. } => {
            let from_m = Vec3::from_array(position_m.map(|x| x as f32));
            let tip_m = match velocity_m_s {
                Some(v) => velocity_tip_m(from_m, Vec3::from_array(v.map(|x| x as f32))),
                None => from_m + OPEN_VELOCITY_M,
            };
            found.push((HandleOf::Velocity(at.clone()), tip_m, Some(from_m)));
        }
        ConstraintKind::Body { position_m, height_m, .. } => {
            let radius_m = constraint.tolerance.as_ref().and_then(|known| known.position_m);
            let Some(radius_m) = radius_m else { return };
            let middle = on_floor(*position_m) + Vec3::Y * height_m.unwrap_or_default() as f32;
            let edge = middle + Vec3::X * radius_m as f32;
            found.push((HandleOf::Tolerance(at.clone()), edge, None));
        }
        ConstraintKind::Pose { .. }
        | ConstraintKind::Style { .. }
        | ConstraintKind::Lock { .. } => {}
    }
}

fn of_obstacle(
    obstacle: ObstacleIdx,
    state: &EditorState,
    found: &mut Vec<(HandleOf, Vec3, Option<Vec3>)>,
) {
    let Some(known) = state.session.document().obstacle(obstacle) else { return };
    let shape = &known.shape;
    let [x, _, z] = obstacle_form::center_m(shape);
    let (bottom, top) = obstacle_form::levels_m(shape);
    let (axes, size) = (obstacle_form::axes(shape), obstacle_form::floor_m(shape));
    let beside = |axis: usize, by: f64, level: f64| {
        let [ax, az] = axes[axis];
        Vec3::new((x + by * ax) as f32, level as f32, (z + by * az) as f32)
    };
    let is_round = obstacle_form::heading_deg(shape).is_none();
    for (axis, length) in size.into_iter().enumerate() {
        for is_far in [false, true] {
            let by = if is_far { 0.5 * length } else { -0.5 * length };
            found.push((HandleOf::Edge(obstacle, axis, is_far), beside(axis, by, bottom), None));
        }
    }
    found.push((HandleOf::Top(obstacle), beside(0, 0.0, top), None));
    if !is_round {
        let edge = beside(1, 0.5 * size[1], bottom);
        let before = beside(1, 0.5 * size[1] + TURN_M, bottom);
        found.push((HandleOf::Turn(obstacle), before, Some(edge)));
    }
}

/// The handle that the pointer means; points before what lies between them.
pub fn nearest(handles: &[Handle], pointer: Pos2) -> Option<&Handle> {
    let off = |handle: &Handle| {
        let behind = if matches!(handle.of, HandleOf::Gap(..)) { 3.0 } else { 0.0 };
        handle.place.distance(pointer) + behind
    };
    let near = handles.iter().filter(|handle| off(handle) <= REACH_PT);
    near.min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// What can be done with a handle, in words.
pub fn words(of: &HandleOf) -> &'static str {
    match of {
        HandleOf::Point(..) => "Drag: move this point   Ctrl+click: without it",
        HandleOf::Gap(..) => "Drag: a new point",
        HandleOf::Velocity(_) => "Drag: where it goes, and how fast   Z: up and down",
        HandleOf::Tolerance(_) => "Drag: how far off is near enough",
        HandleOf::Edge(..) => "Drag: larger or smaller",
        HandleOf::Top(_) => "Drag: higher or lower",
        HandleOf::Turn(_) => "Drag: turn",
    }
}

/// Draws handles; the one that is meant is lit.
pub fn handles_ui(ui: &Ui, handles: &[Handle], lit: Option<&HandleOf>) {
    let palette = theme::of(ui);
    let painter = ui.painter();
    for handle in handles {
        let role = match handle.of {
            HandleOf::Velocity(_) => ColorRole::JointTarget,
            HandleOf::Edge(..) | HandleOf::Top(_) | HandleOf::Turn(_) => ColorRole::Obstacle,
            HandleOf::Point(..) | HandleOf::Gap(..) | HandleOf::Tolerance(_) => {
                ColorRole::Checkpoint
            }
        };
        let color = theme::role(role, palette.theme);
        let is_lit = lit == Some(&handle.of);
        if let Some(from) = handle.from {
            painter.line_segment([from, handle.place], Stroke::new(1.0, color));
        }
        let half = if is_lit { HALF_PT + 1.5 } else { HALF_PT };
        let rim = Stroke::new(1.5, if is_lit { palette.accent } else { palette.base });
        match handle.of {
            // What is not there yet is only hinted at.
            HandleOf::Gap(..) if !is_lit => {
                painter.circle_filled(handle.place, 2.5, color.gamma_multiply(0.8));
            }
            HandleOf::Turn(_) | HandleOf::Velocity(_) | HandleOf::Gap(..) => {
                painter.circle(handle.place, half, Color32::WHITE, rim);
            }
            _ => {
                let square =
                    egui::Rect::from_center_size(handle.place, egui::Vec2::splat(2.0 * half));
                painter.rect(square, 1.5, Color32::WHITE, rim, egui::StrokeKind::Middle);
            }
        }
    }
}
