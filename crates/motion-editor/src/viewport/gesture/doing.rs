//! What a press becomes: what is grabbed, and what is done with it.

use egui::Pos2;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;
use motion_session::selection::Selectable;

use super::by_hand::HandPull;
use super::carry::Carry;
use super::handle::Handle;
use super::handle_pull::HandlePull;
use super::joint::{AimedJoint, Pull};
use super::meeting::MeetingPull;
use super::modal::Modal;
use super::mouse::Mouse;
use super::obstacle::NewObstacle;
use super::sight::Sight;
use super::snap::{GRID_M, heading_deg, snapped};
use super::stroke::Stroke;
use crate::state::EditorState;
use crate::state::moving::rounded;

/// What mouse and keys are doing.
#[derive(Clone, Debug, Default)]
pub(super) enum Doing {
    #[default]
    Nothing,
    /// The button went down on something, and nothing has moved.
    Pressed(Pos2, Grab),
    /// Marks go with the pointer.
    Carry(Carry),
    /// An arrow is turned towards the pointer.
    Turn(ConstraintRef),
    /// A member of a meeting is brought elsewhere.
    Meeting(MeetingPull),
    /// A handle of what is selected is held.
    Handle(HandlePull),
    /// A path is drawn.
    Stroke(Stroke),
    /// An obstacle is drawn.
    Obstacle(NewObstacle),
    /// A new checkpoint stands where the button went down, for this frame.
    Add([f64; 2], u32),
    /// A joint target is pulled.
    Pull(Pull),
    /// Something of the shown take is changed by hand.
    ByHand(Box<HandPull>),
    /// A pose stands where the button went down.
    Pose(Pos2),
    /// A box is drawn.
    Box(Pos2),
    /// Time goes with the pointer: the moment and the place at which it began.
    Shuttle(f64, Pos2),
    /// What is selected follows the pointer.
    Modal(Modal),
    /// It is over, but the button is still down.
    Spent,
}

/// What a press was on.
#[derive(Clone, Debug)]
pub(super) enum Grab {
    Item(Selectable, bool),
    Handle(Handle),
    Meeting(String, usize),
    Tip(ConstraintRef),
    Target(ConstraintRef),
    Joint(AimedJoint),
    ByHand(AimedJoint),
}

impl Grab {
    /// What a drag of it is.
    pub(super) fn begin(self, from: Pos2, sight: &Sight, state: &mut EditorState) -> Doing {
        let begun = match self {
            Self::Item(item, is_copy) => sight
                .floor(from)
                .and_then(|floor_m| Carry::begin(&item, floor_m, is_copy, state))
                .map(Doing::Carry),
            Self::Handle(handle) => HandlePull::begin(&handle, from, state).map(Doing::Handle),
            Self::Meeting(id, member) => {
                MeetingPull::begin(&id, member, from, sight, state).map(Doing::Meeting)
            }
            Self::Tip(at) => {
                if !state.is_selected(&at) {
                    let selection = state.session.selection_mut();
                    selection.select(Selectable::Constraint(at.clone()));
                }
                state.begin_gesture("Turn checkpoint");
                Some(Doing::Turn(at))
            }
            Self::Target(at) => Pull::known(&at, from, state).map(Doing::Pull),
            Self::Joint(joint) => Some(Doing::Pull(Pull::new(joint, from, state))),
            Self::ByHand(joint) => {
                HandPull::begin(&joint, from, state).map(|pull| Doing::ByHand(Box::new(pull)))
            }
        };
        begun.unwrap_or(Doing::Spent)
    }
}

impl Doing {
    /// What it does with the pointer where it is.
    pub(super) fn commands(
        &self,
        sight: &Sight,
        mouse: &Mouse,
        state: &EditorState,
    ) -> Vec<Command> {
        let is_snapping = mouse.is_snapping;
        let floor_m = sight.floor(mouse.at);
        match self {
            Self::Carry(carry) => floor_m
                .map(|floor_m| carry.commands(floor_m, is_snapping, state))
                .unwrap_or_default(),
            Self::Turn(at) => {
                let heading = state
                    .place_of(at)
                    .zip(floor_m)
                    .and_then(|(from, to)| heading_deg(from, to, is_snapping));
                let turn = |deg| Command::Turn { at: at.clone(), heading_deg: Some(deg) };
                heading.map(turn).into_iter().collect()
            }
            Self::Add(from, frame) => {
                let position_m = from.map(|axis| rounded(snapped(axis, GRID_M, is_snapping)));
                let heading = floor_m.and_then(|to| heading_deg(position_m, to, is_snapping));
                state.checkpoint_commands(*frame, position_m, heading)
            }
            Self::ByHand(pull) => pull.commands(sight, mouse.at, mouse.is_lifting),
            Self::Handle(pull) => pull.commands(sight, mouse.at, mouse.is_lifting, is_snapping),
            Self::Meeting(pull) => pull.commands(sight, mouse.at, is_snapping, state),
            Self::Stroke(stroke) => stroke.commands(is_snapping, state),
            Self::Obstacle(new) => {
                floor_m.map(|to_m| new.commands(to_m, is_snapping)).unwrap_or_default()
            }
            Self::Pull(pull) => {
                pull.commands(sight, mouse.at, mouse.is_lifting, is_snapping, state)
            }
            _ => Vec::new(),
        }
    }

    /// Whether it changes the project, as one gesture of its history.
    pub(super) fn is_edit(&self) -> bool {
        matches!(
            self,
            Self::Carry(_)
                | Self::Turn(_)
                | Self::Meeting(_)
                | Self::Handle(_)
                | Self::Stroke(_)
                | Self::Obstacle(_)
                | Self::Add(..)
                | Self::Pull(_)
                | Self::ByHand(_)
        )
    }

    /// What it makes that is to be selected.
    pub(super) fn makes(&self) -> Made {
        match self {
            Self::Add(..) | Self::Stroke(_) => Made::Constraint,
            Self::Obstacle(_) => Made::Obstacle,
            Self::Carry(carry) => match carry.copy_of() {
                Some(Command::AddObstacle { .. }) => Made::Obstacle,
                Some(_) => Made::Constraint,
                None => Made::Nothing,
            },
            Self::Pull(pull) if pull.is_new() => Made::Constraint,
            _ => Made::Nothing,
        }
    }
}

/// What a gesture leaves that was not there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Made {
    /// Nothing.
    Nothing,
    /// A constraint.
    Constraint,
    /// An obstacle.
    Obstacle,
}
