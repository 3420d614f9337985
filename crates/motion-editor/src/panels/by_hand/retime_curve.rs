//! The timing of the shown take as a curve whose knots are dragged.

use egui::{
    CursorIcon, Id, PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2,
    WidgetInfo,
};
use motion_core::by_hand::{Knot, Retime};
use motion_scene::color::ColorRole;
use motion_session::command::Command;
use motion_session::document::StoredTake;

use super::plot::Plot;
use crate::state::EditorState;
use crate::theme;

/// What tests and screen readers call it.
pub const LABEL: &str = "Timing curve";
/// A knot can be taken so far from its middle, points.
const REACH_PT: f32 = 9.0;
/// How high it is, points.
const HEIGHT_PT: f32 = 190.0;
/// A press that moves less than this moves nothing, points.
const THRESHOLD_PT: f32 = 3.0;

/// A knot on its way. The plot stays as it was, so that the curve does not run away.
#[derive(Clone, Debug)]
struct KnotDrag {
    take: StoredTake,
    knots: Vec<Knot>,
    nth: usize,
    plot: Plot,
}

/// The plot.
pub fn retime_curve_ui(ui: &mut Ui, state: &mut EditorState) {
    let size = Vec2::new(ui.available_width(), HEIGHT_PT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, LABEL));
    let retime = state.hand_layer().map(|layer| layer.retime().clone()).unwrap_or_default();
    let n_source = state.n_source_frames();
    let frames = retime.source_frames(n_source);
    let drag_id = Id::unique("knot on its way");
    let mut drag = ui.data(|data| data.get_temp::<KnotDrag>(drag_id));
    let plot = match &drag {
        Some(drag) => drag.plot,
        None => Plot::new(rect.shrink(8.0), frames.len(), n_source),
    };
    curve_ui(ui, rect, &plot, &frames, state);
    if retime.is_identity() {
        let words = "Double-click the line for a knot, drag it to bend the timing";
        let at = rect.right_bottom() - Vec2::new(10.0, 10.0);
        let color = theme::of(ui).faint;
        let font = theme::caption();
        let width = 0.55 * rect.width();
        let galley = ui.fonts_mut(|fonts| fonts.layout(words.to_owned(), font, color, width));
        ui.painter().galley(at - galley.size(), galley, color);
    }
    for nth in 0..retime.knots().len() {
        knot_ui(ui, &response, (&plot, &retime, nth), &mut drag, state);
    }
    follow(ui, &mut drag, state);
    ui.data_mut(|data| match drag.clone() {
        Some(drag) => drop(data.insert_temp(drag_id, drag)),
        None => data.remove::<KnotDrag>(drag_id),
    });
    if drag.is_none() && response.double_clicked() {
        let at = response.interact_pointer_pos().unwrap_or(rect.center());
        add_knot(&plot, &retime, &frames, at, state);
    } else if response.clicked() {
        state.selected_knot = None;
    }
    response.on_hover_text_at_pointer("Double-click: a knot · right click on one: away with it");
}

/// Everything but the knots.
fn curve_ui(ui: &Ui, rect: Rect, plot: &Plot, frames: &[f64], state: &EditorState) {
    let palette = theme::of(ui);
    let painter = ui.painter().with_clip_rect(rect);
    painter.rect_filled(rect, f32::from(theme::RADIUS), palette.base);
    let faint = Stroke::new(1.0, palette.hairline);
    let last = plot.last_source;
    painter.line_segment([plot.place(0.0, 0.0), plot.place(last, last)], faint);
    let hair = |from: Pos2, to: Pos2| painter.line_segment([from, to], faint);
    hair(plot.rect.left_bottom(), plot.rect.right_bottom());
    hair(plot.rect.left_top(), plot.rect.left_bottom());
    let now = state.frame();
    let x = plot.place(now, 0.0).x;
    painter.vline(x, plot.rect.y_range(), Stroke::new(1.0, palette.accent));
    let points: Vec<Pos2> = (0u32..)
        .zip(frames)
        .map(|(output, source)| plot.place(f64::from(output), *source))
        .collect();
    let color = theme::role(ColorRole::JointTarget, palette.theme);
    painter.add(Shape::line(points, Stroke::new(2.0, color)));
    let source = crate::hand_time::source_of(frames, now);
    painter.circle_filled(plot.place(now, source), 3.0, palette.accent);
}

fn knot_ui(
    ui: &Ui,
    ground: &Response,
    (plot, retime, nth): (&Plot, &Retime, usize),
    drag: &mut Option<KnotDrag>,
    state: &mut EditorState,
) {
    let Some(knot) = retime.knots().get(nth) else { return };
    let palette = theme::of(ui);
    let at = plot.place(f64::from(knot.output), knot.source.min(plot.last_source));
    let place = Rect::from_center_size(at, Vec2::splat(2.0 * REACH_PT));
    let response = ui.interact(place, ground.id.with(("knot", nth)), Sense::click_and_drag());
    let is_selected = state.selected_knot == Some(nth);
    let said = || format!("Knot {}, f {} shows f {:.1}", nth + 1, knot.output, knot.source);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, said()));
    let color = theme::role(ColorRole::JointTarget, palette.theme);
    let is_lit = is_selected || response.hovered();
    let (fill, line) =
        if is_selected { (palette.accent, palette.text) } else { (color, palette.base) };
    ui.painter().circle(at, if is_lit { 5.5 } else { 4.5 }, fill, Stroke::new(1.5, line));
    if response.clicked() {
        state.select_knot(nth);
    }
    if response.drag_started_by(PointerButton::Primary)
        && let Some(take) = state.hand_take()
    {
        state.select_knot(nth);
        state.begin_gesture("Change timing");
        let knots = retime.knots().to_vec();
        *drag = Some(KnotDrag { take, knots, nth, plot: *plot });
    }
    if response.secondary_clicked() {
        state.remove_knot(nth);
    }
    let words = format!("f {} shows f {:.1} of the take", knot.output, knot.source);
    response.on_hover_cursor(CursorIcon::Grab).on_hover_text_at_pointer(words);
}

/// Goes on with a drag, or ends it.
fn follow(ui: &Ui, drag: &mut Option<KnotDrag>, state: &mut EditorState) {
    let Some(held) = drag else { return };
    let (is_down, at, from) = ui.input(|input| {
        let pointer = &input.pointer;
        (pointer.primary_down(), pointer.interact_pos(), pointer.press_origin())
    });
    if !state.is_in_gesture() {
        // Escape has ended it.
        *drag = None;
    } else if !is_down {
        state.commit();
        *drag = None;
    } else if let (Some(at), Some(from)) = (at, from)
        && from.distance(at) > THRESHOLD_PT
    {
        let knots = moved(&held.knots, held.nth, held.plot.frames_at(at));
        let (take, knots) = (held.take.clone(), Some(knots));
        state.preview(&[Command::RetimeByHand { take, knots }]);
    }
}

/// The knots with one of them elsewhere, between its neighbours.
fn moved(knots: &[Knot], nth: usize, (output, source): (f64, f64)) -> Vec<Knot> {
    let mut new = knots.to_vec();
    let before = nth.checked_sub(1).and_then(|nth| knots.get(nth));
    let after = knots.get(nth + 1);
    let first = before.map_or(0.0, |knot| f64::from(knot.output) + 1.0);
    let last = after.map_or(f64::MAX, |knot| f64::from(knot.output) - 1.0);
    let least = before.map_or(0.0, |knot| knot.source);
    let most = after.map_or(f64::MAX, |knot| knot.source);
    if let Some(knot) = new.get_mut(nth) {
        knot.output = output.round().min(last).max(first) as u32;
        knot.source = ((source * 10.0).round() / 10.0).min(most).max(least);
    }
    new
}

/// Puts a knot on the curve where it was double-clicked.
fn add_knot(plot: &Plot, retime: &Retime, frames: &[f64], at: Pos2, state: &mut EditorState) {
    let output = plot.frames_at(at).0.round().min(frames.len() as f64 - 1.0) as u32;
    let mut knots = retime.knots().to_vec();
    let place = knots.partition_point(|knot| knot.output < output);
    if knots.get(place).is_some_and(|knot| knot.output == output) {
        return;
    }
    let source = frames.get(output as usize).copied().unwrap_or_default();
    knots.insert(place, Knot { output, source });
    let Some(take) = state.hand_take() else { return };
    let command = Command::RetimeByHand { take, knots: Some(knots) };
    if state.apply_all("Add a knot", &[command]) {
        state.select_knot(place);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_knot_stays_between_its_neighbours() {
        let knots = [(10, 10.0), (20, 25.0), (30, 30.0)];
        let knots = knots.map(|(output, source)| Knot { output, source });
        for (nth, to, expected) in [
            (1, (22.4, 20.04), (22, 20.0)),
            (1, (50.0, 50.0), (29, 30.0)),
            (1, (-5.0, -5.0), (11, 10.0)),
            (0, (-5.0, -5.0), (0, 0.0)),
            (2, (400.0, 90.0), (400, 90.0)),
        ] {
            let new = moved(&knots, nth, to);
            assert_eq!((new[nth].output, new[nth].source), expected, "{nth} {to:?}");
            assert!(Retime::new(new).is_ok());
        }
    }
}
