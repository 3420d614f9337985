//! What is selected goes over the floor with the pointer.

use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef, ObstacleIdx};
use motion_session::selection::Selectable;

use super::snap::{GRID_M, snapped};
use crate::obstacle_form;
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
    /// Grabs `item` with everything that is selected, or it alone where it is not; with `is_copy` a
    /// copy of it.
    pub fn begin(
        item: &Selectable,
        grabbed_m: [f64; 2],
        is_copy: bool,
        state: &mut EditorState,
    ) -> Option<Self> {
        let anchor_m = state.place_of_item(item)?;
        if is_copy {
            return Self::copy(item, anchor_m, grabbed_m, state);
        }
        if !state.session.selection().contains(item) {
            state.session.selection_mut().select(item.clone());
        }
        let document = state.session.document();
        let moving = Moving::of_items(document, state.session.selection().items(document));
        state.begin_gesture(match (moving.len(), item) {
            (2.., _) => "Move together",
            (_, Selectable::Obstacle(_)) => "Move obstacle",
            _ => "Move",
        });
        Some(Self { moving, anchor_m, grabbed_m, copy: None })
    }

    fn copy(
        item: &Selectable,
        anchor_m: [f64; 2],
        grabbed_m: [f64; 2],
        state: &mut EditorState,
    ) -> Option<Self> {
        let document = state.session.document();
        let (copy, moving) = match item {
            Selectable::Constraint(at) => {
                let kind = document.constraint(at)?.kind.name();
                let id = document.next_id(at.character, kind);
                let frame = state.free_frame(at.character, state.frame_number() as u32);
                // The copy is where the original is, under a name of its own.
                let new = ConstraintRef::new(at.character, id);
                let moving = Moving::of(document, [at]).renamed(&new);
                (Command::Duplicate { at: at.clone(), frame }, moving)
            }
            Selectable::Obstacle(obstacle) => {
                let shape = document.obstacle(*obstacle)?.shape.clone();
                let new = ObstacleIdx(document.obstacles().len());
                let moving = Moving::of_obstacle(new, shape.clone());
                (Command::AddObstacle { shape }, moving)
            }
            Selectable::Character(_) | Selectable::Interaction(_) | Selectable::Take(..) => {
                return None;
            }
        };
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

    /// What makes a copy, where one is made.
    pub fn copy_of(&self) -> Option<&Command> {
        self.copy.as_ref()
    }
}

impl EditorState {
    /// Where on the floor something is, if it is anywhere.
    pub fn place_of_item(&self, item: &Selectable) -> Option<[f64; 2]> {
        match item {
            Selectable::Constraint(at) => self.place_of(at),
            Selectable::Obstacle(obstacle) => {
                let known = self.session.document().obstacle(*obstacle)?;
                let [x, _, z] = obstacle_form::center_m(&known.shape);
                Some([x, z])
            }
            Selectable::Character(_) | Selectable::Interaction(_) | Selectable::Take(..) => None,
        }
    }

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
