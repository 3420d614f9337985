//! What a cost is made of, as a bar.

use egui::{Rect, Ui};
use motion_scene::color::ColorRole;

use crate::theme;

/// What a cost is made of, as wide as it is high beside the worst.
pub fn cost_bar_ui(ui: &Ui, bar: Rect, terms: [f64; 4], worst: f64) {
    let palette = theme::of(ui);
    ui.painter().rect_filled(bar, 2.0, palette.base);
    let mut left = bar.left();
    for (term, color) in terms.into_iter().zip(term_colors(&palette)) {
        let width = bar.width() * (term / worst).clamp(0.0, 1.0) as f32;
        if width < 0.5 {
            continue;
        }
        let right = (left + width).min(bar.right());
        let part = Rect::from_x_y_ranges(left..=right, bar.y_range());
        ui.painter().rect_filled(part, 2.0, color);
        left = right;
    }
}

/// The colours of [`TERMS`](crate::take_card::TERMS): those of the things they speak of.
pub fn term_colors(palette: &theme::Palette) -> [egui::Color32; 4] {
    let role = |role| theme::role(role, palette.theme);
    [palette.faint, palette.text, role(ColorRole::Checkpoint), role(ColorRole::Obstacle)]
}
