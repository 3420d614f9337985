//! A box drawn around what is to be selected.

use egui::{Pos2, Rect, Stroke, StrokeKind, Ui};
use glam::Vec3;
use motion_session::ConstraintKind;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::selection::Selectable;

use super::sight::Sight;
use crate::state::EditorState;
use crate::theme;

/// The box that is being drawn.
pub fn box_ui(ui: &Ui, from: Pos2, to: Pos2) {
    let accent = theme::of(ui).accent;
    let rect = Rect::from_two_pos(from, to);
    ui.painter().rect_filled(rect, 0.0, accent.gamma_multiply(0.12));
    ui.painter().rect_stroke(rect, 0.0, Stroke::new(1.0, accent), StrokeKind::Inside);
}

/// Selects every mark in the box; with `is_adding` beside what is selected.
pub fn select_in(rect: Rect, sight: &Sight, is_adding: bool, state: &mut EditorState) {
    let document = state.session.document();
    let mut found = Vec::new();
    for (nth, character) in document.characters().iter().enumerate() {
        for constraint in &character.constraints {
            let place = place_m(&constraint.kind).and_then(|at_m| sight.place(at_m));
            if place.is_some_and(|place| rect.contains(place)) {
                let at = ConstraintRef::new(CharacterIdx(nth), constraint.id.clone());
                found.push(Selectable::Constraint(at));
            }
        }
    }
    let selection = state.session.selection_mut();
    if is_adding {
        found.into_iter().for_each(|item| selection.add(item));
    } else {
        selection.select_all(found);
    }
}

/// Where a constraint's mark is in the world.
pub fn place_m(kind: &ConstraintKind) -> Option<Vec3> {
    let on_floor = |[x, z]: [f64; 2], y: f64| Vec3::new(x as f32, y as f32, z as f32);
    match kind {
        ConstraintKind::Body { position_m, height_m, .. } => {
            Some(on_floor(*position_m, height_m.unwrap_or_default()))
        }
        ConstraintKind::Pose { position_m, height_m, .. } => {
            // The middle of a body.
            Some(on_floor((*position_m)?, height_m.unwrap_or_default() + 0.9))
        }
        ConstraintKind::Joint { position_m, .. } => {
            Some(Vec3::from_array(position_m.map(|x| x as f32)))
        }
        ConstraintKind::Path { points_m, .. } => Some(on_floor(*points_m.first()?, 0.0)),
        _ => None,
    }
}
