//! Numbers along the top, and the playhead, which follows a press on them.

use egui::{Align2, CursorIcon, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo};

use super::axis::Axis;
use super::vertical;
use crate::state::EditorState;
use crate::theme;
use crate::widgets::digits::tabular;

/// What tests and screen readers call the ruler.
pub const LABEL: &str = "Timeline ruler";

/// Faint lines through all rows, at the numbers; darker where the motion is not.
pub fn grid_ui(ui: &Ui, room: Rect, axis: &Axis, state: &EditorState) {
    let palette = theme::of(ui);
    let painter = ui.painter().with_clip_rect(room);
    let motion = axis.x_of(0.0)..=axis.x_of(state.n_frames() as f64);
    let inside = Rect::from_x_y_ranges(*motion.start()..=*motion.end(), room.y_range());
    painter.rect_filled(inside, 0.0, theme::over(palette.base, palette.panel, 0.6));
    for frame in ticks(axis, state) {
        let line = Stroke::new(1.0, palette.hairline.gamma_multiply(0.6));
        vertical(ui, room, axis.x_of(frame as f64).round() + 0.5, line);
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
pub fn ruler_ui(ui: &Ui, strip: Rect, axis: &Axis, state: &mut EditorState) {
    let palette = theme::of(ui);
    let painter = ui.painter().with_clip_rect(strip);
    painter.hline(strip.x_range(), strip.bottom(), Stroke::new(1.0, palette.hairline));
    for frame in ticks(axis, state) {
        let x = axis.x_of(frame as f64).round() + 0.5;
        let line = Stroke::new(1.0, palette.faint);
        painter.vline(x, strip.bottom() - 4.0..=strip.bottom(), line);
        let at = Pos2::new(x + 4.0, strip.center().y);
        let number = frame.to_string();
        painter.text(at, Align2::LEFT_CENTER, number, theme::caption(), palette.faint);
    }
    let response = ui.interact(strip, ui.scope_id().with("ruler"), Sense::click_and_drag());
    let now = state.frame_number() as f64;
    response.widget_info(|| WidgetInfo {
        value: Some(now),
        ..WidgetInfo::labeled(Role::Slider, true, LABEL)
    });
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    if (response.is_pointer_button_down_on() || response.dragged())
        && let Some(at) = response.interact_pointer_pos()
    {
        let is_free = ui.input(|input| input.modifiers.alt);
        let marks: Vec<usize> = state.stops();
        let frame = axis.snap(at.x, &marks, is_free, state.n_frames());
        state.stop_at(frame);
        ui.ctx().request_repaint();
    }
}

/// A line through all rows, with its frame on the ruler.
pub fn playhead_ui(ui: &Ui, room: Rect, axis: &Axis, state: &EditorState) {
    if state.shown_card().is_none() {
        return;
    }
    let palette = theme::of(ui);
    let x = axis.x_of(state.frame());
    if !room.x_range().contains(x) {
        return;
    }
    let painter = ui.painter().with_clip_rect(room);
    let line = Stroke::new(1.5, palette.accent);
    painter.vline(x, room.top() + 20.0..=room.bottom(), line);
    let number = state.frame_number().to_string();
    let font = egui::FontId { size: 11.0, ..theme::heading() };
    let job = tabular(ui, &number, &font, palette.base);
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let half = 0.5 * galley.size().x + 6.0;
    // The plate stays whole at the edges, only its tip goes on.
    let middle = x.clamp(room.left() + half, (room.right() - half).max(room.left() + half));
    let plate =
        Rect::from_x_y_ranges(middle - half..=middle + half, room.top() + 2.0..=room.top() + 19.0);
    painter.rect_filled(plate, 4.0, palette.accent);
    let tip = [(x - 4.0, 18.0), (x + 4.0, 18.0), (x, 24.0)]
        .map(|(x, below)| Pos2::new(x, room.top() + below));
    painter.add(Shape::convex_polygon(tip.to_vec(), palette.accent, Stroke::NONE));
    let at = plate.center() - 0.5 * galley.size();
    painter.galley(at, galley, palette.base);
}
