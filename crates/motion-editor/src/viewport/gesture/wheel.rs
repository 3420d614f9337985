//! The wheel by notches, for what goes in whole steps.

use egui::{Event, MouseWheelUnit, Ui};

/// So many points of a touchpad are a notch.
const PT_PER_NOTCH: f32 = 24.0;

/// Notches since the last frame, up is more: those with Ctrl held, and those without.
pub fn notches(ui: &Ui) -> (f32, f32) {
    ui.input(|input| {
        let mut sums = (0.0, 0.0);
        for event in &input.events {
            let Event::MouseWheel { unit, delta, modifiers, .. } = event else { continue };
            let notches = match unit {
                MouseWheelUnit::Point => delta.y / PT_PER_NOTCH,
                MouseWheelUnit::Line | MouseWheelUnit::Page => delta.y,
            };
            // With Shift systems scroll sideways.
            let sideways = if modifiers.shift && notches == 0.0 { delta.x } else { 0.0 };
            let sum = if modifiers.command || modifiers.ctrl { &mut sums.0 } else { &mut sums.1 };
            *sum += notches + sideways;
        }
        sums
    })
}
