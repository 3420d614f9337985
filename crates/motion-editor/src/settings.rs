//! How the window is set up. Not part of any project, and not undone.

use motion_scene::color::Theme;

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
    /// Pulls targets from joints.
    JointTarget,
    /// Puts poses of clips on the floor.
    Pose,
}

/// Which other moments of the motion are shown, faint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum GhostMode {
    /// None.
    #[default]
    Off,
    /// Some before and after the playhead.
    Around,
    /// Those at which something is asked for.
    AtConstraints,
    /// Some spread over the whole motion.
    Fan,
}

impl GhostMode {
    /// Every mode, in the order in which they are gone through.
    pub const ALL: [Self; 4] = [Self::Off, Self::Around, Self::AtConstraints, Self::Fan];

    /// The one after this, the first after the last.
    pub fn next(self) -> Self {
        let at = Self::ALL.iter().position(|mode| *mode == self).unwrap_or_default();
        Self::ALL[(at + 1) % Self::ALL.len()]
    }
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
    /// Which other moments are shown.
    pub ghosts: GhostMode,
    /// The ways of hands, feet and head are shown.
    pub joint_trails: bool,
    /// Nothing glides: the camera jumps.
    pub reduced_motion: bool,
    /// The library is open.
    pub left_open: bool,
    /// Takes and inspector are open.
    pub right_open: bool,
    /// The timeline is open.
    pub timeline_open: bool,
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
            ghosts: GhostMode::Off,
            joint_trails: false,
            reduced_motion: false,
            left_open: true,
            right_open: true,
            timeline_open: true,
        }
    }
}
