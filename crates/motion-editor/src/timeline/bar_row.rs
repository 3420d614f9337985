//! Stretches of time: styles, drawn paths, what is locked.

use egui::{CursorIcon, Id, Pos2, Rect, Role, Sense, Stroke, StrokeKind, WidgetInfo};
use motion_session::ConstraintKind;

use super::retime::Part;
use super::rows::{Row, STOREY_PT, storeys};
use super::sheet::Sheet;
use super::style_drag::style_ground_ui;
use crate::mark::Mark;
use crate::theme;

/// An end can be taken so far inwards, points.
const END_PT: f32 = 7.0;
/// A bar is drawn at least so wide, points.
const MIN_PT: f32 = 4.0;

/// The bars of a row. The middle of one moves it, its ends change how long it lasts.
pub fn bar_row_ui(sheet: &mut Sheet<'_>, row: &Row, place: Rect) {
    let state = sheet.state;
    let marks: Vec<(usize, &Mark)> =
        state.marks.iter().enumerate().filter(|(_, mark)| row.holds(mark)).collect();
    let storeys = storeys(marks.iter().map(|(_, mark)| *mark));
    if *row == Row::Style {
        style_ground_ui(sheet, place, marks.is_empty());
    }
    for ((index, mark), storey) in marks.into_iter().zip(storeys) {
        let (from, to) = mark.span();
        let left = sheet.axis.x_of(f64::from(from));
        let right = sheet.axis.x_of(f64::from(to) + 1.0).max(left + MIN_PT);
        let top = place.top() + 3.0 + storey as f32 * STOREY_PT;
        let bar = Rect::from_x_y_ranges(left..=right, top..=top + STOREY_PT);
        bar_ui(sheet, index, mark, bar);
    }
}

fn bar_ui(sheet: &mut Sheet<'_>, index: usize, mark: &Mark, bar: Rect) {
    let Some(seen) = sheet.seen(bar) else { return };
    sheet.placed.push((index, bar));
    let palette = sheet.palette;
    let id = sheet.ui.scope_id().with(("bar", &mark.at.id));
    let response = sheet.ui.interact(seen, id, Sense::click_and_drag());
    let (is_selected, is_lit) = sheet.lights(mark);
    let (from, to) = mark.span();
    let said = || format!("{}, frames {from} to {to}, {}", mark.title(), mark.miss_text());
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, said()));
    let color = theme::role(mark.color_role(), palette.theme);
    let share = if is_lit || response.hovered() { 0.55 } else { 0.38 };
    let painter = sheet.painter();
    painter.rect_filled(bar, 3.0, theme::over(palette.panel, color, share));
    let edge = bar.with_max_x(bar.left() + 3.0);
    painter.rect_filled(edge, 1.0, color);
    if is_selected {
        painter.rect_stroke(bar, 3.0, Stroke::new(1.5, palette.accent), StrokeKind::Inside);
    }
    let words = sheet.words(inside(mark));
    if words.size().x <= seen.width() - 2.0 * END_PT {
        let at = Pos2::new(seen.left() + END_PT + 1.0, bar.center().y - 0.5 * words.size().y);
        painter.galley(at, words, palette.text);
    }
    sheet.mark_events(&response, mark, Part::Whole);
    if response.hovered() {
        response.on_hover_cursor(CursorIcon::Grab).on_hover_ui_at_pointer(|ui| {
            ui.strong(mark.title());
            ui.label(format!("f {from} to f {to}, {} frames", to - from + 1));
            ui.label(mark.miss_text());
        });
    }
    // Over the bar, so that they are found first.
    let reach = END_PT.min(0.3 * bar.width());
    for (part, x) in [(Part::Start, bar.left()), (Part::End, bar.right() - reach)] {
        let end = Rect::from_x_y_ranges(x..=x + reach, bar.y_range());
        end_ui(sheet, mark, part, id, end);
    }
}

fn end_ui(sheet: &mut Sheet<'_>, mark: &Mark, part: Part, id: Id, place: Rect) {
    let Some(seen) = sheet.seen(place) else { return };
    let response = sheet.ui.interact(seen, id.with(part), Sense::click_and_drag());
    let (from, to) = mark.span();
    let said = || match part {
        Part::End => format!("End of {}, frame {to}", mark.title()),
        _ => format!("Beginning of {}, frame {from}", mark.title()),
    };
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said()));
    sheet.mark_events(&response, mark, part);
    response.on_hover_cursor(CursorIcon::ResizeHorizontal);
}

/// What is written in a bar.
fn inside(mark: &Mark) -> String {
    match &mark.constraint.kind {
        ConstraintKind::Style { tag, .. } => tag.clone(),
        ConstraintKind::Lock { pieces, .. } => {
            let clips: Vec<&str> = pieces.iter().map(|piece| piece.clip.as_str()).collect();
            clips.join(", ")
        }
        _ => mark.title(),
    }
}
