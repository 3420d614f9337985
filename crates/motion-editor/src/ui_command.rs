//! Everything that can be asked of the window, once: menus, keys, buttons and the palette all
//! speak of these.

mod enabled;
mod keys;
mod words;

use motion_session::sample::SAMPLES;

pub use keys::pressed;

/// A command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "words.rs says of each what it does, to users too")]
pub enum UiCommand {
    // File.
    New,
    Open,
    /// One of the projects that were open lately, from 0.
    Recent(u8),
    /// One of the program's own projects, from 0.
    Sample(u8),
    Save,
    SaveAs,
    Import,
    ImportFolder,
    Export,
    ExportAgain,
    Quit,
    // Edit.
    Undo,
    Redo,
    Delete,
    SelectTool,
    CheckpointTool,
    // Play.
    PlayPause,
    Loop,
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
    Theme,
    Navigation,
    FullScreen,
    Settings,
    Log,
    // Takes.
    /// From 1 to 9.
    ShowTake(u8),
    /// From 1 to 9.
    PinTake(u8),
    FlipTakes,
    ShowBetter,
    Compare,
    CompareSplit,
    RenameTake,
    MoreLikeThis,
    LockStretch,
    PauseSearch,
    Shake,
    FollowBest,
    // Help.
    Guide,
    Palette,
    ShortcutSheet,
}

/// A menu: its name, and groups of commands with a line between them.
pub type Menu = (&'static str, Vec<Vec<UiCommand>>);

/// The menus, from left to right. Every command is in one of them but [`UiCommand::Recent`].
pub fn menus() -> Vec<Menu> {
    use UiCommand as C;
    vec![
        (
            "File",
            vec![
                vec![C::New, C::Open],
                vec![C::Save, C::SaveAs],
                vec![C::Import, C::ImportFolder],
                vec![C::Export, C::ExportAgain],
                (0..SAMPLES.len() as u8).map(C::Sample).collect(),
                vec![C::Quit],
            ],
        ),
        (
            "Edit",
            vec![vec![C::Undo, C::Redo], vec![C::Delete], vec![C::SelectTool, C::CheckpointTool]],
        ),
        (
            "Play",
            vec![
                vec![C::PlayPause, C::Loop, C::Slower, C::NormalSpeed, C::Faster],
                vec![C::StepBack, C::StepAhead, C::SecondBack, C::SecondAhead],
                vec![C::PreviousStop, C::NextStop, C::ToStart, C::ToEnd],
            ],
        ),
        (
            "View",
            vec![
                vec![C::FrameAll, C::ViewFront, C::ViewLeft, C::ViewTop, C::ViewThreeQuarter],
                vec![C::Perspective, C::Follow, C::Trail, C::Ghosts],
                vec![C::LeftPanel, C::RightPanel, C::Timeline, C::FitTimeline],
                vec![C::Theme, C::Navigation, C::FullScreen],
                vec![C::Settings, C::Log],
            ],
        ),
        (
            "Takes",
            vec![
                (1..=9).map(C::ShowTake).collect(),
                (1..=9).map(C::PinTake).collect(),
                vec![C::FlipTakes, C::ShowBetter, C::Compare, C::CompareSplit],
                vec![C::RenameTake, C::MoreLikeThis, C::LockStretch],
                vec![C::PauseSearch, C::Shake, C::FollowBest],
            ],
        ),
        ("Help", vec![vec![C::Guide], vec![C::Palette, C::ShortcutSheet]]),
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
