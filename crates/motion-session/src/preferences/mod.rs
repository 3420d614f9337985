//! What the program remembers beside projects: how the window looks and is laid out, what was open.
//!
//! A [`PreferencesFile`] reads and writes it; a [`Preferences`] is the value.
//!
//! ```
//! use motion_session::preferences::{Preferences, PreferencesFile};
//! # let folder = tempfile::tempdir().unwrap();
//! let mut file = PreferencesFile::open(folder.path());
//! assert_eq!(*file.get(), Preferences::default());
//! file.change(|preferences| preferences.follow_best = true);
//! file.save().unwrap();
//! assert!(PreferencesFile::open(folder.path()).get().follow_best);
//! ```

mod file;
mod folders;
mod recent_files;

use std::collections::BTreeMap;

use motion_scene::color::Theme;
use serde::{Deserialize, Serialize};

pub use file::PreferencesFile;
pub use folders::{config_folder, state_folder};
pub use recent_files::{MAX_RECENT, RecentFiles};

/// How small and large the window's words may be, as a factor.
pub const UI_SCALES: std::ops::RangeInclusive<f32> = 0.75..=2.0;

/// How often work may be kept, seconds. What a crash takes is promised to be less than ten.
pub const AUTOSAVE_RANGE_SECS: std::ops::RangeInclusive<f64> = 1.0..=9.0;

/// Which mouse buttons move the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NavigationScheme {
    /// The middle button orbits.
    #[default]
    Blender,
    /// Alt with the left button orbits.
    Industry,
}

/// A panel of the window.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PanelLayout {
    /// Whether it is open.
    pub open: bool,
    /// Its width or height, in points, where it was ever changed.
    pub size_pt: Option<f32>,
}

impl Default for PanelLayout {
    fn default() -> Self {
        Self { open: true, size_pt: None }
    }
}

/// What is remembered. Values are always within their ranges: [`PreferencesFile`] sees to it
/// whatever a file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Dark or light.
    #[serde(with = "ThemeWord")]
    pub theme: Theme,
    /// The mouse in the view.
    pub navigation: NavigationScheme,
    /// How large everything in the window is, within [`UI_SCALES`].
    pub ui_scale: f32,
    /// Panels by their names, as far as they were ever changed.
    pub panels: BTreeMap<String, PanelLayout>,
    /// What is shown in the view, by name, as far as it was ever changed.
    pub show: BTreeMap<String, bool>,
    /// The best take is shown whenever there is a better one.
    pub follow_best: bool,
    /// The camera keeps to the character.
    pub follow_character: bool,
    /// The window's size when it was closed, in points.
    pub window_size_pt: Option<[f32; 2]>,
    /// Projects that were open lately.
    pub recent: RecentFiles,
    /// The folder that a file was last chosen in.
    pub last_folder: Option<String>,
    /// Whether the first words of welcome were read.
    pub welcome_seen: bool,
    /// Nothing moves that does not have to.
    pub reduced_motion: bool,
    /// How long after a change work is kept, at most, within [`AUTOSAVE_RANGE_SECS`].
    pub autosave_secs: f64,
    /// Files are chosen inside the window, though the system has a dialog.
    pub own_file_dialog: bool,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            theme: Theme::Dark,
            navigation: NavigationScheme::Blender,
            ui_scale: 1.0,
            panels: BTreeMap::new(),
            show: BTreeMap::new(),
            follow_best: false,
            follow_character: false,
            window_size_pt: None,
            recent: RecentFiles::default(),
            last_folder: None,
            welcome_seen: false,
            reduced_motion: false,
            autosave_secs: crate::session::AUTOSAVE_SECS,
            own_file_dialog: false,
        }
    }
}

impl Preferences {
    /// Whether something in the view is shown; `usually` where nobody ever said.
    pub fn shows(&self, name: &str, usually: bool) -> bool {
        self.show.get(name).copied().unwrap_or(usually)
    }

    /// How a panel is laid out.
    pub fn panel(&self, name: &str) -> PanelLayout {
        self.panels.get(name).copied().unwrap_or_default()
    }

    /// Changes how a panel is laid out.
    pub fn set_panel(&mut self, name: &str, layout: PanelLayout) {
        self.panels.insert(name.to_owned(), layout);
    }

    /// Brings every figure into its range.
    fn clamp(&mut self) {
        let usual = Self::default();
        let within = |value: f32, low: f32, high: f32, usual: f32| {
            if value.is_finite() { value.clamp(low, high) } else { usual }
        };
        self.ui_scale = within(self.ui_scale, *UI_SCALES.start(), *UI_SCALES.end(), usual.ui_scale);
        self.autosave_secs = if self.autosave_secs.is_finite() {
            self.autosave_secs.clamp(*AUTOSAVE_RANGE_SECS.start(), *AUTOSAVE_RANGE_SECS.end())
        } else {
            usual.autosave_secs
        };
        // No screen is larger, and no window that can be used smaller.
        let side = |value: f32| within(value, 200.0, 20_000.0, 1000.0);
        self.window_size_pt = self.window_size_pt.map(|size| size.map(side));
        for panel in self.panels.values_mut() {
            panel.size_pt = panel.size_pt.filter(|size| size.is_finite()).map(|size| size.max(0.0));
        }
    }
}

/// The words for themes.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Theme", rename_all = "kebab-case")]
enum ThemeWord {
    Dark,
    Light,
}

#[cfg(test)]
mod tests;
