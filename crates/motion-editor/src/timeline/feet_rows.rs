//! When each foot is planted.

use egui::{Rect, Ui};
use motion_scene::color::ColorRole;

use super::axis::Axis;
use crate::state::EditorState;
use crate::theme;

/// A bar for every plant; left above right.
pub fn feet_rows_ui(ui: &Ui, rows: [Rect; 2], axis: &Axis, state: &EditorState) {
    let Some(card) = state.shown_card() else { return };
    let palette = theme::of(ui);
    let planted = theme::role(ColorRole::Planted, palette.theme);
    let now = state.frame_number();
    for (row, plants) in rows.into_iter().zip(&card.lane.plants) {
        let painter = ui.painter().with_clip_rect(row);
        for plant in plants {
            let (from, to) = (axis.x_of(plant.start as f64), axis.x_of(plant.end as f64));
            let bar = Rect::from_x_y_ranges(from..=to, row.top() + 4.0..=row.bottom() - 4.0);
            let share = if plant.contains(&now) { 1.0 } else { 0.55 };
            painter.rect_filled(bar, 2.0, theme::over(palette.base, planted, share));
        }
    }
}
