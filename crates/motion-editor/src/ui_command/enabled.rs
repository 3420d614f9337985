//! Whether commands can be done, and whether what they switch is on.

use motion_session::selection::Selectable;

use super::UiCommand;
use crate::settings::{GhostMode, Tool};
use crate::state::{CompareMode, EditorState};

impl UiCommand {
    /// Whether it can be done now.
    pub fn is_enabled(self, state: &EditorState) -> bool {
        let (n_undo, n_redo) = state.session.history().n_steps();
        match self {
            Self::Undo => n_undo > 0 || state.is_in_gesture(),
            Self::Redo => n_redo > 0,
            Self::Delete => {
                state.selected_edit().is_some()
                    || state.knot_to_delete().is_some()
                    || matches!(
                        state.selected(),
                        Some(
                            Selectable::Constraint(_)
                                | Selectable::Obstacle(_)
                                | Selectable::Interaction(_)
                        )
                    )
            }
            Self::MoveSelection
            | Self::TurnSelection
            | Self::Nudge(_)
            | Self::TurnLeft
            | Self::TurnRight => {
                let document = state.session.document();
                let has_hand = matches!(self, Self::Nudge(_)) && state.selected_edit().is_some();
                let can_move = |item: &Selectable| {
                    matches!(item, Selectable::Constraint(_) | Selectable::Obstacle(_))
                };
                has_hand || state.session.selection().items(document).any(can_move)
            }
            Self::RetimeBack | Self::RetimeAhead | Self::ScaleTimes => {
                state.selected_marks().next().is_some()
            }
            Self::Duplicate => {
                let is_obstacle = matches!(state.selected(), Some(Selectable::Obstacle(_)));
                is_obstacle || state.selected_marks().next().is_some()
            }
            Self::MeetHere => state.session.document().characters().len() > 1,
            Self::AddJointTarget | Self::AddPose => state.shown_card().is_some(),
            Self::SelectAll => !state.marks.is_empty(),
            Self::ClearLoop => state.session.playback().chosen_range().is_some(),
            Self::NextCharacter => state.session.document().characters().len() > 1,
            Self::ShowTake(n) | Self::PinTake(n) => usize::from(n) <= state.cards.len(),
            Self::ShowBetter => state.better().is_some(),
            Self::Compare | Self::CompareSplit => {
                state.cards.len() > 1 || self.is_on(state) == Some(true)
            }
            Self::RenameTake | Self::MoreLikeThis => state.shown_card().is_some(),
            Self::LockStretch => state.stretch_to_lock().is_some(),
            Self::FlipTakes => state.shown_before.is_some(),
            Self::PlayPause
            | Self::PlayBackwards
            | Self::Stop
            | Self::PlayAhead
            | Self::LoopIn
            | Self::LoopOut
            | Self::TimelineNearer
            | Self::TimelineFarther
            | Self::StepBack
            | Self::StepAhead
            | Self::SecondBack
            | Self::SecondAhead
            | Self::PreviousStop
            | Self::NextStop
            | Self::ToStart
            | Self::ToEnd
            | Self::FrameAll
            | Self::FrameSelection
            | Self::FitTimeline => state.shown_card().is_some(),
            _ => true,
        }
    }

    /// Whether it is something that is on or off, and which.
    pub fn is_on(self, state: &EditorState) -> Option<bool> {
        let settings = &state.settings;
        Some(match self {
            Self::Loop => state.is_looping(),
            Self::Curves => settings.curves_open,
            Self::SelectTool => settings.tool == Tool::Select,
            Self::CheckpointTool => settings.tool == Tool::Checkpoint,
            Self::Follow => settings.follow,
            Self::FollowBest => settings.follow_best,
            Self::PauseSearch => state.session.is_search_paused(),
            Self::Trail => settings.trail,
            Self::JointTargetTool => settings.tool == Tool::JointTarget,
            Self::ByHandTool => settings.tool == Tool::ByHand,
            Self::PoseTool => settings.tool == Tool::Pose,
            Self::PathTool => settings.tool == Tool::Path,
            Self::ObstacleTool => settings.tool == Tool::Obstacle,
            Self::JointTrails => settings.joint_trails,
            Self::Ghosts => settings.ghosts != GhostMode::Off,
            Self::GhostsAre(mode) => settings.ghosts == mode,
            Self::ReducedMotion => settings.reduced_motion,
            Self::LeftPanel => settings.left.open,
            Self::RightPanel => settings.right.open,
            Self::Timeline => settings.timeline.open,
            Self::Compare => state.comparing.mode != CompareMode::Off,
            Self::CompareSplit => state.comparing.mode == CompareMode::Split,
            Self::PinTake(n) => {
                let card = state.cards.get(usize::from(n).wrapping_sub(1));
                card.is_some_and(|card| card.is_pinned)
            }
            Self::ShowTake(n) => {
                let card = state.cards.get(usize::from(n).wrapping_sub(1));
                card.is_some_and(|card| state.shown() == Some(card.id))
            }
            _ => return None,
        })
    }
}
