//! How fast a joint goes where it is asked for.

use egui::Ui;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;

use super::field::{Number, parts_row_ui, tick_row_ui};
use crate::state::EditorState;

/// Any velocity, or its three parts.
pub(super) fn velocity_ui(
    ui: &mut Ui,
    at: &ConstraintRef,
    velocity_m_s: Option<[f64; 3]>,
    state: &mut EditorState,
) {
    let set = |velocity_m_s| Command::SetVelocity { at: at.clone(), velocity_m_s };
    if tick_row_ui(ui, "Any velocity", velocity_m_s.is_none()) {
        state.apply(&set(velocity_m_s.is_none().then_some([0.0; 3])));
    }
    let Some(known) = velocity_m_s else { return };
    let parts =
        [("x ", "Velocity x"), ("y ", "Velocity y"), ("z ", "Velocity z")].map(|(letter, name)| {
            let range = (-100.0, 100.0);
            (letter, Number { unit: "", speed: 0.02, range, ..Number::metres(name) })
        });
    parts_row_ui(ui, "m/s", parts, known, state, |known| vec![set(Some(known))]);
}
