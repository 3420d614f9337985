//! Every key on one sheet.

use egui::{Align2, Grid, RichText, Role, ScrollArea, TextEdit, Ui, Vec2, WidgetInfo, Window};

use crate::icons;
use crate::theme;
use crate::ui_command::{Nudge, Side, UiCommand, key_text, menus};

const N_COLUMNS: usize = 3;
const WIDTH_PT: f32 = 1060.0;
/// Free room over and under the sheet.
const MARGIN_PT: f32 = 140.0;

/// The sheet's own state.
#[derive(Debug, Default)]
pub struct ShortcutSheet {
    /// Whether it is open.
    pub is_open: bool,
    wanted: String,
}

/// What a line says: what is done, and by which keys.
type Line = (String, String);

impl ShortcutSheet {
    /// Draws the sheet while it is open.
    pub fn ui(&mut self, ui: &Ui) {
        if !self.is_open {
            return;
        }
        let height = (ui.ctx().content_rect().height() - MARGIN_PT).max(200.0);
        let width = WIDTH_PT.min(ui.ctx().content_rect().width() - 80.0);
        let mut stays = true;
        Window::new(RichText::new("Keyboard shortcuts").font(theme::title()))
            .id(egui::Id::unique("shortcut sheet"))
            .open(&mut stays)
            .collapsible(false)
            .resizable(false)
            .fixed_size([width, height])
            .anchor(Align2::CENTER_CENTER, Vec2::ZERO)
            .show(ui.ctx(), |ui| self.contents_ui(ui));
        self.is_open = stays;
    }

    fn contents_ui(&mut self, ui: &mut Ui) {
        let palette = theme::of(ui);
        let field = TextEdit::singleline(&mut self.wanted)
            .hint_text("Find a command or a key")
            .prefix(RichText::new(icons::SEARCH).font(theme::icon()).color(palette.faint))
            .align(Align2::LEFT_CENTER)
            .desired_width(f32::INFINITY);
        let response = ui.add_sized([ui.available_width(), 28.0], field);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Find a shortcut"));
        ui.add_space(2.0 * theme::GRID);
        let sections = sections(&self.wanted);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.columns(N_COLUMNS, |columns| {
                for (column, sections) in columns.iter_mut().zip(balanced(sections)) {
                    for (name, lines) in sections {
                        section_ui(column, name, &lines);
                    }
                }
            });
            let mouse = "In the view: drag orbits, Shift+drag pans, the wheel zooms at the pointer, \
                         Ctrl+wheel over a checkpoint retimes it, a click on an axis looks along it. \
                         On the timeline: a drag on the ruler scrubs, on a mark retimes (Alt does not \
                         snap, Shift takes all later ones along), on empty ground selects; Ctrl+wheel \
                         zooms, the middle button pans, a double click shows all.";
            ui.label(RichText::new(mouse).color(palette.faint));
        });
    }
}

/// The menus' commands that have keys and answer to `wanted`.
fn sections(wanted: &str) -> Vec<(&'static str, Vec<Line>)> {
    let wanted = wanted.to_lowercase();
    let found = |line: &Line| {
        let text = format!("{} {}", line.0, line.1).to_lowercase();
        wanted.split_whitespace().all(|word| text.contains(word))
    };
    let lines = |groups: Vec<Vec<UiCommand>>| -> Vec<Line> {
        groups.into_iter().flatten().filter_map(line_of).filter(|line| found(line)).collect()
    };
    let all = menus().into_iter().map(|(name, groups)| (name, lines(groups)));
    all.filter(|(_, lines)| !lines.is_empty()).collect()
}

/// A command's line; families of commands have one together.
fn line_of(command: UiCommand) -> Option<Line> {
    let keys: Vec<String> = command.shortcuts().iter().map(key_text).collect();
    let line = |label: &str, keys: &str| Some((label.to_owned(), keys.to_owned()));
    match command {
        UiCommand::ShowTake(1) => line("Show take 1 to 9", "1 … 9"),
        UiCommand::PinTake(1) => line("Pin or unpin take 1 to 9", "Shift+1 … 9"),
        UiCommand::ShowTake(_) | UiCommand::PinTake(_) => None,
        UiCommand::Nudge(Nudge { to: Side::Left, is_fine: false }) => {
            line("Nudge by 10 cm", "Alt+arrows")
        }
        UiCommand::Nudge(Nudge { to: Side::Left, is_fine: true }) => {
            line("Nudge by 1 cm", "Alt+Shift+arrows")
        }
        UiCommand::Nudge(_) => None,
        _ if keys.is_empty() => None,
        other => Some((other.label(), keys.join("  "))),
    }
}

/// Sections dealt out to columns so that none is much longer than the others.
fn balanced(sections: Vec<(&'static str, Vec<Line>)>) -> Vec<Vec<(&'static str, Vec<Line>)>> {
    let mut columns: Vec<Vec<(&'static str, Vec<Line>)>> = vec![Vec::new(); N_COLUMNS];
    let n_lines: usize = sections.iter().map(|(_, lines)| lines.len() + 2).sum();
    let most = n_lines.div_ceil(N_COLUMNS);
    let (mut column, mut filled) = (0, 0);
    for (name, lines) in sections {
        let mut rest = lines.as_slice();
        while !rest.is_empty() {
            let room = most.saturating_sub(filled + 2).max(1);
            let (now, later) = rest.split_at(rest.len().min(room));
            columns[column].push((name, now.to_vec()));
            filled += now.len() + 2;
            rest = later;
            if filled + 3 > most && column + 1 < N_COLUMNS {
                (column, filled) = (column + 1, 0);
            }
        }
    }
    columns
}

fn section_ui(ui: &mut Ui, name: &str, lines: &[Line]) {
    let faint = theme::of(ui).faint;
    ui.label(RichText::new(name).font(theme::heading()));
    let id = (name, lines.first().map(|line| line.0.clone()));
    Grid::new(id).num_columns(2).spacing([16.0, 2.0]).min_row_height(20.0).show(ui, |ui| {
        for (label, keys) in lines {
            ui.label(label);
            ui.label(RichText::new(keys).color(faint));
            ui.end_row();
        }
    });
    ui.add_space(2.0 * theme::GRID);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_on_the_sheet_once() {
        let lines: Vec<Line> = sections("").into_iter().flat_map(|(_, lines)| lines).collect();
        let has = |keys: &str| lines.iter().filter(|line| line.1.contains(keys)).count();
        for keys in ["Ctrl+S", "Space", "1 … 9", "Alt+arrows", "F11"] {
            assert!(has(keys) > 0, "{keys}");
        }
        let n: usize = balanced(sections("")).iter().flatten().map(|(_, lines)| lines.len()).sum();
        assert_eq!(n, lines.len());
        assert_eq!(sections("undo").len(), 1);
        assert!(sections("no such thing").is_empty());
    }
}
