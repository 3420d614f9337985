//! Moments at which the character meets others.

use egui::{Align2, CursorIcon, FontId, Pos2, Rect, Role, Sense, Vec2, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::Interaction;
use motion_session::selection::Selectable;
use motion_session::stage::meeting_wishes::title;

use super::action::Action;
use super::mark_shape::HALF_PT;
use super::sheet::Sheet;
use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand;

/// The meetings of the active character. A click selects one and goes to its frame, a drag brings it
/// to another.
pub fn meet_row_ui(sheet: &mut Sheet<'_>, place: Rect) {
    let state = sheet.state;
    for meeting in state.meetings() {
        let at = Pos2::new(sheet.axis.x_of(f64::from(meeting.frame)), place.center().y);
        mark_ui(sheet, meeting, at, place.height());
    }
}

fn mark_ui(sheet: &mut Sheet<'_>, meeting: &Interaction, at: Pos2, height: f32) {
    let size = Vec2::new(2.0 * HALF_PT + 6.0, height);
    let Some(touch) = sheet.touch(at, size) else { return };
    let id = sheet.ui.scope_id().with(("meeting", &meeting.id));
    let response = sheet.ui.interact(touch, id, Sense::click_and_drag());
    let item = Selectable::Interaction(meeting.id.clone());
    let is_selected = sheet.state.session.selection().contains(&item);
    let said = || format!("{}, frame {}", title(meeting), meeting.frame);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, said()));
    let palette = sheet.palette;
    let color = theme::role(ColorRole::Pose, palette.theme);
    let painter = sheet.painter();
    let rim = match (is_selected, response.hovered()) {
        (true, _) => Some(palette.accent),
        (false, true) => Some(palette.text),
        (false, false) => None,
    };
    if let Some(rim) = rim {
        painter.circle_filled(at, HALF_PT + 4.5, rim);
    }
    painter.circle_filled(at, HALF_PT + 2.0, color);
    let font = FontId::new(10.0, theme::icons());
    painter.text(at, Align2::CENTER_CENTER, icons::MEETING, font, egui::Color32::WHITE);
    let words = sheet.words(others(sheet.state, meeting));
    let corner = Pos2::new(at.x + 12.0, at.y - 0.5 * words.size().y);
    painter.galley(corner, words, palette.faint);
    if response.clicked() {
        sheet.actions.push(Action::SelectMeeting(meeting.id.clone()));
    }
    if response.drag_started_by(egui::PointerButton::Primary) {
        sheet.actions.push(Action::GrabMeeting(meeting.id.clone()));
    }
    if response.secondary_clicked() || response.context_menu_opened() {
        let actions = &mut sheet.actions;
        response.context_menu(|ui| {
            ui.set_min_width(180.0);
            if ui.button("Go to").clicked() {
                actions.push(Action::SelectMeeting(meeting.id.clone()));
            }
            if ui.button(UiCommand::Delete.label()).clicked() {
                let id = meeting.id.clone();
                let remove = motion_session::command::Command::RemoveInteraction { id };
                actions.push(Action::Do(vec![remove]));
            }
        });
    }
    if response.hovered() {
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_ui_at_pointer(|ui| {
            ui.strong(format!("{} · f {}", title(meeting), meeting.frame));
            for member in &meeting.members {
                let (who, clip) = (&member.character, &member.clip);
                ui.label(format!("{who}: {clip}:{}", member.clip_frame));
            }
        });
    }
}

/// Whom the active character meets.
fn others(state: &EditorState, meeting: &Interaction) -> String {
    let active = state.session.document().character(state.session.active());
    let own = active.map_or("", |character| character.name.as_str());
    let names = meeting.members.iter().map(|m| m.character.as_str());
    names.filter(|name| *name != own).collect::<Vec<_>>().join(", ")
}
