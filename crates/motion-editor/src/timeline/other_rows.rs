//! The other characters: a thin row each, and chips to change between them.

use egui::{Align2, Color32, CursorIcon, Pos2, Rect, Role, Sense, Shape, Stroke, Vec2, WidgetInfo};
use motion_scene::color::{ColorRole, Theme};
use motion_session::ConstraintKind;
use motion_session::document::CharacterIdx;

use super::action::Action;
use super::sheet::Sheet;
use crate::theme::{self, Palette};

/// The colour of a character, as its body is tinted in the view.
fn color(character: CharacterIdx, palette: &Palette) -> Color32 {
    let neutral = theme::role(ColorRole::Body, palette.theme);
    match character.0.checked_sub(1) {
        None => neutral,
        Some(nth) => theme::over(neutral, theme::role(ColorRole::Take(nth), palette.theme), 0.7),
    }
}

/// A chip for every character, where there are several; a click shows its takes and constraints.
pub fn chips_ui(sheet: &mut Sheet<'_>, room: Rect) {
    let characters = sheet.state.session.document().characters();
    if characters.len() < 2 {
        return;
    }
    let palette = sheet.palette;
    let width = ((room.width() - 12.0) / characters.len() as f32).min(26.0);
    for (nth, character) in characters.iter().enumerate() {
        let left = room.left() + 12.0 + nth as f32 * width;
        let place = Rect::from_min_size(
            Pos2::new(left, room.center().y - 9.0),
            Vec2::new(width - 4.0, 18.0),
        );
        let id = sheet.ui.scope_id().with(("character", nth));
        let response = sheet.ui.interact(place, id, Sense::click());
        let is_active = sheet.state.session.active().0 == nth;
        let said = || format!("Character {}", character.name);
        response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_active, said()));
        let ground = color(CharacterIdx(nth), &palette);
        let ground = if is_active { ground } else { theme::over(palette.panel, ground, 0.45) };
        let painter = sheet.ui.painter();
        painter.rect_filled(place, 9.0, ground);
        if is_active || response.hovered() {
            let rim = if is_active { palette.accent } else { palette.text };
            let stroke = Stroke::new(1.5, rim);
            painter.rect_stroke(place, 9.0, stroke, egui::StrokeKind::Outside);
        }
        let letter: String = character.name.chars().take(1).flat_map(char::to_uppercase).collect();
        // The darker of ground and words on what is light.
        let is_dark = palette.theme == Theme::Dark;
        let ink = if is_active && is_dark { palette.base } else { palette.text };
        painter.text(place.center(), Align2::CENTER_CENTER, letter, theme::caption(), ink);
        if response.clicked() {
            sheet.actions.push(Action::Activate(CharacterIdx(nth)));
        }
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(&character.name);
    }
}

/// Another character's checkpoints, small; a click shows that character.
pub fn other_row_ui(sheet: &mut Sheet<'_>, character: CharacterIdx, row: Rect) {
    let Some(of) = sheet.state.session.document().character(character) else { return };
    let Some(seen) = sheet.seen(row) else { return };
    let id = sheet.ui.scope_id().with(("other", character.0));
    let response = sheet.ui.interact(seen, id, Sense::click());
    let n = of.constraints.len();
    let said = || format!("{}, {n} constraints", of.name);
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said()));
    let own = color(character, &sheet.palette);
    let share = if response.hovered() { 1.0 } else { 0.7 };
    let own = theme::over(sheet.palette.base, own, share);
    let painter = sheet.painter();
    let last = of.length.as_ref().and_then(|length| length.frames).unwrap_or_default();
    let last = of.constraints.iter().map(|c| c.kind.last_frame() + 1).max().unwrap_or(0).max(last);
    let ends = [0, last].map(|frame| sheet.axis.x_of(f64::from(frame)));
    painter.hline(ends[0]..=ends[1], row.center().y, Stroke::new(1.0, own.gamma_multiply(0.6)));
    for constraint in &of.constraints {
        let ConstraintKind::Body { frame, .. } = constraint.kind else { continue };
        let at = Pos2::new(sheet.axis.x_of(f64::from(frame)), row.center().y);
        let corners = [(-3.0, -4.0), (4.0, 0.0), (-3.0, 4.0)];
        let corners = corners.map(|(x, y)| at + Vec2::new(x, y)).to_vec();
        painter.add(Shape::convex_polygon(corners, own, Stroke::NONE));
    }
    if response.clicked() {
        sheet.actions.push(Action::Activate(character));
    }
    if response.hovered() {
        let text = format!("Click to show {}", of.name);
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text_at_pointer(text);
    }
}
