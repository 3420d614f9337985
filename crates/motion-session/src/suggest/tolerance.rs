//! More may be missed: as much as the best motion does.

use motion_io::project_file::Tolerance;

use super::candidate::Candidate;
use super::{Case, Change};
use crate::command::Command;
use crate::unmet::missed::Missed;

/// New tolerances are multiples of this, metres.
const STEP_M: f64 = 0.05;
/// New tolerances are multiples of this, degrees.
const STEP_DEG: f64 = 5.0;
/// New tolerances are multiples of this, frames.
const STEP_FRAMES: f64 = 5.0;

/// What is missed is taken for so much more: with a wider tolerance the best motion is another one.
const SLACK: f64 = 1.5;

/// How much is missed of one part, and how much may be.
#[derive(Clone, Copy, Debug)]
struct Part {
    is: f32,
    may_be: f32,
}

impl Part {
    /// The tolerance that would do, if this one does not.
    fn widened(self, step: f64) -> Option<f64> {
        let is_missed = self.is > self.may_be && self.may_be.is_finite();
        is_missed.then(|| (SLACK * f64::from(self.is) / step).ceil() * step)
    }
}

/// The tolerances of what is missed widened until it is not any more.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let (wishes, ids, judged) = (case.wishes(), &case.asked.ids, case.judgement);
    let part = |is: f32, may_be: f32| Part { is, may_be };
    let nothing = part(0.0, f32::INFINITY);
    let of_missed = |missed: &Missed| match *missed {
        Missed::Body(nth) => {
            let (t, e) = (wishes.body.get(nth)?.tolerance, judged.body.get(nth)?);
            let metres = part(e.position_m.max(e.height_m.abs()), t.position_m);
            let degrees = part(e.heading_rad.to_degrees(), t.heading_rad.to_degrees());
            let frames = part(e.frames.unsigned_abs() as f32, t.frames);
            widened(case, ids.body.get(nth)?, metres, degrees, frames)
        }
        Missed::Pose(nth) => {
            let (t, (_, e)) = (wishes.poses.get(nth)?.tolerance, judged.poses.get(nth)?);
            let metres = part(e.position_m.max(e.height_m.abs()), t.position_m);
            let degrees = part(e.heading_rad.to_degrees(), t.heading_rad.to_degrees());
            widened(case, ids.poses.get(nth)?, metres, degrees, nothing)
        }
        Missed::Joint(nth) => {
            let metres =
                part(judged.joints.get(nth)?.position_m, wishes.joints.get(nth)?.tolerance_m);
            widened(case, ids.joints.get(nth)?, metres, nothing, nothing)
        }
        Missed::Follow(nth) => {
            let (wish, e) = (wishes.follows.get(nth)?, judged.follows.get(nth)?);
            let metres = part(e.position_m, wish.tolerance_m);
            let degrees = part(e.heading_rad.to_degrees(), wish.tolerance_rad.to_degrees());
            let degrees = if wish.looks_along { degrees } else { nothing };
            widened(case, ids.follows.get(nth)?, metres, degrees, nothing)
        }
        _ => None,
    };
    case.missed.iter().filter_map(of_missed).collect()
}

fn widened(
    case: &Case<'_>,
    id: &str,
    metres: Part,
    degrees: Part,
    frames: Part,
) -> Option<Candidate> {
    let to_m = metres.widened(STEP_M);
    let to_deg = degrees.widened(STEP_DEG);
    let to_frames = frames.widened(STEP_FRAMES);
    let words: Vec<String> = [
        to_m.map(|m| format!("{m:.2} m")),
        to_deg.map(|deg| format!("{deg:.0}°")),
        to_frames.map(|frames| format!("{frames:.0} frames")),
    ]
    .into_iter()
    .flatten()
    .collect();
    if words.is_empty() {
        return None;
    }
    let wider = |new: Option<f64>, old: Part| new.map_or(0.0, |new| new as f32 / old.may_be - 1.0);
    let constraint = case.document.constraint(&case.at(id))?;
    let old = constraint.tolerance.clone().unwrap_or_default();
    let tolerance = Tolerance {
        position_m: to_m.map(hundredths).or(old.position_m),
        heading_deg: to_deg.or(old.heading_deg),
        frames: to_frames.or(old.frames),
        extra: old.extra,
    };
    Some(Candidate {
        change: Change::Tolerance,
        about: id.to_owned(),
        words: format!("let {id:?} be {} off", words.join(" and ")),
        size: wider(to_m, metres) + wider(to_deg, degrees) + wider(to_frames, frames),
        commands: vec![Command::SetTolerance { at: case.at(id), tolerance: Some(tolerance) }],
    })
}

/// As people write it.
fn hundredths(m: f64) -> f64 {
    (100.0 * m).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missed_is_rounded_up() {
        let part = |is, may_be| Part { is, may_be };
        assert_eq!(part(0.2, 0.3).widened(STEP_M), None);
        assert_eq!(part(5.0, f32::INFINITY).widened(STEP_M), None, "nothing is asked");
        let wide = part(0.41, 0.3).widened(STEP_M).expect("it is missed");
        assert!((wide - 0.65).abs() < 1e-9, "{wide}");
        assert_eq!(part(21.0, 10.0).widened(STEP_DEG), Some(35.0));
    }
}
