//! The mouse over the view, and the keys held with it.

use egui::{Key, PointerButton, Pos2, Ui};

/// The mouse and the keys held with it, in this frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mouse {
    pub(super) at: Pos2,
    pub(super) is_over: bool,
    pub(super) is_pressed: bool,
    pub(super) is_right_pressed: bool,
    pub(super) is_down: bool,
    pub(super) has_moved: bool,
    pub(super) is_wheeling: bool,
    pub(super) is_snapping: bool,
    pub(super) has_alt: bool,
    pub(super) has_ctrl: bool,
    pub(super) is_lifting: bool,
    pub(super) is_shuttling: bool,
}

impl Mouse {
    pub(super) fn of(ui: &Ui, at: Pos2, is_over: bool) -> Self {
        ui.input(|input| Self {
            at,
            is_over,
            is_pressed: is_over && input.pointer.button_pressed(PointerButton::Primary),
            is_right_pressed: input.pointer.button_pressed(PointerButton::Secondary),
            is_down: input.pointer.primary_down(),
            is_wheeling: input.events.iter().any(|e| matches!(e, egui::Event::MouseWheel { .. })),
            has_moved: input.pointer.delta() != egui::Vec2::ZERO,
            is_snapping: input.modifiers.shift,
            has_alt: input.modifiers.alt,
            has_ctrl: input.modifiers.ctrl,
            is_shuttling: input.key_down(Key::K),
            is_lifting: input.key_down(Key::Z) || input.key_down(Key::Y),
        })
    }
}
