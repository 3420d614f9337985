//! Body checkpoints on the timeline.

use egui::{Align2, CursorIcon, PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke};
use egui::{Ui, Vec2, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;
use motion_session::selection::Selectable;
use motion_session::stage::pick::PickTarget;

use super::axis::Axis;
use crate::mark::Mark;
use crate::state::EditorState;
use crate::theme;

/// Half of a mark, points.
const HALF_PT: f32 = 6.0;

/// The marks. A click selects one and goes to its frame, a drag brings it to another frame.
pub fn body_row_ui(ui: &Ui, row: Rect, axis: &Axis, state: &mut EditorState) {
    let marks: Vec<Mark> =
        state.marks.iter().filter(|mark| mark.body().is_some()).cloned().collect();
    let next_x = |nth: usize| marks.get(nth + 1).map(|mark| axis.x_of(mark.frame() as f64));
    for (nth, mark) in marks.iter().enumerate() {
        let x = axis.x_of(mark.frame() as f64);
        if !row.expand(HALF_PT).x_range().contains(x) {
            continue;
        }
        let room = next_x(nth).unwrap_or(row.right()) - x - 3.0 * HALF_PT;
        let at = Pos2::new(x, row.center().y);
        mark_ui(ui, row, (at, axis), room, mark, state);
    }
}

fn mark_ui(
    ui: &Ui,
    row: Rect,
    (at, axis): (Pos2, &Axis),
    room_pt: f32,
    mark: &Mark,
    state: &mut EditorState,
) {
    let palette = theme::of(ui);
    let number = mark.number;
    let character = mark.at.character.0;
    let target = PickTarget::Checkpoint { character, constraint: mark.index };
    let touch = Rect::from_center_size(at, Vec2::new(2.0 * HALF_PT + 6.0, row.height()));
    let id = ui.scope_id().with(("mark", &mark.at.id));
    // egui takes a press for a drag after 6 points.
    let response = ui.interact(touch, id, Sense::click_and_drag());
    let miss = mark.miss_text();
    let label = format!("Body checkpoint {number}, frame {}, {miss}", mark.frame());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    if response.hovered() {
        state.hovered = Some(target);
    }
    let color = match (state.is_selected(&mark.at), state.hovered == Some(target)) {
        (true, _) => palette.accent,
        (false, true) => palette.text,
        (false, false) => theme::role(ColorRole::Checkpoint, palette.theme),
    };
    // An arrow along the motion: the same sign as on the floor, and told apart by its shape.
    let arrow =
        [(-4.0, -6.0), (5.0, 0.0), (-4.0, 6.0), (-1.5, 0.0)].map(|(x, y)| at + Vec2::new(x, y));
    let [tail, tip, low, notch] = arrow;
    for half in [[tail, tip, notch], [low, notch, tip]] {
        ui.painter().add(Shape::convex_polygon(half.to_vec(), color, Stroke::NONE));
    }
    let is_off = mark.is_off();
    let short = if is_off { miss.clone() } else { format!("f {}", mark.frame()) };
    let words = if is_off { theme::role(ColorRole::Miss, palette.theme) } else { palette.faint };
    let width =
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(short.clone(), theme::caption(), words).size().x);
    let painter = ui.painter().with_clip_rect(row);
    if width > room_pt {
        let beside = at - Vec2::new(10.0, 0.0);
        painter.text(beside, Align2::RIGHT_CENTER, short, theme::caption(), words);
    } else {
        let beside = at + Vec2::new(10.0, 0.0);
        painter.text(beside, Align2::LEFT_CENTER, short, theme::caption(), words);
    }
    if response.clicked() {
        let selection = state.session.selection_mut();
        let item = Selectable::Constraint(mark.at.clone());
        if ui.input(|input| input.modifiers.shift) {
            selection.toggle(item);
        } else {
            selection.select(item);
            state.stop_at(mark.frame());
        }
    }
    retime_ui(ui, &response, axis, &mark.at, state);
    response.on_hover_ui_at_pointer(|ui| {
        ui.strong(format!("Checkpoint {number} · f {}", mark.frame()));
        if let Some((at_m, heading)) = mark.body() {
            ui.label(format!("x {:.2} m, z {:.2} m", at_m[0], at_m[1]));
            heading.into_iter().for_each(|deg| drop(ui.label(format!("Heading {deg:.0}°"))));
        }
        ui.label(miss);
    });
}

/// A drag is one step of the history. It snaps to cuts and the playhead unless Alt is held.
fn retime_ui(
    ui: &Ui,
    response: &Response,
    axis: &Axis,
    at: &ConstraintRef,
    state: &mut EditorState,
) {
    let mut marks: Vec<usize> = vec![state.frame_number()];
    if let Some(card) = state.shown_card() {
        marks.extend(card.lane.cuts.iter().map(|cut| cut.frame));
    }
    let n_frames = state.n_frames();
    if response.drag_started_by(PointerButton::Primary) {
        state.session.selection_mut().select(Selectable::Constraint(at.clone()));
        state.begin_gesture("Retime checkpoint");
    }
    if response.dragged_by(PointerButton::Primary)
        && state.is_in_gesture()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let is_free = ui.input(|input| input.modifiers.alt);
        let frame = axis.snap(pointer.x, &marks, is_free, n_frames) as u32;
        state.preview(&[Command::Retime { at: at.clone(), frame }]);
    } else if response.drag_stopped() && state.is_in_gesture() {
        state.commit();
    }
}
