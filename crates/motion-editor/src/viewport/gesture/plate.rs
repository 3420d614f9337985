//! Words on a plate over the picture.

use egui::{Align2, Pos2, Ui};

use crate::theme;

/// Words on a plate over the picture.
pub fn plate_ui(ui: &Ui, at: Pos2, align: Align2, words: &str) {
    let palette = theme::of(ui);
    let galley =
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(words.to_owned(), theme::body(), palette.text));
    let rect = align.anchor_size(at, galley.size());
    let plate = rect.expand2(egui::Vec2::new(8.0, 4.0));
    ui.painter().rect_filled(plate, f32::from(theme::RADIUS), palette.panel.gamma_multiply(0.9));
    ui.painter().galley(rect.min, galley, palette.text);
}
