//! Something elsewhere: where the best motion has it.

use motion_core::constraint::{BodyConstraint, BodyError, TOLERANCE_M, TOLERANCE_RAD};
use motion_core::planar::PlanarTransform;

use super::candidate::Candidate;
use super::{Case, Change};
use crate::command::Command;
use crate::finish::read_at;
use crate::unmet::missed::Missed;

/// Checkpoints, placed poses and joint targets moved and turned by what they are missed by.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let (wishes, ids) = (case.wishes(), &case.asked.ids);
    let of_missed = |missed: &Missed| match *missed {
        Missed::Body(nth) => {
            let frame = read_at(wishes, nth, case.judgement.n_frames);
            let error = case.judgement.body.get(nth)?;
            placed(case, ids.body.get(nth)?, wishes.body.get(nth)?, error, case.torso(frame))
        }
        Missed::Pose(nth) => {
            let place = wishes.poses.get(nth)?.place()?;
            let (_, error) = case.judgement.poses.get(nth)?;
            placed(case, ids.poses.get(nth)?, &place, error, case.torso(place.frame))
        }
        Missed::Joint(nth) => {
            let (wish, id) = (wishes.joints.get(nth)?, ids.joints.get(nth)?);
            let is_m = case.joint_m(wish.joint, wish.frame)?;
            let away_m = is_m.distance(wish.position_m);
            if away_m <= wish.tolerance_m {
                return None;
            }
            let position_m = is_m.to_array().map(|m| rounded(m, 0.01));
            Some(Candidate {
                change: Change::Place,
                about: id.clone(),
                words: format!("move the target {id:?} by {away_m:.2} m"),
                size: away_m / TOLERANCE_M,
                commands: vec![Command::MoveJointTarget { at: case.at(id), position_m }],
            })
        }
        _ => None,
    };
    case.missed.iter().filter_map(of_missed).collect()
}

fn placed(
    case: &Case<'_>,
    id: &str,
    wish: &BodyConstraint,
    error: &BodyError,
    is: PlanarTransform,
) -> Option<Candidate> {
    let (mut words, mut size, mut commands) = (Vec::new(), 0.0, Vec::new());
    if error.position_m > wish.tolerance.position_m {
        words.push(format!("move {id:?} by {:.2} m", error.position_m));
        size += error.position_m / TOLERANCE_M;
        let position_m = is.ground_m().to_array().map(|m| rounded(m, 0.01));
        commands.push(Command::Move { at: case.at(id), position_m });
    }
    if error.heading_rad > wish.tolerance.heading_rad {
        let what = if words.is_empty() { format!("{id:?}") } else { "it".to_owned() };
        words.push(format!("turn {what} by {:.0}°", error.heading_rad.to_degrees()));
        size += error.heading_rad / TOLERANCE_RAD;
        let heading_deg = Some(rounded(is.heading_rad().to_degrees(), 1.0));
        commands.push(Command::Turn { at: case.at(id), heading_deg });
    }
    (!commands.is_empty()).then(|| Candidate {
        change: Change::Place,
        about: id.to_owned(),
        words: words.join(" and "),
        size,
        commands,
    })
}

/// The multiple of `step` next to `value`, as people write it.
fn rounded(value: f32, step: f64) -> f64 {
    let per_one = 1.0 / step;
    (f64::from(value) * per_one).round() / per_one
}
