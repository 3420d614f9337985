//! What is changed by hand on a take, as it is authored and saved: degrees, metres, frames, names.

use motion_core::by_hand::{Knot, Limb, Retime, RetimeError, Space};
use motion_io::limits::MAX_PROJECT_FRAMES;
use motion_io::project_file::Extra;
use serde_json::Value;

/// Most changes of one take.
pub const MAX_EDITS: usize = 256;
/// The most that a joint is turned, degrees: every other turn is a shorter one the other way.
pub const MAX_TURN_DEG: f64 = 180.0;
/// The farthest that a hand or foot is moved, metres: across the body and back.
pub const MAX_SHIFT_M: f64 = 2.0;
/// Longest ease, frames.
pub const MAX_EASE_FRAMES: u32 = 10_000;

/// A layer over a take: the take itself stays as it is found.
///
/// Numbers are kept to a millionth, so that what is saved reads back the same. Invariants, held by
/// the functions that change a layer and by reading it:
/// 1. At most [`MAX_EDITS`] edits, each with an id of its own.
/// 2. Every edit's numbers are finite and within the limits above; it does not end before it begins
///    and is over before frame 1 000 000.
/// 3. The knots are a [`Retime`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ByHand {
    pub(super) edits: Vec<EditEntry>,
    pub(super) retime: Retime,
    /// Keys that this version does not know.
    pub(super) extra: Extra,
}

/// An entry of the file's list of edits.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum EditEntry {
    /// An edit.
    Edit {
        id: String,
        edit: HandEdit,
        /// Keys that this version does not know.
        extra: Extra,
    },
    /// Something that this version does not understand; kept as it is, without effect.
    Strange(Value),
}

/// A change by hand and when it has its effect. Frames are those of the take before it is retimed.
#[derive(Clone, Debug, PartialEq)]
pub struct HandEdit {
    /// What is changed.
    pub change: HandChange,
    /// The first frame with the full effect.
    pub from: u32,
    /// The last frame with the full effect.
    pub to: u32,
    /// Frames before `from` over which it comes.
    pub ease_in: u32,
    /// Frames behind `to` over which it goes.
    pub ease_out: u32,
}

/// What is changed by hand.
#[derive(Clone, Debug, PartialEq)]
pub enum HandChange {
    /// A joint is turned.
    Joint {
        /// Its name, or a role.
        joint: String,
        /// Axis times angle, degrees, in the joint's own frame as it is posed.
        turn_deg: [f64; 3],
    },
    /// A hand or a foot is moved.
    Hand {
        /// Which.
        limb: Limb,
        /// `[x, y, z]`, metres.
        shift_m: [f64; 3],
        /// In the world's directions or the body's (x to its left, z ahead).
        space: Space,
    },
}

/// Why something is no change by hand: a sentence with "must be" between its parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what} must be {allowed}")]
pub struct HandFault {
    /// What was given.
    pub what: &'static str,
    /// What it may be.
    pub allowed: &'static str,
}

impl HandChange {
    /// The kind's name in files and ids.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Joint { .. } => "joint",
            Self::Hand { .. } => "hand",
        }
    }
}

impl HandEdit {
    /// The edit as it is kept: within the limits, numbers to a millionth.
    pub fn checked(mut self) -> Result<Self, HandFault> {
        let fault = |what, allowed| Err(HandFault { what, allowed });
        match &mut self.change {
            HandChange::Joint { joint, turn_deg } => {
                if joint.trim().is_empty() {
                    return fault("a turn", "of a joint with a name");
                }
                if !is_within(turn_deg, MAX_TURN_DEG) {
                    return fault("a turn", "by 180° at most");
                }
                *turn_deg = turn_deg.map(kept);
            }
            HandChange::Hand { shift_m, .. } => {
                if !is_within(shift_m, MAX_SHIFT_M) {
                    return fault("a hand's way", "2 m at most");
                }
                *shift_m = shift_m.map(kept);
            }
        }
        if self.from > self.to {
            return fault("a change by hand", "over after it begins");
        }
        if self.ease_in.max(self.ease_out) > MAX_EASE_FRAMES {
            return fault("an ease", "10 000 frames at most");
        }
        if self.to >= MAX_PROJECT_FRAMES {
            return fault("a frame", "below a million");
        }
        Ok(self)
    }
}

impl ByHand {
    /// The edits with their ids, in the order in which they were made.
    pub fn edits(&self) -> impl Iterator<Item = (&str, &HandEdit)> {
        self.edits.iter().filter_map(|entry| match entry {
            EditEntry::Edit { id, edit, .. } => Some((id.as_str(), edit)),
            EditEntry::Strange(_) => None,
        })
    }

    /// The edit of that id.
    pub fn edit(&self, id: &str) -> Option<&HandEdit> {
        self.edits().find(|(known, _)| *known == id).map(|(_, edit)| edit)
    }

    /// When what is shown.
    pub fn retime(&self) -> &Retime {
        &self.retime
    }

    /// Whether there is nothing in it, not even something that is not understood.
    pub fn is_empty(&self) -> bool {
        self.edits.is_empty() && self.retime.is_identity() && self.extra.is_empty()
    }

    /// The id that the next edit of `kind` gets: the first free of `kind-1`, `kind-2`, ….
    pub fn next_id(&self, kind: &str) -> String {
        let ids = (1..=self.edits.len() + 1).map(|nth| format!("{kind}-{nth}"));
        ids.into_iter().find(|id| self.edit(id).is_none()).unwrap_or_default()
    }

    /// Puts an edit in under its next id.
    pub(crate) fn add(&mut self, edit: HandEdit) -> Result<(), HandFault> {
        let id = self.next_id(edit.change.kind());
        self.push(id, edit, Extra::new())
    }

    /// Puts an edit at the end, as a file has it.
    pub(super) fn push(
        &mut self,
        id: String,
        edit: HandEdit,
        extra: Extra,
    ) -> Result<(), HandFault> {
        if self.edits.len() >= MAX_EDITS {
            let (what, allowed) = ("a take", "changed by hand at no more than 256 places");
            return Err(HandFault { what, allowed });
        }
        if id.is_empty() || self.edit(&id).is_some() {
            return Err(HandFault { what: "an id", allowed: "that of one change by hand alone" });
        }
        let edit = edit.checked()?;
        self.edits.push(EditEntry::Edit { id, edit, extra });
        Ok(())
    }

    /// Gives an edit other values; `false` where there is none of that id.
    pub(crate) fn change(&mut self, id: &str, edit: HandEdit) -> Result<bool, HandFault> {
        let edit = edit.checked()?;
        let known = self.edits.iter_mut().find_map(|entry| match entry {
            EditEntry::Edit { id: known, edit, .. } if known == id => Some(edit),
            _ => None,
        });
        Ok(known.map(|known| *known = edit).is_some())
    }

    /// Takes an edit out; `false` where there is none of that id.
    pub(crate) fn remove(&mut self, id: &str) -> bool {
        let before = self.edits.len();
        self.edits.retain(|e| !matches!(e, EditEntry::Edit { id: known, .. } if known == id));
        self.edits.len() < before
    }

    /// Says anew when what is shown; no knots show everything in its own time.
    pub(crate) fn set_retime(&mut self, knots: &[Knot]) -> Result<(), HandFault> {
        let rounded = |knot: &Knot| Knot { source: kept(knot.source), ..*knot };
        let fault = |error| {
            let (what, allowed) = match error {
                RetimeError::TooMany => ("a timing", "a curve of 256 knots at most"),
                RetimeError::TooLate => ("a knot", "before frame 36 000"),
                RetimeError::Order => ("a knot", "behind the one before it"),
                RetimeError::Backwards => ("time", "on its way forwards, or standing still"),
                RetimeError::TooFast => ("a motion", "no more than eight times as fast"),
            };
            HandFault { what, allowed }
        };
        self.retime = Retime::new(knots.iter().map(rounded).collect()).map_err(fault)?;
        Ok(())
    }
}

/// To a millionth, never −0.
fn kept(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// Whether a vector is no longer than that; one that is no number is not.
fn is_within(vector: &[f64; 3], longest: f64) -> bool {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt() <= longest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of an edit: its fault, or "fine".
    #[track_caller]
    fn check(edit: HandEdit, expected: &str) {
        let said = edit.checked().map_or_else(|fault| fault.to_string(), |_| "fine".to_owned());
        assert_eq!(said, expected);
    }

    fn turn(joint: &str, turn_deg: [f64; 3]) -> HandEdit {
        let change = HandChange::Joint { joint: joint.to_owned(), turn_deg };
        HandEdit { change, from: 10, to: 20, ease_in: 5, ease_out: 5 }
    }

    fn shift(shift_m: [f64; 3]) -> HandEdit {
        let change = HandChange::Hand { limb: Limb::LeftHand, shift_m, space: Space::World };
        HandEdit { change, from: 10, to: 20, ease_in: 5, ease_out: 5 }
    }

    #[test]
    fn limits_are_sentences() {
        check(turn("Head", [0.0, 180.0, 0.0]), "fine");
        check(turn("Head", [0.0, 180.0, 1.0]), "a turn must be by 180° at most");
        check(turn("Head", [f64::NAN, 0.0, 0.0]), "a turn must be by 180° at most");
        check(turn(" ", [0.0; 3]), "a turn must be of a joint with a name");
        check(shift([0.0, 2.0, 0.0]), "fine");
        check(shift([0.0, 2.0, 0.1]), "a hand's way must be 2 m at most");
        check(
            HandEdit { from: 30, ..shift([0.0; 3]) },
            "a change by hand must be over after it begins",
        );
        check(HandEdit { to: u32::MAX, ..shift([0.0; 3]) }, "a frame must be below a million");
        check(
            HandEdit { ease_in: u32::MAX, ..shift([0.0; 3]) },
            "an ease must be 10 000 frames at most",
        );
    }

    #[test]
    fn ids_are_the_first_free_ones_of_their_kind() {
        let mut layer = ByHand::default();
        for edit in [turn("Head", [0.0; 3]), shift([0.0; 3]), turn("Neck", [0.0; 3])] {
            layer.add(edit).unwrap();
        }
        let ids = |layer: &ByHand| layer.edits().map(|(id, _)| id.to_owned()).collect::<Vec<_>>();
        assert_eq!(ids(&layer), ["joint-1", "hand-1", "joint-2"]);
        assert!(layer.remove("joint-1") && !layer.remove("joint-1"));
        layer.add(turn("Head", [0.0; 3])).unwrap();
        assert_eq!(ids(&layer), ["hand-1", "joint-2", "joint-1"]);
        assert_eq!(layer.change("none", shift([0.0; 3])), Ok(false));
    }
}
