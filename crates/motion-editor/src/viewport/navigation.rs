//! The mouse moves the camera.

use egui::{PointerButton, Rect, Response, Ui};
use glam::Vec2;
use motion_scene::camera::{OrbitCamera, Viewport};

use crate::settings::Navigation;

/// A drag over so many points turns once round.
const PT_PER_TURN: f32 = 900.0;
/// A drag over so many points doubles the distance.
const PT_PER_OCTAVE: f32 = 160.0;
/// So many points of wheel double the distance.
const WHEEL_PT_PER_OCTAVE: f32 = 240.0;

/// What a drag does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// Circles the target.
    Orbit,
    /// Goes across.
    Pan,
    /// Comes nearer or goes away.
    Zoom,
}

/// What a drag with `button` and these modifiers does. The left button circles too, where nothing
/// else wants it.
pub fn meaning(scheme: Navigation, button: PointerButton, m: egui::Modifiers) -> Option<Move> {
    use PointerButton as B;
    match (scheme, button) {
        (Navigation::Industry, B::Primary) if m.alt => Some(Move::Orbit),
        (Navigation::Industry, B::Middle) => Some(Move::Pan),
        (Navigation::Industry, B::Secondary) if m.alt => Some(Move::Zoom),
        (Navigation::Blender, B::Middle) if m.shift => Some(Move::Pan),
        (Navigation::Blender, B::Middle) if m.ctrl => Some(Move::Zoom),
        (Navigation::Blender, B::Middle) => Some(Move::Orbit),
        (_, B::Primary) if m.shift => Some(Move::Pan),
        (_, B::Primary) => Some(Move::Orbit),
        _ => None,
    }
}

/// Moves the camera by what the mouse did over `response`. Gives whether it went across: a camera
/// that follows somebody stops then.
pub fn navigate_ui(
    ui: &Ui,
    response: &Response,
    camera: &mut OrbitCamera,
    scheme: Navigation,
) -> bool {
    let rect = response.rect;
    let viewport = Viewport::new(rect.width(), rect.height());
    let modifiers = ui.input(|input| input.modifiers);
    let mut panned = false;
    for button in [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary] {
        if !response.dragged_by(button) {
            continue;
        }
        let by = response.drag_delta();
        match meaning(scheme, button, modifiers) {
            Some(Move::Orbit) => {
                let turn = std::f32::consts::TAU / PT_PER_TURN;
                camera.orbit(-by.x * turn, by.y * turn);
            }
            Some(Move::Pan) => {
                camera.pan(Vec2::new(by.x, by.y), viewport);
                panned = true;
            }
            Some(Move::Zoom) => {
                let factor = ((by.y - by.x) / PT_PER_OCTAVE).exp2();
                camera.dolly(factor, in_rect(rect, rect.center()), viewport);
            }
            None => {}
        }
    }
    if let Some(at) = response.hover_pos() {
        let (wheel, zoom) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        if wheel != 0.0 || zoom != 1.0 {
            let factor = (-wheel / WHEEL_PT_PER_OCTAVE).exp2() / zoom;
            camera.dolly(factor, in_rect(rect, at), viewport);
        }
    }
    panned
}

fn in_rect(rect: Rect, at: egui::Pos2) -> Vec2 {
    let off = at - rect.min;
    Vec2::new(off.x, off.y)
}

#[cfg(test)]
mod tests {
    use egui::Modifiers;

    use super::*;

    #[test]
    fn both_schemes() {
        use Navigation::{Blender, Industry};
        use PointerButton::{Middle, Primary, Secondary};
        let none = Modifiers::NONE;
        for (scheme, button, modifiers, expected) in [
            (Blender, Middle, none, Some(Move::Orbit)),
            (Blender, Middle, Modifiers::SHIFT, Some(Move::Pan)),
            (Blender, Middle, Modifiers::CTRL, Some(Move::Zoom)),
            (Blender, Primary, none, Some(Move::Orbit)),
            (Blender, Secondary, none, None),
            (Industry, Primary, Modifiers::ALT, Some(Move::Orbit)),
            (Industry, Middle, Modifiers::ALT, Some(Move::Pan)),
            (Industry, Secondary, Modifiers::ALT, Some(Move::Zoom)),
            (Industry, Secondary, none, None),
        ] {
            assert_eq!(meaning(scheme, button, modifiers), expected, "{scheme:?} {button:?}");
        }
    }
}
