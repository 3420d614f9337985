//! An obstacle drawn on the floor.

use motion_session::command::Command;

use super::snap::{GRID_M, snapped};
use crate::obstacle_form::{self, ObstacleForm};
use crate::state::EditorState;

/// An obstacle on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewObstacle {
    form: ObstacleForm,
    from_m: [f64; 2],
}

impl NewObstacle {
    /// Begins where the button went down.
    pub fn begin(from_m: [f64; 2], state: &mut EditorState) -> Self {
        state.begin_gesture("Add obstacle");
        Self { form: state.obstacle_form, from_m }
    }

    /// What adds it with the pointer at a place; nothing while it is too small to be meant.
    pub fn commands(&self, to_m: [f64; 2], is_snapping: bool) -> Vec<Command> {
        let on_grid = |p: [f64; 2]| p.map(|axis| snapped(axis, GRID_M, is_snapping));
        let shape = self.form.drawn(on_grid(self.from_m), on_grid(to_m));
        shape.map(|shape| Command::AddObstacle { shape }).into_iter().collect()
    }

    /// What it is so far, in words.
    pub fn words(&self, to_m: Option<[f64; 2]>, is_snapping: bool) -> String {
        let made = to_m.map(|to_m| self.commands(to_m, is_snapping)).unwrap_or_default();
        let size = match made.first() {
            Some(Command::AddObstacle { shape }) => {
                let [width, depth] = obstacle_form::floor_m(shape);
                match self.form {
                    ObstacleForm::Cylinder => format!(" · radius {:.2} m", 0.5 * width),
                    _ => format!(" · {width:.2} × {depth:.2} m"),
                }
            }
            _ => String::new(),
        };
        format!("{}{size}   Shift: grid   Esc: as it was", self.form.name())
    }
}

/// What the tool would draw, in words.
pub fn tool_words(state: &EditorState) -> String {
    let form = state.obstacle_form;
    let how = match form {
        ObstacleForm::Cylinder => "drag from its middle",
        ObstacleForm::Box | ObstacleForm::Ceiling => "drag a rectangle on the floor",
    };
    format!("{}: {how}   O: {}", form.name(), form.next().name().to_lowercase())
}
