//! A square button with an icon.

use egui::{Response, RichText, Role, Ui, Vec2, WidgetInfo};

use crate::theme;

/// A button of [`theme::ICON_BUTTON`] with an icon of [`theme::ICON`]; lit while `is_on`. `label`
/// is what tests and screen readers call it, `tooltip` what is said when the pointer rests on it.
pub fn icon_button_ui(
    ui: &mut Ui,
    icon: &str,
    label: &str,
    tooltip: &str,
    is_on: bool,
) -> Response {
    let palette = theme::of(ui);
    let color = if is_on { palette.accent } else { palette.faint };
    let text = RichText::new(icon).font(theme::icon()).color(color);
    let size = Vec2::splat(theme::ICON_BUTTON);
    let button = egui::Button::new(text).frame_when_inactive(false).min_size(size);
    let response = ui.scope(|ui| {
        ui.spacing_mut().button_padding = Vec2::ZERO;
        ui.add_sized(size, button)
    });
    let response = response.inner.on_hover_text(tooltip);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, label));
    response
}
