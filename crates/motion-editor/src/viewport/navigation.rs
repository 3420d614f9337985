//! The mouse moves the camera.

use egui::{Event, MouseWheelSource, MouseWheelUnit, PointerButton, Rect, Response, Ui};
use glam::Vec2;
use motion_scene::camera::{OrbitCamera, Viewport};

use super::gesture::Claim;
use crate::settings::Navigation;

/// A drag over so many points turns once round.
const PT_PER_TURN: f32 = 900.0;
/// A drag over so many points doubles the distance.
const PT_PER_OCTAVE: f32 = 160.0;
/// So many points of wheel double the distance.
const WHEEL_PT_PER_OCTAVE: f32 = 240.0;

/// Two fingers over so many points turn once round.
const TOUCH_PT_PER_TURN: f32 = 1200.0;

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
        // With Alt or without: nothing else wants the middle button.
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

/// What the mouse did to the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moved {
    /// It moved at all.
    pub any: bool,
    /// It went across: a camera that follows somebody stops then.
    pub across: bool,
}

/// Moves the camera by what the mouse did over `response`; `claim` says what of the mouse is not
/// the camera's.
pub fn navigate_ui(
    ui: &Ui,
    response: &Response,
    camera: &mut OrbitCamera,
    scheme: Navigation,
    claim: Claim,
) -> Moved {
    let before = *camera;
    let across = move_ui(ui, response, camera, scheme, claim);
    Moved { any: *camera != before, across }
}

fn move_ui(
    ui: &Ui,
    response: &Response,
    camera: &mut OrbitCamera,
    scheme: Navigation,
    claim: Claim,
) -> bool {
    let rect = response.rect;
    let viewport = Viewport::new(rect.width(), rect.height());
    let modifiers = ui.input(|input| input.modifiers);
    let mut panned = false;
    for button in [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary] {
        let is_claimed = claim.button && button == PointerButton::Primary;
        if is_claimed || !response.dragged_by(button) {
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
    if let Some(at) = response.hover_pos().filter(|_| !claim.wheel) {
        let touch = fingers(ui);
        if touch != egui::Vec2::ZERO {
            if modifiers.shift {
                camera.pan(Vec2::new(touch.x, touch.y), viewport);
                panned = true;
            } else {
                let turn = std::f32::consts::TAU / TOUCH_PT_PER_TURN;
                camera.orbit(-touch.x * turn, touch.y * turn);
            }
        }
        let (wheel, zoom) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let wheel = if is_touch(ui) { 0.0 } else { wheel };
        if wheel != 0.0 || zoom != 1.0 {
            let factor = (-wheel / WHEEL_PT_PER_OCTAVE).exp2() / zoom;
            camera.dolly(factor, in_rect(rect, at), viewport);
        }
    }
    panned
}

/// How far two fingers went, on a touchpad or a screen. With Ctrl a touchpad zooms, which egui says
/// otherwise.
fn fingers(ui: &Ui) -> egui::Vec2 {
    ui.input(|input| {
        if let Some(touch) = input.multi_touch() {
            return touch.translation_delta;
        }
        let pad = input.events.iter().filter_map(|event| match event {
            Event::MouseWheel { unit: MouseWheelUnit::Point, delta, modifiers, .. }
                if !modifiers.command =>
            {
                Some(*delta)
            }
            _ => None,
        });
        match input.scroll_source() {
            Some(MouseWheelSource::Wheel) => egui::Vec2::ZERO,
            _ => pad.fold(egui::Vec2::ZERO, |sum, delta| sum + delta),
        }
    })
}

/// Whether what is scrolled now is scrolled by fingers: touchpads speak of points, wheels of lines.
fn is_touch(ui: &Ui) -> bool {
    let id = egui::Id::unique("scrolled by fingers");
    let said = ui.input(|input| {
        let unit = input.events.iter().rev().find_map(|event| match event {
            Event::MouseWheel { unit, .. } => Some(*unit == MouseWheelUnit::Point),
            _ => None,
        });
        unit.map(|is_point| is_point && input.scroll_source() != Some(MouseWheelSource::Wheel))
    });
    ui.data_mut(|data| {
        if let Some(said) = said {
            data.insert_temp(id, said);
        }
        data.get_temp(id).unwrap_or_default()
    })
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
