//! The takes: other motions under the same constraints, a card each.

pub mod card;
pub mod cost_bar;
pub mod menu;
pub mod mini;
pub mod minis;
pub mod rename;
pub mod sparkline;
pub mod way;

use egui::{Align, Layout, RichText, ScrollArea, Ui};
use motion_session::live::SearchState;

use super::empty_ui;
use super::inspector::field::row_ui;
use crate::icons;
use crate::state::{CompareMode, EditorState};
use crate::take_card::TakeCard;
use crate::theme;
use crate::ui_command::UiCommand;
use crate::viewport::canvas::Canvas;
use crate::viewport::described;
use crate::widgets::icon_button::icon_button_ui;
use card::Around;
pub use card::CardDrag;
use minis::Minis;
pub use sparkline::sparkline_ui;

/// A bar is full at so many times the best take's cost.
const FULL_BAR: f64 = 4.0;

/// The gallery's own state: pictures of takes.
#[derive(Debug, Default)]
pub struct TakesPanel {
    minis: Minis,
}

impl TakesPanel {
    /// Draws at most one picture that is missing and lets go of those of takes that are gone. To be
    /// called before anything of this frame is painted.
    pub fn keep_up(
        &mut self,
        ctx: &egui::Context,
        canvas: Option<&mut Canvas>,
        state: &EditorState,
    ) {
        // While something is dragged there is a new motion many times a second.
        let Some(canvas) = canvas.filter(|_| !state.is_in_gesture()) else { return };
        let (theme, scale) = (state.settings.theme, ctx.pixels_per_point());
        if self.minis.keep_up(&state.cards, state.shown(), canvas, theme, scale) {
            ctx.request_repaint();
        }
    }

    /// How many takes have a picture.
    pub fn n_minis(&self) -> usize {
        self.minis.len()
    }

    /// The whole panel. A click on a card shows its take at the same frame.
    pub fn ui(&self, ui: &mut Ui, state: &mut EditorState) {
        head_ui(ui, state);
        if state.cards.is_empty() {
            state.cards_are_held = false;
            match state.search_state() {
                SearchState::Infeasible(_) | SearchState::Error(_) => {
                    empty_ui(
                        ui,
                        "No take meets the constraints; the Why tab says what is in the way",
                    );
                }
                _ => empty_ui(ui, "The first takes stand here in a few seconds"),
            }
            return;
        }
        // Bars fill at some times the best: beyond that it does not matter how bad a take is.
        let worst = full_bar(&state.cards);
        let cards = state.cards.clone();
        let scrolled = ScrollArea::vertical().id_salt("takes").auto_shrink([false, true]);
        let scrolled = scrolled.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = theme::GRID;
            for take in &cards {
                let around = Around { worst, mini: self.minis.of(take, &cards) };
                card::card_ui(ui, take, &around, state);
            }
        });
        // A card that goes away under the pointer is clicked by mistake.
        let is_over = ui.rect_contains_pointer(scrolled.inner_rect);
        state.cards_are_held = is_over || state.renaming.is_some();
    }
}

/// The cost at which a bar is full.
pub fn full_bar(cards: &[TakeCard]) -> f64 {
    let scores = || cards.iter().map(|card| card.score).filter(|score| score.is_finite());
    let (best, worst) = (scores().fold(f64::INFINITY, f64::min), scores().fold(0.0, f64::max));
    worst.min((FULL_BAR * best).max(1.0)).max(f64::MIN_POSITIVE)
}

/// A score as it is said.
pub fn score_text(score: f64) -> String {
    match score {
        score if !score.is_finite() => "—".to_owned(),
        score if score < 10.0 => format!("{score:.2}"),
        score => format!("{score:.1}"),
    }
}

/// The heading, always as high: cards stay where they are when something better comes.
fn head_ui(ui: &mut Ui, state: &mut EditorState) {
    ui.add_space(2.0 * theme::GRID);
    row_ui(ui, |ui| {
        ui.label(RichText::new("Takes").font(theme::heading()));
        if !better_ui(ui, state) {
            let found = RichText::new(found_text(state)).font(theme::caption());
            ui.label(found.color(theme::of(ui).faint));
        }
        if state.cards.len() > 1 {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| compare_ui(ui, state));
        }
    });
    ui.add_space(theme::GRID);
}

fn found_text(state: &EditorState) -> String {
    let n_pinned = state.cards.iter().filter(|card| card.is_pinned).count();
    match (state.cards.len(), n_pinned) {
        (0, _) => String::new(),
        (n, 0) => format!("{n} found, the best first"),
        (n, pinned) => format!("{n} found, {pinned} pinned"),
    }
}

/// The buttons that show takes beside each other.
fn compare_ui(ui: &mut Ui, state: &mut EditorState) {
    ui.spacing_mut().item_spacing.x = 2.0;
    for (icon, command, mode) in [
        (icons::SPLIT, UiCommand::CompareSplit, CompareMode::Split),
        (icons::OVERLAY, UiCommand::Compare, CompareMode::Overlay),
    ] {
        let is_on = state.comparing.mode == mode;
        let tooltip = described(command);
        if icon_button_ui(ui, icon, &command.label(), &tooltip, is_on).clicked() {
            state.ask(command);
        }
    }
}

/// Says that there is something better, and shows it on a click: nothing is changed by itself.
/// Gives whether there is.
pub fn better_ui(ui: &mut Ui, state: &mut EditorState) -> bool {
    let Some((_, percent)) = state.better() else { return false };
    let palette = theme::of(ui);
    let text = RichText::new(better_text(percent)).font(theme::caption()).color(palette.text);
    let icon = RichText::new(icons::BETTER).font(theme::icon()).color(palette.accent);
    let button = egui::Button::new((icon, text)).fill(palette.accent_surface);
    let response = ui.add(button).on_hover_text(described(UiCommand::ShowBetter));
    let label = format!("Show the better take, {percent:.0} % lower cost");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
    if response.clicked() {
        state.ask(UiCommand::ShowBetter);
    }
    true
}

fn better_text(percent: f32) -> String {
    format!("Better: −{percent:.0} % · show")
}
