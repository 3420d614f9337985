//! The library's clips: which there are, which may be used, what they look like.

mod clip_list;
mod jobs;
mod tag_menu;
mod tags;

use egui::{Align, Button, Layout, RichText, Role, TextEdit, Ui, WidgetInfo};
use motion_session::clip_rows::ClipRow;
use motion_session::command::Command;
use motion_session::palette::{palette_with_clips, tagged_clips};

use super::{empty_ui, heading_ui};
use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand as C;

/// The panel's own state.
#[derive(Debug, Default)]
pub struct LibraryPanel {
    wanted: String,
    /// Whether the report of the last import is open.
    report_is_open: bool,
}

impl LibraryPanel {
    /// The whole panel.
    pub fn ui(&mut self, ui: &mut Ui, state: &mut EditorState) {
        ui.horizontal(|ui| {
            heading_ui(ui, "Library", &count(state));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let palette = theme::of(ui);
                let button = Button::new("Import…").fill(palette.raised);
                if ui.add(button).on_hover_text(C::Import.tooltip()).clicked() {
                    state.ask(C::Import);
                }
            });
        });
        let palette = theme::of(ui);
        let hint = RichText::new("Find clips or tags").color(palette.faint);
        let field = TextEdit::singleline(&mut self.wanted)
            .hint_text(hint)
            .prefix(RichText::new(icons::SEARCH).font(theme::icon()).color(palette.faint))
            .align(egui::Align2::LEFT_CENTER)
            .desired_width(f32::INFINITY);
        let response = ui.add_sized([ui.available_width(), theme::ICON_BUTTON], field);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Find clips"));
        ui.add_space(theme::GRID);
        tags::tags_ui(ui, state);
        jobs::jobs_ui(ui, state, &mut self.report_is_open);
        let found: Vec<ClipRow> =
            state.clips.iter().filter(|clip| clip.matches(&self.wanted)).cloned().collect();
        if !self.wanted.trim().is_empty() {
            found_ui(ui, &found, state);
        }
        if state.clips.is_empty() {
            empty_ui(ui, "Clips stand here once the library is read. Drop BVH files on the window");
        } else if found.is_empty() {
            empty_ui(ui, "No clip has that in its name or tags");
        }
        clip_list::clip_list_ui(ui, &found, state);
        jobs::report_ui(ui, state, &mut self.report_is_open);
    }
}

/// Lets the search use what was found, or none of it, as one step.
fn found_ui(ui: &mut Ui, found: &[ClipRow], state: &mut EditorState) {
    let mut wanted = None;
    ui.horizontal(|ui| {
        for (words, on) in [("Use these", true), ("Use none of these", false)] {
            let changes = found.iter().any(|clip| clip.is_in_palette != on);
            let button = Button::new(RichText::new(words).font(theme::caption()));
            wanted = ui.add_enabled(changes, button).clicked().then_some(on).or(wanted);
        }
    });
    if let Some(on) = wanted {
        let ids: Vec<&str> = found.iter().map(|clip| clip.id.as_str()).collect();
        let clips = tagged_clips(&state.clips);
        let palette = palette_with_clips(state.session.document().palette(), &clips, &ids, on);
        state.apply(&Command::SetPalette { palette });
    }
}

/// How many clips there are, and how many of them may be used.
fn count(state: &EditorState) -> String {
    let n = state.clips.len();
    let n_used = state.clips.iter().filter(|clip| clip.is_in_palette).count();
    match (n, n_used) {
        (0, _) => String::new(),
        (1, 1) => "1 clip".to_owned(),
        (n, used) if n == used => format!("{n} clips"),
        (n, used) => format!("{used} of {n} clips"),
    }
}
