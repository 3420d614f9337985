//! A clip's pose that is brought from the library to the timeline is asked for at that frame,
//! wherever the body is then.

use egui::{Pos2, Rect, Stroke, Ui};
use motion_scene::color::ColorRole;
use motion_session::command::Command;

use super::axis::Axis;
use crate::settings::Tool;
use crate::state::EditorState;
use crate::theme;
use crate::viewport::gesture::pose::{PoseDrag, source};

/// Shows the frame while a pose is over the lanes, and asks for it where it is dropped.
pub fn pose_drop_ui(ui: &Ui, lanes: Rect, axis: &Axis, state: &mut EditorState) {
    if !PoseDrag::is_under_way(ui) {
        return;
    }
    let at = ui.input(|input| input.pointer.interact_pos()).filter(|at| lanes.contains(*at));
    let Some(at) = at else { return };
    let frame = axis.frame_at(at.x).round().max(0.0);
    let palette = theme::of(ui);
    let color = theme::role(ColorRole::Pose, palette.theme);
    let x = axis.x_of(frame);
    ui.painter().vline(x, lanes.y_range(), Stroke::new(2.0, color));
    let words = state.settings.time_unit.text(frame as usize, state.fps());
    let beside = Pos2::new(x + 6.0, lanes.top() + 30.0);
    ui.painter().text(beside, egui::Align2::LEFT_TOP, words, theme::caption(), palette.text);
    if !PoseDrag::is_dropped(ui) {
        return;
    }
    state.settings.tool = Tool::Select;
    let Some((clip, clip_frame)) = source(state) else { return };
    let frame = frame as u32;
    let (position_m, heading_deg) = (None, None);
    let character = state.session.active();
    let mut commands =
        vec![Command::AddPose { character, frame, clip, clip_frame, position_m, heading_deg }];
    commands.extend(state.length_for(frame));
    if state.apply_all("Add pose", &commands) {
        state.select_newest();
    }
}
