//! What keys do to constraints: small steps, turns, a checkpoint ahead, everything selected.

use motion_session::ConstraintKind;
use motion_session::document::ConstraintRef;
use motion_session::selection::Selectable;

use super::EditorState;
use super::moving::{Moving, rounded, wrapped_deg};

/// Presses that come within so many seconds are one step of the history.
const MERGE_SECS: f64 = 1.0;
/// A checkpoint by key stands so far ahead of the body, metres.
const AHEAD_M: f64 = 1.0;

/// A small step that the next of its kind may join.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Merging {
    label: &'static str,
    moving: Moving,
    sum: [f64; 3],
    until_secs: f64,
    n_steps: (usize, usize),
}

impl EditorState {
    /// Moves what is selected by so much, `[x, y, z]`. Presses in quick succession are one step.
    pub fn nudge_selected(&mut self, by_m: [f64; 3]) {
        self.step_selected("Nudge", by_m, Moving::moved);
    }

    /// Turns what is selected to the left. Presses in quick succession are one step.
    pub fn turn_selected(&mut self, by_deg: f64) {
        self.step_selected("Turn", [by_deg, 0.0, 0.0], |moving, sum| moving.turned(sum[0]));
    }

    fn step_selected(
        &mut self,
        label: &'static str,
        by: [f64; 3],
        commands: impl Fn(&Moving, [f64; 3]) -> Vec<motion_session::command::Command>,
    ) {
        let document = self.session.document();
        let selected = self.selected_items();
        let now = Moving::of_items(document, &selected);
        let now_secs = self.wake.input(|input| input.time);
        let n_steps = self.session.history().n_steps();
        let joins = |last: &Merging| {
            last.label == label
                && now_secs < last.until_secs
                && last.n_steps == n_steps
                && Moving::of_items(document, &selected).is_like(&last.moving)
        };
        let (moving, sum) = match self.merging.take().filter(joins) {
            Some(last) => {
                self.session.undo();
                (last.moving, [0, 1, 2].map(|axis| last.sum[axis] + by[axis]))
            }
            None => (now, by),
        };
        let commands = commands(&moving, sum);
        if commands.is_empty() {
            return;
        }
        if self.apply_all(label, &commands) {
            let n_steps = self.session.history().n_steps();
            let until_secs = now_secs + MERGE_SECS;
            self.merging = Some(Merging { label, moving, sum, until_secs, n_steps });
        }
    }

    /// Puts a checkpoint in front of the active character, at the playhead, and selects it.
    pub fn add_checkpoint_ahead(&mut self) {
        let Some(actor) = self.stage.actors.get(self.session.active().0) else { return };
        let pose = actor.body_at(self.frame(), actor.look).world_from_joint;
        let Some(root) = pose.first() else { return };
        let (at_m, ahead) = (root.w_axis.truncate(), root.z_axis.truncate());
        let heading_rad = f64::from(ahead.x.atan2(ahead.z));
        let position_m = [
            rounded(f64::from(at_m.x) + AHEAD_M * heading_rad.sin()),
            rounded(f64::from(at_m.z) + AHEAD_M * heading_rad.cos()),
        ];
        let heading_deg = Some(wrapped_deg(heading_rad.to_degrees().round()));
        let frame = self.frame_number() as u32;
        let commands = self.checkpoint_commands(frame, position_m, heading_deg);
        if self.apply_all("Add checkpoint", &commands) {
            self.select_newest();
        }
    }

    /// Selects the active character's constraint that was made last.
    pub fn select_newest(&mut self) {
        let character = self.session.active();
        let constraints = self.session.document().character(character).map(|c| &c.constraints);
        let id = constraints.and_then(|constraints| constraints.last()).map(|c| c.id.clone());
        if let Some(id) = id {
            let at = ConstraintRef::new(character, id);
            self.session.selection_mut().select(Selectable::Constraint(at));
        }
    }

    /// Where on the floor a constraint is, if it is anywhere.
    pub fn place_of(&self, at: &ConstraintRef) -> Option<[f64; 2]> {
        match &self.session.document().constraint(at)?.kind {
            ConstraintKind::Body { position_m, .. } => Some(*position_m),
            ConstraintKind::Pose { position_m, .. } => *position_m,
            ConstraintKind::Joint { position_m: [x, _, z], .. } => Some([*x, *z]),
            ConstraintKind::Path { points_m, .. } => points_m.first().copied(),
            _ => None,
        }
    }
}
