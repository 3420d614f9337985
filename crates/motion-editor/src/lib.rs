//! The window in which an animator authors a motion.
//!
//! [`run::run`] opens it; [`app::EditorApp`] is all of it but the window, so that tests can drive
//! it. A frame goes from top to bottom: [`state::EditorState`] takes in what threads have done,
//! does the commands that were asked for ([`ui_command::UiCommand`]), and panels draw
//! it and ask for more. Panels change nothing but the state, and through it alone.
//!
//! Nothing is computed here that takes long: the search runs on a thread of the session's, the picture is
//! drawn by `motion-render`, and only when something in it has changed.

pub mod app;
pub mod run;
pub mod window;

pub mod state;

pub mod focus;
pub mod hand_time;
pub mod hand_words;
pub mod mark;
pub mod meeting;
pub mod notices;
pub mod obstacle_form;
pub mod project_source;
pub mod reasons;
pub mod settings;
pub mod stretch;
pub mod take_card;
pub mod ui_command;

pub mod command_palette;
pub mod coverage_window;
pub mod dialogs;
pub mod export;
pub mod files;
pub mod guide;
pub mod log_window;
pub mod panels;
pub mod settings_window;
pub mod shortcut_sheet;
pub mod timeline;
pub mod viewport;
pub mod welcome;

pub mod icons;
pub mod theme;
pub mod widgets;
