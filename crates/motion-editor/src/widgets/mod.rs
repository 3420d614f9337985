//! Reusable pieces of panels.

pub mod digits;
pub mod icon_button;

use egui::{Frame, Ui};

/// What a question stands on.
pub fn dialog_frame(ui: &Ui) -> Frame {
    Frame::popup(ui.style()).inner_margin(16.0).corner_radius(8.0)
}
