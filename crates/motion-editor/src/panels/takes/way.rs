//! The way over the floor from above: a take's picture until it is drawn.

use egui::{Pos2, Rect, Stroke, Ui, Vec2};
use motion_scene::color::ColorRole;

use crate::mark::Mark;
use crate::take_card::TakeCard;
use crate::theme;

/// The way with the checkpoints.
pub fn way_ui(ui: &Ui, room: Rect, take: &TakeCard, marks: &[Mark]) {
    let palette = theme::of(ui);
    // +X is the body's left; seen from above with +Z up, left is left.
    let flat = |x: f32, z: f32| Pos2::new(-x, -z);
    let way: Vec<Pos2> = take.actor.ground_path_m().iter().map(|p| flat(p.x, p.z)).collect();
    let marks: Vec<Pos2> = marks
        .iter()
        .filter_map(Mark::body)
        .map(|(at_m, _)| flat(at_m[0] as f32, at_m[1] as f32))
        .collect();
    let all = way.iter().chain(&marks).fold(Rect::NOTHING, |all, p| all.union(Rect::from_pos(*p)));
    let scale = (room.size() / all.size().max(Vec2::splat(0.5))).min_elem();
    let place = |p: &Pos2| room.center() + (*p - all.center()) * scale;
    let painter = ui.painter();
    let line: Vec<Pos2> = way.iter().step_by(4).chain(way.last()).map(place).collect();
    let color = theme::role(ColorRole::Take(take.hue), palette.theme);
    painter.add(egui::Shape::line(line, Stroke::new(2.0, color)));
    let orange = theme::role(ColorRole::Checkpoint, palette.theme);
    for mark in &marks {
        painter.circle_stroke(place(mark), 3.0, Stroke::new(1.5, orange));
    }
}
