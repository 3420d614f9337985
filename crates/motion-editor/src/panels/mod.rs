//! What stands around the view, a panel a file.

pub mod takes;

pub mod right_tab;

pub mod by_hand;
pub mod cost;
pub mod inspector;
pub mod why;

pub mod library;
pub mod search_chip;
pub mod status;
pub mod top_bar;

use egui::{RichText, Ui};

use crate::theme;

/// A panel's heading, with a number beside it.
pub fn heading_ui(ui: &mut Ui, text: &str, beside: &str) {
    ui.add_space(2.0 * theme::GRID);
    ui.horizontal(|ui| {
        ui.label(RichText::new(text).font(theme::heading()));
        ui.label(RichText::new(beside).font(theme::caption()).color(theme::of(ui).faint));
    });
    ui.add_space(theme::GRID);
}

/// What would be here, and what fills it.
pub fn empty_ui(ui: &mut Ui, sentence: &str) {
    ui.label(RichText::new(sentence).color(theme::of(ui).faint));
}
