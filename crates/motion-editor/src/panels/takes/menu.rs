//! What can be done with a take, in its card's menu.

use egui::Ui;

use crate::state::EditorState;
use crate::take_card::TakeCard;
use crate::ui_command::UiCommand;

/// The menu.
pub fn menu_ui(ui: &mut Ui, card: &TakeCard, state: &mut EditorState) {
    ui.set_min_width(180.0);
    let id = card.id;
    let item = |ui: &mut Ui, words: &str, tooltip: &str| {
        let clicked = ui.button(words).on_hover_text(tooltip).clicked();
        if clicked {
            ui.close();
        }
        clicked
    };
    if item(ui, "Show", UiCommand::ShowTake(1).tooltip()) {
        state.show_take(id);
    }
    let (pin, about) = match card.is_pinned {
        true => ("Unpin", "It stays only as long as it is among the best"),
        false => ("Pin", UiCommand::PinTake(1).tooltip()),
    };
    if item(ui, pin, about) {
        state.toggle_pin(id);
    }
    if item(ui, "Rename…", "Types a name on the card") {
        state.begin_renaming(id);
    }
    ui.separator();
    if item(ui, "More like this", "Looks for takes that share at least half of this one") {
        state.more_like(id);
    }
    let compare = if state.is_compared(id) { "Compare no longer" } else { "Compare" };
    if item(ui, compare, UiCommand::Compare.tooltip()) {
        state.toggle_compared(id);
    }
    ui.separator();
    if item(ui, "Export…", UiCommand::Export.tooltip()) {
        state.show_take(id);
        state.ask(UiCommand::Export);
    }
    if item(ui, "Copy recipe", "Copies the clips and frames that it is made of, as text")
        && let Some(text) = state.recipe(id)
    {
        ui.ctx().copy_text(text);
        state.notices.tell(format!("Copied the recipe of {}", card.title()));
    }
    ui.menu_button("Show lineage", |ui| {
        let lineage = state.lineage(id);
        if lineage.is_empty() {
            ui.label("Found by itself");
        }
        for (nth, parent) in lineage.iter().enumerate() {
            let words = if nth == 0 { "Made from" } else { "which was made from" };
            ui.label(format!("{words} {parent}"));
        }
    });
}
