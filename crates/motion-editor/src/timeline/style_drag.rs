//! A style drawn over a stretch of the timeline, by a drag where none is.

use egui::{CursorIcon, Rect, Role, Sense, WidgetInfo};
use motion_session::command::Command;

use super::action::Action;
use super::sheet::Sheet;
use crate::state::EditorState;

/// What tests and screen readers call the place.
pub const LABEL: &str = "Style row: drag to ask for a style";

/// Takes hold where somebody drags on the row's ground; says so while the row is empty.
pub fn style_ground_ui(sheet: &mut Sheet<'_>, place: Rect, is_empty: bool) {
    let Some(seen) = sheet.seen(place) else { return };
    let id = sheet.ui.scope_id().with("style ground");
    let response = sheet.ui.interact(seen, id, Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, LABEL));
    if is_empty {
        let words = sheet.words("Drag here to ask for a style");
        let at = seen.left_center() + egui::Vec2::new(22.0, -0.5 * words.size().y);
        let share = if response.hovered() { 0.9 } else { 0.5 };
        sheet.painter().galley(at, words, sheet.palette.faint.gamma_multiply(share));
    }
    if response.drag_started_by(egui::PointerButton::Primary) {
        sheet.actions.push(Action::DrawStyle);
    }
    response.on_hover_cursor(CursorIcon::Crosshair);
}

/// What asks for a style from a frame to a frame: for the tag that was chosen last, else for the
/// library's commonest.
pub fn commands(state: &EditorState, from: u32, to: u32) -> Vec<Command> {
    let tags = motion_session::clip_rows::tag_counts(&state.clips);
    let chosen = state.style_tag.clone().filter(|tag| tags.iter().any(|(known, _)| known == tag));
    let commonest = || tags.iter().max_by_key(|(_, n)| *n).map(|(tag, _)| tag.clone());
    let tag = chosen.or_else(commonest).unwrap_or_else(|| "walk".to_owned());
    let character = state.session.active();
    let mut commands = vec![Command::AddStyle { character, from, to, tag }];
    commands.extend(state.length_for(to));
    commands
}
