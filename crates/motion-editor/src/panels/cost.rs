//! What takes cost, side by side, and what the shown one's cost is made of.

use egui::{Align, Align2, Layout, Pos2, Rect, RichText, Role, Sense, Ui, Vec2, WidgetInfo};

use super::takes::cost_bar::{cost_bar_ui, term_colors};
use super::takes::{full_bar, score_text};
use super::{empty_ui, heading_ui};
use crate::reasons::as_cm;
use crate::state::EditorState;
use crate::take_card::{TERMS, TakeCard};
use crate::theme;
use crate::widgets::digits::tabular;

/// Room for a take's name, points.
const NAME_PT: f32 = 92.0;
/// Room for a number, points.
const NUMBER_PT: f32 = 44.0;

/// The whole tab.
pub fn cost_ui(ui: &mut Ui, state: &mut EditorState) {
    let Some(card) = state.shown_card().cloned() else {
        empty_ui(ui, "What the shown take costs stands here, as soon as there is one");
        return;
    };
    heading_ui(ui, &card.title(), "1 is 30 cm, 10° or 10 frames off");
    for (nth, (name, term)) in TERMS.iter().zip(card.terms).enumerate() {
        term_ui(ui, name, term, term_colors(&theme::of(ui))[nth], &words_of(nth, &card, state));
    }
    ui.add_space(theme::GRID);
    row_ui(ui, |ui| {
        ui.strong("In all");
        number_ui(ui, &score_text(card.score));
    });
    heading_ui(ui, "All takes", "");
    let worst = full_bar(&state.cards);
    let cards = state.cards.clone();
    for take in &cards {
        if take_ui(ui, take, worst, take.id == card.id) {
            state.show_take(take.id);
        }
    }
}

/// A term in words that need no table.
fn words_of(nth: usize, card: &TakeCard, state: &EditorState) -> String {
    let term = card.terms[nth];
    if term < 0.005 {
        return match nth {
            0 => "no cut is seen".to_owned(),
            1 => "as long as it shall be".to_owned(),
            2 => "every checkpoint is met".to_owned(),
            _ => "feet stand on the ground".to_owned(),
        };
    }
    match nth {
        0 => {
            let dearest = card.lane.cuts.iter().max_by(|a, b| a.cost.total_cmp(&b.cost));
            let at = dearest.map(|cut| format!(", the dearest at f {}", cut.frame));
            let n = card.lane.cuts.len();
            format!("{n} {}{}", if n == 1 { "cut" } else { "cuts" }, at.unwrap_or_default())
        }
        1 => {
            let character = state.session.document().character(state.session.active());
            let wished = character.and_then(|c| c.length.as_ref()?.frames);
            let wished = wished.map(|frames| format!(" instead of {frames}"));
            format!("{} f{}", card.n_frames(), wished.unwrap_or_default())
        }
        2 => format!("as one checkpoint {:.0} cm off", as_cm(term)),
        _ => "feet planted where nothing is".to_owned(),
    }
}

fn term_ui(ui: &mut Ui, name: &str, term: f64, color: egui::Color32, words: &str) {
    let faint = theme::of(ui).faint;
    row_ui(ui, |ui| {
        let (dot, _) = ui.allocate_exact_size(Vec2::splat(8.0), Sense::hover());
        ui.painter().circle_filled(dot.center(), 4.0, color);
        ui.label(name);
        ui.label(RichText::new(words).font(theme::caption()).color(faint));
        number_ui(ui, &score_text(term));
    });
}

/// A take's bar. Gives whether it was clicked.
fn take_ui(ui: &mut Ui, take: &TakeCard, worst: f64, is_shown: bool) -> bool {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT - theme::GRID);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let label = format!("Cost of {}: {}", take.title(), score_text(take.score));
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_shown, &label));
    if is_shown || response.hovered() {
        let ground = if is_shown { palette.accent_surface } else { palette.hovered };
        ui.painter().rect_filled(rect.expand2(Vec2::new(4.0, 0.0)), 3.0, ground);
    }
    let name = Rect::from_min_size(rect.min, Vec2::new(NAME_PT, rect.height()));
    let painter = ui.painter().with_clip_rect(name);
    painter.text(
        name.left_center(),
        Align2::LEFT_CENTER,
        take.title(),
        theme::caption(),
        palette.text,
    );
    let bar = Rect::from_x_y_ranges(
        name.right() + 4.0..=rect.right() - NUMBER_PT,
        rect.center().y - 3.0..=rect.center().y + 3.0,
    );
    cost_bar_ui(ui, bar, take.terms, worst);
    let job = tabular(ui, &score_text(take.score), &theme::caption(), palette.text);
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let at = Pos2::new(rect.right() - galley.size().x, rect.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, palette.text);
    response
        .on_hover_ui(|ui| {
            ui.strong(take.title());
            for (name, term) in TERMS.iter().zip(take.terms).filter(|(_, term)| *term > 0.005) {
                ui.label(format!("{name} {}", score_text(term)));
            }
        })
        .clicked()
}

fn row_ui(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let size = [ui.available_width(), theme::ROW_HEIGHT - theme::GRID].into();
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), add);
}

fn number_ui(ui: &mut Ui, number: &str) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let job = tabular(ui, number, &theme::body(), theme::of(ui).text);
        ui.label(job);
    });
}
