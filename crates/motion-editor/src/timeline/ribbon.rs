//! The source ribbon: which clip is shown when, and what the cuts cost.

use egui::{Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo};
use motion_scene::color::ColorRole;

use super::axis::Axis;
use crate::state::EditorState;
use crate::take_card::{Cut, Piece};
use crate::theme;

/// The highest notch, points; a cut of [`FULL_COST`] has it.
const NOTCH_PT: f32 = 9.0;
/// What a cut costs that is hard to overlook.
const FULL_COST: f64 = 1.0;

/// The ribbon of the shown take. A click on a piece goes to its first frame.
pub fn ribbon_ui(ui: &Ui, row: Rect, axis: &Axis, state: &mut EditorState) {
    let Some(card) = state.shown_card() else { return };
    let lane = std::sync::Arc::clone(&card.lane);
    let (pieces, cuts) = (&lane.pieces, &lane.cuts);
    let bars = row.with_min_y(row.top() + 10.0);
    for (nth, piece) in pieces.iter().enumerate() {
        if let Some(frame) = piece_ui(ui, bars, axis, nth, piece, cuts) {
            state.seek(frame as f64);
        }
    }
    for cut in cuts {
        notch_ui(ui, row, axis, cut);
    }
    let at = ui.input(|input| input.pointer.hover_pos()).filter(|at| bars.contains(*at));
    state.hovered_source = at.map(|at| axis.frame_at(at.x).max(0.0) as usize);
}

fn piece_ui(
    ui: &Ui,
    bars: Rect,
    axis: &Axis,
    nth: usize,
    piece: &Piece,
    cuts: &[Cut],
) -> Option<usize> {
    let palette = theme::of(ui);
    let (from, to) = (axis.x_of(piece.frames.start as f64), axis.x_of(piece.frames.end as f64));
    let bar = Rect::from_x_y_ranges(from + 0.5..=(to - 0.5).max(from + 1.0), bars.y_range());
    let seen = bar.intersect(bars);
    if seen.width() <= 0.0 {
        return None;
    }
    let painter = ui.painter().with_clip_rect(bars);
    let response = ui.interact(seen, ui.scope_id().with(("piece", nth)), Sense::click());
    let text = format!("{} {}–{}", piece.clip, piece.of_clip.0, piece.of_clip.1);
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, &text));
    let mut color = theme::clip_color(&piece.clip, &palette);
    if response.hovered() {
        color = theme::over(color, palette.text, 0.12);
    }
    painter.rect_filled(bar, 3.0, color);
    // The clip's name as long as it fits, then its frames if they fit too.
    let layout = |text: &str| {
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), theme::caption(), palette.text))
    };
    let room = seen.width() - 12.0;
    let galley =
        [text.as_str(), piece.clip.as_str()].map(layout).into_iter().find(|g| g.size().x <= room);
    if let Some(galley) = galley {
        let at = Pos2::new(seen.left() + 6.0, seen.center().y - 0.5 * galley.size().y);
        painter.galley(at, galley, palette.text);
    }
    let cost = cuts.iter().find(|cut| cut.frame == piece.frames.start);
    let response = response.on_hover_ui_at_pointer(|ui| {
        ui.strong(piece.clip.as_str());
        let (first, last) = (piece.frames.start, piece.frames.end.saturating_sub(1));
        ui.label(format!("Frames {}–{} of the clip", piece.of_clip.0, piece.of_clip.1));
        ui.label(format!("Shown from f {first} to f {last}"));
        if let Some(cut) = cost {
            ui.label(cut_text(cut));
        }
    });
    response.clicked().then_some(piece.frames.start)
}

fn cut_text(cut: &Cut) -> String {
    let bridge = if cut.is_bridge { ", a bridge between parts" } else { "" };
    format!("Cut at f {} costs {:.2}{bridge}", cut.frame, cut.cost)
}

/// A triangle over the ribbon; the dearer the cut the higher, and in the colour of misses where it
/// is a bridge.
fn notch_ui(ui: &Ui, row: Rect, axis: &Axis, cut: &Cut) {
    let x = axis.x_of(cut.frame as f64);
    if !row.x_range().contains(x) {
        return;
    }
    let palette = theme::of(ui);
    let share = (cut.cost / FULL_COST).clamp(0.5, 1.0) as f32;
    let (low, high) = (row.top() + 10.0, row.top() + 10.0 - share * NOTCH_PT);
    let room = Rect::from_x_y_ranges(x - 5.0..=x + 5.0, row.top()..=low);
    let response = ui.interact(room, ui.scope_id().with(("cut", cut.frame)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, cut_text(cut)));
    let color = match (cut.is_bridge, response.hovered()) {
        (_, true) => palette.text,
        (true, _) => theme::role(ColorRole::Miss, palette.theme),
        (false, _) => palette.faint,
    };
    let points = vec![Pos2::new(x - 4.0, high), Pos2::new(x + 4.0, high), Pos2::new(x, low)];
    ui.painter().add(Shape::convex_polygon(points, color, Stroke::NONE));
    response.on_hover_text(cut_text(cut));
}
