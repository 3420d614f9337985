//! A take's name, typed on its card.

use egui::{Key, Rect, TextEdit, Ui};
use motion_session::document::TakeId;

use crate::state::EditorState;
use crate::theme;

/// What tests and screen readers call the field.
pub const LABEL: &str = "Name of the take";

/// The field where the name stands. Enter and a click elsewhere take the name, Escape does not.
pub fn rename_ui(ui: &mut Ui, place: Rect, id: TakeId, state: &mut EditorState) {
    let Some((_, mut name)) = state.renaming.take() else { return };
    let field_id = egui::Id::unique(("take name", id));
    let hint = state.card(id).map(|card| format!("Take {}", card.number)).unwrap_or_default();
    let field = TextEdit::singleline(&mut name)
        .id(field_id)
        .font(theme::body())
        .margin(egui::Margin::symmetric(4, 2))
        .hint_text(hint)
        .desired_width(place.width());
    let is_first = !ui.memory(|memory| memory.has_focus(field_id))
        && ui.data(|data| data.get_temp::<bool>(field_id)).is_none();
    let mut child = ui.new_child(egui::UiBuilder::new().max_rect(place));
    let response = child.add_sized(place.size(), field);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, LABEL));
    if is_first {
        response.request_focus();
        ui.data_mut(|data| data.insert_temp(field_id, true));
        state.renaming = Some((id, name));
        return;
    }
    let is_over = response.lost_focus();
    if !is_over {
        state.renaming = Some((id, name));
        return;
    }
    ui.data_mut(|data| data.remove::<bool>(field_id));
    let is_meant = |input: &egui::InputState| {
        input.key_pressed(Key::Enter) || input.pointer.any_down() || input.pointer.any_released()
    };
    if ui.input(is_meant) {
        state.name_take(id, &name);
    }
}
