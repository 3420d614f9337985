//! Feet that stand still: every planted foot is held at one place by two-bone IK.
//!
//! Plants are carried from the clips. Displacements at seams and corrections towards targets drag
//! planted feet along; here each plant is given one place, and the leg is bent so that the toe
//! joint stays there. Between plants the shift fades out smoothly. The root is not touched, so
//! body targets stay met; poses at hard frames are not touched either.

use std::ops::Range;

use glam::Vec3;

use super::leg::{Leg, LegPose};
use super::place::Placed;
use super::plants::plants;
use crate::contacts::{Side, percentile};
use crate::floor::Soles;
use crate::skeleton::Skeleton;
use crate::support_level::smoothed;

/// What is done about feet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FootPolicy {
    /// Nothing: feet are where seams and corrections left them (the paper).
    Free,
    /// Planted feet are held and kept out of the floor.
    #[default]
    Locked,
}

/// A lock's shift fades in and out over this time, seconds.
const FADE_SECS: f64 = 0.25;
/// The most that a lock moves a foot along the ground or upwards, metres; approached smoothly. A
/// foot that has to go farther slides: better than a leg that is pulled out of its step.
const MAX_SHIFT_M: f32 = 0.15;
/// How deep a swinging toe may dip below the floor at most, metres; approached smoothly.
const MAX_DIP_M: f32 = 0.01;
/// A support whose level changes by less than this over a plant is one floor, metres.
const FLAT_M: f32 = 0.01;
/// A support whose level changes by this much more than [`FLAT_M`] nearby has no floor to speak
/// of, metres.
const UNEVEN_M: f32 = 0.10;
/// Shifts below this are not worth a knee, metres.
const NEGLIGIBLE_M: f32 = 2e-5;

/// Holds the planted feet of `placed` in place. `hard` frames (sorted) keep their poses.
pub fn lock_feet(
    skeleton: &Skeleton,
    legs: &[Option<Leg>; 2],
    soles: Soles,
    placed: &mut Placed,
    hard: &[usize],
) {
    for side in Side::BOTH {
        let Some(leg) = &legs[side.idx()] else { continue };
        let n_frames = placed.motion.n_frames();
        let poses: Vec<LegPose> =
            (0..n_frames).map(|frame| leg.pose(skeleton, &placed.motion, frame)).collect();
        let shifts_m = shifts_m(placed, &poses, side, soles.height_m[side.idx()], hard);
        for (frame, (pose, shift_m)) in poses.iter().zip(shifts_m).enumerate() {
            if shift_m.length_squared() > NEGLIGIBLE_M * NEGLIGIBLE_M {
                leg.shift_toe(&mut placed.motion, frame, pose, shift_m);
            }
        }
    }
}

/// How far the toe joint is moved in every frame, metres.
fn shifts_m(
    placed: &Placed,
    poses: &[LegPose],
    side: Side,
    sole_m: f32,
    hard: &[usize],
) -> Vec<Vec3> {
    let n_frames = poses.len();
    let fps = placed.motion.fps();
    let fade = fps.frames_in_secs(FADE_SECS).max(1);
    let path_m: Vec<Vec3> = poses.iter().map(|pose| pose.toe_m).collect();
    let plants = plants(&placed.contacts, side, &path_m, fps);
    let mut shifts = vec![Vec3::ZERO; n_frames];
    for plant in &plants {
        let place_m = place_of(placed, poses, plant.clone(), sole_m);
        for frame in plant.clone() {
            shifts[frame] = limited(place_m - poses[frame].toe_m);
        }
    }
    let mut previous_end = 0;
    let gap_ends = plants.iter().map(|plant| (plant.start, plant.end));
    for (start, end) in gap_ends.chain([(n_frames, n_frames)]) {
        fade_gap(&mut shifts, previous_end..start, fade);
        previous_end = end;
    }
    let floors = floor_weights(&placed.levels_m, &plants, fade);
    for (frame, shift) in shifts.iter_mut().enumerate() {
        let height_m = poses[frame].toe_m.y + shift.y - placed.levels_m[frame] - sole_m;
        shift.y += floors[frame] * (out_of_floor_m(height_m) - height_m);
        *shift *= away_from(hard, frame, fade);
    }
    shifts
}

/// Where a plant's toe joint is held: the mean of its places on the ground; on a flat floor at
/// the sole's height above it, elsewhere (a level on its way between steps) at its own height.
fn place_of(placed: &Placed, poses: &[LegPose], plant: Range<usize>, sole_m: f32) -> Vec3 {
    let sum: Vec3 = poses[plant.clone()].iter().map(|pose| pose.toe_m).sum();
    let mut place_m = sum / plant.len() as f32;
    let levels = &placed.levels_m[plant.clone()];
    place_m.y = if is_flat(levels) {
        let (lowest, highest) = extent(levels);
        0.5 * (lowest + highest) + sole_m
    } else {
        let mut heights: Vec<f32> = poses[plant].iter().map(|pose| pose.toe_m.y).collect();
        percentile(&mut heights, 0.5)
    };
    place_m
}

/// `shift` no longer than [`MAX_SHIFT_M`]; short ones as they are to second order.
fn limited(shift: Vec3) -> Vec3 {
    let length = shift.length();
    if length < 1e-6 {
        return shift;
    }
    shift * (MAX_SHIFT_M * (length / MAX_SHIFT_M).tanh() / length)
}

/// Fills the shifts between two plants: each neighbour's shift fades out from its value and
/// slope to nothing over `fade` frames, or over the gap where that is shorter. A gap at either
/// end of the motion has one neighbour and need not come to nothing.
fn fade_gap(shifts: &mut [Vec3], gap: Range<usize>, fade: usize) {
    if gap.is_empty() {
        return;
    }
    let n_frames = shifts.len();
    let at_an_end = gap.start == 0 || gap.end == n_frames;
    let span = if at_an_end { fade } else { fade.min(gap.len() + 1) };
    let slope = |at: usize, inner: Option<usize>| match inner {
        // A plant of one frame, or one that touches another, has no slope of its own.
        Some(inner) if inner < n_frames => shifts[at] - shifts[inner],
        _ => Vec3::ZERO,
    };
    let mut filled = vec![Vec3::ZERO; gap.len()];
    if let Some(last) = gap.start.checked_sub(1) {
        let (value, slope) = (shifts[last], slope(last, last.checked_sub(1)));
        for (idx, fill) in filled.iter_mut().enumerate().take(span) {
            *fill += faded(value, slope, idx + 1, span);
        }
    }
    if gap.end < n_frames {
        let (value, slope) = (shifts[gap.end], slope(gap.end, Some(gap.end + 1)));
        for (idx, fill) in filled.iter_mut().rev().enumerate().take(span) {
            *fill += faded(value, slope, idx + 1, span);
        }
    }
    shifts[gap].copy_from_slice(&filled);
}

/// The cubic from `value` with `slope` per frame at 0 to nothing at `span` frames.
fn faded(value: Vec3, slope: Vec3, frames: usize, span: usize) -> Vec3 {
    let t = frames as f32 / span as f32;
    let left = 1.0 - t;
    value * (left * left * (1.0 + 2.0 * t)) + slope * (frames as f32 * left * left)
}

/// `height_m` above the floor, brought up where it is below: heights above 0 are kept, below it
/// they approach −[`MAX_DIP_M`], without a kink.
fn out_of_floor_m(height_m: f32) -> f32 {
    if height_m >= 0.0 { height_m } else { -MAX_DIP_M * (1.0 - (height_m / MAX_DIP_M).exp()) }
}

/// How much of a floor there is under each frame for a toe to dip into: 1 where the support is
/// even for `reach` frames either way, 0 where it passes from step to step and in plants on such
/// ground, smooth in between.
fn floor_weights(levels_m: &[f32], plants: &[Range<usize>], reach: usize) -> Vec<f32> {
    let last = levels_m.len() - 1;
    let mut weights: Vec<f32> = (0..levels_m.len())
        .map(|frame| {
            let here = levels_m[frame];
            let rise_m = [frame.saturating_sub(reach), (frame + reach).min(last)]
                .into_iter()
                .map(|other| (levels_m[other] - here).abs())
                .fold(0.0, f32::max);
            (1.0 - (rise_m - FLAT_M) / UNEVEN_M).clamp(0.0, 1.0)
        })
        .collect();
    if weights.iter().all(|&weight| weight == 1.0) {
        return weights;
    }
    for plant in plants.iter().filter(|plant| !is_flat(&levels_m[(*plant).clone()])) {
        weights[plant.clone()].fill(0.0);
    }
    smoothed(&weights, reach / 2)
}

/// Whether a plant with these levels stands on one floor.
fn is_flat(levels_m: &[f32]) -> bool {
    let (lowest, highest) = extent(levels_m);
    highest - lowest < FLAT_M
}

fn extent(levels_m: &[f32]) -> (f32, f32) {
    let start = (f32::INFINITY, f32::NEG_INFINITY);
    levels_m.iter().fold(start, |(lowest, highest), &l| (lowest.min(l), highest.max(l)))
}

/// 0 at the frames of `hard`, 1 from `reach` frames off, smooth in between.
fn away_from(hard: &[usize], frame: usize, reach: usize) -> f32 {
    let next = hard.partition_point(|&other| other < frame);
    let before = next.checked_sub(1).map(|idx| frame - hard[idx]);
    let after = hard.get(next).map(|&other| other - frame);
    let nearest = before.into_iter().chain(after).min().unwrap_or(usize::MAX);
    let t = (nearest as f32 / reach as f32).min(1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::assemble::Piece;
    use crate::assemble::place::place;
    use crate::assemble::seam::{SeamPolicy, smooth_seams};
    use crate::floor::soles_of;
    use crate::planar::PlanarTransform;
    use crate::rotation::angle_between_rad;
    use crate::testing::{legs, piece, walks};

    fn smoothed(pieces: &[Piece]) -> Placed {
        let set = walks();
        let mut placed = place(&set, pieces, PlanarTransform::IDENTITY).expect("valid");
        smooth_seams(&set, pieces, &mut placed, &[], SeamPolicy::VelocityMatched);
        placed
    }

    fn locked(placed: &Placed, hard: &[usize]) -> Placed {
        let (set, skeleton) = (walks(), legs());
        let soles = soles_of(&skeleton, set.clips().iter().map(|c| (&c.motion, &c.track)));
        let both = Side::BOTH.map(|side| Leg::new(&skeleton, side));
        let mut locked = placed.clone();
        lock_feet(&skeleton, &both, soles, &mut locked, hard);
        locked
    }

    /// Mean speed along the ground of planted toe joints, m/s.
    fn slide_m_s(placed: &Placed) -> f32 {
        let skeleton = legs();
        let (mut sum, mut n) = (0.0, 0);
        for side in Side::BOTH {
            let leg = Leg::new(&skeleton, side).expect("a leg");
            let toe = |frame: usize| leg.pose(&skeleton, &placed.motion, frame).toe_m;
            for frame in 1..placed.motion.n_frames() {
                if placed.contacts[frame].side(side) && placed.contacts[frame - 1].side(side) {
                    let way = toe(frame) - toe(frame - 1);
                    sum += way.x.hypot(way.z) * 30.0;
                    n += 1;
                }
            }
        }
        sum / n as f32
    }

    #[test]
    fn feet_that_stand_already_are_left_alone() {
        let placed = smoothed(&[piece(0, 0, 59)]);
        let locked = locked(&placed, &[]);
        for frame in 0..60 {
            for (a, b) in placed.motion.rotations(frame).iter().zip(locked.motion.rotations(frame))
            {
                assert!(angle_between_rad(*a, *b) < 0.03, "frame {frame}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn planted_feet_stop_sliding(a in 15u32..50, off in 0u32..5) {
            // Clip 1 is 6 frames ahead of clip 0 in a cycle of 30: a cut about in phase.
            let b = (a + 1 + 22 + off) % 30 + 2;
            let placed = smoothed(&[piece(0, 0, a), piece(1, b, 59)]);
            let locked = locked(&placed, &[]);
            let (before, after) = (slide_m_s(&placed), slide_m_s(&locked));
            prop_assert!(after < 0.2 * before + 0.01, "{before} became {after} m/s");
            prop_assert_eq!(placed.motion.root_positions_m(), locked.motion.root_positions_m());
        }

        #[test]
        fn hard_frames_keep_their_poses(a in 15u32..50, b in 5u32..40, hard in 0usize..60) {
            let placed = smoothed(&[piece(0, 0, a), piece(1, b, 59)]);
            let hard = hard.min(placed.motion.n_frames() - 1);
            let locked = locked(&placed, &[hard]);
            prop_assert_eq!(placed.motion.rotations(hard), locked.motion.rotations(hard));
        }

        #[test]
        fn fades_go_on_at_the_value_and_slope_they_start_from(
            value in -0.1f32..0.1, slope in -0.01f32..0.01, span in 2usize..20,
        ) {
            let (value, slope) = (Vec3::X * value, Vec3::X * slope);
            prop_assert_eq!(faded(value, slope, 0, span), value);
            prop_assert!(faded(value, slope, span, span).length() < 1e-7);
        }
    }

    #[test]
    fn the_dip_below_the_floor_is_bounded_without_a_kink() {
        assert_eq!(out_of_floor_m(0.02), 0.02);
        assert!(out_of_floor_m(-1.0) >= -MAX_DIP_M);
        let slope = (out_of_floor_m(0.0) - out_of_floor_m(-1e-5)) / 1e-5;
        assert!((slope - 1.0).abs() < 1e-2, "{slope}");
    }

    #[test]
    fn bodies_without_feet_are_left_alone() {
        let placed = smoothed(&[piece(0, 0, 20), piece(1, 20, 40)]);
        let mut free = placed.clone();
        lock_feet(&legs(), &[None, None], Soles::default(), &mut free, &[]);
        assert_eq!(placed, free);
    }
}
