//! Menus, the name of the project, and how the search stands.

use egui::{Align, Button, Layout, MenuBar, RichText, ScrollArea, Ui};

use super::search_chip;
use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::{UiCommand as C, key_text, menus};

/// The bar.
pub fn top_bar_ui(ui: &mut Ui, state: &mut EditorState) {
    MenuBar::new().ui(ui, |ui| {
        ui.set_min_height(theme::TOP_BAR_HEIGHT);
        ui.add_space(theme::GRID);
        for (name, groups) in menus() {
            ui.menu_button(name, |ui| {
                // What is longer than a small window is high can still be reached.
                let room = ui.ctx().content_rect().height() - 2.0 * theme::TOP_BAR_HEIGHT;
                let whole = ScrollArea::vertical().max_height(room).min_scrolled_height(room);
                whole.show(ui, |ui| {
                    menu_ui(ui, &groups, state);
                    if name == "File" {
                        recent_ui(ui, state);
                    }
                });
            });
        }
        ui.add_space(2.0 * theme::GRID);
        workspace_ui(ui);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(theme::GRID);
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.add_space(3.0 * theme::GRID);
            search_chip::search_chip_ui(ui, state);
            ui.add_space(3.0 * theme::GRID);
            let faint = theme::of(ui).faint;
            let changed = if state.session.is_changed() { " •" } else { "" };
            let name = format!("{}{changed}", state.session.document().name());
            ui.label(RichText::new(name).color(faint));
        });
    });
}

fn menu_ui(ui: &mut Ui, groups: &[Vec<C>], state: &mut EditorState) {
    ui.set_min_width(240.0);
    for (nth, group) in groups.iter().enumerate() {
        if nth > 0 {
            ui.separator();
        }
        if let Some(name) = submenu(group)
            && groups.len() > 1
        {
            ui.menu_button(name, |ui| menu_ui(ui, std::slice::from_ref(group), state));
            continue;
        }
        for &command in group {
            let enabled = command.is_enabled(state);
            let key = command.shortcut().map(|key| key_text(&key));
            let tick = if command.is_on(state) == Some(true) { icons::DONE } else { "" };
            // In letters it would be another sign.
            let tick = RichText::new(tick).font(theme::icon()).color(theme::of(ui).accent);
            let mut button = Button::new((command.label(), tick));
            if let Some(key) = key {
                button = button.shortcut_text(key);
            }
            if ui.add_enabled(enabled, button).on_hover_text(command.tooltip()).clicked() {
                state.ask(command);
                ui.close();
            }
        }
    }
}

/// What many alike stand behind.
fn submenu(group: &[C]) -> Option<&'static str> {
    let are_all = |is_one: fn(&C) -> bool| group.iter().all(is_one);
    if are_all(|command| matches!(command, C::PinTake(_))) {
        Some("Pin or unpin")
    } else if are_all(|command| matches!(command, C::Nudge(_))) {
        Some("Nudge")
    } else if group.contains(&C::ViewFront) {
        Some("Views")
    } else if are_all(|command| matches!(command, C::GhostsAre(_))) {
        Some("Which ghosts")
    } else {
        None
    }
}

/// Projects that were open lately.
fn recent_ui(ui: &mut Ui, state: &mut EditorState) {
    if state.recent.is_empty() {
        return;
    }
    ui.separator();
    ui.menu_button("Open again", |ui| {
        ui.set_min_width(320.0);
        for nth in 0..state.recent.len() {
            let path = &state.recent[nth];
            let name = path.file_stem().map(|name| name.to_string_lossy().into_owned());
            let button = Button::new(name.unwrap_or_default());
            if ui.add(button).on_hover_text(path.display().to_string()).clicked() {
                state.ask(C::Recent(nth as u8));
                ui.close();
            }
        }
    });
}

/// There is one workspace so far.
fn workspace_ui(ui: &mut Ui) {
    let palette = theme::of(ui);
    let text = RichText::new("Author").font(theme::heading());
    let response = ui.label(text);
    let y = ui.max_rect().bottom() - 1.0;
    let line = egui::Stroke::new(2.0, palette.accent);
    ui.painter().hline(response.rect.x_range(), y, line);
}
