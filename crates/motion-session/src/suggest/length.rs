//! More frames, or fewer: as many as the speeds that are asked suggest.

use motion_core::constraint::{LengthMode as CoreLengthMode, TOLERANCE_FRAMES};
use motion_io::project_file::{Constraint, ConstraintKind, LengthMode};

use super::candidate::Candidate;
use super::{Case, Change};
use crate::command::Command;
use crate::unmet::missed::Missed;
use crate::unmet::too_fast::top_speed_m_s;

/// Whoever turns, turns about as fast, radians per second: a quarter in a second.
const TURN_RAD_S: f64 = std::f64::consts::FRAC_PI_2;
/// Below this a body stands, metres per second.
const STANDING_M_S: f64 = 0.3;
/// Shares of a stretch that are tried too.
const SHARES: [f64; 2] = [0.1, 0.25];
/// A stretch is made so many times as long at most: beyond that it is another motion.
const MOST_TIMES: i64 = 5;
/// Fewer frames than this are no change worth trying.
const LEAST: i64 = 3;

/// More and fewer frames before each place that is missed, or in all.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    for missed in &case.missed {
        let (stretch, name) = match *missed {
            Missed::Body(nth) if nth > 0 => {
                (stretch_before(case, nth), case.asked.ids.body.get(nth))
            }
            _ => (None, None),
        };
        let n_asked = asked_frames(case);
        let stretch = stretch.unwrap_or(Stretch { from: 0, to: n_asked.saturating_sub(1) });
        let is_last = stretch.to + 1 >= n_asked;
        for more in frames_worth_trying(case, *missed, &stretch) {
            let size = more.unsigned_abs() as f32 / TOLERANCE_FRAMES;
            let n = more.unsigned_abs();
            let what = if more > 0 {
                format!("give it {n} frames more")
            } else {
                format!("give it {n} frames less")
            };
            let words = match name.filter(|_| !is_last) {
                Some(id) => format!("{what} before {id:?}"),
                None => what,
            };
            let about = if is_last { String::new() } else { name.cloned().unwrap_or_default() };
            let commands = shifted(case, stretch.to.min(n_asked.saturating_sub(1)), more);
            candidates.push(Candidate { change: Change::Length, about, words, size, commands });
        }
    }
    candidates
}

/// Frames between two checkpoints.
struct Stretch {
    from: u32,
    to: u32,
}

fn stretch_before(case: &Case<'_>, nth: usize) -> Option<Stretch> {
    let body = &case.wishes().body;
    Some(Stretch { from: body.get(nth.checked_sub(1)?)?.frame, to: body.get(nth)?.frame })
}

/// How many frames are asked for, by the length or else by the last constraint.
fn asked_frames(case: &Case<'_>) -> u32 {
    let length = case.wishes().length.filter(|length| length.mode != CoreLengthMode::Free);
    let last = case.wishes().body.last().map(|last| last.frame + 1);
    length.map(|length| length.frames).or(last).unwrap_or(case.judgement.n_frames)
}

/// Changes of a stretch's length, in frames; below 0 it is shorter.
fn frames_worth_trying(case: &Case<'_>, missed: Missed, stretch: &Stretch) -> Vec<i64> {
    let fps = case.library.clips.fps().get();
    let n_frames = i64::from(stretch.to.saturating_sub(stretch.from));
    let mut changes: Vec<i64> = Vec::new();
    let mut by_secs = |secs: f64| changes.push((secs * fps).ceil() as i64);
    if let Missed::Body(nth) = missed
        && let (Some(error), Some(pair)) =
            (case.judgement.body.get(nth), case.wishes().body.get(nth.saturating_sub(1)..=nth))
        && let [before, wish] = pair
    {
        let asked_m = f64::from(wish.position_m.distance(before.position_m));
        let secs = n_frames as f64 / fps;
        // What the best motion does there, and what the fastest clip could do.
        let (a, b) = (case.torso(stretch.from), case.torso(stretch.to));
        let goes_m_s = f64::from(a.ground_m().distance(b.ground_m())) / secs.max(1.0 / fps);
        let top_m_s = top_speed_m_s(&case.asked.problem.allowed_clips, case.library);
        if error.position_m > wish.tolerance.position_m {
            for speed_m_s in [goes_m_s, top_m_s, 0.8 * top_m_s] {
                if speed_m_s > STANDING_M_S {
                    by_secs(asked_m / speed_m_s - secs);
                }
            }
            by_secs(f64::from(error.position_m) / goes_m_s.max(STANDING_M_S));
        }
        if error.heading_rad > wish.tolerance.heading_rad {
            by_secs(f64::from(error.heading_rad) / TURN_RAD_S);
        }
        if error.frames.unsigned_abs() as f32 > wish.tolerance.frames {
            changes.push(i64::from(error.frames));
        }
    }
    if let Missed::Length = missed {
        changes.push(i64::from(case.judgement.n_frames) - i64::from(asked_frames(case)));
    }
    for share in SHARES {
        let frames = (share * n_frames as f64).round() as i64;
        changes.extend([frames, -frames]);
    }
    let lengths = n_frames / 3..=MOST_TIMES * n_frames;
    changes.retain(|&more| more.abs() >= LEAST && lengths.contains(&(n_frames + more)));
    changes.sort_unstable();
    changes.dedup();
    changes
}

/// Everything from frame `at` on so many frames later, and the whole longer by as many.
fn shifted(case: &Case<'_>, at: u32, more: i64) -> Vec<Command> {
    let Some(character) = case.document.character(case.character) else { return Vec::new() };
    let moved = |frame: u32| u32::try_from(i64::from(frame) + more).unwrap_or_default();
    let mut constraints: Vec<&Constraint> = character.constraints.iter().collect();
    constraints.sort_by_key(|constraint| constraint.kind.last_frame());
    if more > 0 {
        // The last first, so that none comes upon one that is still there.
        constraints.reverse();
    }
    let command =
        |constraint: &&Constraint| {
            let to_be = case.at(&constraint.id);
            match constraint.kind {
                ConstraintKind::Body { frame, .. }
                | ConstraintKind::Joint { frame, .. }
                | ConstraintKind::Pose { frame, .. } => {
                    (frame >= at).then(|| Command::Retime { at: to_be, frame: moved(frame) })
                }
                ConstraintKind::Lock { from, to, .. } => (from >= at)
                    .then(|| Command::RetimeSpan { at: to_be, from: moved(from), to: moved(to) }),
                ConstraintKind::Style { from, to, .. } | ConstraintKind::Path { from, to, .. } => {
                    let from = if from >= at { moved(from) } else { from };
                    let to_then = moved(to).max(from);
                    (to >= at).then(|| Command::RetimeSpan { at: to_be, from, to: to_then })
                }
            }
        };
    let retimed = constraints.iter().filter_map(command);
    let length = character.length.as_ref().filter(|length| length.mode != LengthMode::Free);
    let longer = length.and_then(|length| {
        Some(Command::SetLength {
            character: case.character,
            frames: Some(moved(length.frames?)),
            mode: length.mode,
        })
    });
    if more > 0 {
        longer.into_iter().chain(retimed).collect()
    } else {
        retimed.chain(longer).collect()
    }
}
