//! What goes on in the background: a library that is opened or built, clips that are imported.

use egui::{
    Align, Align2, Button, Layout, ProgressBar, RichText, Role, ScrollArea, Ui, WidgetInfo, Window,
};
use motion_scene::color::ColorRole;
use motion_session::import_report::{ImportOutcome, ImportReport};
use motion_session::progress::JobProgress;
use motion_session::session::ImportState;

use crate::state::EditorState;
use crate::theme;

/// Progress with a way to stop it, and what came of it.
pub(super) fn jobs_ui(ui: &mut Ui, state: &mut EditorState, report_is_open: &mut bool) {
    if let ImportState::Running(progress) = state.session.import() {
        let progress = progress.clone();
        if progress_ui(ui, "Importing", &progress) {
            state.session.cancel_import();
        }
    } else if let Some(progress) = state.session.library_progress() {
        let progress = progress.clone();
        if progress_ui(ui, "Library", &progress) {
            state.session.cancel_library();
            state.refresh();
        }
    }
    if let Some(note) = state.session.library_note().map(str::to_owned) {
        note_ui(ui, &note);
        if ui.button("Open it again").clicked() {
            state.session.reopen_library();
        }
    }
    let outcome = match state.session.import() {
        ImportState::Cancelled => Some("The import was cancelled; nothing has changed".to_owned()),
        ImportState::Done(report) => Some(report.summary()),
        ImportState::Failed(why, _) => Some(why.clone()),
        ImportState::Idle | ImportState::Running(_) => None,
    };
    let Some(outcome) = outcome else { return };
    let has_report =
        matches!(state.session.import(), ImportState::Done(_) | ImportState::Failed(..));
    note_ui(ui, &outcome);
    ui.horizontal(|ui| {
        if has_report && ui.button("Report").clicked() {
            *report_is_open = true;
        }
        if ui.button("Dismiss").clicked() {
            state.session.dismiss_import();
            *report_is_open = false;
        }
    });
    ui.add_space(theme::GRID);
}

/// Gives whether it is to be stopped.
fn progress_ui(ui: &mut Ui, what: &str, progress: &JobProgress) -> bool {
    let palette = theme::of(ui);
    let mut cancelled = false;
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("{what}: {}", progress.stage)).font(theme::caption()));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let response = ui.add(Button::new("Cancel").fill(palette.raised));
            let label = format!("Cancel {}", what.to_lowercase());
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
            cancelled = response.clicked();
        });
    });
    let bar = ProgressBar::new(progress.share as f32).desired_height(5.0).fill(palette.accent);
    ui.add(bar);
    let eta = progress.eta_secs.map(eta_text);
    let counts = progress.counts.map(|counts| counts.to_string());
    let share = format!("{:.0} %", 100.0 * progress.share);
    let words: Vec<String> = [Some(share), counts, eta].into_iter().flatten().collect();
    ui.label(RichText::new(words.join(" · ")).font(theme::caption()).color(palette.faint));
    ui.add_space(theme::GRID);
    cancelled
}

fn eta_text(secs: f64) -> String {
    match secs.round() as u64 {
        0..=1 => "a second left".to_owned(),
        secs @ 2..=90 => format!("{secs} s left"),
        secs => format!("{} min left", (secs + 30) / 60),
    }
}

fn note_ui(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(theme::caption()).color(theme::of(ui).faint));
}

/// A line for every file of the last import.
pub(super) fn report_ui(ui: &Ui, state: &EditorState, is_open: &mut bool) {
    let report = match state.session.import() {
        ImportState::Done(report) | ImportState::Failed(_, report) => report,
        _ => return,
    };
    if !*is_open {
        return;
    }
    Window::new(RichText::new("Import report").font(theme::title()))
        .id(egui::Id::unique("import report"))
        .open(is_open)
        .collapsible(false)
        .default_size([640.0, 420.0])
        .pivot(Align2::CENTER_CENTER)
        .default_pos(ui.ctx().content_rect().center())
        .show(ui.ctx(), |ui| lines_ui(ui, report));
}

fn lines_ui(ui: &mut Ui, report: &ImportReport) {
    let palette = theme::of(ui);
    ui.label(report.summary());
    ui.horizontal(|ui| {
        if ui.add(Button::new("Copy report").fill(palette.hovered)).clicked() {
            ui.copy_text(report.text());
        }
    });
    ui.add_space(theme::GRID);
    let miss = theme::role(ColorRole::Miss, palette.theme);
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        for line in &report.lines {
            let is_refused = matches!(line.outcome, ImportOutcome::Refused(_));
            let color = if is_refused { miss } else { palette.text };
            ui.label(RichText::new(line.text()).font(theme::caption()).color(color));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_left_is_said_in_fitting_units() {
        for (secs, expected) in [
            (0.2, "a second left"),
            (12.4, "12 s left"),
            (100.0, "2 min left"),
            (3600.0, "60 min left"),
        ] {
            assert_eq!(eta_text(secs), expected);
        }
    }
}
