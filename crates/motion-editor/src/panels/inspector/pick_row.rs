//! A row with a choice among many: typing narrows it down.

use egui::{
    Align, ComboBox, Id, Layout, PopupCloseBehavior, Role, ScrollArea, TextEdit, Ui, WidgetInfo,
};

use super::field::{name_ui, row_ui};

/// So many lines are seen at once.
const LIST_PT: f32 = 260.0;

/// A row with a choice; gives another one where it was made.
pub(super) fn pick_row_ui(
    ui: &mut Ui,
    name: &str,
    value: &str,
    choices: &[(String, String)],
) -> Option<String> {
    let id = Id::unique(("picked", name));
    let mut chosen = None;
    row_ui(ui, |ui| {
        name_ui(ui, name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let words = choices.iter().find(|(known, _)| known == value);
            let words = words.map_or(value, |(_, words)| words.as_str());
            let combo = ComboBox::from_id_salt(("pick", name))
                .selected_text(words)
                .width(150.0)
                .truncate()
                .close_behavior(PopupCloseBehavior::CloseOnClickOutside);
            let shown = combo.show_ui(ui, |ui| chosen = list_ui(ui, id, value, choices));
            let info = || WidgetInfo::labeled(Role::ComboBox, true, name);
            shown.response.widget_info(info);
            if shown.inner.is_none() {
                ui.data_mut(|data| data.remove::<String>(id));
            }
        });
    });
    chosen.filter(|choice| choice != value)
}

/// What is typed, and what is left of the choices; gives the one that was clicked, or the first on
/// Enter.
fn list_ui(ui: &mut Ui, id: Id, value: &str, choices: &[(String, String)]) -> Option<String> {
    let mut typed = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_default();
    let is_new = ui.data(|data| data.get_temp::<String>(id)).is_none();
    let field = TextEdit::singleline(&mut typed).hint_text("Type to find").desired_width(180.0);
    let response = ui.add(field);
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Type to find"));
    if is_new {
        response.request_focus();
    }
    let sought = typed.to_lowercase();
    let fits = |words: &str| words.to_lowercase().contains(&sought);
    let mut left = choices.iter().filter(|(key, words)| fits(key) || fits(words)).peekable();
    let is_entered = response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
    let mut chosen = left.peek().filter(|_| is_entered).map(|(key, _)| key.clone());
    ScrollArea::vertical().max_height(LIST_PT).show(ui, |ui| {
        for (key, words) in left {
            if ui.selectable_label(key == value, words).clicked() {
                chosen = Some(key.clone());
            }
        }
    });
    ui.data_mut(|data| data.insert_temp(id, typed));
    if chosen.is_some() {
        ui.close();
    }
    chosen
}
