//! A line of a list of files.

use egui::{Align2, Pos2, Response, Role, Sense, Ui, Vec2, WidgetInfo};

use crate::icons;
use crate::theme;

/// A folder or a file by its name. `is_chosen` lights it; `reveal` brings it into sight.
pub(super) fn file_row_ui(
    ui: &mut Ui,
    name: &str,
    is_folder: bool,
    is_chosen: bool,
    reveal: bool,
) -> Response {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT);
    // Not to be reached by Tab, which would go through thousands: the arrow keys are the dialog's.
    let (rect, response) = ui.allocate_exact_size(size, Sense::CLICK);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_chosen, name));
    if reveal {
        response.scroll_to_me(None);
    }
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let painter = ui.painter();
    if is_chosen || response.hovered() {
        let ground = if is_chosen { palette.accent_surface } else { palette.hovered };
        painter.rect_filled(rect, f32::from(theme::RADIUS), ground);
    }
    let at = |x: f32| Pos2::new(rect.left() + x, rect.center().y);
    let icon = if is_folder { icons::FOLDER } else { icons::FILE };
    painter.text(at(8.0), Align2::LEFT_CENTER, icon, theme::icon(), palette.faint);
    painter.text(at(32.0), Align2::LEFT_CENTER, name, theme::body(), palette.text);
    response
}
