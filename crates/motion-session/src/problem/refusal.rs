//! Why a character's problem cannot be searched, in the project's own words.

use std::fmt;
use std::path::Path;

use motion_core::constraint::BodyConstraint;
use motion_core::search::ProblemError;
use motion_io::diagnostic::FileError;

use super::CharacterProblem;

/// What is wrong with what is asked, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong; begins with whose problem it is.
    pub what: String,
    /// What the user can do about it.
    pub what_to_do: String,
}

impl Refusal {
    /// A refusal of the problem of the character `name`.
    pub(super) fn of(name: &str, what: &str, what_to_do: &str) -> Self {
        let what = format!("character {name:?}: {what}");
        Self { what, what_to_do: what_to_do.to_owned() }
    }

    /// The error of the project's file.
    pub fn in_file(self, project_path: &Path) -> FileError {
        FileError::new(project_path, self.what, self.what_to_do)
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.what, self.what_to_do)
    }
}

impl CharacterProblem {
    /// What the search's refusal means for the project: its constraints by their ids.
    pub fn refusal(&self, error: &ProblemError) -> Refusal {
        let hard = |wish| self.ids.hard(wish);
        let (what, what_to_do) = match error {
            ProblemError::SameFrame(frame) => (
                format!("{} are at frame {frame}", self.all_at(*frame)),
                "move one of them to another frame".to_owned(),
            ),
            ProblemError::HardConflict(one, other) => (
                format!(
                    "{} and {} ask for different things at one frame",
                    hard(*one),
                    hard(*other)
                ),
                "move one of them to another frame, or remove it".to_owned(),
            ),
            ProblemError::HardNotThere(wish) => (
                format!("{} shows frames that the clips in use do not have", hard(*wish)),
                "choose frames of clips that the library and the palette have".to_owned(),
            ),
            ProblemError::HardNoCut(wish) => (
                format!("{} has a cut that this library does not have", hard(*wish)),
                "lock a stretch of a take of this library, or allow bridges".to_owned(),
            ),
            ProblemError::HardTooFar { from, to, needed: None, .. } => (
                format!(
                    "no way leads from {} to {} through the clips in use",
                    hard(*from),
                    hard(*to)
                ),
                "allow more clips or bridges, or choose another".to_owned(),
            ),
            ProblemError::HardTooFar { from, to, needed: Some(needed), available } => (
                format!(
                    "from {} to {} it takes at least {needed} frames and there are {available}",
                    hard(*from),
                    hard(*to)
                ),
                "move them apart, allow more clips, or choose others".to_owned(),
            ),
            ProblemError::NoClips | ProblemError::TooShort { .. } | ProblemError::NotFinite => {
                let text = error.to_string();
                let (what, what_to_do) =
                    text.split_once("; ").unwrap_or((&text, "correct the project"));
                (what.to_owned(), what_to_do.to_owned())
            }
        };
        Refusal::of(&self.name, &what, &what_to_do)
    }

    /// The body constraints at a frame, by their ids.
    fn all_at(&self, frame: u32) -> String {
        let named = self.ids.body.iter().zip(&self.problem.wishes.body);
        let at = |(id, wish): (&String, &BodyConstraint)| {
            (wish.frame == frame).then(|| format!("{id:?}"))
        };
        let ids: Vec<String> = named.filter_map(at).collect();
        format!("body constraints {}", ids.join(" and "))
    }
}

#[cfg(test)]
mod tests {
    use motion_core::search::{HardWish, Problem};

    use super::*;
    use crate::problem::ConstraintIds;

    #[test]
    fn both_constraints_are_called_by_their_ids() {
        let ids = ConstraintIds {
            poses: vec!["kick".to_owned(), "roll".to_owned()],
            locks: vec!["keep".to_owned()],
            ..ConstraintIds::default()
        };
        let problem =
            Problem { wishes: Default::default(), allowed_clips: vec![true], bridges: true };
        let asked = CharacterProblem { name: "A".to_owned(), problem, ids, remarks: Vec::new() };
        let (kick, roll, keep) = (HardWish::Pose(0), HardWish::Pose(1), HardWish::Lock(0));
        let far = |needed| ProblemError::HardTooFar { from: kick, to: roll, needed, available: 40 };
        for (error, expected) in [
            (
                far(Some(80)),
                "p.gaitway: character \"A\": from pose \"kick\" to pose \"roll\" it takes at least \
                 80 frames and there are 40; move them apart, allow more clips, or choose others",
            ),
            (
                far(None),
                "p.gaitway: character \"A\": no way leads from pose \"kick\" to pose \"roll\" \
                 through the clips in use; allow more clips or bridges, or choose another",
            ),
            (
                ProblemError::HardConflict(keep, roll),
                "p.gaitway: character \"A\": locked stretch \"keep\" and pose \"roll\" ask for \
                 different things at one frame; move one of them to another frame, or remove it",
            ),
            (
                ProblemError::HardNotThere(kick),
                "p.gaitway: character \"A\": pose \"kick\" shows frames that the clips in use do \
                 not have; choose frames of clips that the library and the palette have",
            ),
            (
                ProblemError::HardNoCut(keep),
                "p.gaitway: character \"A\": locked stretch \"keep\" has a cut that this library \
                 does not have; lock a stretch of a take of this library, or allow bridges",
            ),
            (
                ProblemError::NoClips,
                "p.gaitway: character \"A\": no clip of the library is in the palette; include at \
                 least one",
            ),
        ] {
            let said = asked.refusal(&error).in_file(Path::new("p.gaitway")).to_string();
            assert_eq!(said, expected, "{error:?}");
        }
    }
}
