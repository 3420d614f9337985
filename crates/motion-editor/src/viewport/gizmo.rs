//! The axes in the corner of the view: they show which way is which, and a click looks along one.

use egui::{Align2, CursorIcon, FontId, Pos2, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};
use glam::Vec3;
use motion_scene::camera::{OrbitCamera, Projection, StandardView};

use crate::theme;

/// From the middle to an axis's ball, points.
const REACH_PT: f32 = 32.0;
const BALL_PT: f32 = 8.5;
const SMALL_BALL_PT: f32 = 5.5;
/// The middle can be clicked so far around, points.
const MIDDLE_PT: f32 = 8.0;

/// An end of an axis.
struct End {
    direction: Vec3,
    axis: usize,
    letter: &'static str,
    view: StandardView,
    label: &'static str,
}

fn ends() -> [End; 6] {
    let end = |direction, axis, letter, view, label| End { direction, axis, letter, view, label };
    [
        end(Vec3::X, 0, "X", StandardView::Left, "View from +X"),
        end(Vec3::Y, 1, "Y", StandardView::Top, "View from +Y"),
        end(Vec3::Z, 2, "Z", StandardView::Front, "View from +Z"),
        end(Vec3::NEG_X, 0, "", StandardView::Right, "View from −X"),
        end(Vec3::NEG_Y, 1, "", StandardView::Top, "View from −Y"),
        end(Vec3::NEG_Z, 2, "", StandardView::Back, "View from −Z"),
    ]
}

/// What was done to the gizmo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clicked {
    /// An axis: a view along it is wanted.
    View(StandardView),
    /// The middle: with vanishing points, or without.
    Middle,
    /// It was dragged, and the camera circled.
    Dragged,
}

/// What tests and screen readers call the middle.
pub const MIDDLE: &str = "Perspective on or off";

/// The room it takes around `center`.
pub fn room(center: Pos2) -> Rect {
    Rect::from_center_size(center, Vec2::splat(2.0 * (REACH_PT + BALL_PT)))
}

/// Draws the axes around `center`. Gives what was done to them.
pub fn gizmo_ui(ui: &mut Ui, center: Pos2, camera: &mut OrbitCamera) -> Option<Clicked> {
    let palette = theme::of(ui);
    let around = room(center);
    let whole = ui.interact(around, ui.scope_id().with("gizmo"), Sense::drag());
    if whole.dragged() {
        let by = whole.drag_delta() * (std::f32::consts::PI / around.width());
        camera.orbit(-by.x, by.y);
    }
    let mut clicked = whole.dragged().then_some(Clicked::Dragged);
    if whole.hovered() || whole.dragged() {
        let ground = palette.raised.gamma_multiply(0.5);
        ui.painter().circle_filled(center, around.width() / 2.0, ground);
    }
    let into_view = camera.world_from_view_rotation().inverse();
    let colors = theme::axis_colors();
    let mut placed: Vec<(Vec3, End)> =
        ends().into_iter().map(|end| (into_view * end.direction, end)).collect();
    // The farthest first, so that near ones cover it.
    placed.sort_by(|(a, _), (b, _)| a.z.total_cmp(&b.z));
    for (in_view, end) in placed {
        let at = center + Vec2::new(in_view.x, -in_view.y) * REACH_PT;
        // The end below the floor cannot be looked from.
        let can_look = end.direction != Vec3::NEG_Y;
        let color = theme::over(palette.base, colors[end.axis], 0.72 + 0.28 * in_view.z);
        let named = !end.letter.is_empty();
        let radius = if named { BALL_PT } else { SMALL_BALL_PT };
        let mut ground = if named { color } else { theme::over(palette.base, color, 0.35) };
        if can_look {
            let room = Rect::from_center_size(at, Vec2::splat(2.0 * BALL_PT));
            let response =
                ui.interact(room, ui.scope_id().with(("axis", end.label)), Sense::click());
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, end.label));
            let response = response.on_hover_cursor(CursorIcon::PointingHand);
            if response.hovered() {
                ground = palette.text;
            }
            if response.clicked() {
                clicked = Some(Clicked::View(end.view));
            }
        }
        if named {
            ui.painter().line_segment([center, at], Stroke::new(2.0, color));
        }
        ui.painter().circle(at, radius, ground, Stroke::new(1.5, color));
        let font = FontId { size: 11.0, ..theme::heading() };
        ui.painter().text(at, Align2::CENTER_CENTER, end.letter, font, palette.base);
    }
    middle_ui(ui, center, camera).or(clicked)
}

/// The middle: a dot for vanishing points, a square for none.
fn middle_ui(ui: &Ui, center: Pos2, camera: &OrbitCamera) -> Option<Clicked> {
    let palette = theme::of(ui);
    let place = Rect::from_center_size(center, Vec2::splat(2.0 * MIDDLE_PT));
    let response = ui.interact(place, ui.scope_id().with("middle"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, MIDDLE));
    let color = if response.hovered() { palette.text } else { palette.faint };
    match camera.projection {
        Projection::Perspective { .. } => drop(ui.painter().circle_filled(center, 4.0, color)),
        Projection::Orthographic => {
            let square = Rect::from_center_size(center, Vec2::splat(7.0));
            ui.painter().rect_filled(square, 1.0, color);
        }
    }
    let response = response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(MIDDLE);
    response.clicked().then_some(Clicked::Middle)
}
