//! A take's card that is brought to the timeline keeps a stretch of that take.

use egui::{Rect, Response, Stroke, StrokeKind, Ui};

use super::axis::Axis;
use crate::panels::takes::CardDrag;
use crate::state::EditorState;
use crate::stretch::stretch_at;
use crate::theme;

/// Shows what would be locked while a card is over the lanes, and locks it where it is dropped: what
/// lies between the cuts of that take around the frame.
pub fn take_drop_ui(ui: &Ui, ground: &Response, lanes: Rect, axis: &Axis, state: &mut EditorState) {
    let Some(CardDrag(id)) = egui::DragAndDrop::payload::<CardDrag>(ui.ctx()).as_deref().copied()
    else {
        return;
    };
    let at = ui.input(|input| input.pointer.interact_pos()).filter(|at| lanes.contains(*at));
    let Some(at) = at else { return };
    let frame = axis.frame_at(at.x).max(0.0) as usize;
    if let Some((from, to)) = state.card(id).and_then(|card| stretch_at(&card.lane, frame)) {
        let (left, right) = (axis.x_of(from as f64), axis.x_of((to + 1) as f64));
        let place = Rect::from_x_y_ranges(left..=right, lanes.y_range()).intersect(lanes);
        let accent = theme::of(ui).accent;
        let painter = ui.painter();
        painter.rect_filled(place, 3.0, accent.gamma_multiply(0.18));
        painter.rect_stroke(place, 3.0, Stroke::new(1.0, accent), StrokeKind::Inside);
    }
    let is_dropped = ui.input(|input| input.pointer.any_released());
    if is_dropped && ground.rect.contains(at) {
        egui::DragAndDrop::clear_payload(ui.ctx());
        state.lock_at(id, frame);
    }
}
