//! A change that may help.

use super::Change;
use crate::command::Command;

/// A change that may help, not tried yet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Candidate {
    pub(super) change: Change,
    /// The constraint or clip that it is about; of several changes of one kind about one thing the
    /// smallest that helps is enough.
    pub(super) about: String,
    /// What to do.
    pub(super) words: String,
    /// How much is changed, in tolerances.
    pub(super) size: f32,
    pub(super) commands: Vec<Command>,
}

/// Words for something that happens later or, below 0, earlier.
pub(super) fn later(frames: i64) -> String {
    let when = if frames > 0 { "later" } else { "earlier" };
    match frames.unsigned_abs() {
        1 => format!("a frame {when}"),
        n => format!("{n} frames {when}"),
    }
}
