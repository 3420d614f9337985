//! Sentences for a person on what could not be met, and why.

pub(crate) mod missed;
pub(crate) mod too_fast;

use motion_core::constraint::joint::TOLERANCE_M_S;
use motion_core::constraint::obstacle::BODY_MARGIN_M;
use motion_core::constraint::{BodyError, LengthWish, Tolerance};
use motion_core::score::Judgement;

use crate::Library;
use crate::problem::CharacterProblem;
use crate::solve_job::Found;
use missed::{Missed, missed};
use too_fast::infeasible;

/// What the best motion found misses by more than a tolerance, then what is odd in what is asked.
pub fn unmet(character: &CharacterProblem, library: &Library, found: &Found) -> Vec<String> {
    let mut sentences = Vec::new();
    if let Some(best) = found.alternatives.first() {
        let judgement = &best.judgement;
        let missed = missed(&character.problem.wishes, judgement);
        sentences.extend(missed.iter().filter_map(|missed| {
            Some(format!("{} before it is corrected", sentence(character, judgement, *missed)?))
        }));
    } else {
        sentences.push(
            "no motion was found: search longer, allow more clips, or ask for another length"
                .to_owned(),
        );
    }
    if !sentences.is_empty() {
        sentences.extend(infeasible(character, library));
    }
    sentences.extend(character.remarks.iter().cloned());
    sentences
}

/// How a wish is missed; `None` only for a wish that there is not.
fn sentence(character: &CharacterProblem, judgement: &Judgement, missed: Missed) -> Option<String> {
    let (wishes, ids) = (&character.problem.wishes, &character.ids);
    let found = "the best motion found";
    Some(match missed {
        Missed::Body(nth) => {
            let parts = place_parts(judgement.body.get(nth)?, &wishes.body.get(nth)?.tolerance);
            format!("body constraint {:?}: {found} ends up {parts}", ids.body.get(nth)?)
        }
        Missed::Joint(nth) => {
            let (wish, error) = (wishes.joints.get(nth)?, judgement.joints.get(nth)?);
            let mut parts = Vec::new();
            if error.position_m > wish.tolerance_m {
                parts.push(format!("{:.2} m away", error.position_m));
            }
            if error.velocity_m_s > TOLERANCE_M_S {
                parts.push(format!("{:.1} m/s off its velocity", error.velocity_m_s));
            }
            let id = ids.joints.get(nth)?;
            format!("joint constraint {id:?}: in {found} the joint is {}", parts.join(", "))
        }
        Missed::Pose(nth) => {
            let (is_met, place) = judgement.poses.get(nth)?;
            let id = ids.poses.get(nth)?;
            if *is_met {
                let parts = place_parts(place, &wishes.poses.get(nth)?.tolerance);
                format!("pose constraint {id:?}: {found} takes the pose {parts}")
            } else {
                format!("pose constraint {id:?}: {found} does not show it")
            }
        }
        Missed::Lock(nth) => {
            format!("lock constraint {:?}: {found} does not show it", ids.locks.get(nth)?)
        }
        Missed::Style(nth) => {
            let (wish, share) = (wishes.styles.get(nth)?, judgement.styles.get(nth)?);
            let id = ids.styles.get(nth)?;
            let percent = 100.0 * share;
            format!(
                "style constraint {id:?}: in {found} {percent:.0} % of the frames are not {:?}",
                wish.tag
            )
        }
        Missed::Follow(nth) => {
            let (wish, error) = (wishes.follows.get(nth)?, judgement.follows.get(nth)?);
            let mut parts = vec![format!("{:.2} m", error.position_m)];
            if wish.looks_along && error.heading_rad > wish.tolerance_rad {
                parts.push(format!("{:.0}°", error.heading_rad.to_degrees()));
            }
            let id = ids.follows.get(nth)?;
            format!(
                "path constraint {id:?}: {found} is off by {} (root mean square)",
                parts.join(" and ")
            )
        }
        Missed::Obstacles => {
            let deep_m = judgement.deepest_m - BODY_MARGIN_M;
            format!("{found} goes {deep_m:.2} m into an obstacle")
        }
        Missed::Others => {
            format!("{found} comes {:.2} m too near to another character", judgement.too_near_m)
        }
        Missed::Length => {
            let LengthWish { frames, .. } = wishes.length?;
            format!("{found} has {} frames instead of {frames}", judgement.n_frames)
        }
    })
}

/// The parts of a place that are off by more than `tolerance`.
fn place_parts(error: &BodyError, tolerance: &Tolerance) -> String {
    let mut parts = Vec::new();
    if error.position_m > tolerance.position_m {
        parts.push(format!("{:.2} m away", error.position_m));
    }
    if error.heading_rad > tolerance.heading_rad {
        parts.push(format!("turned by {:.0}°", error.heading_rad.to_degrees()));
    }
    if error.height_m.abs() > tolerance.position_m {
        parts.push(format!("{:.2} m too high or low", error.height_m.abs()));
    }
    if error.frames.unsigned_abs() as f32 > tolerance.frames {
        let when = if error.frames > 0 { "late" } else { "early" };
        parts.push(format!("{} frames {when}", error.frames.abs()));
    }
    parts.join(", ")
}
