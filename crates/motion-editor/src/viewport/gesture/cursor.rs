//! What the pointer looks like over the view.

use egui::{CursorIcon, Ui};
use motion_session::stage::pick::PickTarget;

use crate::settings::Tool;
use crate::state::EditorState;

/// Has the pointer look like what a press would do.
pub(super) fn cursor_ui(
    ui: &Ui,
    is_over: bool,
    box_is_due: bool,
    has_handle: bool,
    state: &EditorState,
) {
    if !is_over {
        return;
    }
    let icon = match (state.settings.tool, state.hovered) {
        _ if box_is_due => CursorIcon::Crosshair,
        _ if has_handle => CursorIcon::Move,
        (Tool::ByHand, _) => CursorIcon::Grab,
        (Tool::Path, _) => CursorIcon::Crosshair,
        (Tool::Select | Tool::Checkpoint, Some(PickTarget::CheckpointTip { .. })) => {
            CursorIcon::Grab
        }
        (
            Tool::Select | Tool::Checkpoint,
            Some(
                PickTarget::Checkpoint { .. }
                | PickTarget::Pose { .. }
                | PickTarget::Path { .. }
                | PickTarget::Meeting { .. },
            ),
        )
        | (Tool::Obstacle, Some(PickTarget::Obstacle { .. }))
        | (_, Some(PickTarget::JointTarget { .. })) => CursorIcon::Move,
        (Tool::Checkpoint | Tool::JointTarget | Tool::Pose | Tool::Obstacle, _) => {
            CursorIcon::Crosshair
        }
        _ => return,
    };
    ui.ctx().set_cursor_icon(icon);
}
