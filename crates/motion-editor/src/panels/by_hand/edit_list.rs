//! Every change by hand, a line each.

use egui::{Align2, Pos2, Rect, Role, Sense, Ui, UiBuilder, Vec2, WidgetInfo};
use motion_session::document::HandEdit;

use crate::hand_words::{how_much, what};
use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::widgets::icon_button::icon_button_ui;

/// The lines. A click selects a change and goes to where it is full; again, and nothing is selected.
pub(super) fn edit_list_ui(ui: &mut Ui, state: &mut EditorState) {
    let edits: Vec<(String, HandEdit)> = state
        .hand_layer()
        .into_iter()
        .flat_map(|layer| layer.edits())
        .map(|(id, edit)| (id.to_owned(), edit.clone()))
        .collect();
    for (id, edit) in edits {
        line_ui(ui, &id, &edit, state);
    }
}

fn line_ui(ui: &mut Ui, id: &str, edit: &HandEdit, state: &mut EditorState) {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let is_on = state.selected_edit().is_some_and(|(known, _)| known == id);
    let name = what(&edit.change);
    let about = format!("{} · f {}–{}", how_much(&edit.change), edit.from, edit.to);
    let said = || format!("Change of {name}, {about}");
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_on, said()));
    if is_on || response.hovered() {
        let ground = if is_on { palette.accent_surface } else { palette.hovered };
        ui.painter().rect_filled(rect.expand2(Vec2::new(4.0, 0.0)), 3.0, ground);
    }
    let y = rect.center().y;
    let left = Pos2::new(rect.left() + 4.0, y);
    ui.painter().text(left, Align2::LEFT_CENTER, &name, theme::body(), palette.text);
    let right = Pos2::new(rect.right() - theme::ICON_BUTTON - 6.0, y);
    ui.painter().text(right, Align2::RIGHT_CENTER, about, theme::caption(), palette.faint);
    let at = Pos2::new(rect.right() - theme::ICON_BUTTON, rect.top());
    let place = Rect::from_min_size(at, Vec2::splat(theme::ICON_BUTTON));
    let mut child = ui.new_child(UiBuilder::new().max_rect(place).id_salt(("remove", id)));
    let label = format!("Delete the change of {}", name.to_lowercase());
    if icon_button_ui(&mut child, icons::REMOVE, &label, "Takes this change away", false).clicked()
    {
        state.remove_hand_edit(id);
    } else if response.clicked() && is_on {
        state.selected_hand_edit = None;
    } else if response.clicked() {
        state.select_edit(id);
        if !(edit.from..=edit.to).contains(&state.hand_frame()) {
            let frame = state.output_frame(f64::from(edit.from)).round().max(0.0);
            state.stop_at(frame as usize);
        }
    }
}
