//! Everything that can be asked of the window, once: menus, keys, buttons and the palette all
//! speak of these.

mod enabled;
mod keys;
mod words;

pub use keys::pressed;

/// A command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "words.rs says of each what it does, to users too")]
pub enum UiCommand {
    // File.
    Save,
    Quit,
    // Edit.
    Undo,
    Redo,
    Delete,
    Duplicate,
    SelectAll,
    SelectNone,
    RetimeBack,
    RetimeAhead,
    SelectTool,
    CheckpointTool,
    // Play.
    PlayPause,
    PlayBackwards,
    Stop,
    PlayAhead,
    Loop,
    LoopIn,
    LoopOut,
    ClearLoop,
    Slower,
    NormalSpeed,
    Faster,
    StepBack,
    StepAhead,
    SecondBack,
    SecondAhead,
    PreviousStop,
    NextStop,
    ToStart,
    ToEnd,
    // View.
    FrameAll,
    ViewFront,
    ViewLeft,
    ViewTop,
    ViewThreeQuarter,
    Perspective,
    Follow,
    Trail,
    Ghosts,
    LeftPanel,
    RightPanel,
    Timeline,
    FitTimeline,
    TimelineNearer,
    TimelineFarther,
    Curves,
    TimeUnit,
    NextCharacter,
    Theme,
    Navigation,
    // Takes.
    /// From 1 to 9.
    ShowTake(u8),
    FlipTakes,
    PauseSearch,
    Shake,
    FollowBest,
    // Help.
    Palette,
    ShortcutSheet,
}

/// A menu: its name, and groups of commands with a line between them.
pub type Menu = (&'static str, Vec<Vec<UiCommand>>);

/// The menus, from left to right. Every command is in one of them.
pub fn menus() -> Vec<Menu> {
    use UiCommand as C;
    vec![
        ("File", vec![vec![C::Save], vec![C::Quit]]),
        (
            "Edit",
            vec![
                vec![C::Undo, C::Redo],
                vec![C::Delete, C::Duplicate, C::SelectAll, C::SelectNone],
                vec![C::RetimeBack, C::RetimeAhead],
                vec![C::SelectTool, C::CheckpointTool],
            ],
        ),
        (
            "Play",
            vec![
                vec![C::PlayPause, C::PlayBackwards, C::Stop, C::PlayAhead],
                vec![C::Loop, C::LoopIn, C::LoopOut, C::ClearLoop],
                vec![C::Slower, C::NormalSpeed, C::Faster],
                vec![C::StepBack, C::StepAhead, C::SecondBack, C::SecondAhead],
                vec![C::PreviousStop, C::NextStop, C::ToStart, C::ToEnd],
            ],
        ),
        (
            "View",
            vec![
                vec![C::FrameAll, C::ViewFront, C::ViewLeft, C::ViewTop, C::ViewThreeQuarter],
                vec![C::Perspective, C::Follow, C::Trail, C::Ghosts],
                vec![C::LeftPanel, C::RightPanel, C::Timeline],
                vec![C::FitTimeline, C::TimelineNearer, C::TimelineFarther],
                vec![C::Curves, C::TimeUnit, C::NextCharacter],
                vec![C::Theme, C::Navigation],
            ],
        ),
        (
            "Takes",
            vec![
                (1..=9).map(C::ShowTake).collect(),
                vec![C::FlipTakes],
                vec![C::PauseSearch, C::Shake, C::FollowBest],
            ],
        ),
        ("Help", vec![vec![C::Palette, C::ShortcutSheet]]),
    ]
}

impl UiCommand {
    /// Every command, in the order of menus.
    pub fn all() -> Vec<Self> {
        menus().into_iter().flat_map(|(_, groups)| groups).flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_says_what_it_is() {
        for command in UiCommand::all() {
            assert!(!command.label().is_empty() && !command.tooltip().is_empty());
            let first = command.label().chars().next();
            assert!(first.is_some_and(char::is_uppercase), "sentence case: {command:?}");
        }
    }
}
