//! Every key on one sheet.

use egui::{Align2, Grid, RichText, Ui, Vec2, Window};

use crate::theme;
use crate::ui_command::UiCommand;

/// Draws the sheet while `is_open`.
pub fn shortcut_sheet_ui(ui: &Ui, is_open: &mut bool) {
    if !*is_open {
        return;
    }
    let mut stays = true;
    Window::new(RichText::new("Keyboard shortcuts").font(theme::title()))
        .id(egui::Id::unique("shortcut sheet"))
        .open(&mut stays)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, Vec2::ZERO)
        .show(ui.ctx(), contents_ui);
    *is_open = stays;
}

fn contents_ui(ui: &mut Ui) {
    let commands: Vec<UiCommand> = UiCommand::all()
        .into_iter()
        .filter(|command| command.shortcut().is_some())
        .filter(|command| !matches!(command, UiCommand::ShowTake(2..)))
        .collect();
    let half = commands.len().div_ceil(2);
    ui.columns(2, |columns| {
        for (column, commands) in columns.iter_mut().zip(commands.chunks(half)) {
            let spacing = Vec2::new(24.0, theme::GRID);
            let id = commands.first().map(|command| command.label());
            Grid::new(id).spacing(spacing).min_row_height(20.0).show(column, |ui| {
                for command in commands {
                    line_ui(ui, *command);
                }
            });
        }
    });
    ui.add_space(2.0 * theme::GRID);
    let mouse = "In the view: drag orbits, Shift+drag pans, the wheel zooms at the pointer, a click on \
                 an axis looks along it. On the timeline: drag on the ruler scrubs (Alt does not \
                 snap), a mark's drag retimes it (Shift takes what comes later along), Ctrl+wheel zooms, \
                 the middle button pans, a double click shows all.";
    ui.label(RichText::new(mouse).color(theme::of(ui).faint));
}

fn line_ui(ui: &mut Ui, command: UiCommand) {
    let label = match command {
        UiCommand::ShowTake(_) => "Show take 1 … 9".to_owned(),
        other => other.label(),
    };
    ui.label(label);
    let keys: Vec<String> =
        command.shortcuts().iter().map(|key| ui.ctx().format_shortcut(key)).collect();
    ui.label(RichText::new(keys.join("  or  ")).color(theme::of(ui).faint));
    ui.end_row();
}
