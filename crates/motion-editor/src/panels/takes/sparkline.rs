//! The best cost over the rounds of the search, as a small step-shaped line.

use egui::{Pos2, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo};
use motion_session::live::BestAt;

use super::score_text;
use crate::theme;

/// So many of the last gains are told.
const N_TOLD: usize = 6;

/// The line; `n_rounds` are done.
pub fn sparkline_ui(ui: &mut Ui, size: Vec2, trace: &[BestAt], n_rounds: u64) -> Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Cost over time"));
    let palette = theme::of(ui);
    let shares = shares(trace, n_rounds);
    let place = |(x, y): (f32, f32)| {
        Pos2::new(rect.left() + x * rect.width(), rect.top() + y * rect.height())
    };
    let mut line: Vec<Pos2> = Vec::with_capacity(2 * shares.len() + 1);
    for (nth, share) in shares.iter().enumerate() {
        if let Some(before) = nth.checked_sub(1).and_then(|nth| shares.get(nth)) {
            line.push(place((share.0, before.1)));
        }
        line.push(place(*share));
    }
    if let Some(last) = shares.last() {
        line.push(place((1.0, last.1)));
        ui.painter().add(Shape::line(line, Stroke::new(1.25, palette.accent)));
    } else {
        ui.painter().hline(rect.x_range(), rect.bottom(), Stroke::new(1.0, palette.hairline));
    }
    response.on_hover_ui(|ui| {
        ui.strong("Best cost by round, since the last edit");
        if trace.is_empty() {
            ui.label("Nothing found yet");
        }
        let from = trace.len().saturating_sub(N_TOLD);
        for at in &trace[from..] {
            ui.label(format!("Round {}: {}", at.iteration, score_text(f64::from(at.best))));
        }
        ui.label(format!("{n_rounds} rounds done"));
    })
}

/// Points within a unit square, y down. Both axes are logarithmic: half the cost is the same step
/// everywhere, and the first rounds, in which most happens, have room.
fn shares(trace: &[BestAt], n_rounds: u64) -> Vec<(f32, f32)> {
    let (Some(first), Some(last)) = (trace.first(), trace.last()) else { return Vec::new() };
    let begin = first.iteration;
    let log = |best: f32| best.max(1e-3).ln();
    let (top, bottom) = (log(first.best), log(last.best));
    let since = |iteration: u64| (iteration.saturating_sub(begin) as f32).ln_1p();
    let whole = since(n_rounds.max(last.iteration)).max(1e-3);
    let height = (top - bottom).max(1e-3);
    trace.iter().map(|at| (since(at.iteration) / whole, (top - log(at.best)) / height)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_goes_from_the_upper_left_down_and_half_the_cost_is_one_step() {
        let at = |iteration, best| BestAt { iteration, best };
        let found = shares(&[at(5, 16.0), at(6, 8.0), at(20, 4.0), at(40, 4.0)], 400);
        assert_eq!(found[0], (0.0, 0.0));
        assert!((found[1].1 - 0.5).abs() < 1e-5 && (found[2].1 - 1.0).abs() < 1e-5, "{found:?}");
        assert!(found.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[1].0 < 1.0));
        for trace in [&[][..], &[at(1, 0.0)], &[at(9, 3.0)]] {
            let found = shares(trace, 0);
            assert_eq!(found.len(), trace.len());
            assert!(found.iter().all(|(x, y)| x.is_finite() && y.is_finite()), "{found:?}");
        }
    }
}
