//! How the window is set up. Not part of any project, and not undone.

use motion_scene::color::Theme;

use crate::timeline::time_unit::TimeUnit;

/// Which mouse buttons move the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Navigation {
    /// Middle button orbits, Shift+middle pans, wheel zooms.
    #[default]
    Blender,
    /// Alt with the left button orbits, with the middle one pans, with the right one zooms.
    Industry,
}

impl Navigation {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Blender => "Blender",
            Self::Industry => "Industry",
        }
    }
}

/// What a press in the view does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Tool {
    /// Selects, drags what is there, and circles elsewhere.
    #[default]
    Select,
    /// Puts checkpoints on the floor.
    Checkpoint,
}

/// The choices.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Dark or light.
    pub theme: Theme,
    /// The mouse in the view.
    pub navigation: Navigation,
    /// What a press in the view does.
    pub tool: Tool,
    /// The camera keeps to the character.
    pub follow: bool,
    /// The best take is shown whenever there is a better one.
    pub follow_best: bool,
    /// The way over the floor is shown.
    pub trail: bool,
    /// Other moments are shown.
    pub ghosts: bool,
    /// The library is open.
    pub left_open: bool,
    /// Takes and inspector are open.
    pub right_open: bool,
    /// The timeline is open.
    pub timeline_open: bool,
    /// The curves at the bottom of the timeline are open.
    pub curves_open: bool,
    /// How moments are written.
    pub time_unit: TimeUnit,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: Theme::Dark,
            navigation: Navigation::Blender,
            tool: Tool::Select,
            follow: false,
            follow_best: false,
            trail: true,
            ghosts: false,
            left_open: true,
            right_open: true,
            timeline_open: true,
            curves_open: false,
            time_unit: TimeUnit::Frames,
        }
    }
}
