//! When each foot is planted, and where it slides.

use egui::{Rect, Role, Sense, Shape, Stroke, WidgetInfo};
use motion_core::contacts::Side;
use motion_scene::color::ColorRole;

use super::sheet::Sheet;
use crate::theme;

/// Between hatches, points.
const HATCH_PT: f32 = 4.0;

/// A bar for every plant; hatched in the colour of misses where the foot slides or sinks.
pub fn foot_row_ui(sheet: &Sheet<'_>, side: Side, row: Rect) {
    let Some(card) = sheet.state.shown_card() else { return };
    let palette = sheet.palette;
    let planted = theme::role(ColorRole::Planted, palette.theme);
    let miss = theme::role(ColorRole::Miss, palette.theme);
    let now = sheet.state.frame_number();
    let axis = &sheet.axis;
    let painter = sheet.painter();
    let bar = |frames: &std::ops::Range<usize>| {
        let (from, to) = (axis.x_of(frames.start as f64), axis.x_of(frames.end as f64));
        Rect::from_x_y_ranges(from..=to, row.top() + 4.0..=row.bottom() - 4.0)
    };
    for plant in &card.lane.plants[side.idx()] {
        let share = if plant.contains(&now) { 1.0 } else { 0.55 };
        painter.rect_filled(bar(plant), 2.0, theme::over(palette.base, planted, share));
    }
    for fault in &card.lane.foot_faults[side.idx()] {
        let Some(place) = sheet.seen(bar(fault)) else { continue };
        let painter = painter.with_clip_rect(place);
        painter.rect_filled(place, 0.0, theme::over(palette.base, miss, 0.45));
        let n = ((place.width() + place.height()) / HATCH_PT) as usize + 1;
        painter.extend((0..n).map(|nth| {
            let x = place.left() + nth as f32 * HATCH_PT;
            let points =
                [egui::pos2(x, place.top()), egui::pos2(x - place.height(), place.bottom())];
            Shape::line_segment(points, Stroke::new(1.0, miss))
        }));
    }
    let Some(seen) = sheet.seen(row) else { return };
    let id = sheet.ui.scope_id().with(("foot", side.idx()));
    let response = sheet.ui.interact(seen, id, Sense::hover());
    let n_faults = card.lane.foot_faults[side.idx()].len();
    let name = if side == Side::Left { "Left" } else { "Right" };
    let said = || {
        let plants = card.lane.plants[side.idx()].len();
        format!("{name} foot, planted {plants} times, slides or sinks in {n_faults} places")
    };
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said()));
    let at = response.hover_pos().map(|at| axis.frame_at(at.x).max(0.0) as usize);
    let is_in = |runs: &[std::ops::Range<usize>]| {
        at.is_some_and(|frame| runs.iter().any(|run| run.contains(&frame)))
    };
    if is_in(&card.lane.foot_faults[side.idx()]) {
        response.on_hover_text_at_pointer(
            "Planted, and slides faster than 2 cm/s or sinks by more than 1 cm",
        );
    } else if is_in(&card.lane.plants[side.idx()]) {
        response.on_hover_text_at_pointer("Planted");
    }
}
