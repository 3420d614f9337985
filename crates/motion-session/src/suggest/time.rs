//! Something earlier or later: when the best motion is there.

use motion_core::constraint::TOLERANCE_FRAMES;

use super::candidate::{Candidate, later};
use super::{Case, Change};
use crate::command::Command;
use crate::finish::read_at;
use crate::unmet::missed::Missed;

/// So much of its tolerance may be used up by what is met at another time: the rest is for the search.
const SHARE: f32 = 0.8;

/// Checkpoints and joint targets at the frame next to theirs at which the best motion meets them.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let (wishes, ids) = (case.wishes(), &case.asked.ids);
    let of_missed = |missed: &Missed| match *missed {
        Missed::Body(nth) => {
            let (wish, id) = (wishes.body.get(nth)?, ids.body.get(nth)?);
            let own = read_at(wishes, nth, case.judgement.n_frames);
            if own != wish.frame {
                // The last one: when the motion ends.
                return retimed(case, id, wish.frame, own);
            }
            let after = wishes.body.get(nth.checked_sub(1)?)?.frame;
            let before = wishes.body.get(nth + 1)?.frame;
            let near = |frame: u32| {
                let error = wish.error(case.torso(frame), 0);
                error.position_m <= SHARE * wish.tolerance.position_m
                    && error.heading_rad <= SHARE * wish.tolerance.heading_rad
            };
            let frame = nearest(wish.frame, (after + 1, before), near)?;
            retimed(case, id, wish.frame, frame)
        }
        Missed::Joint(nth) => {
            let (wish, id) = (wishes.joints.get(nth)?, ids.joints.get(nth)?);
            let near = |frame: u32| {
                let away_m = case.joint_m(wish.joint, frame).map(|m| m.distance(wish.position_m));
                away_m.is_some_and(|away_m| away_m <= SHARE * wish.tolerance_m)
            };
            let frame = nearest(wish.frame, (0, case.judgement.n_frames), near)?;
            retimed(case, id, wish.frame, frame)
        }
        _ => None,
    };
    case.missed.iter().filter_map(of_missed).collect()
}

/// The frame next to `own` within `from..to` at which `is_well`.
fn nearest(own: u32, (from, to): (u32, u32), is_well: impl Fn(u32) -> bool) -> Option<u32> {
    (from..to).filter(|&frame| is_well(frame)).min_by_key(|frame| frame.abs_diff(own))
}

fn retimed(case: &Case<'_>, id: &str, own: u32, frame: u32) -> Option<Candidate> {
    let frames = i64::from(frame) - i64::from(own);
    (frames != 0).then(|| Candidate {
        change: Change::Time,
        about: id.to_owned(),
        words: format!("have {id:?} {}", later(frames)),
        size: frames.unsigned_abs() as f32 / TOLERANCE_FRAMES,
        commands: vec![Command::Retime { at: case.at(id), frame }],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_frame_within_bounds() {
        let is_well = |frame: u32| [3, 12, 40].contains(&frame);
        assert_eq!(nearest(10, (0, 100), is_well), Some(12));
        assert_eq!(nearest(10, (0, 12), is_well), Some(3));
        assert_eq!(nearest(10, (13, 40), is_well), None);
    }
}
