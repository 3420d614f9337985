//! When the search last brought something better.

use motion_session::live::ConstraintHash;

use super::EditorState;

/// When the best score last fell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gain {
    /// For which constraints.
    version: ConstraintHash,
    /// The best score then.
    best: f32,
    /// Seconds since the window opened.
    at_secs: f64,
}

impl EditorState {
    /// How long ago the search for what is asked now last brought something better, seconds.
    pub fn since_gain_secs(&self) -> Option<f64> {
        (self.gain.best > 0.0).then(|| (self.clock_secs - self.gain.at_secs).max(0.0))
    }

    pub(super) fn note_gain(&mut self) {
        let Some(found) = self.session.snapshot().character(self.session.active()) else { return };
        let Some(last) = found.trace.last() else { return };
        let is_other = self.gain.version != found.version;
        if is_other || last.best < self.gain.best {
            self.gain = Gain { version: found.version, best: last.best, at_secs: self.clock_secs };
        }
    }
}
