//! What is changed by hand on the shown take: a bar for each edit, with slopes where it comes and
//! goes.

use egui::{CursorIcon, Pos2, Rect, Response, Role, Sense, Shape, Stroke, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::document::HandEdit;

use super::action::Action;
use super::axis::Axis;
use super::hand_drag::HandPart;
use super::rows::STOREY_PT;
use super::sheet::Sheet;
use crate::hand_words::{how_much, what};
use crate::state::EditorState;
use crate::theme;

/// The full part can be taken at its ends so far inwards, and slopes so far around their feet,
/// points.
const END_PT: f32 = 6.0;
/// The full part is drawn at least so wide, points.
const MIN_PT: f32 = 8.0;

/// Where an edit's bar is: the slope up, the full part, the slope down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandBar {
    /// The foot of the first slope.
    pub start: f32,
    /// The full part.
    pub full: Rect,
    /// The foot of the last slope.
    pub end: f32,
}

impl HandBar {
    /// Of an edit whose frames are where `x_of` says, between two heights.
    pub fn new(edit: &HandEdit, x_of: impl Fn(f64) -> f32, (top, bottom): (f32, f32)) -> Self {
        let (from, to) = (f64::from(edit.from), f64::from(edit.to));
        let (left, right) = (x_of(from), x_of(to + 1.0));
        let lack = 0.5 * (MIN_PT - (right - left)).max(0.0);
        let full = Rect::from_x_y_ranges(left - lack..=right + lack, top..=bottom);
        let start = x_of(from - f64::from(edit.ease_in)).min(full.left());
        let end = x_of(to + 1.0 + f64::from(edit.ease_out)).max(full.right());
        Self { start, full, end }
    }

    /// All of it.
    pub fn whole(&self) -> Rect {
        Rect::from_x_y_ranges(self.start..=self.end, self.full.y_range())
    }

    fn corners(&self) -> [Pos2; 4] {
        let Self { start, full, end } = *self;
        [
            Pos2::new(start, full.bottom()),
            full.left_top(),
            full.right_top(),
            Pos2::new(end, full.bottom()),
        ]
    }
}

/// Where a source frame is.
pub fn x_of(state: &EditorState, axis: &Axis, source: f64) -> f32 {
    axis.x_of(state.output_frame(source))
}

/// How high the row is beyond a track, storeys.
pub fn extra_storeys(state: &EditorState) -> usize {
    storeys(state).into_iter().max().unwrap_or_default()
}

/// On which storey each edit stands, from 0; those that overlap stand one below the other.
fn storeys(state: &EditorState) -> Vec<usize> {
    let mut ends: Vec<u32> = Vec::new();
    let edits = state.hand_layer().into_iter().flat_map(|layer| layer.edits());
    edits
        .map(|(_, edit)| {
            let from = edit.from.saturating_sub(edit.ease_in);
            let to = edit.to.saturating_add(edit.ease_out);
            let storey = ends.iter().position(|end| *end < from).unwrap_or(ends.len());
            match ends.get_mut(storey) {
                Some(end) => *end = to,
                None => ends.push(to),
            }
            storey
        })
        .collect()
}

/// The row.
pub fn hand_row_ui(sheet: &mut Sheet<'_>, place: Rect) {
    let state = sheet.state;
    let Some(layer) = state.hand_layer() else { return };
    retimed_ui(sheet, place);
    for ((id, edit), storey) in layer.edits().zip(storeys(state)) {
        let top = place.top() + 3.0 + storey as f32 * STOREY_PT;
        let x_of = |source| x_of(state, &sheet.axis, source);
        let bar = HandBar::new(edit, x_of, (top, top + STOREY_PT - 1.0));
        bar_ui(sheet, id, edit, bar);
    }
}

/// A line under all, where the timing is bent.
fn retimed_ui(sheet: &Sheet<'_>, place: Rect) {
    let retime = sheet.state.hand_layer().map(|layer| layer.retime());
    let Some(retime) = retime.filter(|retime| !retime.is_identity()) else { return };
    let color = sheet.palette.faint;
    let y = place.bottom() - 2.0;
    for knot in retime.knots() {
        let at = Pos2::new(sheet.axis.x_of(f64::from(knot.output)), y - 1.0);
        sheet.painter().circle_filled(at, 2.5, color);
    }
}

fn bar_ui(sheet: &mut Sheet<'_>, id: &str, edit: &HandEdit, bar: HandBar) {
    let Some(seen) = sheet.seen(bar.whole()) else { return };
    let palette = sheet.palette;
    let key = sheet.ui.scope_id().with(("by hand", id));
    let response = sheet.ui.interact(seen, key, Sense::click_and_drag());
    let is_selected = sheet.state.selected_edit().is_some_and(|(known, _)| known == id);
    let title = format!("{} by hand", what(&edit.change));
    let said = || {
        let HandEdit { from, to, ease_in, ease_out, .. } = edit;
        format!(
            "{title}, {}, frames {from} to {to}, ease {ease_in} and {ease_out} frames",
            how_much(&edit.change)
        )
    };
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, said()));
    let color = theme::role(ColorRole::JointTarget, palette.theme);
    let share = if is_selected || response.hovered() { 0.6 } else { 0.4 };
    let painter = sheet.painter();
    let fill = theme::over(palette.base, color, 0.5 * share);
    painter.add(Shape::convex_polygon(bar.corners().to_vec(), fill, Stroke::NONE));
    painter.rect_filled(bar.full, 0.0, theme::over(palette.base, color, share));
    let line = if is_selected { palette.accent } else { color };
    let width = if is_selected { 1.5 } else { 1.0 };
    painter.add(Shape::line(bar.corners().to_vec(), Stroke::new(width, line)));
    name_ui(sheet, &format!("{} {}", what(&edit.change), how_much(&edit.change)), &bar);
    events(sheet, &response, id, HandPart::Whole);
    let HandEdit { from, to, ease_in, ease_out, .. } = *edit;
    response.on_hover_cursor(CursorIcon::Grab).on_hover_ui_at_pointer(|ui| {
        ui.strong(format!("{}, {}", what(&edit.change), how_much(&edit.change)));
        ui.label(format!("f {from} to f {to}; comes over {ease_in} f, goes over {ease_out} f"));
    });
    // Over the bar, so that they are found first.
    let inwards = END_PT.min(0.35 * bar.full.width());
    let handles = [
        (HandPart::EaseIn, bar.start - END_PT, bar.start + END_PT),
        (HandPart::EaseOut, bar.end - END_PT, bar.end + END_PT),
        (HandPart::From, bar.full.left() - 2.0, bar.full.left() + inwards),
        (HandPart::To, bar.full.right() - inwards, bar.full.right() + 2.0),
    ];
    for (part, left, right) in handles {
        let grip = Rect::from_x_y_ranges(left..=right, bar.full.y_range());
        let Some(grip) = sheet.seen(grip) else { continue };
        let response = sheet.ui.interact(grip, key.with(part), Sense::click_and_drag());
        let said = || format!("{} of {title}", part.name());
        response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, said()));
        events(sheet, &response, id, part);
        if matches!(part, HandPart::EaseIn | HandPart::EaseOut)
            && (is_selected || response.hovered())
        {
            let x = if part == HandPart::EaseIn { bar.start } else { bar.end };
            let foot = Pos2::new(x, bar.full.bottom() - 1.0);
            sheet.painter().circle(foot, 3.0, palette.base, Stroke::new(1.5, line));
        }
        response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    }
}

/// The name in the bar where it has room, else behind it.
fn name_ui(sheet: &Sheet<'_>, name: &str, bar: &HandBar) {
    let words = sheet.words(name);
    let y = bar.full.center().y - 0.5 * words.size().y;
    let room = bar.full.width() - 2.0 * END_PT;
    let x = match words.size().x <= room {
        true => bar.full.center().x - 0.5 * words.size().x,
        false => bar.end + 6.0,
    };
    sheet.painter().galley(Pos2::new(x, y), words, sheet.palette.text);
}

fn events(sheet: &mut Sheet<'_>, response: &Response, id: &str, part: HandPart) {
    if response.clicked() {
        sheet.actions.push(Action::SelectHand(id.to_owned()));
    }
    if response.drag_started_by(egui::PointerButton::Primary) {
        sheet.actions.push(Action::GrabHand(id.to_owned(), part));
    }
    if response.secondary_clicked() || response.context_menu_opened() {
        let frame = sheet.state.hand_layer().and_then(|layer| layer.edit(id)).map(|e| e.from);
        let frame = frame.map(|from| sheet.state.output_frame(f64::from(from)).round());
        let actions = &mut sheet.actions;
        response.context_menu(|ui| {
            ui.set_min_width(180.0);
            if let Some(frame) = frame
                && ui.button("Go to").clicked()
            {
                actions.push(Action::GoTo(frame.max(0.0) as usize));
            }
            if ui.button("Delete").clicked() {
                actions.push(Action::RemoveHand(id.to_owned()));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use motion_core::by_hand::{Limb, Space};
    use motion_session::document::HandChange;

    use super::*;

    fn edit((from, to, ease_in, ease_out): (u32, u32, u32, u32)) -> HandEdit {
        let (limb, space) = (Limb::LeftHand, Space::World);
        let change = HandChange::Hand { limb, shift_m: [0.0; 3], space };
        HandEdit { change, from, to, ease_in, ease_out }
    }

    #[test]
    fn a_bar_has_its_slopes_beside_the_full_part() {
        let x_of = |frame: f64| 100.0 + 2.0 * frame as f32;
        for (stretch, start, (left, right), end) in [
            ((20, 29, 5, 10), 130.0, (140.0, 160.0), 180.0),
            // One frame is drawn wide enough to be taken.
            ((20, 20, 12, 12), 116.0, (137.0, 145.0), 166.0),
            ((20, 20, 0, 0), 137.0, (137.0, 145.0), 145.0),
            ((3, 9, 12, 0), 82.0, (106.0, 120.0), 120.0),
        ] {
            let bar = HandBar::new(&edit(stretch), x_of, (0.0, 20.0));
            assert_eq!((bar.start, bar.end), (start, end), "{stretch:?}");
            assert_eq!((bar.full.left(), bar.full.right()), (left, right), "{stretch:?}");
        }
    }
}
