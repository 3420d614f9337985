//! The plants of a motion made of pieces.
//!
//! Contacts carried from clips are interrupted at cuts: one clip lifts its foot a frame before
//! the other has put it down. Holding such fragments each at a place of its own would throw the
//! foot from one to the next within a frame or two.

use std::ops::Range;

use glam::Vec3;

use crate::contacts::{self, Side};
use crate::ground::Contacts;
use crate::units::Fps;

/// A pause between plants shorter than this is an accident of cutting, seconds.
const PAUSE_SECS: f64 = 0.2;
/// Plants on either side of such a pause are one where their places are nearer than this, metres.
const JOIN_M: f32 = 0.06;
/// Where they are not, the foot is given at least this long to go from one to the other, seconds.
const PASSAGE_SECS: f64 = 0.3;
/// A touch shorter than this is none, seconds.
const TOUCH_SECS: f64 = 0.09;

/// The plants of one foot, in order and apart from one another.
///
/// Runs of carried contact, with three corrections: runs that a pause of less than 0.2 s
/// separates are joined where the toe joint's mean places (`path_m`) are within 6 cm, otherwise
/// both are shortened until they are 0.3 s apart; runs shorter than 0.09 s are dropped, unless
/// the motion ends in them.
pub fn plants(contacts: &[Contacts], side: Side, path_m: &[Vec3], fps: Fps) -> Vec<Range<usize>> {
    let frames = |secs| fps.frames_in_secs(secs);
    let mut joined: Vec<Range<usize>> = Vec::new();
    for run in contacts::runs(contacts.len(), |frame| contacts[frame].side(side)) {
        match joined.last_mut() {
            Some(last)
                if run.start - last.end < frames(PAUSE_SECS)
                    && ground_distance_m(mean(path_m, last), mean(path_m, &run)) < JOIN_M =>
            {
                last.end = run.end;
            }
            _ => joined.push(run),
        }
    }
    let n_frames = contacts.len();
    joined.retain(|run| run.len() >= frames(TOUCH_SECS) || run.start == 0 || run.end == n_frames);
    for next in 1..joined.len() {
        let pause = joined[next].start - joined[next - 1].end;
        if pause >= frames(PAUSE_SECS) {
            continue;
        }
        // A plant keeps a frame at least: it is still where the foot should be.
        let lacking = frames(PASSAGE_SECS).saturating_sub(pause);
        let before = lacking.div_ceil(2).min(joined[next - 1].len() - 1);
        let after = (lacking / 2).min(joined[next].len() - 1);
        joined[next - 1].end -= before;
        joined[next].start += after;
    }
    joined
}

fn mean(path_m: &[Vec3], frames: &Range<usize>) -> Vec3 {
    path_m[frames.clone()].iter().sum::<Vec3>() / frames.len() as f32
}

fn ground_distance_m(a: Vec3, b: Vec3) -> f32 {
    (b.x - a.x).hypot(b.z - a.z)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// `x` is a planted frame, anything else is not; the toe is at z = 0 before frame `step` and
    /// at `far` from there on.
    #[track_caller]
    fn check(pattern: &str, step: usize, far: f32, expected: &[(usize, usize)]) {
        let contacts: Vec<Contacts> =
            pattern.chars().map(|c| Contacts { left: c == 'x', right: false }).collect();
        let path: Vec<Vec3> = (0..contacts.len())
            .map(|f| if f < step { Vec3::ZERO } else { Vec3::Z * far })
            .collect();
        let found: Vec<(usize, usize)> = plants(&contacts, Side::Left, &path, Fps::THIRTY)
            .into_iter()
            .map(|plant| (plant.start, plant.end))
            .collect();
        assert_eq!(found, expected, "{pattern}");
        assert_eq!(plants(&contacts, Side::Right, &path, Fps::THIRTY), []);
    }

    #[test]
    fn runs_are_plants() {
        check("..xxxxxx........xxxxx..", 10, 0.5, &[(2, 8), (16, 21)]);
    }

    #[test]
    fn a_short_pause_on_the_spot_is_none() {
        check("..xxxxxx...xxxxx..", 9, 0.03, &[(2, 16)]);
    }

    #[test]
    fn a_short_pause_between_places_is_made_longer() {
        check("xxxxxxxxxx.xxxxxxxxxx", 10, 0.3, &[(0, 6), (15, 21)]);
        check("xx.xxx", 3, 0.3, &[(0, 1), (5, 6)]);
    }

    #[test]
    fn a_touch_is_dropped_but_at_the_ends() {
        check("x.......xx.......x", 0, 0.0, &[(0, 1), (17, 18)]);
    }

    proptest! {
        #[test]
        fn plants_are_in_order_apart_and_within(
            pattern in prop::collection::vec(any::<bool>(), 1..80), far in 0f32..0.5, step in 0usize..80,
        ) {
            let contacts: Vec<Contacts> =
                pattern.iter().map(|&left| Contacts { left, right: false }).collect();
            let path: Vec<Vec3> = (0..contacts.len())
                .map(|f| if f < step { Vec3::ZERO } else { Vec3::Z * far })
                .collect();
            let mut end = None;
            for plant in plants(&contacts, Side::Left, &path, Fps::THIRTY) {
                prop_assert!(!plant.is_empty() && plant.end <= contacts.len());
                prop_assert!(end.is_none_or(|end| plant.start > end), "apart");
                end = Some(plant.end);
            }
        }
    }
}
