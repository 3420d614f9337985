//! How long the motion shall be: a flag at its end.

use egui::{CursorIcon, Pos2, Rect, Role, Sense, Shape, Stroke, WidgetInfo};
use motion_session::LengthMode;
use motion_session::command::Command;

use super::action::Action;
use super::sheet::Sheet;
use crate::state::EditorState;
use crate::theme;

/// How wide the flag is, points.
const FLAG_PT: f32 = 10.0;
/// Each mode with what it is called and what it means.
const MODES: [(LengthMode, &str, &str); 3] = [
    (LengthMode::Free, "Free", "Any length will do"),
    (LengthMode::Preferred, "Preferred", "About as long; how far off it is costs something"),
    (LengthMode::Exact, "Exact", "Exactly as long"),
];

/// What is wished of the active character's length: frames and how strictly. Where nothing is
/// wished, it is as long as the shown motion.
pub fn wished(state: &EditorState) -> (u32, LengthMode) {
    let shown = state.n_frames() as u32;
    let character = state.session.document().character(state.session.active());
    let length = character.and_then(|character| character.length.as_ref());
    let frames = length.and_then(|length| length.frames).unwrap_or(shown);
    (frames, length.map_or(LengthMode::Free, |length| length.mode))
}

/// What wishes another length; a free one that is dragged is preferred from then on.
pub fn command(state: &EditorState, frames: u32, mode: LengthMode) -> Command {
    let character = state.session.active();
    Command::SetLength { character, frames: Some(frames.max(1)), mode }
}

/// The flag and its line: hollow and dotted where the length is free, dashed where it is preferred,
/// full where it is exact. A drag changes the length, a right click how strictly it is meant.
pub fn length_handle_ui(sheet: &mut Sheet<'_>, room: Rect, strip: Rect) {
    let (frames, mode) = wished(sheet.state);
    let x = sheet.axis.x_of(f64::from(frames));
    let palette = sheet.palette;
    let top = strip.bottom() - 21.0;
    let place = Rect::from_x_y_ranges(x - 4.0..=x + FLAG_PT + 2.0, top..=strip.bottom());
    let seen = place.intersect(strip);
    if seen.width() <= 0.0 {
        return;
    }
    let id = sheet.ui.scope_id().with("length");
    let response = sheet.ui.interact(seen, id, Sense::click_and_drag());
    let (_, name, meaning) = MODES.iter().find(|known| known.0 == mode).unwrap_or(&MODES[0]);
    let said = || format!("Length, {frames} frames, {}", name.to_lowercase());
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said()));

    let color = if response.hovered() || response.dragged() { palette.text } else { palette.faint };
    let painter = sheet.ui.painter().with_clip_rect(room);
    let line = [Pos2::new(x, top), Pos2::new(x, room.bottom())];
    let stroke = Stroke::new(1.0, color);
    match mode {
        LengthMode::Free => drop(painter.add(Shape::dotted_line(&line, color, 6.0, 0.8))),
        LengthMode::Preferred => drop(painter.add(Shape::dashed_line(&line, stroke, 4.0, 4.0))),
        LengthMode::Exact => drop(painter.line_segment(line, Stroke::new(1.5, color))),
    }
    let corners = [(0.0, 0.0), (FLAG_PT, 5.0), (0.0, 10.0)];
    let corners = corners.map(|(right, down)| Pos2::new(x + right, top + down)).to_vec();
    let fill = match mode {
        LengthMode::Free => palette.base,
        LengthMode::Preferred => theme::over(palette.base, color, 0.5),
        LengthMode::Exact => color,
    };
    painter.add(Shape::convex_polygon(corners, fill, stroke));
    if response.drag_started_by(egui::PointerButton::Primary) {
        sheet.actions.push(Action::GrabLength);
    }
    if response.secondary_clicked() || response.context_menu_opened() {
        let (state, actions) = (sheet.state, &mut sheet.actions);
        response.context_menu(|ui| {
            ui.set_min_width(200.0);
            for (other, name, meaning) in MODES {
                if ui.selectable_label(other == mode, name).on_hover_text(meaning).clicked() {
                    actions.push(Action::Do(vec![command(state, frames, other)]));
                    ui.close();
                }
            }
        });
    } else if response.hovered() {
        let secs = f64::from(frames) / sheet.state.fps();
        response.on_hover_cursor(CursorIcon::ResizeHorizontal).on_hover_ui_at_pointer(|ui| {
            ui.strong(format!("Length {frames} frames, {secs:.2} s"));
            ui.label(format!("{name}: {}", meaning.to_lowercase()));
            ui.label("Drag to change it, right-click for how strictly it is meant");
        });
    }
}
