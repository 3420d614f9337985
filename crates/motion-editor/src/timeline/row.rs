//! A row's name, left of its lane.

use egui::{Align2, CursorIcon, Pos2, Rect, Role, Sense, WidgetInfo};

use super::action::Action;
use super::curve_rows::value_text;
use super::rows::Row;
use super::sheet::Sheet;
use crate::icons;
use crate::theme;
use crate::ui_command::UiCommand;

/// The name of a row, of whose place some is `seen`; a curve's value at the playhead beside it.
pub fn name_ui(
    sheet: &mut Sheet<'_>,
    row: &Row,
    (place, seen): (Rect, Rect),
    path_errors_m: &[f32],
) {
    let palette = sheet.palette;
    let painter = sheet.ui.painter().with_clip_rect(seen);
    let y = match row {
        // The ribbon stands below its notches.
        Row::Source => place.center().y + 5.0,
        Row::Style | Row::Path | Row::Locked | Row::ByHand(_) => {
            place.top() + 0.5 * theme::TRACK_HEIGHT
        }
        _ => place.center().y,
    };
    let left = place.left() + 3.0 * theme::GRID;
    let words = sheet.words(row.name(sheet.state));
    let at = Pos2::new(left, y - 0.5 * words.size().y);
    match row {
        Row::Curve(curve) => {
            painter.galley(at, words, palette.faint);
            if let Some(text) = value_text(sheet.state, *curve, path_errors_m) {
                let words = sheet.words(text);
                let right = place.right() - 2.0 * theme::GRID - words.size().x;
                painter.galley(Pos2::new(right, y - 0.5 * words.size().y), words, palette.text);
            }
        }
        Row::Curves => {
            let id = sheet.ui.scope_id().with("curves");
            let response = sheet.ui.interact(seen, id, Sense::click());
            let is_open = sheet.state.settings.curves_open;
            let said = if is_open { "Close the curves" } else { "Open the curves" };
            response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said));
            let color = if response.hovered() { palette.text } else { palette.faint };
            let icon = if is_open { icons::OPEN } else { icons::CLOSED };
            let font = egui::FontId::new(11.0, theme::icons());
            painter.text(Pos2::new(left - 1.0, y), Align2::LEFT_CENTER, icon, font, color);
            painter.galley(at + egui::Vec2::new(14.0, 0.0), words, color);
            if response.clicked() {
                sheet.actions.push(Action::Ask(UiCommand::Curves));
            }
            response.on_hover_cursor(CursorIcon::PointingHand);
        }
        _ => painter.galley(at, words, palette.faint),
    }
}
