//! A constraint on the timeline and in lists.

use motion_scene::color::ColorRole;
use motion_session::document::{CharacterIdx, ConstraintRef, Document};
use motion_session::{Constraint, ConstraintKind, ConstraintReport};

/// A constraint with how far off the shown motion is.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Its name in the document.
    pub at: ConstraintRef,
    /// Its place in the character's list.
    pub index: usize,
    /// From 1, among those of its kind, by frame.
    pub number: usize,
    /// What it asks.
    pub constraint: Constraint,
    /// How far off the motion is; `None` while nobody knows.
    pub miss: Option<ConstraintReport>,
    /// Why nobody knows.
    pub unknown: Unknown,
}

/// Why nobody knows how far off a motion is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unknown {
    /// It is being looked for.
    #[default]
    Searching,
    /// The search leaves it out, and says so.
    NotConsidered,
    /// It is met or not, but not by a distance.
    NotMeasured,
}

impl Unknown {
    /// Why nothing is known of a constraint while `misses` are of others, and `remarks` say what is
    /// left out.
    pub fn of(constraint: &Constraint, misses: &[ConstraintReport], remarks: &[String]) -> Self {
        let begins =
            format!("{} constraint {:?} was not considered", constraint.kind.name(), constraint.id);
        if remarks.iter().any(|remark| remark.starts_with(&begins)) {
            Self::NotConsidered
        } else if misses.is_empty() {
            Self::Searching
        } else {
            Self::NotMeasured
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Searching => "searching",
            Self::NotConsidered => "not considered",
            Self::NotMeasured => "asked for",
        }
    }
}

/// The constraints of a character, by frame.
pub fn marks_of(
    document: &Document,
    character: CharacterIdx,
    misses: &[ConstraintReport],
) -> Vec<Mark> {
    let constraints = document.character(character).map_or(&[][..], |c| &c.constraints);
    let mark = |(index, constraint): (usize, &Constraint)| Mark {
        at: ConstraintRef::new(character, constraint.id.clone()),
        index,
        number: 0,
        constraint: constraint.clone(),
        miss: misses.iter().find(|miss| miss.constraint == constraint.id).cloned(),
        unknown: Unknown::default(),
    };
    let mut marks: Vec<Mark> = constraints.iter().enumerate().map(mark).collect();
    marks.sort_by_key(Mark::frame);
    for nth in 0..marks.len() {
        let kind = marks[nth].constraint.kind.name();
        marks[nth].number =
            1 + marks[..nth].iter().filter(|other| other.constraint.kind.name() == kind).count();
    }
    marks
}

impl Mark {
    /// Its frame, or the first of its stretch.
    pub fn frame(&self) -> usize {
        self.span().0 as usize
    }

    /// Its first and last frame; the same where it has one.
    pub fn span(&self) -> (u32, u32) {
        match &self.constraint.kind {
            ConstraintKind::Body { frame, .. }
            | ConstraintKind::Joint { frame, .. }
            | ConstraintKind::Pose { frame, .. } => (*frame, *frame),
            ConstraintKind::Style { from, to, .. }
            | ConstraintKind::Path { from, to, .. }
            | ConstraintKind::Lock { from, to, .. } => (*from, *to),
        }
    }

    /// Place and heading of a body constraint.
    pub fn body(&self) -> Option<([f64; 2], Option<f64>)> {
        match &self.constraint.kind {
            ConstraintKind::Body { position_m, heading_deg, .. } => {
                Some((*position_m, *heading_deg))
            }
            _ => None,
        }
    }

    /// What it is called.
    pub fn title(&self) -> String {
        let number = self.number;
        match &self.constraint.kind {
            ConstraintKind::Body { .. } => format!("Checkpoint {number}"),
            ConstraintKind::Joint { joint, .. } => format!("{joint} target"),
            ConstraintKind::Pose { clip, clip_frame, .. } => format!("Pose {clip}:{clip_frame}"),
            ConstraintKind::Style { tag, .. } => format!("Style {tag}"),
            ConstraintKind::Path { .. } => format!("Path {number}"),
            ConstraintKind::Lock { .. } => format!("Locked stretch {number}"),
        }
    }

    /// The colour of its kind.
    pub fn color_role(&self) -> ColorRole {
        match &self.constraint.kind {
            ConstraintKind::Body { .. } | ConstraintKind::Path { .. } => ColorRole::Checkpoint,
            ConstraintKind::Joint { .. } => ColorRole::JointTarget,
            ConstraintKind::Pose { .. } | ConstraintKind::Lock { .. } => ColorRole::Pose,
            ConstraintKind::Style { .. } => ColorRole::Style,
        }
    }

    /// Whether the body is off by what somebody could see.
    pub fn is_off(&self) -> bool {
        !self.misses().is_empty()
    }

    /// `miss 4 cm, 2°`, or that it is met.
    pub fn miss_text(&self) -> String {
        match (&self.miss, self.misses()) {
            (None, _) => self.unknown.words().to_owned(),
            (Some(_), misses) if misses.is_empty() => "met".to_owned(),
            (Some(_), misses) => format!("miss {}", misses.join(", ")),
        }
    }

    /// The misses that somebody could see, with their units.
    fn misses(&self) -> Vec<String> {
        let Some(miss) = &self.miss else { return Vec::new() };
        let cm = miss.position_error_m.map(|m| m * 100.0).filter(|cm| *cm >= 0.5);
        let deg = miss.heading_error_deg.filter(|deg| deg.abs() >= 0.5);
        let frames = miss.frame_error.filter(|frames| *frames != 0);
        let when = |frames: i64| if frames > 0 { "late" } else { "early" };
        let all = [
            cm.map(|cm| format!("{cm:.0} cm")),
            deg.map(|deg| format!("{:.0}°", deg.abs())),
            frames.map(|frames| format!("{} f {}", frames.abs(), when(frames))),
        ];
        all.into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use motion_session::sample;

    use super::*;

    #[test]
    fn misses_nobody_can_see_are_none() {
        let document = Document::from_project(sample::sample().unwrap());
        let mark = marks_of(&document, CharacterIdx(0), &[]).remove(0);
        let check = |miss: Option<(f64, f64, i64)>, expected: &str, is_off: bool| {
            let miss = miss.map(|(metres, degrees, frames)| ConstraintReport {
                position_error_m: Some(metres),
                heading_error_deg: Some(degrees),
                frame_error: Some(frames),
                ..ConstraintReport::default()
            });
            let mark = Mark { miss, ..mark.clone() };
            assert_eq!((mark.miss_text().as_str(), mark.is_off()), (expected, is_off));
        };
        check(None, "searching", false);
        check(Some((0.0, 0.0, 0)), "met", false);
        check(Some((0.004, 0.2, 0)), "met", false);
        check(Some((0.042, 0.0, 0)), "miss 4 cm", true);
        check(Some((0.042, -3.4, 11)), "miss 4 cm, 3°, 11 f late", true);
        check(Some((0.0, 0.0, -2)), "miss 2 f early", true);
    }

    #[test]
    fn what_is_left_out_is_not_searched_for() {
        let document = Document::from_project(sample::sample().unwrap());
        let mark = marks_of(&document, CharacterIdx(0), &[]).remove(0);
        let other = [ConstraintReport::default()];
        let said = ["body constraint \"start\" was not considered: it is a test".to_owned()];
        let elsewhere = ["the tolerance of constraint \"start\" was not considered".to_owned()];
        for (misses, remarks, expected) in [
            (&[][..], &[][..], "searching"),
            (&other, &[], "asked for"),
            (&[], &said, "not considered"),
            (&other, &said, "not considered"),
            (&[], &elsewhere, "searching"),
        ] {
            let unknown = Unknown::of(&mark.constraint, misses, remarks);
            assert_eq!(Mark { unknown, ..mark.clone() }.miss_text(), expected);
        }
    }

    #[test]
    fn numbers_count_by_frame() {
        let document = Document::from_project(sample::sample().unwrap());
        let marks = marks_of(&document, CharacterIdx(0), &[]);
        let titles: Vec<String> = marks.iter().map(Mark::title).collect();
        assert_eq!(titles, ["Checkpoint 1", "Checkpoint 2", "Checkpoint 3"]);
    }
}
