//! The usual views around the pointer.

use egui::{Area, Button, Id, Order, Pos2, Rect, Ui, Vec2};

use super::described;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand as C;

/// From the middle to a view, points.
const REACH: Vec2 = Vec2::new(124.0, 84.0);

/// The views, with where they are around the middle: as the picture would turn.
const VIEWS: [(C, &str, f32, f32); 7] = [
    (C::ViewTop, "Top", 0.0, -1.0),
    (C::ViewFront, "Front", 0.0, 1.0),
    (C::ViewLeft, "Left", -1.0, 0.0),
    (C::ViewRight, "Right", 1.0, 0.0),
    (C::ViewBack, "Back", 0.8, -0.5),
    (C::ViewThreeQuarter, "Three-quarter", -0.8, 0.5),
    (C::Perspective, "Perspective", 0.8, 0.5),
];

/// Draws the views around `at`. Gives whether it stays open.
pub fn pie_ui(ui: &Ui, at: Pos2, within: Rect, state: &mut EditorState) -> bool {
    let margin = REACH + Vec2::new(60.0, 24.0);
    let at = at.clamp(within.min + margin, (within.max - margin).max(within.min + margin));
    let mut stays = true;
    let area = Area::new(Id::unique("views")).order(Order::Foreground).fixed_pos(at - margin);
    area.show(ui.ctx(), |ui| {
        let palette = theme::of(ui);
        ui.painter().circle_stroke(at, 10.0, egui::Stroke::new(2.0, palette.faint));
        for (command, name, x, y) in VIEWS {
            let place =
                Rect::from_center_size(at + Vec2::new(x, y) * REACH, Vec2::new(108.0, 26.0));
            let tooltip = described(command);
            let button = Button::new(name).fill(palette.raised).frame(true);
            if ui.put(place, button).on_hover_text(tooltip).clicked() {
                state.ask(command);
                stays = false;
            }
        }
    });
    let is_elsewhere = ui.input(|input| {
        let pressed = input.pointer.any_pressed();
        pressed && input.pointer.interact_pos().is_some_and(|p| p.distance(at) > 2.0 * REACH.x)
    });
    stays && !is_elsewhere
}
