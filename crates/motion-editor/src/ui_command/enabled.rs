//! Whether commands can be done, and whether what they switch is on.

use motion_session::selection::Selectable;

use super::UiCommand;
use crate::settings::Tool;
use crate::state::EditorState;

impl UiCommand {
    /// Whether it can be done now.
    pub fn is_enabled(self, state: &EditorState) -> bool {
        let (n_undo, n_redo) = state.session.history().n_steps();
        match self {
            Self::Save => state.session.path().is_some(),
            Self::Undo => n_undo > 0 || state.is_in_gesture(),
            Self::Redo => n_redo > 0,
            Self::Delete => {
                matches!(
                    state.selected(),
                    Some(Selectable::Constraint(_) | Selectable::Obstacle(_))
                )
            }
            Self::Duplicate | Self::RetimeBack | Self::RetimeAhead => {
                state.selected_marks().next().is_some()
            }
            Self::SelectAll => !state.marks.is_empty(),
            Self::ClearLoop => state.session.playback().chosen_range().is_some(),
            Self::NextCharacter => state.session.document().characters().len() > 1,
            Self::ShowTake(n) => usize::from(n) <= state.cards.len(),
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
            Self::Ghosts => settings.ghosts,
            Self::LeftPanel => settings.left_open,
            Self::RightPanel => settings.right_open,
            Self::Timeline => settings.timeline_open,
            Self::ShowTake(n) => {
                let card = state.cards.get(usize::from(n).wrapping_sub(1));
                card.is_some_and(|card| state.shown() == Some(card.id))
            }
            _ => return None,
        })
    }
}
