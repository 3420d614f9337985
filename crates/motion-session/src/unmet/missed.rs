//! Which wishes a motion misses by more than a tolerance.

use motion_core::constraint::clearance::CLEARANCE_LIMIT_M;
use motion_core::constraint::obstacle::OBSTACLE_TOLERANCE_M;
use motion_core::constraint::style::TOLERANCE_SHARE;
use motion_core::constraint::{LengthMode, LengthWish};
use motion_core::score::{Judgement, Wishes};

/// A wish, by its number among those of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Missed {
    /// A body constraint.
    Body(usize),
    /// A joint constraint.
    Joint(usize),
    /// A pose, or its place.
    Pose(usize),
    /// A locked stretch.
    Lock(usize),
    /// A style.
    Style(usize),
    /// A followed curve.
    Follow(usize),
    /// What is in the way.
    Obstacles,
    /// Another character.
    Others,
    /// The length.
    Length,
}

/// The wishes that are missed by more than a tolerance before correction; none where the motion is
/// acceptable.
pub(crate) fn missed(wishes: &Wishes, judgement: &Judgement) -> Vec<Missed> {
    let mut missed = Vec::new();
    for (nth, (wish, error)) in wishes.body.iter().zip(&judgement.body).enumerate() {
        if !error.is_within(&wish.tolerance) {
            missed.push(Missed::Body(nth));
        }
    }
    for (nth, (wish, &error)) in wishes.joints.iter().zip(&judgement.joints).enumerate() {
        if !wish.is_within_tolerance(error) {
            missed.push(Missed::Joint(nth));
        }
    }
    for (nth, (wish, (is_met, place))) in wishes.poses.iter().zip(&judgement.poses).enumerate() {
        if !is_met || !place.is_within(&wish.tolerance) {
            missed.push(Missed::Pose(nth));
        }
    }
    let locks = judgement.locks.iter().enumerate().filter(|(_, is_met)| !**is_met);
    missed.extend(locks.map(|(nth, _)| Missed::Lock(nth)));
    let styles = judgement.styles.iter().enumerate();
    let is_lacking = |share: f32| share > TOLERANCE_SHARE + 1e-6;
    missed.extend(styles.filter(|(_, share)| is_lacking(**share)).map(|(n, _)| Missed::Style(n)));
    for (nth, (wish, &error)) in wishes.follows.iter().zip(&judgement.follows).enumerate() {
        if !wish.is_within_tolerance(error) {
            missed.push(Missed::Follow(nth));
        }
    }
    if judgement.deepest_m > OBSTACLE_TOLERANCE_M {
        missed.push(Missed::Obstacles);
    }
    if judgement.too_near_m > CLEARANCE_LIMIT_M {
        missed.push(Missed::Others);
    }
    let length = wishes.length.filter(|length| length.mode != LengthMode::Free);
    let cost = |wish| LengthWish { weight: 1.0, ..wish }.cost(judgement.n_frames);
    if length.is_some_and(|wish| cost(wish) > 1.0) {
        missed.push(Missed::Length);
    }
    missed
}
