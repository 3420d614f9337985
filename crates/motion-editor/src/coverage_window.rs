//! What the library can do and what it cannot, on one page.

use std::sync::Arc;

use egui::{
    Align, Align2, Button, Grid, Layout, Rect, RichText, Role, ScrollArea, Sense, Ui, Vec2,
    WidgetInfo, Window,
};
use motion_core::coverage::{SpeedClass, TurnClass};
use motion_scene::color::ColorRole;
use motion_session::coverage_job::CoverageJob;
use motion_session::coverage_report::{CoverageReport, cell_text};

use crate::state::EditorState;
use crate::theme;

/// The page and the report on it.
#[derive(Debug, Default)]
pub struct CoverageWindow {
    /// Whether it is shown.
    pub is_open: bool,
    job: CoverageJob,
}

impl CoverageWindow {
    /// Draws the page while it is open.
    pub fn ui(&mut self, ui: &Ui, state: &EditorState) {
        if !self.is_open {
            return;
        }
        if let Some(library) = state.session.library() {
            let ctx = ui.ctx().clone();
            let wake: motion_session::live::Wake = Arc::new(move || ctx.request_repaint());
            self.job.want(library, &wake);
        }
        let job = &mut self.job;
        Window::new(RichText::new("Coverage").font(theme::title()))
            .id(egui::Id::unique("coverage"))
            .open(&mut self.is_open)
            .collapsible(false)
            .default_size([600.0, 560.0])
            .pivot(Align2::CENTER_CENTER)
            .default_pos(ui.ctx().content_rect().center())
            .show(ui.ctx(), |ui| match job.report() {
                Some(report) => report_ui(ui, report),
                None => drop(faint(ui, "What the library can do will stand here once it is read")),
            });
    }
}

fn faint(ui: &mut Ui, text: &str) -> egui::Response {
    ui.label(RichText::new(text).font(theme::caption()).color(theme::of(ui).faint))
}

fn report_ui(ui: &mut Ui, report: &CoverageReport) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let (right, left) = (report.fastest_right_turn_deg_s, report.fastest_left_turn_deg_s);
        ui.label(format!(
            "{} clips, {:.1} minutes. Speeds up to {:.1} m/s, turns up to {left:.0}°/s to the left \
             and {right:.0}°/s to the right",
            report.clips,
            report.seconds / 60.0,
            report.fastest_m_s
        ));
        ui.label(format!("Heights: {}", report.heights_text()));
        ui.label(format!("Parts that hang together: {}", report.parts_text()));
        heading_ui(ui, "To record");
        capture_ui(ui, &report.capture_list);
        heading_ui(ui, "Seconds of each speed with each turn");
        cells_ui(ui, report);
        if !report.tags.is_empty() {
            heading_ui(ui, "Found in the motions");
            tags_ui(ui, report);
        }
        heading_ui(ui, "Dead ends");
        dead_ends_ui(ui, report);
    });
}

fn heading_ui(ui: &mut Ui, text: &str) {
    ui.add_space(3.0 * theme::GRID);
    ui.label(RichText::new(text).font(theme::heading()));
}

fn capture_ui(ui: &mut Ui, list: &[String]) {
    if list.is_empty() {
        faint(ui, "Nothing that this page looks for is missing");
        return;
    }
    for wish in list {
        let (what, record) = wish.split_once(": ").unwrap_or((wish, ""));
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(capitalized(what)).strong());
            ui.label(RichText::new(record).color(theme::of(ui).faint));
        });
    }
    ui.with_layout(Layout::left_to_right(Align::Min), |ui| {
        if ui.add(Button::new("Copy list").fill(theme::of(ui).raised)).clicked() {
            ui.copy_text(list.join("\n"));
        }
    });
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

/// A table whose cells are the darker the more there is; what is missing is outlined.
fn cells_ui(ui: &mut Ui, report: &CoverageReport) {
    const CELL: Vec2 = Vec2::new(84.0, 24.0);
    let palette = theme::of(ui);
    let most = report.speeds_and_turns.iter().map(|cell| cell.seconds).fold(1.0, f64::max);
    let miss = theme::role(ColorRole::Miss, palette.theme);
    Grid::new("coverage cells").spacing([2.0, 2.0]).show(ui, |ui| {
        ui.label("");
        for turn in TurnClass::ALL {
            faint(ui, turn.name());
        }
        ui.end_row();
        for speed in SpeedClass::ALL {
            let from = speed.from_m_s();
            ui.label(RichText::new(speed.name()).font(theme::caption()))
                .on_hover_text(format!("From {from:.1} m/s"));
            for turn in TurnClass::ALL {
                let secs = report.secs(speed, turn);
                let (rect, response) = ui.allocate_exact_size(CELL, Sense::hover());
                let text = cell_text(secs);
                let label = format!("{}, {}: {text} s", speed.name(), turn.name());
                response.widget_info(|| WidgetInfo::labeled(Role::Cell, true, &label));
                // A tenth of the most is a good deal.
                let share = (secs / most).sqrt() as f32;
                cell_ui(ui, rect, share, &text, miss);
                response.on_hover_text(label);
            }
            ui.end_row();
        }
    });
}

fn cell_ui(ui: &Ui, rect: Rect, share: f32, text: &str, miss: egui::Color32) {
    let palette = theme::of(ui);
    let radius = f32::from(theme::RADIUS);
    let is_empty = text == "–";
    let fill = theme::over(palette.panel, palette.accent, 0.6 * share);
    ui.painter().rect_filled(rect, radius, if is_empty { palette.base } else { fill });
    let color = if is_empty { miss } else { palette.text };
    let middle = rect.center();
    ui.painter().text(middle, Align2::CENTER_CENTER, text, theme::caption(), color);
}

fn tags_ui(ui: &mut Ui, report: &CoverageReport) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0 * theme::GRID;
        for tag in &report.tags {
            let color = if tag.clips == 0 { theme::of(ui).faint } else { theme::of(ui).text };
            let text = format!("{} {:.1} s", tag.tag, tag.seconds);
            ui.label(RichText::new(text).color(color))
                .on_hover_text(format!("In {} clips", tag.clips));
        }
    });
}

fn dead_ends_ui(ui: &mut Ui, report: &CoverageReport) {
    if report.dead_ends.is_empty() {
        faint(ui, "From every frame the search can go on");
    }
    for end in &report.dead_ends {
        let frames = if end.frames == 1 { "frame" } else { "frames" };
        ui.label(format!(
            "{}: nothing leads out of its last {} {frames}, from frame {} on",
            end.clip, end.frames, end.from
        ));
    }
    if !report.on_bridges.is_empty() {
        faint(ui, &format!("Only bridges join: {}", report.on_bridges.join(", ")));
    }
}
