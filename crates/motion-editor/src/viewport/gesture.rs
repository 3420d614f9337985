//! Checkpoints placed, moved and turned on the floor with the mouse.

use egui::{CursorIcon, PointerButton, Response, Ui};
use glam::{Vec2, Vec3};
use motion_scene::camera::{OrbitCamera, Viewport};
use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;
use motion_session::selection::Selectable;
use motion_session::stage::pick::PickTarget;

use crate::settings::Tool;
use crate::state::EditorState;

/// With Shift places are brought to a grid of this, metres.
const SNAP_M: f64 = 0.25;
/// And headings to multiples of this, degrees.
const SNAP_DEG: f64 = 15.0;
/// A new checkpoint's arrow appears when the pointer is further away than this, metres.
const MIN_ARROW_M: f64 = 0.15;

/// What the left button is doing to the project.
#[derive(Clone, Debug, Default)]
pub struct Gesture(Option<Doing>);

#[derive(Clone, Debug)]
enum Doing {
    /// Something is brought along with the pointer, which took it so far from its middle, metres.
    Move(ConstraintRef, [f64; 2]),
    /// An arrow is turned towards the pointer.
    Turn(ConstraintRef),
    /// A new checkpoint stands where the button went down, for this frame.
    Add([f64; 2], u32),
}

impl Gesture {
    /// Follows the mouse over the view. Gives whether the left button belongs to it now.
    pub fn ui(
        &mut self,
        ui: &Ui,
        response: &Response,
        camera: &OrbitCamera,
        state: &mut EditorState,
    ) -> bool {
        let is_adding = state.settings.tool == Tool::Checkpoint;
        cursor_ui(ui, response, state);
        let pressed = response.contains_pointer()
            && ui.input(|input| input.pointer.button_pressed(PointerButton::Primary))
            && !ui.input(|input| input.modifiers.alt);
        if pressed && (is_adding || response.is_pointer_button_down_on()) {
            let at = ui.input(|input| input.pointer.press_origin());
            self.0 = at.and_then(|at| begin(floor_at(response, camera, at)?, state));
        }
        let Some(doing) = self.0.clone() else {
            return is_adding && response.dragged_by(PointerButton::Primary);
        };
        if !state.is_in_gesture() {
            // Escape has ended it.
            self.0 = None;
            return true;
        }
        let is_down = ui.input(|input| input.pointer.primary_down());
        let moved = ui.input(|input| input.pointer.delta() != egui::Vec2::ZERO) || pressed;
        let at = ui.input(|input| input.pointer.interact_pos());
        if is_down && moved {
            if let Some(floor) = at.and_then(|at| floor_at(response, camera, at)) {
                let is_snapping = ui.input(|input| input.modifiers.shift);
                let commands = commands(&doing, floor, is_snapping, state);
                if !commands.is_empty() {
                    state.preview(&commands);
                }
            }
        } else if !is_down {
            state.commit();
            self.0 = None;
            if let Doing::Add(..) = doing {
                select_last(state);
            }
        }
        true
    }
}

/// What a press on the floor begins; nothing where it means the camera.
fn begin(floor: [f64; 2], state: &mut EditorState) -> Option<Doing> {
    if state.settings.tool == Tool::Checkpoint {
        state.begin_gesture("Add checkpoint");
        return Some(Doing::Add(floor, state.frame_number() as u32));
    }
    let target = state.hovered?;
    let Selectable::Constraint(at) = state.selectable_of(target)? else { return None };
    let place = place_of(state, &at)?;
    if !state.is_selected(&at) {
        state.session.selection_mut().select(Selectable::Constraint(at.clone()));
    }
    match target {
        PickTarget::CheckpointTip { .. } => {
            state.begin_gesture("Turn checkpoint");
            Some(Doing::Turn(at))
        }
        PickTarget::Checkpoint { .. } => {
            state.begin_gesture("Move checkpoint");
            Some(Doing::Move(at, [place[0] - floor[0], place[1] - floor[1]]))
        }
        _ => None,
    }
}

fn commands(
    doing: &Doing,
    floor: [f64; 2],
    is_snapping: bool,
    state: &EditorState,
) -> Vec<Command> {
    let snapped = |value: f64, step: f64| {
        if is_snapping { (value / step).round() * step } else { value }
    };
    match doing {
        Doing::Move(at, off) => {
            let position_m = [0, 1].map(|axis| {
                // Millimetres are enough, and files stay readable.
                (snapped(floor[axis] + off[axis], SNAP_M) * 1000.0).round() / 1000.0
            });
            vec![Command::Move { at: at.clone(), position_m }]
        }
        Doing::Turn(at) => {
            let Some(from) = place_of(state, at) else { return Vec::new() };
            let heading = heading_deg(from, floor).map(|deg| snapped(deg, SNAP_DEG).round());
            heading
                .map(|deg| Command::Turn { at: at.clone(), heading_deg: Some(deg) })
                .into_iter()
                .collect()
        }
        Doing::Add(from, frame) => {
            let position_m =
                [0, 1].map(|axis| (snapped(from[axis], SNAP_M) * 1000.0).round() / 1000.0);
            let heading = heading_deg(position_m, floor).map(|deg| snapped(deg, SNAP_DEG).round());
            state.checkpoint_commands(*frame, position_m, heading)
        }
    }
}

/// Where on the floor a checkpoint is.
fn place_of(state: &EditorState, at: &ConstraintRef) -> Option<[f64; 2]> {
    match &state.session.document().constraint(at)?.kind {
        ConstraintKind::Body { position_m, .. } => Some(*position_m),
        _ => None,
    }
}

/// Selects the active character's constraint that was made last.
fn select_last(state: &mut EditorState) {
    let character = state.session.active();
    let constraints = state.session.document().character(character).map(|c| &c.constraints);
    let id = constraints.and_then(|constraints| constraints.last()).map(|c| c.id.clone());
    if let Some(id) = id {
        let at = ConstraintRef::new(character, id);
        state.session.selection_mut().select(Selectable::Constraint(at));
    }
}

/// From a place towards another, 0 along +Z and 90 along +X; `None` where they are too near.
fn heading_deg(from: [f64; 2], to: [f64; 2]) -> Option<f64> {
    let [x, z] = [to[0] - from[0], to[1] - from[1]];
    (x.hypot(z) > MIN_ARROW_M).then(|| x.atan2(z).to_degrees())
}

/// The place on the floor under the pointer, along X and Z.
fn floor_at(response: &Response, camera: &OrbitCamera, at: egui::Pos2) -> Option<[f64; 2]> {
    /// Near the horizon a pixel is a street.
    const FARTHEST_M: f32 = 200.0;
    let rect = response.rect;
    let off = at - rect.min;
    let viewport = Viewport::new(rect.width(), rect.height());
    let hit = camera.ray_through(Vec2::new(off.x, off.y), viewport).at_height(0.0)?;
    let is_near = hit.distance(camera.target_m * Vec3::new(1.0, 0.0, 1.0)) < FARTHEST_M;
    is_near.then(|| [f64::from(hit.x), f64::from(hit.z)])
}

fn cursor_ui(ui: &Ui, response: &Response, state: &EditorState) {
    if !response.contains_pointer() {
        return;
    }
    let icon = match (state.settings.tool, state.hovered) {
        (Tool::Checkpoint, _) => CursorIcon::Crosshair,
        (_, Some(PickTarget::Checkpoint { .. })) => CursorIcon::Move,
        (_, Some(PickTarget::CheckpointTip { .. })) => CursorIcon::Grab,
        _ => return,
    };
    ui.ctx().set_cursor_icon(icon);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_grow_to_the_left() {
        for (to, expected) in [
            ([0.0, 1.0], Some(0.0)),
            ([1.0, 0.0], Some(90.0)),
            ([-1.0, 0.0], Some(-90.0)),
            ([0.1, 0.1], None),
        ] {
            assert_eq!(heading_deg([0.0, 0.0], to), expected, "{to:?}");
        }
    }
}
