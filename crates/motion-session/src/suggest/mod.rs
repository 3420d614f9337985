//! What would help where something is not met: small changes of what is asked, each tried for real.
//!
//! A change is a list of commands on the document, so what is tried is what would be applied. Each is
//! searched for a little, from the motions that are known; those with which everything is met are kept,
//! the smallest changes first. Where none is enough by itself, those that meet something more and miss
//! nothing new are kept instead.

pub(crate) mod after_solve;
mod candidate;
mod case;
mod length;
mod palette;
mod place;
mod pose;
mod style;
mod suggester;
mod time;
mod tolerance;
mod trial;

pub(crate) use case::Case;
pub(crate) use suggester::Suggester;
pub(crate) use trial::{Effort, Ground};

use motion_io::report_file::SuggestionReport;

use crate::command::Command;
use crate::finish::digits_of;

/// So many are said.
const N_SAID: usize = 3;

/// How a sentence of a report's `unmet` begins that says what would help.
pub const WOULD_HELP: &str = "what would help: ";

/// A kind of change of what is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Change {
    /// More or fewer frames.
    Length,
    /// Something elsewhere.
    Place,
    /// Something earlier or later.
    Time,
    /// More may be missed.
    Tolerance,
    /// A pose earlier or later.
    Pose,
    /// A style less.
    Style,
    /// A clip more.
    Palette,
}

impl Change {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Place => "place",
            Self::Time => "time",
            Self::Tolerance => "tolerance",
            Self::Pose => "pose",
            Self::Style => "style",
            Self::Palette => "palette",
        }
    }
}

/// A change that would help, as it was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Suggestion {
    /// What kind it is.
    pub change: Change,
    /// What to do and what that brings: `give it 14 frames more: score −61 %`.
    pub sentence: String,
    /// The best score as it is asked.
    pub score_before: f32,
    /// The best score of a short search with the change.
    pub score_after: f32,
    /// The change of the document; one step to be undone.
    pub commands: Vec<Command>,
}

impl Suggestion {
    /// What the report says of it.
    pub fn report(&self) -> SuggestionReport {
        SuggestionReport {
            change: self.change.name().to_owned(),
            sentence: self.sentence.clone(),
            score_before: digits_of(self.score_before),
            score_after: digits_of(self.score_after),
        }
    }
}

#[cfg(test)]
mod tests;
