//! Random problems that a body like that of the clips can be expected to meet.
//!
//! A **leg** leads from a checkpoint to the next. How far a body gets on it, and how it is turned
//! then, is taken from the clips: stretches of one to three seconds, each from a random frame of a
//! random clip, are laid end to end, whether or not they could be cut together, until the leg's time is
//! full. So legs have the speeds and turns of the data, a boxer's as often as a runner's. No such walk
//! is a solution, and the goal is not where it ends: the way is shortened to 70–100 % and turned by
//! up to 15° to either side, the turn taken to 70–100 % too. Nothing is asked of the graph or of any
//! search, so that a problem may be beyond both.

use glam::Vec2;
use motion_core::clip::ClipSet;
use motion_core::constraint::{BodyConstraint, LengthMode, LengthWish, Tolerance};
use motion_core::ids::ClipId;
use motion_core::planar::PlanarTransform;
use motion_core::score::Wishes;
use motion_core::search::Problem;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Seconds of a leg.
const LEG_S: std::ops::Range<f64> = 2.0..5.0;

/// Seconds of a stretch.
const STRETCH_S: std::ops::Range<f64> = 1.0..3.0;

/// Shares of way and turn that are asked for.
const SHARE: std::ops::RangeInclusive<f32> = 0.7..=1.0;

/// The way is turned by up to this to either side, radians.
const ASIDE_RAD: f32 = 0.26;

/// Clips drawn before a leg stands still: a set of nothing but very short clips.
const MAX_DRAWS: usize = 1000;

/// The `nth` problem: two to four checkpoints, the first at the origin.
pub fn random_problem(clips: &ClipSet, nth: u64) -> Problem {
    let mut rng = Pcg64Mcg::seed_from_u64(nth);
    let fps = clips.fps().get();
    let mut at = PlanarTransform::IDENTITY;
    let mut frame = 0;
    let mut body = vec![checkpoint(frame, at)];
    for _ in 0..rng.random_range(1..=3) {
        let n_frames = (rng.random_range(LEG_S) * fps) as u32;
        let walked = walk(clips, n_frames, &mut rng);
        let aside_rad = rng.random_range(-ASIDE_RAD..=ASIDE_RAD);
        let way_m = walked.ground_m() * rng.random_range(SHARE);
        let way_m = PlanarTransform::new(aside_rad, Vec2::ZERO, 0.0).turn_ground(way_m);
        let turn_rad = walked.heading_rad() * rng.random_range(SHARE);
        at = at * PlanarTransform::new(turn_rad, way_m, 0.0);
        frame += n_frames;
        body.push(checkpoint(frame, at));
    }
    let length = LengthWish { frames: frame + 1, mode: LengthMode::Preferred, weight: 1.0 };
    let wishes = Wishes { length: Some(length), body, ..Wishes::default() };
    Problem { wishes, allowed_clips: vec![true; clips.clips().len()], bridges: true }
}

fn checkpoint(frame: u32, world_from_torso: PlanarTransform) -> BodyConstraint {
    BodyConstraint {
        frame,
        position_m: world_from_torso.ground_m(),
        heading_rad: world_from_torso.heading_rad(),
        height_m: None,
        weight: 1.0,
        tolerance: Tolerance::default(),
    }
}

/// Where a body is after `n_frames` of random stretches, seen from where it was.
fn walk(clips: &ClipSet, n_frames: u32, rng: &mut Pcg64Mcg) -> PlanarTransform {
    let fps = clips.fps().get();
    let mut at = PlanarTransform::IDENTITY;
    let mut left = n_frames as usize;
    for _ in 0..MAX_DRAWS {
        if left == 0 {
            break;
        }
        let clip = clips.clip(ClipId::from_idx(rng.random_range(0..clips.clips().len())));
        let n = ((rng.random_range(STRETCH_S) * fps) as usize).min(left);
        let torsos = &clip.track.world_from_torso;
        if torsos.len() <= n {
            continue;
        }
        let from = rng.random_range(0..torsos.len() - n);
        at = at * (torsos[from].inverse() * torsos[from + n]);
        left -= n;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_the_same_each_time_and_make_sense() {
        let clips = crate::clips::Source::BuiltIn.load().unwrap();
        for nth in 0..20 {
            let problem = random_problem(&clips.set, nth);
            assert_eq!(problem, random_problem(&clips.set, nth), "{nth}");
            assert_eq!(problem.check(), Ok(()), "{nth}");
            assert!((2..=4).contains(&problem.wishes.body.len()), "{nth}");
        }
    }
}
