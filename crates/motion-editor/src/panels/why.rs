//! Why the shown take costs what it costs: what is missed at each constraint, and each cut.

use egui::{Align2, Color32, FontId, Pos2, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::live::SearchState;

use super::takes::score_text;
use super::{empty_ui, heading_ui};
use crate::icons;
use crate::reasons::{
    ConstraintReason, CutReason, constraint_reasons, cut_reasons, meeting_reasons,
};
use crate::state::EditorState;
use crate::theme;

/// A cost below this nobody needs to hear of.
const WORTH_A_WORD: f64 = 0.005;

/// The whole tab.
pub fn why_ui(ui: &mut Ui, state: &mut EditorState) {
    if let SearchState::Infeasible(sentence) | SearchState::Error(sentence) = state.search_state() {
        heading_ui(ui, "Cannot be met", "");
        let miss = theme::role(ColorRole::Miss, theme::of(ui).theme);
        ui.horizontal_wrapped(|ui| {
            ui.label(egui::RichText::new(icons::ALERT).font(theme::icon()).color(miss));
            ui.label(sentence);
        });
    }
    suggestions_ui(ui, state);
    let Some(card) = state.shown_card().cloned() else {
        empty_ui(
            ui,
            "What each constraint misses and each cut costs stands here, for the shown take",
        );
        remarks_ui(ui, state);
        return;
    };
    let weights = &state.session.document().search().weights;
    let stale = if card.is_stale { "for earlier constraints" } else { "the dearest first" };
    heading_ui(ui, "Constraints", stale);
    let mut reasons = constraint_reasons(&card, &state.marks, weights);
    let active = state.session.snapshot().character(state.session.active());
    let name = active.map_or("", |active| active.name.as_str());
    reasons.extend(meeting_reasons(&card, state.meetings(), name, weights));
    reasons.sort_by(|a, b| b.cost.total_cmp(&a.cost));
    if reasons.is_empty() {
        empty_ui(ui, "Nothing is asked yet; C and a press on the floor ask for a place");
    }
    for (nth, reason) in reasons.iter().enumerate() {
        let is_worst = nth == 0 && reason.cost > WORTH_A_WORD;
        let is_on = state.session.selection().contains(&reason.item);
        if constraint_ui(ui, reason, is_worst, is_on).clicked() {
            state.session.selection_mut().select(reason.item.clone());
            state.stop_at(reason.frame);
        }
    }
    heading_ui(ui, "Cuts", "the dearest first");
    let cuts = cut_reasons(&card);
    if cuts.is_empty() {
        empty_ui(ui, "It is one piece of one clip");
    }
    for (nth, cut) in cuts.iter().enumerate() {
        let is_worst = nth == 0 && cut.cost > WORTH_A_WORD;
        if cut_ui(ui, cut, is_worst).clicked() {
            state.stop_at(cut.frame);
        }
    }
    remarks_ui(ui, state);
}

/// What would help where something is missed: each was tried, and is one step to be undone.
fn suggestions_ui(ui: &mut Ui, state: &mut EditorState) {
    let character = state.session.active();
    let known = state.session.snapshot().character(character);
    let suggestions = known.map_or_else(Vec::new, |known| known.suggestions.clone());
    if suggestions.is_empty() {
        return;
    }
    heading_ui(ui, "What would help", "tried for real, the smallest change first");
    for suggestion in &suggestions {
        ui.horizontal_wrapped(|ui| {
            let button = ui.button("Apply");
            button.widget_info(|| {
                let label = format!("Apply: {}", suggestion.sentence);
                WidgetInfo::labeled(Role::Button, true, label)
            });
            ui.label(&suggestion.sentence);
            if button.clicked() {
                state.apply_all("Apply suggestion", &suggestion.commands);
            }
        });
    }
}

/// What is odd in what is asked, or cannot be.
fn remarks_ui(ui: &mut Ui, state: &EditorState) {
    if state.remarks().is_empty() {
        return;
    }
    heading_ui(ui, "To know", "");
    for sentence in state.remarks() {
        empty_ui(ui, sentence);
    }
}

fn constraint_ui(ui: &mut Ui, reason: &ConstraintReason, is_worst: bool, is_on: bool) -> Response {
    let (before, after) = (reason.before.as_deref(), reason.after.as_deref());
    let missed = match (before, after) {
        (None, _) => "not known yet".to_owned(),
        (Some("met"), _) => "met".to_owned(),
        (Some(before), Some("met")) => format!("{before} · met after correction"),
        (Some(before), Some(after)) if after != before => {
            let left = after.strip_prefix("miss ").unwrap_or(after);
            format!("{before} · {left} after correction")
        }
        (Some(before), _) => before.to_owned(),
    };
    let line = Line {
        title: format!("{} · f {}", reason.title, reason.frame),
        below: vec![reason.wish.clone(), missed],
        cost: reason.before.as_ref().map(|_| (reason.cost, reason.share)),
        is_worst,
        is_on,
    };
    line.ui(ui)
}

fn cut_ui(ui: &mut Ui, cut: &CutReason, is_worst: bool) -> Response {
    let bridge = if cut.is_bridge { " · a bridge between clips that are not alike" } else { "" };
    let line = Line {
        title: format!("Cut at f {}", cut.frame),
        below: vec![format!("{} → {}{bridge}", cut.from, cut.to)],
        cost: Some((cut.cost, cut.share)),
        is_worst,
        is_on: false,
    };
    line.ui(ui)
}

/// Something that costs.
struct Line {
    title: String,
    below: Vec<String>,
    /// What it adds to the score, and the share of it.
    cost: Option<(f64, f64)>,
    is_worst: bool,
    is_on: bool,
}

impl Line {
    fn ui(&self, ui: &mut Ui) -> Response {
        const ROW_PT: f32 = 16.0;
        let palette = theme::of(ui);
        let miss = theme::role(ColorRole::Miss, palette.theme);
        let width = ui.available_width();
        let galleys: Vec<_> = self
            .below
            .iter()
            .map(|words| {
                let (words, font) = (words.clone(), theme::caption());
                ui.fonts_mut(|fonts| fonts.layout(words, font, palette.faint, width - 16.0))
            })
            .collect();
        let height = ROW_PT + 6.0 + galleys.iter().map(|galley| galley.size().y + 2.0).sum::<f32>();
        let (rect, response) = ui.allocate_exact_size(Vec2::new(width, height), Sense::click());
        response
            .widget_info(|| WidgetInfo::selected(Role::ListItem, true, self.is_on, self.label()));
        if self.is_on || response.hovered() {
            let ground = if self.is_on { palette.accent_surface } else { palette.hovered };
            ui.painter().rect_filled(rect.expand2(Vec2::new(4.0, 0.0)), 3.0, ground);
        }
        if self.is_worst {
            let strip = Rect::from_min_size(rect.min - Vec2::new(4.0, 0.0), Vec2::new(3.0, height));
            ui.painter().rect_filled(strip, 1.0, miss);
        }
        let mut at = Pos2::new(rect.left() + 4.0, rect.top() + 3.0);
        let text = |at: Pos2, align, words: &str, font: FontId, color: Color32| {
            ui.painter().text(at, align, words, font, color)
        };
        let title = text(at, Align2::LEFT_TOP, &self.title, theme::body(), palette.text);
        if self.is_worst {
            let beside = title.right_center() + Vec2::new(8.0, 0.0);
            text(beside, Align2::LEFT_CENTER, "worst", theme::caption(), miss);
        }
        if let Some((cost, share)) = self.cost {
            let words = match cost < WORTH_A_WORD {
                true => "0".to_owned(),
                false => format!("{} · {:.0} %", score_text(cost), 100.0 * share),
            };
            let color = if self.is_worst { palette.text } else { palette.faint };
            let right = Pos2::new(rect.right(), at.y);
            text(right, Align2::RIGHT_TOP, &words, theme::body(), color);
        }
        at.y += ROW_PT;
        for galley in galleys {
            let height = galley.size().y;
            ui.painter().galley(at, galley, palette.faint);
            at.y += height + 2.0;
        }
        response
    }

    /// For tests and screen readers.
    fn label(&self) -> String {
        let cost = self.cost.map(|(cost, _)| format!(", costs {}", score_text(cost)));
        let worst = if self.is_worst { ", the worst" } else { "" };
        format!("{}: {}{}{worst}", self.title, self.below.join(", "), cost.unwrap_or_default())
    }
}
