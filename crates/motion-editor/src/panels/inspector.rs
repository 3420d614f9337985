//! What is selected, in numbers; the shown take where nothing is.

use egui::{Align, Layout, RichText, Ui};

use super::{empty_ui, heading_ui, takes};
use crate::mark::Mark;
use crate::state::EditorState;
use crate::take_card::{TERMS, TakeCard};
use crate::theme;
use crate::widgets::digits::tabular;

/// The whole panel.
pub fn inspector_ui(ui: &mut Ui, state: &EditorState) {
    if let Some(mark) = state.selected_mark() {
        heading_ui(ui, &mark.title(), "");
        mark_ui(ui, mark, state.fps());
    } else if let Some(card) = state.shown_card() {
        heading_ui(ui, "Cost", "1 is 30 cm, 10° or 10 frames off");
        cost_ui(ui, card);
    } else {
        heading_ui(ui, "Inspector", "");
        empty_ui(ui, "Click a checkpoint, in the view or on the timeline");
    }
    let remarks = state.remarks();
    if !remarks.is_empty() {
        ui.add_space(2.0 * theme::GRID);
        heading_ui(ui, "What could not be met", "");
        for sentence in remarks {
            empty_ui(ui, sentence);
        }
    }
}

fn mark_ui(ui: &mut Ui, mark: &Mark, fps: f64) {
    let frame = format!("f {}  ({:.2} s)", mark.frame(), mark.frame() as f64 / fps);
    line_ui(ui, "Frame", &frame);
    if let Some((at_m, heading)) = mark.body() {
        line_ui(ui, "Place", &format!("x {:.2} m   z {:.2} m", at_m[0], at_m[1]));
        let heading = heading.map_or("any".to_owned(), |deg| format!("{deg:.0}°"));
        line_ui(ui, "Heading", &heading);
    }
    line_ui(ui, "Shown take", &mark.miss_text());
}

fn cost_ui(ui: &mut Ui, card: &TakeCard) {
    let palette = theme::of(ui);
    let colors = takes::cost_bar::term_colors(&palette);
    for ((name, term), color) in TERMS.iter().zip(card.terms).zip(colors) {
        if term < 0.005 {
            continue;
        }
        row_ui(ui, |ui| {
            let (dot, _) = ui.allocate_exact_size([8.0, 8.0].into(), egui::Sense::hover());
            ui.painter().circle_filled(dot.center(), 4.0, color);
            ui.label(*name);
            value_ui(ui, &format!("{term:.2}"));
        });
    }
    line_ui(ui, "In all", &format!("{:.2}", card.score));
}

fn line_ui(ui: &mut Ui, name: &str, value: &str) {
    row_ui(ui, |ui| {
        ui.label(RichText::new(name).color(theme::of(ui).faint));
        value_ui(ui, value);
    });
}

fn row_ui(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let size = [ui.available_width(), theme::ROW_HEIGHT - theme::GRID].into();
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), add);
}

fn value_ui(ui: &mut Ui, value: &str) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let job = tabular(ui, value, &theme::body(), theme::of(ui).text);
        ui.label(job);
    });
}
