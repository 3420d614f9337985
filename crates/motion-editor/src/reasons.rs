//! Why a take costs what it costs: each constraint and each cut, the dearest first.

use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::selection::Selectable;
use motion_session::stage::meeting_wishes::title;
use motion_session::{Constraint, ConstraintKind, ConstraintReport, Interaction, Member};

use crate::mark::{Mark, Unknown};
use crate::take_card::TakeCard;

/// A cost of 1 is so much off where the constraint says nothing else: metres, degrees, frames
/// (docs/search.md).
const TOLERANCES: [f64; 3] = [0.30, 10.0, 10.0];
/// So much of a joint's velocity is, metres per second.
const TOLERANCE_M_S: f64 = 1.0;
/// Such a share of a style's frames without its tag is.
const TOLERANCE_SHARE: f64 = 0.10;

/// What a constraint costs.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstraintReason {
    /// Which: a constraint, or a meeting.
    pub item: Selectable,
    /// What it is called.
    pub title: String,
    /// When.
    pub frame: usize,
    /// What it asks, in words.
    pub wish: String,
    /// How far off the clips are as they were found; `None` while nobody knows.
    pub before: Option<String>,
    /// How far off the motion is after correction.
    pub after: Option<String>,
    /// What it adds to the score.
    pub cost: f64,
    /// The share of the score, 0 to 1.
    pub share: f64,
}

/// What a cut costs.
#[derive(Clone, Debug, PartialEq)]
pub struct CutReason {
    /// The first frame after it.
    pub frame: usize,
    /// The clip and the frame before it.
    pub from: String,
    /// The clip and the frame after it.
    pub to: String,
    /// What it adds to the score.
    pub cost: f64,
    /// The share of the score, 0 to 1.
    pub share: f64,
    /// Whether it joins what is not alike.
    pub is_bridge: bool,
}

/// What each constraint adds to a take's score, in their order. `weights` are the project's factors of
/// the terms, by their names.
pub fn constraint_reasons(
    take: &TakeCard,
    marks: &[Mark],
    weights: &[(String, f64)],
) -> Vec<ConstraintReason> {
    marks.iter().map(|mark| reason(take, mark, weights)).collect()
}

/// What each meeting adds to the score of a take of its member called `name`, in their order: it
/// counts as a pose of his.
pub fn meeting_reasons<'a>(
    take: &TakeCard,
    meetings: impl Iterator<Item = &'a Interaction>,
    name: &str,
    weights: &[(String, f64)],
) -> Vec<ConstraintReason> {
    let own = |known: &'a Interaction| {
        known.members.iter().find(|member| member.character == name).map(|member| (known, member))
    };
    let of_meeting = |(known, member): (&Interaction, &Member)| ConstraintReason {
        item: Selectable::Interaction(known.id.clone()),
        title: title(known),
        ..reason(take, &as_pose(known, member), weights)
    };
    meetings.filter_map(own).map(of_meeting).collect()
}

/// What a meeting asks of a member.
fn as_pose(meeting: &Interaction, member: &Member) -> Mark {
    let kind = ConstraintKind::Pose {
        frame: meeting.frame,
        clip: member.clip.clone(),
        clip_frame: member.clip_frame,
        position_m: None,
        heading_deg: None,
        height_m: None,
    };
    let (id, weight) = (meeting.id.clone(), meeting.weight);
    Mark {
        at: ConstraintRef::new(CharacterIdx(0), id.clone()),
        index: 0,
        number: 0,
        constraint: Constraint { id, kind, weight, tolerance: None, extra: Default::default() },
        miss: None,
        unknown: Unknown::default(),
    }
}

fn reason(take: &TakeCard, mark: &Mark, weights: &[(String, f64)]) -> ConstraintReason {
    let find = |all: &[ConstraintReport]| {
        all.iter().find(|report| report.constraint == mark.constraint.id).cloned()
    };
    let (before, after) = (find(&take.lane.raw_misses), find(&take.lane.misses));
    let term = term_of(&mark.constraint.kind);
    let factor = weights.iter().find(|(name, _)| name == term).map_or(1.0, |(_, w)| *w);
    let weight = mark.constraint.weight.unwrap_or(1.0) * factor;
    let tolerances = tolerances_of(mark);
    let cost = before.as_ref().map_or(0.0, |report| in_tolerances(report, tolerances)) * weight;
    ConstraintReason {
        item: Selectable::Constraint(mark.at.clone()),
        title: mark.title(),
        frame: mark.frame(),
        wish: wish_of(mark),
        before: before.map(|report| words(mark, &report)),
        after: after.map(|report| words(mark, &report)),
        cost,
        share: share(cost, take.score),
    }
}

/// What each cut adds to a take's score, the most first.
pub fn cut_reasons(take: &TakeCard) -> Vec<CutReason> {
    let lane = &take.lane;
    let sum: f64 = lane.cuts.iter().map(|cut| cut.cost).sum();
    let reason = |(nth, cut): (usize, &crate::take_card::Cut)| {
        let (before, after) = (lane.pieces.get(nth)?, lane.pieces.get(nth + 1)?);
        let cost = if sum > 0.0 { take.terms[0] * cut.cost / sum } else { 0.0 };
        Some(CutReason {
            frame: cut.frame,
            from: format!("{}:{}", before.clip, before.of_clip.1),
            to: format!("{}:{}", after.clip, after.of_clip.0),
            cost,
            share: share(cost, take.score),
            is_bridge: cut.is_bridge,
        })
    };
    let mut reasons: Vec<CutReason> = lane.cuts.iter().enumerate().filter_map(reason).collect();
    reasons.sort_by(|a, b| b.cost.total_cmp(&a.cost));
    reasons
}

/// A cost as one distance that would cost as much, centimetres.
pub fn as_cm(cost: f64) -> f64 {
    100.0 * TOLERANCES[0] * cost.max(0.0).sqrt()
}

fn share(cost: f64, score: f64) -> f64 {
    if score.is_finite() && score > 0.0 { (cost / score).clamp(0.0, 1.0) } else { 0.0 }
}

/// The term of the score that a kind of constraint counts in.
fn term_of(kind: &ConstraintKind) -> &'static str {
    match kind {
        ConstraintKind::Body { .. } | ConstraintKind::Pose { .. } => "body",
        ConstraintKind::Joint { .. } => "joint",
        ConstraintKind::Style { .. } => "style",
        ConstraintKind::Path { .. } => "path",
        ConstraintKind::Lock { .. } => "",
    }
}

/// How far off a constraint says is well.
fn tolerances_of(mark: &Mark) -> [f64; 3] {
    let asked = mark.constraint.tolerance.as_ref();
    let parts = asked.map_or([None; 3], |t| [t.position_m, t.heading_deg, t.frames]);
    let [a, b, c] = TOLERANCES;
    let or = |part: Option<f64>, usual: f64| part.unwrap_or(usual).max(1e-3);
    [or(parts[0], a), or(parts[1], b), or(parts[2], c)]
}

/// The sum of squares in tolerances; of a style the share itself.
fn in_tolerances(report: &ConstraintReport, tolerances: [f64; 3]) -> f64 {
    let frames = report.frame_error.map(|frames| frames as f64);
    let parts = [report.position_error_m, report.heading_error_deg, frames];
    let each = parts.iter().zip(tolerances).map(|(part, one)| (part.unwrap_or(0.0) / one).powi(2));
    let velocity = (report.velocity_error_m_s.unwrap_or(0.0) / TOLERANCE_M_S).powi(2);
    each.sum::<f64>() + velocity + report.share_without.unwrap_or(0.0) / TOLERANCE_SHARE
}

/// How far a motion is off, in words.
fn words(mark: &Mark, report: &ConstraintReport) -> String {
    match (&mark.constraint.kind, report.share_without, report.met) {
        (ConstraintKind::Style { tag, .. }, Some(share), _) if share >= 0.005 => {
            format!("miss {:.0} %: it is not {tag}", 100.0 * share)
        }
        (_, _, Some(false)) => "miss all of it: it is not shown".to_owned(),
        _ => Mark { miss: Some(report.clone()), ..mark.clone() }.miss_text(),
    }
}

fn wish_of(mark: &Mark) -> String {
    match &mark.constraint.kind {
        ConstraintKind::Body { position_m: [x, z], heading_deg, .. } => {
            let heading = heading_deg.map(|deg| format!(", heading {deg:.0}°"));
            format!("be at x {x:.2} m, z {z:.2} m{}", heading.unwrap_or_default())
        }
        ConstraintKind::Joint { joint, position_m: [x, y, z], .. } => {
            format!("have {joint} at x {x:.2} m, y {y:.2} m, z {z:.2} m")
        }
        ConstraintKind::Pose { clip, clip_frame, .. } => {
            format!("be in the pose {clip}:{clip_frame}")
        }
        ConstraintKind::Style { from, to, tag } => format!("move as {tag} from f {from} to f {to}"),
        ConstraintKind::Path { from, to, .. } => format!("follow a path from f {from} to f {to}"),
        ConstraintKind::Lock { from, to, pieces } => {
            let n = pieces.len();
            format!("keep {n} {} from f {from} to f {to}", if n == 1 { "piece" } else { "pieces" })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cost_of_one_is_one_tolerance() {
        let report = |metres, degrees, frames| ConstraintReport {
            position_error_m: Some(metres),
            heading_error_deg: Some(degrees),
            frame_error: Some(frames),
            ..ConstraintReport::default()
        };
        for (metres, degrees, frames, expected) in [
            (0.0, 0.0, 0, 0.0),
            (0.3, 0.0, 0, 1.0),
            (0.0, 10.0, 0, 1.0),
            (0.0, 0.0, -10, 1.0),
            (0.6, 0.0, 0, 4.0),
            (0.3, 10.0, 10, 3.0),
        ] {
            let report = report(metres, degrees, frames);
            assert!((in_tolerances(&report, TOLERANCES) - expected).abs() < 1e-9);
        }
        assert_eq!(in_tolerances(&ConstraintReport::default(), TOLERANCES), 0.0);
        let style = ConstraintReport { share_without: Some(0.2), ..ConstraintReport::default() };
        assert!((in_tolerances(&style, TOLERANCES) - 2.0).abs() < 1e-9, "a share counts as it is");
        assert!((as_cm(1.0) - 30.0).abs() < 1e-9 && (as_cm(4.0) - 60.0).abs() < 1e-9);
        assert_eq!((share(2.0, 8.0), share(1.0, f64::INFINITY), share(1.0, 0.0)), (0.25, 0.0, 0.0));
    }
}
