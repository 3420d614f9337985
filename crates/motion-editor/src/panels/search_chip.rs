//! How the search stands, in a few words, a line and two buttons.

use egui::{Align2, Color32, FontId, RichText, Sense, Ui, Vec2};
use motion_scene::color::ColorRole;
use motion_session::live::SearchState;

use super::right_tab::RightTab;
use super::takes::{better_ui, score_text, sparkline_ui};
use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand as C;
use crate::viewport::described;
use crate::widgets::icon_button::icon_button_ui;

/// Cost over time, points.
const SPARKLINE_PT: Vec2 = Vec2::new(56.0, 16.0);
/// A gain longer ago than this is not told.
const OLD_NEWS_SECS: f64 = 3600.0;

/// The chip, from right to left.
pub fn search_chip_ui(ui: &mut Ui, state: &mut EditorState) {
    ui.spacing_mut().item_spacing.x = 2.0;
    let is_paused = state.session.is_search_paused();
    let (icon, words) = if is_paused { (icons::PLAY, "Resume") } else { (icons::PAUSE, "Pause") };
    for (icon, command, label) in [
        (icons::SHAKE, C::Shake, C::Shake.label()),
        (icon, C::PauseSearch, format!("{words} the search")),
    ] {
        let tooltip = described(command);
        if icon_button_ui(ui, icon, &label, &tooltip, false).clicked() {
            state.ask(command);
        }
    }
    ui.add_space(theme::GRID);
    // Beside the takes it stands over them. The words are of another length every second: left of
    // them it would run away from the pointer.
    if !state.settings.right.open && better_ui(ui, state) {
        ui.add_space(theme::GRID);
    }
    let active = state.session.snapshot().character(state.session.active());
    if let Some(found) = active {
        sparkline_ui(ui, SPARKLINE_PT, &found.trace, found.iterations);
        ui.add_space(theme::GRID);
    }
    words_ui(ui, state);
}

/// What is said, with a sign before it.
fn words_ui(ui: &mut Ui, state: &mut EditorState) {
    let palette = theme::of(ui);
    let miss = theme::role(ColorRole::Miss, palette.theme);
    let search = state.search_state();
    let (icon, color): (&str, Color32) = match &search {
        SearchState::Infeasible(_) | SearchState::Error(_) => (icons::ALERT, miss),
        SearchState::Paused => (icons::PAUSE, palette.faint),
        SearchState::Settled => (icons::DONE, palette.faint),
        _ => (icons::WORKING, palette.accent),
    };
    let reason = match &search {
        SearchState::Infeasible(sentence) | SearchState::Error(sentence) => Some(sentence.clone()),
        _ => None,
    };
    let text = RichText::new(words(&search, state)).font(theme::caption()).color(palette.text);
    let sense = if reason.is_some() { Sense::click() } else { Sense::hover() };
    let response = ui.add(egui::Label::new(text).selectable(false).sense(sense));
    if let Some(sentence) = reason {
        let response = response
            .on_hover_cursor(egui::CursorIcon::PointingHand)
            .on_hover_text(format!("{sentence}\nClick for the reasons"));
        if response.clicked() {
            state.right_tab = RightTab::Why;
            state.settings.right.open = true;
        }
    }
    let (place, _) = ui.allocate_exact_size(Vec2::splat(theme::ICON), Sense::hover());
    let font = FontId { size: 14.0, ..theme::icon() };
    ui.painter().text(place.center(), Align2::CENTER_CENTER, icon, font, color);
}

fn words(search: &SearchState, state: &EditorState) -> String {
    let best = state.cards.iter().map(|card| card.score).fold(f64::INFINITY, f64::min);
    let n = state.cards.len();
    let takes = if n == 1 { "take" } else { "takes" };
    let found = if n == 0 {
        String::new()
    } else {
        format!(" · best {} · {n} {takes}", score_text(best))
    };
    let since = state.since_gain_secs().filter(|secs| n > 0 && *secs < OLD_NEWS_SECS);
    let gain = since.map(|secs| format!(" · last gain {}", ago(secs))).unwrap_or_default();
    match search {
        SearchState::NoGraph => "No library".to_owned(),
        SearchState::Building { what, share } if what.is_empty() => {
            format!("Building · {:.0} %", share * 100.0)
        }
        SearchState::Building { what, share } => {
            format!("Building · {what} · {:.0} %", share * 100.0)
        }
        SearchState::Ready => "Ready".to_owned(),
        SearchState::Searching => format!("Searching{found}{gain}"),
        SearchState::Paused => format!("Paused{found}"),
        SearchState::Settled => format!("Settled{found}"),
        SearchState::Infeasible(_) => format!("Cannot be met{found}"),
        SearchState::Error(_) => "No search".to_owned(),
    }
}

/// How long ago, in the unit that says it shortest.
fn ago(secs: f64) -> String {
    if secs < 60.0 { format!("{secs:.0} s ago") } else { format!("{:.0} min ago", secs / 60.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_long_ago_has_a_unit() {
        for (secs, expected) in
            [(0.2, "0 s ago"), (2.4, "2 s ago"), (59.0, "59 s ago"), (150.0, "2 min ago")]
        {
            assert_eq!(ago(secs), expected);
        }
    }
}
