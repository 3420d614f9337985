//! Questions that must be answered before anything else.

use egui::{Align, Button, Id, Key, Layout, Modal, RichText, Ui};

use super::FileFlow;
use crate::state::EditorState;
use crate::theme;
use crate::widgets::dialog_frame;

const WIDTH_PT: f32 = 420.0;

impl FileFlow {
    /// Draws what asks, if anything does.
    pub fn ui(&mut self, ui: &Ui, state: &mut EditorState) {
        self.dialogs.ui(ui);
        if self.dialogs.is_open() {
            return;
        }
        if self.recoveries.is_empty() {
            self.guard_ui(ui, state);
        } else {
            self.recovery_ui(ui, state);
        }
    }

    fn guard_ui(&mut self, ui: &Ui, state: &mut EditorState) {
        let Some(next) = self.guarded.clone() else { return };
        let mut chosen = None;
        let name = state.session.document().name().to_owned();
        let modal =
            Modal::new(Id::unique("unsaved work")).frame(dialog_frame(ui)).show(ui.ctx(), |ui| {
                ui.set_width(WIDTH_PT);
                ui.label(RichText::new(next.question()).font(theme::title()));
                ui.add_space(theme::GRID);
                let text = format!("“{name}” has changes that are in no file.");
                ui.label(RichText::new(text).color(theme::of(ui).faint));
                ui.add_space(4.0 * theme::GRID);
                buttons_ui(ui, &["Save", "Discard changes", "Cancel"], &mut chosen);
            });
        let escaped = modal.should_close() || ui.input(|input| input.key_pressed(Key::Escape));
        match chosen {
            Some(0) => {
                self.guarded = None;
                self.save(Some(next), state, ui.ctx());
            }
            Some(1) => {
                self.guarded = None;
                self.go(next, state, ui.ctx());
            }
            Some(_) => self.guarded = None,
            None if escaped => self.guarded = None,
            None => {}
        }
    }

    fn recovery_ui(&mut self, ui: &Ui, state: &mut EditorState) {
        let Some(recovery) = self.recoveries.first().cloned() else { return };
        let mut chosen = None;
        Modal::new(Id::unique("recovered work")).frame(dialog_frame(ui)).show(ui.ctx(), |ui| {
            ui.set_width(WIDTH_PT);
            ui.label(RichText::new("Go on with unsaved work?").font(theme::title()));
            ui.add_space(theme::GRID);
            let of = recovery.file.as_ref().map_or("in no file yet".to_owned(), |file| {
                format!("changes of {}", file.display())
            });
            let when = ago(&recovery.autosave).map(|ago| format!(", kept {ago}"));
            let text = format!(
                "“{}”, {of}{}. The program ended before it was saved.",
                recovery.project.name,
                when.unwrap_or_default()
            );
            ui.label(RichText::new(text).color(theme::of(ui).faint));
            if recovery.file_is_newer {
                let text = "The file was saved later than that.";
                ui.label(RichText::new(text).color(theme::of(ui).text));
            }
            ui.add_space(4.0 * theme::GRID);
            buttons_ui(ui, &["Restore", "Discard", "Ask me later"], &mut chosen);
        });
        match chosen {
            Some(0) => {
                match state.session.recover(&recovery) {
                    Ok(()) => {
                        state.begin_again();
                        state.notices.tell("Restored; save it to keep it");
                    }
                    Err(error) => state.notices.refuse(error.to_string()),
                }
                // What else was left is offered the next time: there is one project at a time.
                self.recoveries.clear();
            }
            Some(1) => {
                state.session.discard(&recovery);
                self.recoveries.remove(0);
            }
            Some(_) => self.recoveries.clear(),
            None => {}
        }
    }
}

/// Buttons from the right; the first is the one that Enter means.
fn buttons_ui(ui: &mut Ui, labels: &[&str], chosen: &mut Option<usize>) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        for (nth, label) in labels.iter().enumerate() {
            let palette = theme::of(ui);
            let button = match nth {
                0 => Button::new(RichText::new(*label).color(palette.base)).fill(palette.accent),
                _ => Button::new(*label).fill(palette.hovered),
            };
            if ui.add(button.min_size([96.0, 28.0].into())).clicked() {
                *chosen = Some(nth);
            }
        }
    });
    if ui.input(|input| input.key_pressed(Key::Enter)) && chosen.is_none() {
        *chosen = Some(0);
    }
}

/// How long ago a file was written, in words.
fn ago(path: &std::path::Path) -> Option<String> {
    let written = std::fs::metadata(path).ok()?.modified().ok()?;
    let secs = written.elapsed().ok()?.as_secs();
    Some(match secs {
        0..=90 => "a minute ago".to_owned(),
        91..=5400 => format!("{} minutes ago", (secs + 30) / 60),
        5401..=129_600 => format!("{} hours ago", (secs + 1800) / 3600),
        _ => format!("{} days ago", (secs + 43_200) / 86_400),
    })
}
