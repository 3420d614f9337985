//! A change by hand brought to other frames, or made to come and go more slowly.

use motion_session::command::Command;
use motion_session::document::by_hand::MAX_EASE_FRAMES;
use motion_session::document::{HandEdit, StoredTake};

use crate::state::EditorState;

/// A million frames are nine hours.
const MAX_FRAME: i64 = 999_999;

/// By what a bar is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HandPart {
    /// All of it.
    Whole,
    /// The first frame with the full effect.
    From,
    /// The last one.
    To,
    /// Where it begins to come.
    EaseIn,
    /// Where it is gone.
    EaseOut,
}

impl HandPart {
    /// What tests and screen readers call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Whole => "All",
            Self::From => "Beginning",
            Self::To => "End",
            Self::EaseIn => "Ease in",
            Self::EaseOut => "Ease out",
        }
    }
}

/// An edit that is held, as it was when it was taken.
#[derive(Clone, Debug)]
pub struct HandGrab {
    take: StoredTake,
    id: String,
    edit: HandEdit,
    part: HandPart,
    /// How far from the held edge the pointer took it, source frames.
    off: f64,
    /// What was done last, so that a pointer that rests asks for nothing.
    pub done: Option<i64>,
}

impl HandGrab {
    /// Takes hold of an edit of the shown take at an output frame.
    pub fn new(id: &str, part: HandPart, press: f64, state: &mut EditorState) -> Option<Self> {
        let take = state.hand_take()?;
        let edit = take.by_hand.as_ref()?.edit(id)?.clone();
        let off = state.source_frame(press) - edge(&edit, part) as f64;
        state.select_edit(id);
        state.begin_gesture("Change by hand");
        Some(Self { take, id: id.to_owned(), edit, part, off, done: None })
    }

    /// What brings the held edge to an output frame; nothing where it is there.
    pub fn commands(&mut self, output: f64, state: &EditorState) -> Vec<Command> {
        let to = (state.source_frame(output) - self.off).round() as i64;
        let by = to - edge(&self.edit, self.part);
        if self.done.unwrap_or_default() == by {
            return Vec::new();
        }
        self.done = Some(by);
        let edit = moved(&self.edit, self.part, by);
        let (take, id) = (self.take.clone(), self.id.clone());
        vec![Command::ChangeByHand { take, id, edit }]
    }
}

/// The frame that is held, or the one behind it at ends: a frame is a column.
fn edge(edit: &HandEdit, part: HandPart) -> i64 {
    let [from, to, ease_in, ease_out] =
        [edit.from, edit.to, edit.ease_in, edit.ease_out].map(i64::from);
    match part {
        HandPart::Whole | HandPart::From => from,
        HandPart::To => to + 1,
        HandPart::EaseIn => from - ease_in,
        HandPart::EaseOut => to + 1 + ease_out,
    }
}

/// The edit with a part of it so many frames on, or back. Ends stop at each other, eases at nothing.
fn moved(edit: &HandEdit, part: HandPart, by: i64) -> HandEdit {
    let mut new = edit.clone();
    let [from, to, ease_in, ease_out] =
        [edit.from, edit.to, edit.ease_in, edit.ease_out].map(i64::from);
    let frame = |frame: i64| frame.clamp(0, MAX_FRAME) as u32;
    let ease = |ease: i64| ease.clamp(0, i64::from(MAX_EASE_FRAMES)) as u32;
    match part {
        HandPart::Whole => {
            let by = by.clamp(-from, MAX_FRAME - to);
            (new.from, new.to) = (frame(from + by), frame(to + by));
        }
        HandPart::From => new.from = frame((from + by).min(to)),
        HandPart::To => new.to = frame((to + by).max(from)),
        HandPart::EaseIn => new.ease_in = ease(ease_in - by),
        HandPart::EaseOut => new.ease_out = ease(ease_out + by),
    }
    new
}

#[cfg(test)]
mod tests {
    use motion_session::document::HandChange;

    use super::*;

    fn edit([from, to, ease_in, ease_out]: [u32; 4]) -> HandEdit {
        let change = HandChange::Joint { joint: "Head".to_owned(), turn_deg: [0.0; 3] };
        HandEdit { change, from, to, ease_in, ease_out }
    }

    #[test]
    fn parts_move_and_stop() {
        let before = [20, 30, 5, 8];
        for (part, by, after) in [
            (HandPart::Whole, 4, [24, 34, 5, 8]),
            (HandPart::Whole, -50, [0, 10, 5, 8]),
            (HandPart::From, 4, [24, 30, 5, 8]),
            (HandPart::From, 40, [30, 30, 5, 8]),
            (HandPart::From, -40, [0, 30, 5, 8]),
            (HandPart::To, -40, [20, 20, 5, 8]),
            (HandPart::To, 3, [20, 33, 5, 8]),
            (HandPart::EaseIn, -3, [20, 30, 8, 8]),
            (HandPart::EaseIn, 9, [20, 30, 0, 8]),
            (HandPart::EaseOut, 3, [20, 30, 5, 11]),
            (HandPart::EaseOut, -30, [20, 30, 5, 0]),
        ] {
            assert_eq!(moved(&edit(before), part, by), edit(after), "{part:?} {by}");
        }
        let edges = [HandPart::From, HandPart::To, HandPart::EaseIn, HandPart::EaseOut];
        assert_eq!(edges.map(|part| edge(&edit(before), part)), [20, 31, 15, 39]);
    }
}
