//! The application without a window.
//!
//! [`library_job`] makes a [`Library`] of files; [`problem`] gives a project its meaning for one;
//! [`solve_job`] searches, under a budget, and reports; [`stage`] says what is to be seen. Nothing here
//! prints or waits for a person: jobs take a cancel token and a callback that hears how far they are.
//!
//! What is authored is a [`document`], changed by [`command`]s and kept in a [`history`]; the search
//! that always runs is [`live`]. A [`Session`] ties these together: it is what a window has.

pub mod error;
pub mod folder_list;
pub(crate) mod import_job;
pub mod import_report;
pub mod library;
pub mod library_info;
pub mod library_job;
pub mod library_source;

pub mod budget;
pub mod clip_rows;
pub mod coverage_job;
pub mod coverage_report;
pub mod eta;
pub mod finish;
pub mod hand_layer;
pub mod problem;
pub mod progress;
pub mod project_job;
pub mod quality;
pub mod results;
pub mod sample;
pub mod solve_cast;
pub mod solve_job;
pub mod suggest;
pub mod unmet;

pub mod command;
pub mod document;
pub mod history;
pub mod live;
pub mod palette;
pub mod playback;
pub mod preferences;
pub mod recovery;
pub mod selection;
pub mod session;

pub mod stage;

pub use error::JobError;
pub use library::Library;
pub use session::Session;
// What a window must be able to name, though files are none of its business.
pub use motion_io::diagnostic::{FileError, Warnings};
pub use motion_io::project_file::{
    Constraint, ConstraintKind, Interaction, LengthMode, LockedPiece, Member, Obstacle, Palette,
    PathHeading, Placement, Project, Shape, Tolerance, load as load_project, save as save_project,
};
pub use motion_io::report_file::{
    AlternativeReport, ConstraintReport, SeamReport, SuggestionReport,
};

#[cfg(test)]
mod fixture;
