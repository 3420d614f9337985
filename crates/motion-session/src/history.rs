//! Undo and redo as a history of documents.

use std::collections::VecDeque;

use crate::command::{Command, CommandError, apply_all};
use crate::document::Document;

/// Steps that are kept at most.
pub const MAX_STEPS: usize = 1_000;
/// Memory that steps may take, about, bytes.
pub const MAX_BYTES: usize = 64 << 20;
/// So many frames in a row with a new step each are taken for a mistake: a gesture that was not
/// begun. A person's fastest clicks come every few frames.
const SUSPICIOUS_FRAMES: u32 = 12;

/// The documents before and after the present one.
///
/// Rules, each with a test of its name:
///
/// 1. What changes nothing makes no step.
/// 2. What is refused changes nothing.
/// 3. A gesture is one step, however much is previewed; each preview begins where the gesture did.
/// 4. A gesture that is cancelled, or ends where it began, leaves no step, and what could be redone
///    still can be.
/// 5. A new step drops what could be redone.
/// 6. Undo, redo and edits while a gesture is under way first cancel it; undo then does nothing
///    more.
/// 7. Undo and redo bring back the very documents, not equal ones made anew.
/// 8. When there are too many steps the oldest are forgotten, and the present never is.
#[derive(Clone, Debug)]
pub struct History {
    present: Document,
    past: VecDeque<Step>,
    future: Vec<Step>,
    gesture: Option<Gesture>,
    max_steps: usize,
    max_bytes: usize,
    n_bytes: usize,
    frames: FrameWatch,
}

/// A change of the document.
#[derive(Clone, Debug)]
struct Step {
    label: String,
    /// The document on the other side of the step.
    document: Document,
    n_bytes: usize,
}

#[derive(Clone, Debug)]
struct Gesture {
    label: String,
    /// The document when the gesture began.
    before: Document,
}

/// Counts frames in a row in which a step was made.
#[derive(Clone, Debug, Default)]
struct FrameWatch {
    has_step: bool,
    in_a_row: u32,
    suspicious: bool,
}

impl History {
    /// A history that begins with `document`.
    pub fn new(document: Document) -> Self {
        Self::with_limits(document, MAX_STEPS, MAX_BYTES)
    }

    /// A history that keeps so many steps and takes about so much memory at most.
    pub fn with_limits(document: Document, max_steps: usize, max_bytes: usize) -> Self {
        Self {
            present: document,
            past: VecDeque::new(),
            future: Vec::new(),
            gesture: None,
            max_steps,
            max_bytes,
            n_bytes: 0,
            frames: FrameWatch::default(),
        }
    }

    /// The document as it is now; while a gesture is under way, as it would be.
    pub fn present(&self) -> &Document {
        &self.present
    }

    /// The document as it would be saved: without a gesture that is still under way.
    pub fn settled(&self) -> &Document {
        self.gesture.as_ref().map_or(&self.present, |gesture| &gesture.before)
    }

    /// Carries out a command as one step.
    pub fn apply(&mut self, command: &Command) -> Result<(), CommandError> {
        self.apply_all(command.label(), std::slice::from_ref(command))
    }

    /// Carries out several commands as one step, all or none.
    pub fn apply_all(&mut self, label: &str, commands: &[Command]) -> Result<(), CommandError> {
        self.cancel();
        let new = apply_all(&self.present, commands)?;
        let old = std::mem::replace(&mut self.present, new);
        self.record(label.to_owned(), old);
        Ok(())
    }

    /// Begins a gesture; one under way is committed.
    pub fn begin_gesture(&mut self, label: &str) {
        self.commit();
        let before = self.present.clone();
        self.gesture = Some(Gesture { label: label.to_owned(), before });
    }

    /// Shows what the gesture would do, instead of what was previewed before. On a refusal the last
    /// preview stays. Without a gesture nothing happens.
    pub fn preview(&mut self, commands: &[Command]) -> Result<(), CommandError> {
        if let Some(gesture) = &self.gesture {
            self.present = apply_all(&gesture.before, commands)?;
        }
        Ok(())
    }

    /// Ends the gesture: what was previewed last becomes a step.
    pub fn commit(&mut self) {
        if let Some(Gesture { label, before }) = self.gesture.take() {
            self.record(label, before);
        }
    }

    /// Ends the gesture as if it had not been. Returns whether there was one.
    pub fn cancel(&mut self) -> bool {
        let Some(gesture) = self.gesture.take() else { return false };
        self.present = gesture.before;
        true
    }

    /// Whether a gesture is under way.
    pub fn is_in_gesture(&self) -> bool {
        self.gesture.is_some()
    }

    /// Goes back one step, or cancels the gesture under way. Returns whether anything changed.
    pub fn undo(&mut self) -> bool {
        if self.cancel() {
            return true;
        }
        let Some(step) = self.past.pop_back() else { return false };
        self.n_bytes -= step.n_bytes;
        let document = std::mem::replace(&mut self.present, step.document);
        self.future.push(Step { document, ..step });
        true
    }

    /// Goes forward one step. Returns whether anything changed.
    pub fn redo(&mut self) -> bool {
        let cancelled = self.cancel();
        let Some(step) = self.future.pop() else { return cancelled };
        let document = std::mem::replace(&mut self.present, step.document);
        self.n_bytes += step.n_bytes;
        self.past.push_back(Step { document, ..step });
        true
    }

    /// What undo would take back.
    pub fn undo_label(&self) -> Option<&str> {
        let of_gesture = self.gesture.as_ref().map(|gesture| gesture.label.as_str());
        of_gesture.or(self.past.back().map(|step| step.label.as_str()))
    }

    /// What redo would bring back.
    pub fn redo_label(&self) -> Option<&str> {
        self.future.last().map(|step| step.label.as_str())
    }

    /// Labels of the steps that can be undone, the latest first.
    pub fn past_labels(&self) -> impl Iterator<Item = &str> {
        self.past.iter().rev().map(|step| step.label.as_str())
    }

    /// Steps that can be undone and redone.
    pub fn n_steps(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }

    /// To be called once a frame, for [`History::has_a_step_every_frame`].
    pub fn note_frame(&mut self) {
        let watch = &mut self.frames;
        watch.in_a_row = if watch.has_step { watch.in_a_row + 1 } else { 0 };
        watch.has_step = false;
        watch.suspicious |= watch.in_a_row >= SUSPICIOUS_FRAMES;
    }

    /// Whether steps were once made in frame after frame: a drag that should have been a gesture.
    /// A heuristic, for tests and the log.
    pub fn has_a_step_every_frame(&self) -> bool {
        self.frames.suspicious
    }

    fn record(&mut self, label: String, old: Document) {
        if old == self.present {
            // The old one shares more with its past.
            self.present = old;
            return;
        }
        self.future.clear();
        self.frames.has_step = true;
        let n_bytes = label.len() + old.bytes_beside(&self.present);
        self.n_bytes += n_bytes;
        self.past.push_back(Step { label, document: old, n_bytes });
        while self.past.len() > self.max_steps
            || (self.n_bytes > self.max_bytes && self.past.len() > 1)
        {
            let Some(oldest) = self.past.pop_front() else { break };
            self.n_bytes -= oldest.n_bytes;
        }
    }
}

#[cfg(test)]
mod tests;
