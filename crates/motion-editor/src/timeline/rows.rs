//! Which rows there are, and where.

use egui::{Pos2, Rect, Vec2};
use motion_core::contacts::Side;
use motion_session::ConstraintKind;
use motion_session::document::CharacterIdx;

use super::curves::Curve;
use super::hand_row;
use crate::mark::Mark;
use crate::state::EditorState;
use crate::theme;

/// A row of the timeline.
#[derive(Clone, Debug, PartialEq)]
pub enum Row {
    /// Which clip is shown when.
    Source,
    /// Body checkpoints.
    Body,
    /// Targets of a joint.
    Joint(String),
    /// Poses.
    Pose,
    /// Stretches of a style.
    Style,
    /// Stretches of drawn paths.
    Path,
    /// Stretches that stay.
    Locked,
    /// Where the character meets others.
    Meetings,
    /// What is changed by hand on the shown take, on so many storeys besides the first.
    ByHand(usize),
    /// When a foot is planted.
    Foot(Side),
    /// The heading of the curves, which opens them.
    Curves,
    /// A curve.
    Curve(Curve),
    /// Another character's checkpoints.
    Other(CharacterIdx),
}

/// The rows that have something in them; source, body, styles, feet and the heading of curves
/// always.
pub fn rows_of(state: &EditorState) -> Vec<Row> {
    let has = |kind: &str| state.marks.iter().any(|mark| mark.constraint.kind.name() == kind);
    let mut rows = vec![Row::Source, Row::Body];
    let mut joints: Vec<&str> = state.marks.iter().filter_map(joint).collect();
    joints.sort_unstable();
    joints.dedup();
    rows.extend(joints.into_iter().map(|joint| Row::Joint(joint.to_owned())));
    let stretches =
        [("pose", Row::Pose), ("style", Row::Style), ("path", Row::Path), ("lock", Row::Locked)];
    // Styles begin on their row, so it is there before there are any.
    let is_there = |kind: &str| kind == "style" || has(kind);
    rows.extend(stretches.into_iter().filter(|(kind, _)| is_there(kind)).map(|(_, row)| row));
    if state.meetings().next().is_some() {
        rows.push(Row::Meetings);
    }
    if state.has_hand_edits() {
        rows.push(Row::ByHand(hand_row::extra_storeys(state)));
    }
    rows.extend(Side::BOTH.map(Row::Foot));
    let characters = state.session.document().characters().len();
    let others = (0..characters).map(CharacterIdx).filter(|nth| *nth != state.session.active());
    rows.extend(others.map(Row::Other));
    rows.push(Row::Curves);
    if state.settings.curves_open {
        let curves = [Curve::Miss, Curve::Speed, Curve::Turn].into_iter();
        rows.extend(curves.chain(has("path").then_some(Curve::Path)).map(Row::Curve));
    }
    rows
}

/// The joint of a joint target.
fn joint(mark: &Mark) -> Option<&str> {
    match &mark.constraint.kind {
        ConstraintKind::Joint { joint, .. } => Some(joint),
        _ => None,
    }
}

impl Row {
    /// What is written before it.
    pub fn name(&self, state: &EditorState) -> String {
        match self {
            Self::Source => "Source".to_owned(),
            Self::Body => "Body".to_owned(),
            Self::Joint(joint) => joint.clone(),
            Self::Pose => "Pose".to_owned(),
            Self::Style => "Style".to_owned(),
            Self::Path => "Path".to_owned(),
            Self::Locked => "Locked".to_owned(),
            Self::Meetings => "Meets".to_owned(),
            Self::ByHand(_) => "By hand".to_owned(),
            Self::Foot(Side::Left) => "Foot L".to_owned(),
            Self::Foot(Side::Right) => "Foot R".to_owned(),
            Self::Curves => "Curves".to_owned(),
            Self::Curve(curve) => curve.name().to_owned(),
            Self::Other(character) => {
                let character = state.session.document().character(*character);
                character.map(|character| character.name.clone()).unwrap_or_default()
            }
        }
    }

    /// Whether a mark stands in it.
    pub fn holds(&self, mark: &Mark) -> bool {
        match (self, &mark.constraint.kind) {
            (Self::Joint(own), ConstraintKind::Joint { joint, .. }) => own == joint,
            (Self::Body, ConstraintKind::Body { .. })
            | (Self::Pose, ConstraintKind::Pose { .. })
            | (Self::Style, ConstraintKind::Style { .. })
            | (Self::Path, ConstraintKind::Path { .. })
            | (Self::Locked, ConstraintKind::Lock { .. }) => true,
            _ => false,
        }
    }

    /// How high it is, points. Stretches that overlap stand one below the other.
    pub fn height(&self, marks: &[Mark]) -> f32 {
        match self {
            Self::Source => theme::TRACK_HEIGHT + 10.0,
            Self::Style | Self::Path | Self::Locked => {
                let n = storeys(marks.iter().filter(|mark| self.holds(mark))).into_iter().max();
                theme::TRACK_HEIGHT + STOREY_PT * n.unwrap_or_default() as f32
            }
            Self::ByHand(n) => theme::TRACK_HEIGHT + STOREY_PT * *n as f32,
            Self::Foot(_) | Self::Other(_) => 16.0,
            Self::Curves => 20.0,
            Self::Curve(_) => 36.0,
            _ => theme::TRACK_HEIGHT,
        }
    }
}

/// How high a storey of a row of stretches is, points.
pub const STOREY_PT: f32 = 20.0;

/// On which storey each stretch stands, from 0: the first where it covers none before it.
pub fn storeys<'a>(marks: impl Iterator<Item = &'a Mark>) -> Vec<usize> {
    let mut ends: Vec<u32> = Vec::new();
    let mut storeys = Vec::new();
    for (from, to) in marks.map(Mark::span) {
        let free = ends.iter().position(|end| *end < from);
        let storey = free.unwrap_or(ends.len());
        match free {
            Some(storey) => ends[storey] = to,
            None => ends.push(to),
        }
        storeys.push(storey);
    }
    storeys
}

/// Where rows are in a window that shows some of them.
pub struct Layout {
    /// Every row with its place, also where it cannot be seen.
    pub rows: Vec<(Row, Rect)>,
    /// How high they are together, points.
    pub height_pt: f32,
}

impl Layout {
    /// One below the other, moved up by `scroll_pt`.
    pub fn new(rows: Vec<Row>, marks: &[Mark], window: Rect, scroll_pt: f32) -> Self {
        let mut top = theme::GRID;
        let mut placed = Vec::with_capacity(rows.len());
        for row in rows {
            let height = row.height(marks);
            let at = Pos2::new(window.left(), window.top() + top - scroll_pt);
            let place = Rect::from_min_size(at, Vec2::new(window.width(), height));
            top += height + theme::GRID;
            placed.push((row, place));
        }
        Self { rows: placed, height_pt: top }
    }

    /// The furthest that they can be moved up.
    pub fn max_scroll_pt(&self, window: Rect) -> f32 {
        (self.height_pt - window.height()).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use motion_session::command::{Command, apply_all};
    use motion_session::document::Document;
    use motion_session::sample;

    use super::*;
    use crate::mark::marks_of;

    #[test]
    fn stretches_that_overlap_stand_on_storeys() {
        let document = Document::from_project(sample::sample().unwrap());
        let character = CharacterIdx(0);
        let style = |(from, to)| Command::AddStyle { character, from, to, tag: "run".to_owned() };
        let spans = [(0, 40), (10, 20), (41, 60), (21, 90), (15, 30)];
        let document = apply_all(&document, &spans.map(style)).unwrap();
        let marks = marks_of(&document, character, &[]);
        let styles = marks.iter().filter(|mark| Row::Style.holds(mark));
        assert_eq!(storeys(styles), [0, 1, 2, 1, 0]);
        assert_eq!(Row::Style.height(&marks), theme::TRACK_HEIGHT + 2.0 * STOREY_PT);
        let window = Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 100.0));
        let layout = Layout::new(vec![Row::Source, Row::Style], &marks, window, 10.0);
        assert_eq!(layout.rows[0].1.top(), theme::GRID - 10.0);
        assert_eq!(layout.max_scroll_pt(window), layout.height_pt - 100.0);
    }
}
