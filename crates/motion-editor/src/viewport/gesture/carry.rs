//! What is selected goes over the floor with the pointer.

use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::selection::Selectable;

use super::snap::{GRID_M, snapped};
use crate::state::EditorState;
use crate::state::moving::Moving;

/// Marks on their way.
#[derive(Clone, Debug)]
pub struct Carry {
    moving: Moving,
    /// Where the one that was grabbed was, `[x, z]`.
    anchor_m: [f64; 2],
    /// Where the pointer grabbed it.
    grabbed_m: [f64; 2],
    /// What makes a copy, which is carried instead.
    copy: Option<Command>,
}

impl Carry {
    /// Grabs `at` with everything that is selected, or it alone where it is not; with `is_copy` a
    /// copy of it.
    pub fn begin(
        at: &ConstraintRef,
        grabbed_m: [f64; 2],
        is_copy: bool,
        state: &mut EditorState,
    ) -> Option<Self> {
        let anchor_m = state.place_of(at)?;
        if is_copy {
            return Self::copy(at, anchor_m, grabbed_m, state);
        }
        if !state.is_selected(at) {
            state.session.selection_mut().select(Selectable::Constraint(at.clone()));
        }
        let document = state.session.document();
        let moving = Moving::of(document, state.session.selection().constraints(document));
        state.begin_gesture(if moving.len() > 1 { "Move constraints" } else { "Move" });
        Some(Self { moving, anchor_m, grabbed_m, copy: None })
    }

    fn copy(
        at: &ConstraintRef,
        anchor_m: [f64; 2],
        grabbed_m: [f64; 2],
        state: &mut EditorState,
    ) -> Option<Self> {
        let document = state.session.document();
        let kind = document.constraint(at)?.kind.name();
        let id = document.next_id(at.character, kind);
        let frame = state.free_frame(at.character, state.frame_number() as u32);
        let copy = Command::Duplicate { at: at.clone(), frame };
        // The copy is where the original is, under a name of its own.
        let moving = Moving::of(document, [at]).renamed(&ConstraintRef::new(at.character, id));
        state.begin_gesture("Duplicate");
        Some(Self { moving, anchor_m, grabbed_m, copy: Some(copy) })
    }

    /// What brings everything to a pointer at `floor_m`.
    pub fn commands(
        &self,
        floor_m: [f64; 2],
        is_snapping: bool,
        state: &EditorState,
    ) -> Vec<Command> {
        let by = [0, 1].map(|axis| {
            let to = self.anchor_m[axis] + floor_m[axis] - self.grabbed_m[axis];
            snapped(to, GRID_M, is_snapping) - self.anchor_m[axis]
        });
        let mut commands: Vec<Command> = self.copy.iter().cloned().collect();
        if let Some(Command::Duplicate { frame, .. }) = self.copy {
            commands.extend(state.length_for(frame));
        }
        commands.extend(self.moving.moved([by[0], 0.0, by[1]]));
        commands
    }

    /// Whether something new is made.
    pub fn is_copy(&self) -> bool {
        self.copy.is_some()
    }
}

impl EditorState {
    /// `frame`, or the first after it at which no checkpoint of the character is.
    pub fn free_frame(&self, character: CharacterIdx, frame: u32) -> u32 {
        let marks =
            self.session.document().character(character).map_or(&[][..], |c| &c.constraints);
        let is_taken = |frame: u32| {
            marks.iter().any(|constraint| match constraint.kind {
                motion_session::ConstraintKind::Body { frame: taken, .. } => taken == frame,
                _ => false,
            })
        };
        // Apart enough to be told apart on the timeline.
        (frame..).step_by(10).find(|frame| !is_taken(*frame)).unwrap_or(frame)
    }
}
