//! What the user is told: a refusal while it lasts, and a log of everything that was said.

use std::collections::VecDeque;

/// Lines of the log that are kept.
const MAX_LINES: usize = 500;
/// So long a word stays in the status bar, seconds.
const SHOWN_SECS: f64 = 8.0;

/// How much a line matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Something was done.
    News,
    /// Something was odd.
    Remark,
    /// Something was not done.
    Refusal,
}

/// A line of the log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// How much it matters.
    pub weight: Weight,
    /// A sentence.
    pub text: String,
}

/// What was said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notices {
    log: VecDeque<Notice>,
    /// Whether the last line is a refusal that nothing has come after.
    refused: bool,
    /// How long the last line is shown yet.
    left_secs: f64,
}

impl Notices {
    /// Says that something was done.
    pub fn tell(&mut self, text: impl Into<String>) {
        self.push(Weight::News, text.into());
    }

    /// Says that something is odd.
    pub fn note(&mut self, text: impl Into<String>) {
        self.push(Weight::Remark, text.into());
    }

    /// Says that something was not done, and why. It stays until something else is done.
    pub fn refuse(&mut self, text: impl Into<String>) {
        let text = text.into();
        // A drag is refused anew with every step.
        if self.refusal() != Some(text.as_str()) {
            self.push(Weight::Refusal, text);
        }
        self.refused = true;
    }

    /// Something was done: what was refused before is no news any more.
    pub fn clear_refusal(&mut self) {
        if std::mem::take(&mut self.refused) {
            self.left_secs = 0.0;
        }
    }

    /// Why the last thing was not done.
    pub fn refusal(&self) -> Option<&str> {
        self.log.back().filter(|_| self.refused).map(|notice| notice.text.as_str())
    }

    /// What the status bar says.
    pub fn current(&self) -> Option<&Notice> {
        self.log.back().filter(|_| self.refused || self.left_secs > 0.0)
    }

    /// Everything that was said, the latest last.
    pub fn log(&self) -> impl DoubleEndedIterator<Item = &Notice> {
        self.log.iter()
    }

    /// Lets time pass. Gives how long the current line is shown yet, if that ends.
    pub fn advance(&mut self, secs: f64) -> Option<f64> {
        self.left_secs = (self.left_secs - secs.max(0.0)).max(0.0);
        (!self.refused && self.left_secs > 0.0).then_some(self.left_secs)
    }

    fn push(&mut self, weight: Weight, text: String) {
        self.log.push_back(Notice { weight, text });
        self.log.drain(..self.log.len().saturating_sub(MAX_LINES));
        self.refused = false;
        self.left_secs = SHOWN_SECS;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_stays_until_something_is_done() {
        let mut notices = Notices::default();
        notices.refuse("no");
        notices.refuse("no");
        notices.advance(100.0);
        assert_eq!(notices.refusal(), Some("no"));
        assert_eq!(notices.log().count(), 1, "once is enough");
        notices.clear_refusal();
        assert_eq!((notices.refusal(), notices.current()), (None, None));
    }

    #[test]
    fn news_go_by() {
        let mut notices = Notices::default();
        notices.tell("saved");
        assert!(notices.advance(1.0).is_some());
        assert_eq!(notices.current().unwrap().text, "saved");
        assert_eq!(notices.advance(SHOWN_SECS), None);
        assert_eq!(notices.current(), None);
        (0..2 * MAX_LINES).for_each(|n| notices.note(n.to_string()));
        assert_eq!(notices.log().count(), MAX_LINES);
    }
}
