//! The project that is open, and how it is changed and changed back.

use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef, Document};
use motion_session::live::Wake;
use motion_session::session::SessionOptions;
use motion_session::stage::pick::PickTarget;
use motion_session::{Constraint, ConstraintKind, Session, Warnings};

use crate::project_source::ProjectSource;

/// A person's usual speed, metres per second: what a new checkpoint's frame is guessed by.
const WALK_M_S: f64 = 1.2;

/// A session, as the window speaks of it.
pub struct Authoring {
    /// The document with its history and its search.
    pub session: Session,
    /// Why the last change was refused.
    pub refusal: Option<String>,
}

impl Authoring {
    /// Opens a project; fails with a sentence.
    pub fn new(source: &ProjectSource, wake: Wake) -> Result<Self, String> {
        let project = source.read(&mut Warnings::new())?.0;
        let options =
            SessionOptions { state_folder: None, wake, builtin: None, project: Some(project) };
        let mut session = Session::new(options).map_err(|error| error.to_string())?;
        if let ProjectSource::File(path) = source {
            // Again, so that the session knows the file that it saves to.
            session.open(path).map_err(|error| error.to_string())?;
        }
        Ok(Self { session, refusal: None })
    }

    /// The document as it is, or would be after the gesture under way.
    pub fn document(&self) -> &Document {
        self.session.document()
    }

    /// The constraints of the character number `nth`.
    pub fn constraints(&self, nth: usize) -> &[Constraint] {
        self.document().character(CharacterIdx(nth)).map_or(&[], |c| c.constraints.as_slice())
    }

    /// The constraint that a mark in the view or on the timeline stands for.
    pub fn constraint_of(&self, target: PickTarget) -> Option<ConstraintRef> {
        match target {
            PickTarget::Checkpoint { character, constraint }
            | PickTarget::CheckpointTip { character, constraint }
            | PickTarget::JointTarget { character, constraint } => {
                let id = &self.constraints(character).get(constraint)?.id;
                Some(ConstraintRef::new(CharacterIdx(character), id.clone()))
            }
            _ => None,
        }
    }

    /// Where and when a body constraint is.
    pub fn checkpoint(&self, at: &ConstraintRef) -> Option<(u32, [f64; 2])> {
        match &self.document().constraint(at)?.kind {
            ConstraintKind::Body { frame, position_m, .. } => Some((*frame, *position_m)),
            _ => None,
        }
    }

    /// Does something as one step.
    pub fn apply(&mut self, command: &Command) {
        self.refusal = self.session.apply(command).err().map(|error| error.to_string());
    }

    /// Begins a gesture, which becomes one step.
    pub fn begin(&mut self, label: &str) {
        self.refusal = None;
        self.session.begin_gesture(label);
    }

    /// Shows what the gesture would do.
    pub fn preview(&mut self, commands: &[Command]) {
        self.refusal = self.session.preview(commands).err().map(|error| error.to_string());
    }

    /// Ends the gesture.
    pub fn commit(&mut self) {
        self.session.commit();
    }

    /// Ends the gesture as if it had not been; gives whether there was one.
    pub fn cancel(&mut self) -> bool {
        let is_in_gesture = self.is_in_gesture();
        self.session.cancel();
        is_in_gesture
    }

    /// Whether a gesture is under way.
    pub fn is_in_gesture(&self) -> bool {
        self.session.history().is_in_gesture()
    }

    /// Takes back the last step.
    pub fn undo(&mut self) {
        self.refusal = None;
        self.session.undo();
    }

    /// Does again what was taken back.
    pub fn redo(&mut self) {
        self.refusal = None;
        self.session.redo();
    }

    /// Whether there is a step to take back, and one to do again.
    pub fn can_undo_redo(&self) -> (bool, bool) {
        let history = self.session.history();
        (history.undo_label().is_some(), history.redo_label().is_some())
    }

    /// Writes the project to its own file.
    pub fn save(&mut self) {
        self.refusal = self.session.save().err().map(|error| error.to_string());
    }

    /// Commands that put a checkpoint for the first character: at `frame` if no other is there,
    /// else when somebody who walks from the last one would come by. The motion gets as long as it
    /// must be.
    pub fn add_checkpoint(
        &self,
        frame: u32,
        position_m: [f64; 2],
        heading_deg: Option<f64>,
    ) -> Vec<Command> {
        let character = CharacterIdx(0);
        let others: Vec<(u32, [f64; 2])> = self
            .before_gesture()
            .iter()
            .filter_map(|constraint| match &constraint.kind {
                ConstraintKind::Body { frame, position_m, .. } => Some((*frame, *position_m)),
                _ => None,
            })
            .collect();
        let mut frame = frame;
        if others.iter().any(|(other, _)| *other == frame)
            && let Some((last, from)) = others.iter().max_by_key(|(frame, _)| *frame)
        {
            let metres = (position_m[0] - from[0]).hypot(position_m[1] - from[1]);
            let frames = (metres / WALK_M_S * self.document().fps()).round().max(10.0);
            frame = last + frames as u32;
        }
        let mut commands =
            vec![Command::AddCheckpoint { character, frame, position_m, heading_deg }];
        let length = self.document().character(character).and_then(|c| c.length.as_ref());
        if let Some(length) = length
            && length.frames.is_some_and(|frames| frames <= frame)
        {
            let frames = Some(frame + 1);
            commands.push(Command::SetLength { character, frames, mode: length.mode });
        }
        commands
    }

    /// The first character's constraints without what the gesture under way has made.
    fn before_gesture(&self) -> &[Constraint] {
        let settled = self.session.history().settled();
        settled.character(CharacterIdx(0)).map_or(&[], |c| c.constraints.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    fn sample() -> Authoring {
        Authoring::new(&ProjectSource::Sample, Arc::new(|| ())).unwrap()
    }

    fn frames(authoring: &Authoring) -> Vec<u32> {
        authoring.constraints(0).iter().map(|c| c.kind.last_frame()).collect()
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut authoring = sample();
        let at = ConstraintRef::new(CharacterIdx(0), "corner");
        authoring.begin("Retime");
        for frame in [100, 90] {
            authoring.preview(&[Command::Retime { at: at.clone(), frame }]);
        }
        authoring.commit();
        assert_eq!(frames(&authoring), [0, 90, 239]);
        authoring.undo();
        assert_eq!(frames(&authoring), [0, 110, 239]);
        assert_eq!(authoring.can_undo_redo(), (false, true));
    }

    #[test]
    fn a_new_checkpoint_takes_the_playhead_or_the_time_it_needs() {
        let mut authoring = sample();
        authoring.begin("Add");
        authoring.preview(&authoring.add_checkpoint(60, [0.0, 2.0], None));
        authoring.commit();
        assert_eq!(frames(&authoring), [0, 110, 239, 60]);
        // The end is at 5.5, 5; 2.4 m further are two seconds.
        authoring.begin("Add");
        authoring.preview(&authoring.add_checkpoint(60, [7.9, 5.0], Some(90.0)));
        authoring.commit();
        assert_eq!(frames(&authoring), [0, 110, 239, 60, 299]);
        let length = authoring.document().characters()[0].length.as_ref().unwrap();
        assert_eq!(length.frames, Some(300));
        assert_eq!(authoring.refusal, None);
    }

    #[test]
    fn what_is_refused_says_why() {
        let mut authoring = sample();
        for id in ["corner", "end"] {
            let at = ConstraintRef::new(CharacterIdx(0), id);
            authoring.apply(&Command::Remove { at });
        }
        assert!(authoring.refusal.is_some_and(|why| why.contains("start and an end")));
    }
}
