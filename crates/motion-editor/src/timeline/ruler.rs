//! Numbers along the top, and the playhead, which follows a press on them.

use std::sync::Arc;

use egui::{Align2, CursorIcon, Galley, Pos2, Rect, Role, Sense, Shape, Stroke, WidgetInfo};

use super::action::Action;
use super::axis::Axis;
use super::sheet::Sheet;
use super::vertical;
use crate::state::EditorState;
use crate::theme;
use crate::widgets::digits::tabular;

/// What tests and screen readers call the ruler.
pub const LABEL: &str = "Timeline ruler";
/// How high it is, points.
pub const HEIGHT_PT: f32 = 30.0;

/// Faint lines through all rows, at the numbers; darker where the motion is not.
pub fn grid_ui(sheet: &Sheet<'_>, room: Rect) {
    let (palette, axis, state) = (sheet.palette, &sheet.axis, sheet.state);
    let painter = sheet.ui.painter().with_clip_rect(room);
    let motion = axis.x_of(0.0)..=axis.x_of(state.n_frames() as f64);
    let inside = Rect::from_x_y_ranges(*motion.start()..=*motion.end(), room.y_range());
    painter.rect_filled(inside, 0.0, theme::over(palette.base, palette.panel, 0.6));
    let line = Stroke::new(1.0, palette.hairline.gamma_multiply(0.6));
    for frame in ticks(axis, state) {
        vertical(sheet.ui, room, axis.x_of(frame as f64).round() + 0.5, line);
    }
}

fn ticks(axis: &Axis, state: &EditorState) -> impl Iterator<Item = usize> + use<> {
    let step = axis.tick_step(state.fps());
    let first = (axis.first.max(0.0) as usize).div_ceil(step) * step;
    let last = (axis.last_in_view().max(0.0) as usize).min(state.last_frame());
    (first..=last).step_by(step)
}

/// The numbers; a press or drag moves the playhead to the nearest frame, or to a mark within reach
/// unless Alt is held.
pub fn ruler_ui(sheet: &mut Sheet<'_>, strip: Rect) {
    let (palette, state) = (sheet.palette, sheet.state);
    let painter = sheet.ui.painter().with_clip_rect(strip);
    painter.hline(strip.x_range(), strip.bottom(), Stroke::new(1.0, palette.hairline));
    let (unit, fps) = (state.settings.time_unit, state.fps());
    let plate = plate(sheet, strip).map(|(plate, _)| plate);
    for frame in ticks(&sheet.axis, state) {
        let x = sheet.axis.x_of(frame as f64).round() + 0.5;
        let line = Stroke::new(1.0, palette.faint);
        painter.vline(x, strip.bottom() - 4.0..=strip.bottom(), line);
        let words = sheet.words(unit.short(frame, fps));
        let at = Pos2::new(x + 4.0, strip.bottom() - 11.0 - 0.5 * words.size().y);
        // Half a number beside the playhead's reads as another one.
        let room = Rect::from_min_size(at, words.size());
        if plate.is_none_or(|plate| !plate.x_range().intersects(room.x_range())) {
            painter.galley(at, words, palette.faint);
        }
    }
    let id = sheet.ui.scope_id().with("ruler");
    let response = sheet.ui.interact(strip, id, Sense::click_and_drag());
    let now = state.frame_number() as f64;
    response.widget_info(|| WidgetInfo {
        value: Some(now),
        ..WidgetInfo::labeled(Role::Slider, true, LABEL)
    });
    let pressed =
        sheet.ui.input(|input| input.pointer.button_pressed(egui::PointerButton::Primary));
    if pressed && response.is_pointer_button_down_on() {
        sheet.actions.push(Action::Scrub);
    }
    response.on_hover_cursor(CursorIcon::ResizeHorizontal);
}

/// The plate with the playhead's frame, and the words on it; none where it is not in sight.
fn plate(sheet: &Sheet<'_>, room: Rect) -> Option<(Rect, Arc<Galley>)> {
    let (state, ui) = (sheet.state, sheet.ui);
    let x = sheet.axis.x_of(state.frame());
    if state.shown_card().is_none() || !room.x_range().contains(x) {
        return None;
    }
    let number = state.settings.time_unit.short(state.frame_number(), state.fps());
    let font = egui::FontId { size: 11.0, ..theme::heading() };
    let job = tabular(ui, &number, &font, sheet.palette.base);
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let half = 0.5 * galley.size().x + 6.0;
    // The plate stays whole at the edges, only its tip goes on.
    let middle = x.clamp(room.left() + half, (room.right() - half).max(room.left() + half));
    let top = room.top() + HEIGHT_PT - 21.0;
    Some((Rect::from_x_y_ranges(middle - half..=middle + half, top..=top + 16.0), galley))
}

/// A line through all rows, with its frame on the ruler.
pub fn playhead_ui(sheet: &Sheet<'_>, room: Rect) {
    let Some((plate, galley)) = plate(sheet, room) else { return };
    let palette = sheet.palette;
    let (x, top) = (sheet.axis.x_of(sheet.state.frame()), plate.top());
    let painter = sheet.ui.painter().with_clip_rect(room);
    let line = Stroke::new(1.5, palette.accent);
    painter.vline(x, plate.bottom()..=room.bottom(), line);
    painter.rect_filled(plate, 4.0, palette.accent);
    let tip =
        [(x - 4.0, 15.0), (x + 4.0, 15.0), (x, 21.0)].map(|(x, below)| Pos2::new(x, top + below));
    painter.add(Shape::convex_polygon(tip.to_vec(), palette.accent, Stroke::NONE));
    let at = plate.center() - 0.5 * galley.size();
    painter.galley(at, galley, palette.base);
}

/// What would be there.
pub fn empty_ui(sheet: &Sheet<'_>, room: Rect, sentence: &str) {
    let (faint, at) = (sheet.palette.faint, room.center());
    sheet.ui.painter().text(at, Align2::CENTER_CENTER, sentence, theme::caption(), faint);
}
