//! The part that is played, a band on the ruler.

use egui::{CursorIcon, Rect, Role, Sense, WidgetInfo};

use super::action::Action;
use super::retime::Part;
use super::sheet::Sheet;
use crate::theme;

/// How high the band is, points.
pub const HEIGHT_PT: f32 = 8.0;
/// How far an end can be missed, points.
const END_PT: f32 = 8.0;

/// The band. Its ends and its middle can be dragged; a double click plays all again.
pub fn loop_band_ui(sheet: &mut Sheet<'_>, strip: Rect) {
    let Some(range) = sheet.state.chosen_range() else { return };
    let palette = sheet.palette;
    let left = sheet.axis.x_of(f64::from(range.from));
    let right = sheet.axis.x_of(f64::from(range.to) + 1.0).max(left + 2.0);
    let band = Rect::from_x_y_ranges(left..=right, strip.top()..=strip.top() + HEIGHT_PT);
    let painter = sheet.ui.painter().with_clip_rect(strip);
    let ground = Rect::from_x_y_ranges(left..=right, strip.y_range());
    painter.rect_filled(ground, 0.0, palette.accent.gamma_multiply(0.10));
    painter.rect_filled(band, 2.0, theme::over(palette.base, palette.accent, 0.55));
    let (from, to) = (range.from, range.to);
    let parts = [
        (Part::Whole, band, format!("Loop range, frames {from} to {to}")),
        (Part::Start, end(left, band, -1.0), format!("Beginning of the loop range, frame {from}")),
        (Part::End, end(right, band, 1.0), format!("End of the loop range, frame {to}")),
    ];
    for (part, place, said) in parts {
        let seen = place.intersect(strip);
        if seen.width() <= 0.0 {
            continue;
        }
        let id = sheet.ui.scope_id().with(("loop", part));
        let response = sheet.ui.interact(seen, id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, &said));
        if part != Part::Whole {
            let x = if part == Part::Start { left } else { right };
            let bar = Rect::from_x_y_ranges(x - 1.5..=x + 1.5, band.y_range());
            let color = if response.hovered() { palette.text } else { palette.accent };
            painter.rect_filled(bar, 1.0, color);
        }
        if response.drag_started_by(egui::PointerButton::Primary) {
            sheet.actions.push(Action::GrabLoop(part));
        }
        if response.double_clicked() {
            sheet.actions.push(Action::Play(None));
        }
        let cursor =
            if part == Part::Whole { CursorIcon::Grab } else { CursorIcon::ResizeHorizontal };
        if response.hovered() {
            response.on_hover_cursor(cursor).on_hover_text(format!(
                "Plays f {from} to f {to}; drag its ends, double-click to play all"
            ));
        }
    }
}

/// Where an end can be taken: rather outside the band, so that a short one still has a middle.
fn end(x: f32, band: Rect, outwards: f32) -> Rect {
    let [inner, outer] = [x - 3.0 * outwards, x + (END_PT - 3.0) * outwards];
    Rect::from_x_y_ranges(inner.min(outer)..=inner.max(outer), band.y_range())
}
