//! Marks brought to other frames together.

use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;

use crate::mark::Mark;

/// By what a mark is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// All of it.
    Whole,
    /// The beginning of a stretch.
    Start,
    /// The end of a stretch.
    End,
}

/// Marks that are held, as they were when they were taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Grab {
    /// Those that move: the one under the pointer first.
    held: Vec<Held>,
    /// Those that move only where everything later is to go along.
    later: Vec<Held>,
    part: Part,
    /// What was done last, so that a pointer that rests asks for nothing.
    pub done: Option<(i64, bool)>,
}

#[derive(Clone, Debug, PartialEq)]
struct Held {
    at: ConstraintRef,
    span: (u32, u32),
    /// The first body constraint is at frame 0 and stays there.
    is_start: bool,
}

impl Grab {
    /// Takes hold of the mark `of`, and of those beside it that `is_selected` if it is one of them.
    /// A stretch that is held by an end is held alone. `None` where there is no such mark.
    pub fn new(
        marks: &[Mark],
        is_selected: impl Fn(&Mark) -> bool,
        of: &ConstraintRef,
        part: Part,
    ) -> Option<Self> {
        let held = |mark: &Mark| Held {
            at: mark.at.clone(),
            span: mark.span(),
            is_start: mark.frame() == 0 && mark.body().is_some(),
        };
        let own = marks.iter().find(|mark| mark.at == *of)?;
        let goes_along = |mark: &&Mark| {
            mark.at == *of || (part == Part::Whole && is_selected(own) && is_selected(mark))
        };
        let mut all: Vec<Held> = marks.iter().filter(goes_along).map(held).collect();
        all.sort_by_key(|other| other.at != *of);
        let is_later = |mark: &&Mark| mark.frame() > own.frame() && !goes_along(mark);
        let later = marks.iter().filter(is_later).map(held).collect();
        Some(Self { held: all, later, part, done: None })
    }

    /// The frame of what is held, as it was.
    pub fn frame(&self) -> u32 {
        let span = self.held.first().map(|held| held.span).unwrap_or_default();
        if self.part == Part::End { span.1 } else { span.0 }
    }

    /// By what it is held.
    pub fn part(&self) -> Part {
        self.part
    }

    /// Whether it is one of those that move.
    pub fn moves(&self, at: &ConstraintRef, is_rippling: bool) -> bool {
        self.moving(is_rippling).any(|held| held.at == *at)
    }

    fn moving(&self, is_rippling: bool) -> impl Iterator<Item = &Held> {
        let later = self.later.iter().filter(move |_| is_rippling && self.part == Part::Whole);
        // What begins the motion stays where others are moved with it; alone, it is refused aloud.
        let is_alone = self.held.len() == 1;
        self.held.iter().chain(later).filter(move |held| !held.is_start || is_alone)
    }

    /// The last frame that anything gets to.
    pub fn last_frame(&self, by: i64, is_rippling: bool) -> Option<u32> {
        let by = self.clamped(by, is_rippling);
        let ends = self.moving(is_rippling).map(|held| shifted(held.span.1, by));
        if self.part == Part::Start { None } else { ends.max() }
    }

    /// No further back than the first of them can go.
    fn clamped(&self, by: i64, is_rippling: bool) -> i64 {
        let first = self.moving(is_rippling).map(|held| held.span.0).min().unwrap_or_default();
        if self.part == Part::Whole { by.max(-i64::from(first)) } else { by }
    }

    /// What brings them so many frames on, or back. In an order in which none gets in another's way.
    pub fn commands(&self, by: i64, is_rippling: bool) -> Vec<Command> {
        let by = self.clamped(by, is_rippling);
        if by == 0 {
            return Vec::new();
        }
        if self.part != Part::Whole {
            return self.held.iter().map(|held| self.stretched(held, by)).collect();
        }
        let mut moving: Vec<&Held> = self.moving(is_rippling).collect();
        moving.sort_by_key(|held| held.span.0);
        if by > 0 {
            moving.reverse();
        }
        let retime =
            |held: &Held| Command::Retime { at: held.at.clone(), frame: shifted(held.span.0, by) };
        moving.into_iter().map(retime).collect()
    }

    /// One end moves and stops at the other.
    fn stretched(&self, held: &Held, by: i64) -> Command {
        let (from, to) = held.span;
        let (from, to) = match self.part {
            Part::Start => (shifted(from, by).min(to), to),
            _ => (from, shifted(to, by).max(from)),
        };
        Command::RetimeSpan { at: held.at.clone(), from, to }
    }
}

fn shifted(frame: u32, by: i64) -> u32 {
    u32::try_from((i64::from(frame) + by).max(0)).unwrap_or(u32::MAX)
}

/// Whether a constraint asks something over a stretch of time.
pub fn is_stretch(kind: &ConstraintKind) -> bool {
    matches!(
        kind,
        ConstraintKind::Style { .. } | ConstraintKind::Path { .. } | ConstraintKind::Lock { .. }
    )
}

#[cfg(test)]
mod tests {
    use motion_session::command::apply_all;
    use motion_session::document::{CharacterIdx, Document};
    use motion_session::sample;

    use super::*;
    use crate::mark::marks_of;

    /// The sample (body at 0, 110, 239) with a style from 20 to 60.
    fn document() -> Document {
        let document = Document::from_project(sample::sample().unwrap());
        let (character, tag) = (CharacterIdx(0), "run".to_owned());
        let style = Command::AddStyle { character, from: 20, to: 60, tag };
        apply_all(&document, &[style]).unwrap()
    }

    /// Spans by frame after a grab of `of` with `selected`.
    #[track_caller]
    fn check(
        (of, part, selected): (&str, Part, &[&str]),
        (by, is_rippling): (i64, bool),
        expected: &[(u32, u32)],
    ) {
        let document = document();
        let marks = marks_of(&document, CharacterIdx(0), &[]);
        let of = ConstraintRef::new(CharacterIdx(0), of);
        let is_selected = |mark: &Mark| selected.contains(&mark.at.id.as_str());
        let grab = Grab::new(&marks, is_selected, &of, part).unwrap();
        let document = apply_all(&document, &grab.commands(by, is_rippling)).unwrap();
        let marks = marks_of(&document, CharacterIdx(0), &[]);
        assert_eq!(marks.iter().map(Mark::span).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn what_moves() {
        let (whole, all) = (Part::Whole, ["start", "style-1", "corner", "end"]);
        let at = |style: (u32, u32), corner, end| [(0, 0), style, (corner, corner), (end, end)];
        check(("corner", whole, &[]), (5, false), &at((20, 60), 115, 239));
        check(("corner", whole, &["end"]), (5, false), &at((20, 60), 115, 239));
        check(("corner", whole, &["corner", "end"]), (-5, false), &at((20, 60), 105, 234));
        check(("corner", whole, &[]), (5, true), &at((20, 60), 115, 244));
        check(("style-1", whole, &[]), (129, true), &at((149, 189), 239, 368));
        check(("end", whole, &all), (3, false), &at((23, 63), 113, 242));
        check(("end", whole, &all), (-50, false), &at((0, 40), 90, 219));
    }

    #[test]
    fn ends_of_a_stretch() {
        let at = |style: (u32, u32)| [(0, 0), style, (110, 110), (239, 239)];
        check(("style-1", Part::Start, &[]), (5, true), &at((25, 60)));
        check(("style-1", Part::Start, &[]), (500, false), &at((60, 60)));
        check(("style-1", Part::End, &["end"]), (-500, false), &at((20, 20)));
        check(("style-1", Part::End, &[]), (9, false), &at((20, 69)));
    }

    #[test]
    fn the_start_alone_is_refused() {
        let document = document();
        let marks = marks_of(&document, CharacterIdx(0), &[]);
        let of = ConstraintRef::new(CharacterIdx(0), "start");
        let grab = Grab::new(&marks, |_| false, &of, Part::Whole).unwrap();
        assert!(apply_all(&document, &grab.commands(4, false)).is_err());
        assert!(Grab::new(&[], |_| false, &of, Part::Whole).is_none());
    }
}
