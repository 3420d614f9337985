//! Menus, the name of the project, and how the search stands.

use egui::{Align, Button, Layout, MenuBar, RichText, Sense, Ui, Vec2};
use motion_session::live::SearchState;

use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::{UiCommand as C, menus};
use crate::viewport::described;
use crate::widgets::icon_button::icon_button_ui;

/// The bar.
pub fn top_bar_ui(ui: &mut Ui, state: &mut EditorState) {
    MenuBar::new().ui(ui, |ui| {
        ui.set_min_height(theme::TOP_BAR_HEIGHT);
        ui.add_space(theme::GRID);
        for (name, groups) in menus() {
            ui.menu_button(name, |ui| {
                menu_ui(ui, &groups, state);
                if name == "File" {
                    recent_ui(ui, state);
                }
            });
        }
        ui.add_space(2.0 * theme::GRID);
        workspace_ui(ui);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(theme::GRID);
            ui.spacing_mut().item_spacing.x = 2.0;
            for (icon, command) in [
                (icons::PANEL_RIGHT, C::RightPanel),
                (icons::PANEL_BOTTOM, C::Timeline),
                (icons::PANEL_LEFT, C::LeftPanel),
            ] {
                let tooltip = described(ui, command);
                if icon_button_ui(ui, icon, &command.label(), &tooltip, false).clicked() {
                    state.ask(command);
                }
            }
            ui.add_space(3.0 * theme::GRID);
            chip_ui(ui, state);
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
        for &command in group {
            let enabled = command.is_enabled(state);
            let key = command.shortcut().map(|key| ui.ctx().format_shortcut(&key));
            let tick = if command.is_on(state) == Some(true) { icons::DONE } else { "" };
            let tick = RichText::new(tick).color(theme::of(ui).accent);
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

/// How the search stands, in a few words.
fn chip_ui(ui: &mut Ui, state: &EditorState) {
    let palette = theme::of(ui);
    let miss = theme::role(motion_scene::color::ColorRole::Miss, palette.theme);
    let best = state.cards.iter().map(|card| card.score).fold(f64::INFINITY, f64::min);
    let n = state.cards.len();
    let found = if n == 0 { String::new() } else { format!(" · best {best:.2} · {n} takes") };
    let better = state.better();
    let better =
        better.map(|(_, percent)| format!(" · better: −{percent:.0} %")).unwrap_or_default();
    let search = state.search_state();
    let (icon, color, text) = match &search {
        SearchState::NoGraph | SearchState::Ready => {
            (icons::WORKING, palette.accent, "Preparing".to_owned())
        }
        SearchState::Building { share, .. } => {
            (icons::WORKING, palette.accent, format!("Reading · {:.0} %", share * 100.0))
        }
        SearchState::Searching => {
            (icons::WORKING, palette.accent, format!("Searching{found}{better}"))
        }
        SearchState::Paused => (icons::PAUSE, palette.faint, format!("Paused{found}{better}")),
        SearchState::Settled => (icons::DONE, palette.faint, format!("Settled{found}{better}")),
        SearchState::Infeasible(_) => (icons::ALERT, miss, format!("Cannot be met{found}")),
        SearchState::Error(_) => (icons::ALERT, miss, "No search".to_owned()),
    };
    let response = ui.label(RichText::new(text).font(theme::caption()).color(palette.text));
    if let SearchState::Infeasible(sentence) | SearchState::Error(sentence) = &search {
        response.on_hover_text(sentence);
    }
    let (place, _) = ui.allocate_exact_size(Vec2::splat(theme::ICON), Sense::hover());
    ui.painter().text(
        place.center(),
        egui::Align2::CENTER_CENTER,
        icon,
        egui::FontId { size: 14.0, ..theme::icon() },
        color,
    );
}
