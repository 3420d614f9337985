//! How the window is set up. Not part of any project, and not undone.

use std::path::PathBuf;

use motion_scene::color::Theme;
use motion_session::preferences::{NavigationScheme, PanelLayout, Preferences};

pub use motion_session::preferences::NavigationScheme as Navigation;

use crate::timeline::time_unit::TimeUnit;

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
    /// Draws paths on the floor.
    Path,
    /// Draws what stands in the way.
    Obstacle,
    /// Moves hands and feet of the shown take, and turns its other joints.
    ByHand,
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

    /// What it is remembered by.
    fn key(self) -> &'static str {
        match self {
            Self::Off => "no ghosts",
            Self::Around => "ghosts around",
            Self::AtConstraints => "ghosts at constraints",
            Self::Fan => "ghosts over all",
        }
    }

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
    /// How large everything is.
    pub ui_scale: f32,
    /// What a press in the view does. It is not remembered.
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
    /// The library.
    pub left: PanelLayout,
    /// Takes and inspector.
    pub right: PanelLayout,
    /// The timeline.
    pub timeline: PanelLayout,
    /// The curves at the bottom of the timeline are open.
    pub curves_open: bool,
    /// How moments are written.
    pub time_unit: TimeUnit,
    /// Nothing moves that does not have to.
    pub reduced_motion: bool,
    /// Whether the welcome was seen and sent away.
    pub welcome_seen: bool,
    /// Files are chosen inside the window, though the system has a dialog.
    pub own_file_dialog: bool,
    /// Where a file was last chosen.
    pub last_folder: Option<PathBuf>,
}

const LEFT: &str = "library";
const RIGHT: &str = "takes";
const CURVES: &str = "curves";
const TIMELINE: &str = "timeline";
const TRAIL: &str = "trail";
const JOINT_TRAILS: &str = "joint trails";

impl Settings {
    /// As they were left.
    pub fn of(p: &Preferences) -> Self {
        Self {
            theme: p.theme,
            navigation: p.navigation,
            ui_scale: p.ui_scale,
            tool: Tool::Select,
            follow: p.follow_character,
            follow_best: p.follow_best,
            trail: p.shows(TRAIL, true),
            ghosts: GhostMode::ALL
                .into_iter()
                .find(|mode| p.shows(mode.key(), false))
                .unwrap_or_default(),
            joint_trails: p.shows(JOINT_TRAILS, false),
            left: p.panel(LEFT),
            right: p.panel(RIGHT),
            timeline: p.panel(TIMELINE),
            curves_open: p.shows(CURVES, false),
            time_unit: TimeUnit::ALL
                .into_iter()
                .find(|unit| p.shows(unit.key(), false))
                .unwrap_or_default(),
            reduced_motion: p.reduced_motion,
            welcome_seen: p.welcome_seen,
            own_file_dialog: p.own_file_dialog,
            last_folder: p.last_folder.as_ref().map(PathBuf::from),
        }
    }

    /// Writes them down where they are remembered.
    pub fn put_into(&self, p: &mut Preferences) {
        p.theme = self.theme;
        p.navigation = self.navigation;
        p.ui_scale = self.ui_scale;
        p.follow_character = self.follow;
        p.follow_best = self.follow_best;
        p.show.insert(TRAIL.to_owned(), self.trail);
        for mode in GhostMode::ALL {
            p.show.insert(mode.key().to_owned(), self.ghosts == mode);
        }
        p.show.insert(JOINT_TRAILS.to_owned(), self.joint_trails);
        p.set_panel(LEFT, self.left);
        p.set_panel(RIGHT, self.right);
        p.set_panel(TIMELINE, self.timeline);
        p.show.insert(CURVES.to_owned(), self.curves_open);
        for unit in TimeUnit::ALL {
            p.show.insert(unit.key().to_owned(), self.time_unit == unit);
        }
        p.reduced_motion = self.reduced_motion;
        p.welcome_seen = self.welcome_seen;
        p.own_file_dialog = self.own_file_dialog;
        let folder = self.last_folder.as_ref();
        p.last_folder = folder.and_then(|folder| Some(folder.to_str()?.to_owned()));
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::of(&Preferences::default())
    }
}

/// What a scheme is called.
pub fn navigation_name(scheme: NavigationScheme) -> &'static str {
    match scheme {
        NavigationScheme::Blender => "Blender",
        NavigationScheme::Industry => "Industry",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_down_comes_back() {
        let settings = Settings {
            theme: Theme::Light,
            navigation: Navigation::Industry,
            ui_scale: 1.5,
            follow: true,
            trail: false,
            ghosts: GhostMode::Fan,
            joint_trails: true,
            left: PanelLayout { open: false, size_pt: Some(300.0) },
            curves_open: true,
            time_unit: TimeUnit::Timecode,
            reduced_motion: true,
            welcome_seen: true,
            own_file_dialog: true,
            last_folder: Some("/tmp".into()),
            ..Settings::default()
        };
        let mut preferences = Preferences::default();
        settings.put_into(&mut preferences);
        assert_eq!(Settings::of(&preferences), settings);
    }
}
