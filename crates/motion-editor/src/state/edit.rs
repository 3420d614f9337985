//! Changes of the document. What is refused is said.

use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ObstacleIdx};
use motion_session::selection::Selectable;

use super::EditorState;

/// A person's usual speed, metres per second: what a new checkpoint's frame is guessed by.
pub(super) const WALK_M_S: f64 = 1.2;

impl EditorState {
    /// Does something as one step. Gives whether it was done.
    pub fn apply(&mut self, command: &Command) -> bool {
        let done = self.session.apply(command);
        self.after(done)
    }

    /// Does several things as one step, all or none. Gives whether they were done.
    pub fn apply_all(&mut self, label: &str, commands: &[Command]) -> bool {
        let done = self.session.apply_all(label, commands);
        self.after(done)
    }

    /// Begins a gesture, which becomes one step.
    pub fn begin_gesture(&mut self, label: &str) {
        self.notices.clear_refusal();
        self.session.begin_gesture(label);
    }

    /// Shows what the gesture would do.
    pub fn preview(&mut self, commands: &[Command]) {
        let done = self.session.preview(commands);
        self.after(done);
    }

    /// Ends the gesture.
    pub fn commit(&mut self) {
        self.session.commit();
        self.refresh();
    }

    /// Ends the gesture as if it had not been; gives whether there was one.
    pub fn cancel(&mut self) -> bool {
        let beside = std::mem::take(&mut self.is_dragging_beside);
        let was_in_gesture = self.is_in_gesture() || beside;
        self.session.cancel();
        self.refresh();
        was_in_gesture
    }

    /// Whether a gesture is under way.
    pub fn is_in_gesture(&self) -> bool {
        self.session.history().is_in_gesture()
    }

    fn after(&mut self, done: Result<(), motion_session::command::CommandError>) -> bool {
        let is_done = done.is_ok();
        match done {
            Ok(()) => self.notices.clear_refusal(),
            Err(error) => self.notices.refuse(error.to_string()),
        }
        self.refresh();
        is_done
    }

    /// Removes what is selected, as one step.
    pub fn delete_selected(&mut self) {
        if let Some((id, _)) = self.selected_edit() {
            let id = id.to_owned();
            self.remove_hand_edit(&id);
            return;
        }
        if let Some(nth) = self.knot_to_delete() {
            self.remove_knot(nth);
            return;
        }
        let document = self.session.document();
        let selection = self.session.selection();
        // Obstacles are places in a list: the last first.
        let mut items: Vec<&Selectable> = selection.items(document).collect();
        items.sort();
        let commands: Vec<Command> = items
            .into_iter()
            .rev()
            .filter_map(|item| match item {
                Selectable::Constraint(at) => Some(Command::Remove { at: at.clone() }),
                Selectable::Obstacle(obstacle) => {
                    Some(Command::RemoveObstacle { obstacle: *obstacle })
                }
                Selectable::Interaction(id) => Some(Command::RemoveInteraction { id: id.clone() }),
                Selectable::Character(_) | Selectable::Take(..) => None,
            })
            .collect();
        if let [command] = commands.as_slice() {
            self.apply(command);
        } else if !commands.is_empty() {
            self.apply_all("Delete", &commands);
        }
    }

    /// Selects the obstacle that was made last.
    pub fn select_newest_obstacle(&mut self) {
        let n = self.session.document().obstacles().len();
        if let Some(last) = n.checked_sub(1) {
            let item = Selectable::Obstacle(ObstacleIdx(last));
            self.session.selection_mut().select(item);
        }
    }

    /// Commands that put a checkpoint for the active character: at `frame` if no other is there,
    /// else when somebody who walks from the last one would come by. The motion gets as long as it
    /// must be.
    pub fn checkpoint_commands(
        &self,
        frame: u32,
        position_m: [f64; 2],
        heading_deg: Option<f64>,
    ) -> Vec<Command> {
        let character = self.session.active();
        let others = self.checkpoints_before_gesture(character);
        let mut frame = frame;
        if others.iter().any(|(other, _)| *other == frame)
            && let Some((last, from)) = others.iter().max_by_key(|(frame, _)| *frame)
        {
            let metres = (position_m[0] - from[0]).hypot(position_m[1] - from[1]);
            let frames = (metres / WALK_M_S * self.fps()).round().max(10.0);
            frame = last + frames as u32;
        }
        let mut commands =
            vec![Command::AddCheckpoint { character, frame, position_m, heading_deg }];
        commands.extend(self.length_for(frame));
        commands
    }

    /// What makes the active character's motion long enough for `frame`, where it is not.
    pub fn length_for(&self, frame: u32) -> Option<Command> {
        self.length_of_for(self.session.active(), frame)
    }

    /// The same for any character.
    pub fn length_of_for(&self, character: CharacterIdx, frame: u32) -> Option<Command> {
        let settled = self.session.history().settled();
        let length = settled.character(character)?.length.as_ref()?;
        let too_short = length.frames.is_some_and(|frames| frames <= frame);
        let mode = length.mode;
        too_short.then_some(Command::SetLength { character, frames: Some(frame + 1), mode })
    }

    /// Frames and places of body constraints without what the gesture under way has made.
    fn checkpoints_before_gesture(&self, character: CharacterIdx) -> Vec<(u32, [f64; 2])> {
        let settled = self.session.history().settled();
        let constraints = settled.character(character).map_or(&[][..], |c| &c.constraints);
        let place = |kind: &ConstraintKind| match kind {
            ConstraintKind::Body { frame, position_m, .. } => Some((*frame, *position_m)),
            _ => None,
        };
        constraints.iter().filter_map(|constraint| place(&constraint.kind)).collect()
    }
}

#[cfg(test)]
mod tests {
    use motion_session::document::ConstraintRef;

    use super::*;
    use crate::project_source::ProjectSource;
    use crate::state::EditorOptions;

    fn sample() -> EditorState {
        let ctx = egui::Context::default();
        EditorState::new(EditorOptions::new(ProjectSource::Sample), &ctx).unwrap()
    }

    fn frames(state: &EditorState) -> Vec<usize> {
        state.marks.iter().map(crate::mark::Mark::frame).collect()
    }

    fn at(id: &str) -> ConstraintRef {
        ConstraintRef::new(CharacterIdx(0), id)
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut state = sample();
        state.begin_gesture("Retime");
        for frame in [100, 90] {
            state.preview(&[Command::Retime { at: at("corner"), frame }]);
        }
        state.commit();
        assert_eq!(frames(&state), [0, 90, 239]);
        state.session.undo();
        state.refresh();
        assert_eq!(frames(&state), [0, 110, 239]);
        assert_eq!(state.session.history().n_steps(), (0, 1));
    }

    #[test]
    fn a_new_checkpoint_takes_the_playhead_or_the_time_it_needs() {
        let mut state = sample();
        state.apply_all("Add", &state.checkpoint_commands(60, [0.0, 2.0], None));
        assert_eq!(frames(&state), [0, 60, 110, 239]);
        // The end is at 5.5, 5; 2.4 m further are two seconds.
        state.apply_all("Add", &state.checkpoint_commands(60, [7.9, 5.0], Some(90.0)));
        assert_eq!(frames(&state), [0, 60, 110, 239, 299]);
        let length = state.session.document().characters()[0].length.as_ref().unwrap();
        assert_eq!(length.frames, Some(300));
        assert_eq!(state.notices.refusal(), None);
    }

    #[test]
    fn what_is_refused_says_why() {
        let mut state = sample();
        for id in ["corner", "end"] {
            state.apply(&Command::Remove { at: at(id) });
        }
        assert!(state.notices.refusal().is_some_and(|why| why.contains("start and an end")));
    }
}
