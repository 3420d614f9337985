//! Marks at one frame: checkpoints, joint targets, poses.

use egui::{CursorIcon, Pos2, Rect, Role, Sense, Vec2, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;

use super::mark_shape::{HALF_PT, mark_shape};
use super::retime::Part;
use super::rows::Row;
use super::sheet::Sheet;
use crate::mark::Mark;
use crate::theme;

/// The marks of a row. A click selects one and goes to its frame, a drag brings it to another.
pub fn point_row_ui(sheet: &mut Sheet<'_>, row: &Row, place: Rect) {
    let state = sheet.state;
    let marks: Vec<(usize, &Mark)> =
        state.marks.iter().enumerate().filter(|(_, mark)| row.holds(mark)).collect();
    for (nth, (index, mark)) in marks.iter().enumerate() {
        let x = sheet.axis.x_of(mark.frame() as f64);
        let next = marks.get(nth + 1).map(|(_, next)| sheet.axis.x_of(next.frame() as f64));
        let room = next.unwrap_or(place.right()) - x - 3.0 * HALF_PT;
        mark_ui(sheet, *index, mark, Pos2::new(x, place.center().y), (place, room));
    }
}

fn mark_ui(sheet: &mut Sheet<'_>, index: usize, mark: &Mark, at: Pos2, (row, room): (Rect, f32)) {
    let size = Vec2::new(2.0 * HALF_PT + 6.0, row.height());
    let Some(touch) = sheet.touch(at, size) else { return };
    sheet.placed.push((index, Rect::from_center_size(at, Vec2::splat(2.0 * HALF_PT))));
    let id = sheet.ui.scope_id().with(("mark", &mark.at.id));
    // egui takes a press for a drag after 6 points.
    let response = sheet.ui.interact(touch, id, Sense::click_and_drag());
    let (is_selected, is_lit) = sheet.lights(mark);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, said(mark)));
    let palette = sheet.palette;
    let rim = match (is_selected, is_lit || response.hovered()) {
        (true, _) => Some(palette.accent),
        (false, true) => Some(palette.text),
        (false, false) => None,
    };
    let painter = sheet.painter();
    let color = theme::role(mark.color_role(), palette.theme);
    mark_shape(&painter, &mark.constraint.kind, at, color, rim);
    let is_off = mark.is_off();
    let color = if is_off { theme::role(ColorRole::Miss, palette.theme) } else { palette.faint };
    let words = sheet.words(beside(sheet, mark));
    // Before the mark where there is no room behind it.
    let fits = words.size().x <= room;
    let off = if fits { 11.0 } else { -11.0 - words.size().x };
    let corner = Pos2::new(at.x + off, at.y - 0.5 * words.size().y);
    painter.galley(corner, words, color);
    sheet.mark_events(&response, mark, Part::Whole);
    if response.hovered() {
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_ui_at_pointer(|ui| {
            ui.strong(format!("{} · f {}", mark.title(), mark.frame()));
            details(&mark.constraint.kind).into_iter().for_each(|line| drop(ui.label(line)));
            ui.label(mark.miss_text());
        });
    }
}

/// What stands beside a mark.
fn beside(sheet: &Sheet<'_>, mark: &Mark) -> String {
    if mark.is_off() {
        return mark.miss_text();
    }
    let when = sheet.state.settings.time_unit.text(mark.frame(), sheet.state.fps());
    match &mark.constraint.kind {
        ConstraintKind::Joint { position_m, .. } => format!("{when} · {:.2} m", position_m[1]),
        ConstraintKind::Pose { clip, clip_frame, .. } => format!("{clip}:{clip_frame}"),
        _ => when,
    }
}

/// A mark as a sentence.
fn said(mark: &Mark) -> String {
    let (frame, miss) = (mark.frame(), mark.miss_text());
    match &mark.constraint.kind {
        ConstraintKind::Body { .. } => {
            format!("Body checkpoint {}, frame {frame}, {miss}", mark.number)
        }
        _ => format!("{}, frame {frame}, {miss}", mark.title()),
    }
}

/// Where it is, in lines.
fn details(kind: &ConstraintKind) -> Vec<String> {
    let heading = |deg: &Option<f64>| deg.map(|deg| format!("Heading {deg:.0}°"));
    let place = |at: &[f64; 2]| format!("x {:.2} m, z {:.2} m", at[0], at[1]);
    match kind {
        ConstraintKind::Body { position_m, heading_deg, .. } => {
            std::iter::once(place(position_m)).chain(heading(heading_deg)).collect()
        }
        ConstraintKind::Joint { position_m: [x, y, z], .. } => {
            vec![format!("x {x:.2} m, height {y:.2} m, z {z:.2} m")]
        }
        ConstraintKind::Pose { position_m, heading_deg, .. } => {
            let place = position_m.as_ref().map_or("Anywhere".to_owned(), place);
            std::iter::once(place).chain(heading(heading_deg)).collect()
        }
        _ => Vec::new(),
    }
}
