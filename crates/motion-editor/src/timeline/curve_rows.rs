//! Curves below the rows, with their value at the playhead.

use std::sync::Arc;

use egui::{Align2, Pos2, Rect, Role, Sense, Shape, Stroke, WidgetInfo};
use motion_scene::color::ColorRole;

use super::curves::{Curve, path_errors_m};
use super::sheet::Sheet;
use crate::state::EditorState;
use crate::take_card::Lane;
use crate::theme;

/// Distances from drawn paths, kept as long as neither motion nor paths change.
#[derive(Debug, Default)]
pub struct PathErrors {
    of: Option<(Arc<Lane>, Vec<crate::mark::Mark>)>,
    errors_m: Arc<Vec<f32>>,
}

impl PathErrors {
    /// The distances of the shown motion, metres.
    pub fn of_shown(&mut self, state: &EditorState) -> Arc<Vec<f32>> {
        let Some(card) = state.shown_card().filter(|_| state.settings.curves_open) else {
            return Arc::default();
        };
        let is_same = self
            .of
            .as_ref()
            .is_some_and(|(lane, marks)| Arc::ptr_eq(lane, &card.lane) && *marks == state.marks);
        if !is_same {
            let root_m = card.actor.motion.root_positions_m();
            self.errors_m = Arc::new(path_errors_m(root_m, &state.marks));
            self.of = Some((Arc::clone(&card.lane), state.marks.clone()));
        }
        Arc::clone(&self.errors_m)
    }
}

/// A curve, or the stems of misses.
pub fn curve_row_ui(sheet: &mut Sheet<'_>, curve: Curve, row: Rect, path_errors_m: &[f32]) {
    let Some(card) = sheet.state.shown_card() else { return };
    let lane = Arc::clone(&card.lane);
    if sheet.seen(row).is_none() {
        return;
    }
    let values: &[f32] = match curve {
        Curve::Miss => return stems_ui(sheet, row),
        Curve::Speed => &lane.speed_m_s,
        Curve::Turn => &lane.turn_deg_s,
        Curve::Path => path_errors_m,
    };
    let top = values.iter().map(|value| value.abs()).filter(|value| value.is_finite());
    let top = top.fold(curve.least_top(), f32::max);
    let (low, high) = match curve {
        Curve::Turn => (row.center().y, row.top() + 2.0),
        _ => (row.bottom() - 2.0, row.top() + 2.0),
    };
    let palette = sheet.palette;
    let painter = sheet.painter();
    let line = Stroke::new(1.0, palette.hairline);
    painter.hline(row.x_range(), low, line);
    let y = |value: f32| low + (high - low) * (value / top);
    let color = match curve {
        Curve::Path => theme::role(ColorRole::Checkpoint, palette.theme),
        _ => palette.faint,
    };
    // A point for every point of the screen at most: the largest of its frames, so that no peak is
    // lost.
    let step = (1.0 / sheet.axis.pt_per_frame).ceil().max(1.0) as usize;
    let first = sheet.axis.first.max(0.0) as usize / step * step;
    let last = (sheet.axis.last_in_view().max(0.0) as usize + step).min(values.len());
    let mut points: Vec<Pos2> = Vec::new();
    for from in (first..last).step_by(step) {
        let bucket = &values[from..(from + step).min(values.len())];
        let value = bucket
            .iter()
            .copied()
            .fold(f32::NAN, |a, b| if b.abs() > a.abs() || a.is_nan() { b } else { a });
        if value.is_nan() {
            let done = std::mem::take(&mut points);
            painter.add(Shape::line(done, Stroke::new(1.25, color)));
            continue;
        }
        points.push(Pos2::new(sheet.axis.x_of(from as f64), y(value)));
    }
    painter.add(Shape::line(points, Stroke::new(1.25, color)));
    let now = values.get(sheet.state.frame_number()).copied().filter(|value| value.is_finite());
    if let Some(value) = now {
        let at = Pos2::new(sheet.axis.x_of(sheet.state.frame()), y(value));
        painter.circle_filled(at, 2.5, palette.accent);
    }
    let id = sheet.ui.scope_id().with(("curve", curve.name()));
    let Some(seen) = sheet.seen(row) else { return };
    let response = sheet.ui.interact(seen, id, Sense::hover());
    let said = || match now {
        Some(value) => format!("{} curve, {} at the playhead", curve.name(), curve.text(value)),
        None => format!("{} curve", curve.name()),
    };
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said()));
    if let Some(at) = response.hover_pos() {
        let frame = sheet.axis.frame_at(at.x).round().max(0.0) as usize;
        if let Some(value) = values.get(frame).filter(|value| value.is_finite()) {
            response.on_hover_text_at_pointer(format!("f {frame}  {}", curve.text(*value)));
        }
    }
}

/// The value of a curve at the playhead, in words.
pub fn value_text(state: &EditorState, curve: Curve, path_errors_m: &[f32]) -> Option<String> {
    let lane = &state.shown_card()?.lane;
    let values: &[f32] = match curve {
        Curve::Miss => return None,
        Curve::Speed => &lane.speed_m_s,
        Curve::Turn => &lane.turn_deg_s,
        Curve::Path => path_errors_m,
    };
    let value = values.get(state.frame_number()).filter(|value| value.is_finite())?;
    Some(curve.text(*value))
}

/// A stem at each constraint, as high as the motion is off in place.
fn stems_ui(sheet: &Sheet<'_>, row: Rect) {
    let palette = sheet.palette;
    let painter = sheet.painter();
    painter.hline(row.x_range(), row.bottom() - 2.0, Stroke::new(1.0, palette.hairline));
    let off_m = |mark: &crate::mark::Mark| {
        mark.miss.as_ref().and_then(|miss| miss.position_error_m).unwrap_or_default() as f32
    };
    let top = sheet.state.marks.iter().map(off_m).fold(Curve::Miss.least_top(), f32::max);
    let miss = theme::role(ColorRole::Miss, palette.theme);
    for mark in sheet.state.marks.iter().filter(|mark| mark.miss.is_some()) {
        let x = sheet.axis.x_of(mark.frame() as f64);
        let color = if mark.is_off() { miss } else { palette.faint };
        let height = (row.height() - 6.0) * off_m(mark) / top;
        let y = row.bottom() - 2.0 - height;
        painter.vline(x, y..=row.bottom() - 2.0, Stroke::new(1.5, color));
        painter.circle_filled(Pos2::new(x, y), 2.5, color);
        if mark.is_off() {
            let text = mark.miss_text();
            let text = text.strip_prefix("miss ").unwrap_or(&text);
            let at = Pos2::new(x + 6.0, y.min(row.bottom() - 8.0));
            painter.text(at, Align2::LEFT_CENTER, text, theme::caption(), miss);
        }
    }
}
