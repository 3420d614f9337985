//! Everything that was said, on one page.

use egui::{Align, Align2, Button, Layout, RichText, ScrollArea, Ui, Window};
use motion_scene::color::ColorRole;

use crate::notices::{Notices, Weight};
use crate::theme;

/// Draws the log while `is_open`.
pub fn log_window_ui(ui: &Ui, notices: &Notices, is_open: &mut bool) {
    Window::new(RichText::new("Log").font(theme::title()))
        .id(egui::Id::unique("log"))
        .open(is_open)
        .collapsible(false)
        .default_size([560.0, 320.0])
        .pivot(Align2::CENTER_CENTER)
        .default_pos(ui.ctx().content_rect().center())
        .show(ui.ctx(), |ui| contents_ui(ui, notices));
}

fn contents_ui(ui: &mut Ui, notices: &Notices) {
    let palette = theme::of(ui);
    if notices.log().next().is_none() {
        let text = "What was done, was odd or could not be done will stand here";
        ui.label(RichText::new(text).color(palette.faint));
        return;
    }
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        if ui.add(Button::new("Copy").fill(palette.hovered)).clicked() {
            let lines: Vec<&str> = notices.log().map(|notice| notice.text.as_str()).collect();
            ui.copy_text(lines.join("\n"));
        }
    });
    ScrollArea::vertical().auto_shrink(false).stick_to_bottom(true).show(ui, |ui| {
        for notice in notices.log() {
            let color = match notice.weight {
                Weight::News => palette.text,
                Weight::Remark => palette.faint,
                Weight::Refusal => theme::role(ColorRole::Miss, palette.theme),
            };
            ui.label(RichText::new(&notice.text).color(color));
        }
    });
}
