//! Everything that can be asked of the window, once: menus, keys, buttons and the palette all
//! speak of these.

mod enabled;
mod keys;
mod words;

use motion_session::sample::SAMPLES;

pub use keys::{key_text, pressed};

use crate::settings::GhostMode;

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
    Duplicate,
    RetimeBack,
    RetimeAhead,
    ScaleTimes,
    SelectTool,
    CheckpointTool,
    JointTargetTool,
    PoseTool,
    PathTool,
    ObstacleTool,
    ByHandTool,
    AddCheckpoint,
    AddJointTarget,
    AddPose,
    AddStyle,
    MeetHere,
    MoveSelection,
    TurnSelection,
    BoxSelect,
    SelectAll,
    SelectNone,
    Nudge(Nudge),
    TurnLeft,
    TurnRight,
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
    FrameSelection,
    FrameAll,
    ViewFront,
    ViewBack,
    ViewLeft,
    ViewRight,
    ViewTop,
    ViewThreeQuarter,
    ViewPie,
    Perspective,
    Fly,
    Follow,
    Trail,
    JointTrails,
    Ghosts,
    GhostsAre(GhostMode),
    ReducedMotion,
    NextPanel,
    PreviousPanel,
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
    FullScreen,
    Settings,
    Log,
    Coverage,
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

/// A small step of what is selected, as the camera sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Nudge {
    /// Where to.
    pub to: Side,
    /// By 1 cm rather than 10 cm.
    pub is_fine: bool,
}

/// A direction on the floor, as the camera sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// To the left of the picture.
    Left,
    /// To its right.
    Right,
    /// Away from the camera.
    Away,
    /// Towards it.
    Near,
}

impl Nudge {
    /// Every step, the large ones first.
    pub const ALL: [Self; 8] = [
        Self { to: Side::Left, is_fine: false },
        Self { to: Side::Right, is_fine: false },
        Self { to: Side::Away, is_fine: false },
        Self { to: Side::Near, is_fine: false },
        Self { to: Side::Left, is_fine: true },
        Self { to: Side::Right, is_fine: true },
        Self { to: Side::Away, is_fine: true },
        Self { to: Side::Near, is_fine: true },
    ];
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
            vec![
                vec![C::Undo, C::Redo],
                vec![C::Delete, C::Duplicate, C::MoveSelection, C::TurnSelection],
                vec![C::RetimeBack, C::RetimeAhead, C::ScaleTimes],
                vec![C::SelectAll, C::SelectNone, C::BoxSelect],
                vec![
                    C::SelectTool,
                    C::CheckpointTool,
                    C::JointTargetTool,
                    C::PoseTool,
                    C::PathTool,
                    C::ObstacleTool,
                    C::ByHandTool,
                ],
                vec![C::AddCheckpoint, C::AddJointTarget, C::AddPose, C::AddStyle, C::MeetHere],
                vec![C::TurnLeft, C::TurnRight],
                Nudge::ALL.into_iter().map(C::Nudge).collect(),
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
                vec![C::FrameSelection, C::FrameAll, C::Follow, C::Fly],
                vec![
                    C::ViewPie,
                    C::ViewFront,
                    C::ViewBack,
                    C::ViewLeft,
                    C::ViewRight,
                    C::ViewTop,
                    C::ViewThreeQuarter,
                    C::Perspective,
                ],
                vec![C::Trail, C::JointTrails, C::Ghosts],
                GhostMode::ALL.into_iter().map(C::GhostsAre).collect(),
                vec![C::LeftPanel, C::RightPanel, C::Timeline],
                vec![C::FitTimeline, C::TimelineNearer, C::TimelineFarther],
                vec![C::Curves, C::TimeUnit, C::NextCharacter],
                vec![C::NextPanel, C::PreviousPanel],
                vec![C::Theme, C::Navigation, C::ReducedMotion, C::FullScreen],
                vec![C::Settings, C::Coverage, C::Log],
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
