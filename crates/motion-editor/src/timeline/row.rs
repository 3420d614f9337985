//! What all rows of the timeline have.

use egui::{Align2, Pos2, Rect, Ui};

use crate::theme;

/// A row's name, left of its lane.
pub fn name_ui(ui: &Ui, panel: Rect, row: Rect, name: &str) {
    let at = Pos2::new(panel.left() + 3.0 * theme::GRID, row.center().y);
    ui.painter().text(at, Align2::LEFT_CENTER, name, theme::caption(), theme::of(ui).faint);
}

/// What would be there.
pub fn empty_ui(ui: &Ui, room: Rect, sentence: &str) {
    let faint = theme::of(ui).faint;
    ui.painter().text(room.center(), Align2::CENTER_CENTER, sentence, theme::caption(), faint);
}
