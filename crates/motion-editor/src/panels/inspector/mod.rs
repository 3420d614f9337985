//! What is selected, in fields; the scene where nothing is; and everything that is asked for.

mod constraint;
pub mod field;
mod meeting;
mod obstacle;
mod outliner;
mod path;
mod pick_row;
mod scene;
mod tolerance;
mod velocity;

use egui::Ui;
use motion_session::selection::Selectable;

use super::{empty_ui, heading_ui};
use crate::state::EditorState;
use crate::theme;

/// The whole panel.
pub fn inspector_ui(ui: &mut Ui, state: &mut EditorState) {
    if let Some(mark) = state.selected_mark().cloned() {
        let fresh = mark_now(state, &mark);
        constraint::constraint_ui(ui, &fresh, state);
    } else if let Some(meeting) = state.selected_meeting().cloned() {
        meeting::meeting_ui(ui, &meeting, state);
    } else if let Some(Selectable::Obstacle(obstacle)) = state.selected().cloned() {
        obstacle::obstacle_ui(ui, obstacle, state);
    } else {
        scene::scene_ui(ui, state);
    }
    outliner::outliner_ui(ui, state);
    ui.add_space(4.0 * theme::GRID);
}

/// A mark as the document has it in this moment: the copy may be older than a drag.
fn mark_now(state: &EditorState, mark: &crate::mark::Mark) -> crate::mark::Mark {
    let known = state.session.document().constraint(&mark.at);
    let constraint = known.unwrap_or(&mark.constraint).clone();
    crate::mark::Mark { constraint, ..mark.clone() }
}
