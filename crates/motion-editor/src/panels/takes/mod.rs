//! The takes: other motions under the same constraints.

use egui::{Align2, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::live::SearchState;

use super::{empty_ui, heading_ui};
use crate::mark::Mark;
use crate::state::EditorState;
use crate::take_card::{TERMS, TakeCard};
use crate::theme;

/// A bar is full at so many times the best take's cost.
const FULL_BAR: f64 = 4.0;
/// A card, points.
const CARD_PT: f32 = 64.0;

/// The whole panel. A click shows a take at the same frame.
pub fn takes_ui(ui: &mut Ui, state: &mut EditorState) {
    let n = state.cards.len();
    let beside = match n {
        0 => String::new(),
        1 => "1 found".to_owned(),
        n => format!("{n} found, the best first"),
    };
    heading_ui(ui, "Takes", &beside);
    if n == 0 {
        match state.search_state() {
            SearchState::Infeasible(_) | SearchState::Error(_) => {
                empty_ui(ui, "No take meets the constraints");
            }
            _ => empty_ui(ui, "The first takes stand here in a few seconds"),
        }
    }
    // Bars fill at some times the best: beyond that it does not matter how bad a take is.
    let best = state.cards.iter().map(|card| card.score).fold(f64::INFINITY, f64::min);
    let worst = state.cards.iter().map(|card| card.score).fold(f64::MIN_POSITIVE, f64::max);
    let worst = worst.min((FULL_BAR * best).max(1.0));
    let mut clicked = None;
    let shown = state.shown();
    for card in &state.cards {
        if card_ui(ui, card, &state.marks, worst, shown == Some(card.id)) {
            clicked = Some(card.id);
        }
    }
    // A card that goes away under the pointer is clicked by mistake.
    state.cards_are_held = ui.rect_contains_pointer(ui.min_rect());
    clicked.into_iter().for_each(|id| state.show_take(id));
}

fn card_ui(ui: &mut Ui, take: &TakeCard, marks: &[Mark], worst: f64, is_shown: bool) -> bool {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), CARD_PT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let lane = &take.lane;
    let label = format!("{}, cost {:.2}", take.title(), take.score);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_shown, &label));
    let ground = match (is_shown, response.hovered()) {
        (true, _) => palette.accent_surface,
        (false, true) => palette.hovered,
        (false, false) => palette.raised,
    };
    let painter = ui.painter();
    painter.rect_filled(rect, f32::from(theme::RADIUS), ground);
    if is_shown {
        let line = Stroke::new(1.0, palette.accent);
        painter.rect_stroke(rect, f32::from(theme::RADIUS), line, StrokeKind::Inside);
    }
    way_ui(ui, Rect::from_min_size(rect.min, Vec2::splat(CARD_PT)).shrink(6.0), take, marks);
    let left = rect.left() + CARD_PT + theme::GRID;
    let text = |x: f32, y: f32, align, words: String, font, color| {
        ui.painter().text(Pos2::new(x, rect.top() + y), align, words, font, color)
    };
    let right = rect.right() - 10.0;
    let title = take.title();
    text(left, 17.0, Align2::LEFT_CENTER, title, theme::heading(), palette.text);
    let score = format!("{:.2}", take.score);
    text(right, 17.0, Align2::RIGHT_CENTER, score, theme::body(), palette.text);
    let cuts = match lane.cuts.len() {
        1 => "1 cut".to_owned(),
        n => format!("{n} cuts"),
    };
    let slide = lane.foot_slide_cm_per_s.map(|cm| format!(" · slide {cm:.1} cm/s"));
    let about = format!("{} frames · {cuts}{}", take.n_frames(), slide.unwrap_or_default());
    text(left, 34.0, Align2::LEFT_CENTER, about, theme::caption(), palette.faint);
    let bar = Rect::from_x_y_ranges(left..=right, rect.top() + 48.0..=rect.top() + 53.0);
    cost_bar_ui(ui, bar, take.terms, worst);
    let response = response.on_hover_ui(|ui| {
        ui.strong(format!("{} costs {:.2}", take.title(), take.score));
        for (name, term) in TERMS.iter().zip(take.terms).filter(|(_, term)| *term > 0.005) {
            ui.label(format!("{name} {term:.2}"));
        }
    });
    response.clicked()
}

/// What a cost is made of, as wide as it is high beside the worst.
pub fn cost_bar_ui(ui: &Ui, bar: Rect, terms: [f64; 4], worst: f64) {
    let palette = theme::of(ui);
    ui.painter().rect_filled(bar, 2.0, palette.base);
    let mut left = bar.left();
    for (term, color) in terms.into_iter().zip(term_colors(&palette)) {
        let width = bar.width() * (term / worst).clamp(0.0, 1.0) as f32;
        if width < 0.5 {
            continue;
        }
        let right = (left + width).min(bar.right());
        let part = Rect::from_x_y_ranges(left..=right, bar.y_range());
        ui.painter().rect_filled(part, 2.0, color);
        left = right;
    }
}

/// The colours of [`TERMS`]: those of the things they speak of.
pub fn term_colors(palette: &theme::Palette) -> [egui::Color32; 4] {
    let role = |role| theme::role(role, palette.theme);
    [palette.faint, palette.text, role(ColorRole::Checkpoint), role(ColorRole::Obstacle)]
}

/// The way over the floor from above, with the checkpoints: what tells takes apart at a glance.
fn way_ui(ui: &Ui, room: Rect, take: &TakeCard, marks: &[Mark]) {
    let palette = theme::of(ui);
    // +X is the body's left; seen from above with +Z up, left is left.
    let flat = |x: f32, z: f32| Pos2::new(-x, -z);
    let way: Vec<Pos2> = take.actor.ground_path_m().iter().map(|p| flat(p.x, p.z)).collect();
    let marks: Vec<Pos2> = marks
        .iter()
        .filter_map(Mark::body)
        .map(|(at_m, _)| flat(at_m[0] as f32, at_m[1] as f32))
        .collect();
    let all = way.iter().chain(&marks).fold(Rect::NOTHING, |all, p| all.union(Rect::from_pos(*p)));
    let scale = (room.size() / all.size().max(Vec2::splat(0.5))).min_elem();
    let place = |p: &Pos2| room.center() + (*p - all.center()) * scale;
    let painter = ui.painter();
    let line: Vec<Pos2> = way.iter().step_by(4).chain(way.last()).map(place).collect();
    let color = theme::role(ColorRole::Take(take.hue), palette.theme);
    painter.add(egui::Shape::line(line, Stroke::new(2.0, color)));
    let orange = theme::role(ColorRole::Checkpoint, palette.theme);
    for mark in &marks {
        painter.circle_stroke(place(mark), 3.0, Stroke::new(1.5, orange));
    }
}
