//! What the pointer asks of the timeline, said while it is drawn and done afterwards.

use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::playback::PlayRange;

use super::hand_drag::HandPart;
use super::retime::Part;
use crate::ui_command::UiCommand;

/// Something that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Select a constraint and go to its frame; or only add it to what is selected.
    Select(ConstraintRef, bool),
    /// The pointer is over a constraint.
    Hover(ConstraintRef),
    /// A constraint is being dragged.
    Grab(ConstraintRef, Part),
    /// A style is drawn where the button went down.
    DrawStyle,
    /// Select a meeting and go to its frame.
    SelectMeeting(String),
    /// A meeting is being dragged to another frame.
    GrabMeeting(String),
    /// Select a change by hand.
    SelectHand(String),
    /// A change by hand is being dragged.
    GrabHand(String, HandPart),
    /// Take a change by hand away.
    RemoveHand(String),
    /// The end of the motion is being dragged.
    GrabLength,
    /// The played part is being dragged by an end, or as a whole.
    GrabLoop(Part),
    /// The ruler was pressed.
    Scrub,
    /// Go there and stay.
    GoTo(usize),
    /// Do this as one step.
    Do(Vec<Command>),
    /// A command of the window.
    Ask(UiCommand),
    /// Make this and nothing else selected, then do the command.
    With(ConstraintRef, UiCommand),
    /// Play this part, or all.
    Play(Option<PlayRange>),
    /// Show another character.
    Activate(CharacterIdx),
}
