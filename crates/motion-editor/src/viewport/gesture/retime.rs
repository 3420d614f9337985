//! Ctrl and the wheel over a mark bring it to another frame.

use motion_session::command::Command;
use motion_session::document::ConstraintRef;
use motion_session::selection::Selectable;

use super::wheel;
use crate::state::EditorState;

/// A burst is over when the wheel rests for so long, seconds.
const REST_SECS: f64 = 0.7;

/// A burst of the wheel: one gesture.
#[derive(Clone, Debug)]
pub struct Retime {
    at: ConstraintRef,
    from: u32,
    notches: f32,
    until_secs: f64,
}

/// Follows the wheel. Gives whether it was meant for a mark.
pub fn retime_ui(
    ui: &egui::Ui,
    burst: &mut Option<Retime>,
    is_over: bool,
    state: &mut EditorState,
) -> bool {
    let notches = if is_over { wheel::notches(ui).0 } else { 0.0 };
    let (now, is_pressed) = ui.input(|input| (input.time, input.pointer.any_pressed()));
    if burst.is_some() && !state.is_in_gesture() {
        *burst = None;
    }
    if let Some(known) = burst
        && (now > known.until_secs || is_pressed)
    {
        state.commit();
        *burst = None;
    }
    if notches == 0.0 {
        if burst.is_some() {
            ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(REST_SECS));
        }
        return burst.is_some();
    }
    if burst.is_none() {
        *burst = begin(state, now);
    }
    let Some(known) = burst else { return false };
    known.notches += notches;
    known.until_secs = now + REST_SECS;
    let frame = (f64::from(known.from) + f64::from(known.notches.round())).max(0.0) as u32;
    let mut commands = vec![Command::Retime { at: known.at.clone(), frame }];
    commands.extend(state.length_for(frame));
    state.preview(&commands);
    true
}

fn begin(state: &mut EditorState, now: f64) -> Option<Retime> {
    let Selectable::Constraint(at) = state.selectable_of(state.hovered?)? else { return None };
    let mark = state.marks.iter().find(|mark| mark.at == at)?;
    let from = mark.frame() as u32;
    state.session.selection_mut().select(Selectable::Constraint(at.clone()));
    state.begin_gesture("Retime");
    Some(Retime { at, from, notches: 0.0, until_secs: now + REST_SECS })
}
