//! The sign of each kind of constraint, told apart by its shape as well as its colour.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2};
use motion_session::ConstraintKind;

use crate::icons;
use crate::theme;

/// Half of a sign, points.
pub const HALF_PT: f32 = 6.0;

/// Draws a sign: an arrow for the body, as on the floor; a diamond for a joint; a square with a lock
/// for a pose. With a `rim` it stands out, because it is selected or pointed at.
pub fn mark_shape(
    painter: &Painter,
    kind: &ConstraintKind,
    at: Pos2,
    color: Color32,
    rim: Option<Color32>,
) {
    match kind {
        ConstraintKind::Joint { .. } => {
            let [half, more] = [HALF_PT, HALF_PT + 3.0];
            if let Some(rim) = rim {
                painter.add(diamond(at, more, rim));
            }
            painter.add(diamond(at, half, color));
        }
        ConstraintKind::Pose { .. } => {
            let place = Rect::from_center_size(at, Vec2::splat(2.0 * HALF_PT));
            if let Some(rim) = rim {
                painter.rect_filled(place.expand(2.5), 4.0, rim);
            }
            painter.rect_filled(place, 2.5, color);
            let font = FontId::new(9.0, theme::icons());
            painter.text(at, Align2::CENTER_CENTER, icons::LOCK, font, Color32::WHITE);
        }
        _ => {
            rim.into_iter().for_each(|rim| arrow(painter, at, 1.55, rim));
            arrow(painter, at, 1.0, color);
        }
    }
}

fn diamond(at: Pos2, half: f32, color: Color32) -> Shape {
    let corners = [(0.0, -half), (half, 0.0), (0.0, half), (-half, 0.0)];
    let corners = corners.map(|(x, y)| at + Vec2::new(x, y));
    Shape::convex_polygon(corners.to_vec(), color, Stroke::NONE)
}

fn arrow(painter: &Painter, at: Pos2, scale: f32, color: Color32) {
    let corners = [(-4.0, -6.0), (5.5, 0.0), (-4.0, 6.0), (-1.5, 0.0)];
    let [tail, tip, low, notch] = corners.map(|(x, y)| at + scale * Vec2::new(x, y));
    for half in [[tail, tip, notch], [low, notch, tip]] {
        painter.add(Shape::convex_polygon(half.to_vec(), color, Stroke::NONE));
    }
}
