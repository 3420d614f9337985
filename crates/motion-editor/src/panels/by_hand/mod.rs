//! What is changed by hand on the shown take: a list, the fields of one, and the timing.

mod add_menu;
mod edit_fields;
mod edit_list;
pub mod plot;
pub mod retime_curve;
pub mod tempo;

use egui::{Button, Ui};

use super::{empty_ui, heading_ui};
use crate::state::EditorState;
use crate::theme;

/// The whole tab.
pub fn by_hand_ui(ui: &mut Ui, state: &mut EditorState) {
    if state.shown_card().is_none() {
        empty_ui(ui, "What is changed by hand on the shown take stands here");
        return;
    }
    let n = state.hand_layer().map_or(0, |layer| layer.edits().count());
    let beside = if n == 0 { String::new() } else { n.to_string() };
    heading_ui(ui, "Changes", &beside);
    if n == 0 {
        empty_ui(ui, "Press I and drag a hand to change this take by hand");
    }
    edit_list::edit_list_ui(ui, state);
    ui.add_space(theme::GRID);
    buttons_ui(ui, state);
    edit_fields::edit_fields_ui(ui, state);
    heading_ui(ui, "Timing", "shown frames across, the take's own frames up");
    retime_curve::retime_curve_ui(ui, state);
    tempo::tempo_ui(ui, state);
    ui.add_space(2.0 * theme::GRID);
}

fn buttons_ui(ui: &mut Ui, state: &mut EditorState) {
    let has_edits = state.has_hand_edits();
    ui.horizontal(|ui| {
        add_menu::add_menu_ui(ui, state);
        let clear = Button::new("Clear all").fill(theme::of(ui).raised);
        let tooltip = "The take as it was found, without anything that is changed by hand";
        if ui.add_enabled(has_edits, clear).on_hover_text(tooltip).clicked() {
            state.clear_by_hand();
        }
    });
    ui.add_enabled_ui(has_edits, |ui| {
        ui.checkbox(&mut state.compares_before_hand, "Compare with before")
            .on_hover_text("Shows the motion without the changes beside it, faint");
    });
}
