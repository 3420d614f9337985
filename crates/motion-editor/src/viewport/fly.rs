//! Flying: the mouse turns the camera about itself, keys move it.

use egui::{Key, PointerButton, Ui, ViewportCommand};
use glam::Vec3;
use motion_scene::camera::OrbitCamera;

use super::gesture::wheel;

/// A drag over so many points turns once round.
const PT_PER_TURN: f32 = 1400.0;
/// Shift makes it so many times as fast.
const HURRY: f32 = 4.0;
/// A notch of the wheel changes the speed by this factor.
const NOTCH: f32 = 1.25;

/// How one flies.
#[derive(Clone, Copy, Debug)]
pub struct Fly {
    /// Where it began.
    before: OrbitCamera,
    /// Whether it lasts as long as the right button is held.
    is_held: bool,
}

/// What becomes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flight {
    /// It goes on.
    Goes,
    /// The camera stays where it is.
    Landed,
    /// The camera goes back to where it was.
    Cancelled,
}

impl Fly {
    /// Takes off. The pointer is held and hidden meanwhile.
    pub fn begin(ctx: &egui::Context, camera: &OrbitCamera, is_held: bool) -> Self {
        if !is_held {
            ctx.send_viewport_cmd(ViewportCommand::CursorGrab(egui::CursorGrab::Locked));
            ctx.send_viewport_cmd(ViewportCommand::CursorVisible(false));
        }
        Self { before: *camera, is_held }
    }

    /// Where the camera was.
    pub fn before(&self) -> OrbitCamera {
        self.before
    }

    /// Goes on for a frame. `speed_m_s` is kept for the next flight.
    pub fn ui(&self, ui: &Ui, camera: &mut OrbitCamera, speed_m_s: &mut f32) -> Flight {
        let (with_ctrl, without) = wheel::notches(ui);
        *speed_m_s = (*speed_m_s * NOTCH.powf(with_ctrl + without)).clamp(0.1, 50.0);
        let (by, way, dt_secs, end) = ui.input(|input| {
            let by = input.pointer.motion().unwrap_or(input.pointer.delta());
            let held = |key: Key| f32::from(u8::from(input.key_down(key)));
            let way = Vec3::new(
                held(Key::D) - held(Key::A),
                held(Key::E) - held(Key::Q),
                held(Key::S) - held(Key::W),
            );
            let hurry = if input.modifiers.shift { HURRY } else { 1.0 };
            let end = match self.is_held {
                true if input.pointer.button_down(PointerButton::Secondary) => Flight::Goes,
                true => Flight::Landed,
                false if input.pointer.secondary_pressed() => Flight::Cancelled,
                false if input.pointer.primary_pressed() => Flight::Landed,
                false => Flight::Goes,
            };
            (by, way * hurry, input.stable_dt.min(0.1), end)
        });
        turn_head(camera, by);
        let step =
            camera.world_from_view_rotation() * Vec3::new(way.x, 0.0, way.z) + Vec3::Y * way.y;
        camera.target_m += step * *speed_m_s * dt_secs;
        ui.ctx().request_repaint();
        end
    }

    /// Gives the pointer back.
    pub fn end(ctx: &egui::Context) {
        ctx.send_viewport_cmd(ViewportCommand::CursorGrab(egui::CursorGrab::None));
        ctx.send_viewport_cmd(ViewportCommand::CursorVisible(true));
    }
}

/// Looks elsewhere from the same place.
fn turn_head(camera: &mut OrbitCamera, by: egui::Vec2) {
    let eye_m = camera.eye_m();
    let turn = std::f32::consts::TAU / PT_PER_TURN;
    camera.orbit(-by.x * turn, by.y * turn);
    camera.target_m = eye_m + camera.forward() * camera.distance_m;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_eye_stays_while_the_head_turns() {
        let mut camera = OrbitCamera::default();
        let (eye_m, yaw_rad) = (camera.eye_m(), camera.yaw_rad);
        turn_head(&mut camera, egui::Vec2::new(100.0, 40.0));
        assert!(camera.eye_m().distance(eye_m) < 1e-4);
        assert!(camera.yaw_rad < yaw_rad, "a mouse to the right looks to the right");
    }
}
