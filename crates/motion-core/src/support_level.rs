//! The height of what supports the body, followed from plant to plant.

use std::ops::Range;

use crate::contacts::{self, Side};
use crate::units::Fps;

/// A plant's say in the support height fades in and out over this time, seconds.
const HANDOVER_SECS: f64 = 0.30;

/// Half the width of the triangle that the support height is smoothed with, seconds.
const SMOOTHING_SECS: f64 = 0.35;

/// A spell in which a foot stands on something.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// The foot.
    pub side: Side,
    /// Frames, the end not included.
    pub frames: Range<usize>,
    /// Height of what it stands on, exactly 0 for the floor, metres.
    pub level_m: f32,
}

/// The support height of every frame, metres.
///
/// A frame in which one foot is planted is at that plant's level; where feet on different levels
/// are planted together each counts less towards the ends of its plant; flights go from one
/// support to the next in a line; before the first and after the last plant nothing changes.
/// A triangle of ± 0.35 s then smooths the series, so that floors stay exactly 0 and a step of
/// 0.2 m is taken at no more than 0.6 m/s. Without plants everything is at 0.
pub fn levels_m(plants: &[Plant], n_frames: usize, fps: Fps) -> Vec<f32> {
    if plants.iter().all(|plant| plant.level_m == 0.0) {
        return vec![0.0; n_frames];
    }
    let handover = (HANDOVER_SECS * fps.get()) as f32;
    // Σ weight · level and Σ weight per frame; a weight is in (0, 1] within its plant.
    let mut sums = vec![(0.0f32, 0.0f32); n_frames];
    for plant in plants {
        let frames = plant.frames.clone();
        let ramp = handover.min(0.5 * frames.len() as f32);
        for frame in frames.clone() {
            let inside = (frame - frames.start + 1).min(frames.end - frame) as f32;
            let t = (inside / ramp).min(1.0);
            let weight = t * t * (3.0 - 2.0 * t);
            sums[frame].0 += weight * plant.level_m;
            sums[frame].1 += weight;
        }
    }
    let mut levels = bridged(&sums);
    let half = fps.frames_in_secs(SMOOTHING_SECS);
    if half > 0 {
        levels = smoothed(&levels, half);
    }
    levels
}

/// The weighted means, with frames in flight between two supports interpolated linearly and the
/// ends held.
fn bridged(sums: &[(f32, f32)]) -> Vec<f32> {
    let mut levels: Vec<f32> =
        sums.iter().map(|&(sum, weight)| if weight > 0.0 { sum / weight } else { 0.0 }).collect();
    let last = levels.len().saturating_sub(1);
    for flight in contacts::runs(sums.len(), |frame| sums[frame].1 <= 0.0) {
        let before = flight.start.checked_sub(1).map(|frame| levels[frame]);
        let after = (flight.end <= last).then(|| levels[flight.end]);
        let (before, after) = match (before, after) {
            (Some(before), Some(after)) => (before, after),
            (Some(held), None) | (None, Some(held)) => (held, held),
            (None, None) => (0.0, 0.0),
        };
        let span = (flight.len() + 1) as f32;
        let start = flight.start;
        for frame in flight {
            let t = (frame - start + 1) as f32 / span;
            levels[frame] = before + (after - before) * t;
        }
    }
    levels
}

/// `levels` under a triangle that reaches `half` frames to either side; ends are held.
pub fn smoothed(levels: &[f32], half: usize) -> Vec<f32> {
    let last = levels.len() as isize - 1;
    let half = half as isize;
    (0..=last)
        .map(|frame| {
            let (mut sum, mut weights) = (0.0f64, 0.0f64);
            for offset in -half..=half {
                let weight = (half + 1 - offset.abs()) as f64;
                sum += weight * f64::from(levels[(frame + offset).clamp(0, last) as usize]);
                weights += weight;
            }
            (sum / weights) as f32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn plant(side: Side, frames: Range<usize>, level_m: f32) -> Plant {
        Plant { side, frames, level_m }
    }

    #[test]
    fn a_step_is_taken_smoothly_between_its_plants() {
        let plants = [plant(Side::Left, 0..40, 0.0), plant(Side::Right, 35..80, 0.2)];
        let levels = levels_m(&plants, 80, Fps::THIRTY);
        assert_eq!((levels[10], levels[70]), (0.0, 0.2));
        assert!((levels[37] - 0.1).abs() < 0.03, "half way at the handover: {}", levels[37]);
        let fastest = levels.windows(2).map(|w| (w[1] - w[0]) * 30.0).fold(0.0, f32::max);
        assert!(fastest < 0.6, "{fastest} m/s");
    }

    #[test]
    fn without_plants_everything_is_the_floor() {
        assert_eq!(levels_m(&[], 5, Fps::THIRTY), [0.0; 5]);
    }

    proptest! {
        #[test]
        fn levels_stay_within_those_of_the_plants(
            spells in prop::collection::vec((0usize..90, 1usize..40, -0.3f32..0.9), 1..6),
        ) {
            let plants: Vec<Plant> = spells
                .iter()
                .map(|&(start, n, level)| plant(Side::Left, start..(start + n).min(100), level))
                .collect();
            let (lowest, highest) = plants.iter().fold((f32::MAX, f32::MIN), |(lo, hi), plant| {
                (lo.min(plant.level_m), hi.max(plant.level_m))
            });
            for level in levels_m(&plants, 100, Fps::THIRTY) {
                prop_assert!((lowest - 1e-5..=highest + 1e-5).contains(&level), "{level}");
            }
        }

        #[test]
        fn smoothing_keeps_what_is_even(level in -1f32..1.0, half in 0usize..12) {
            for value in smoothed(&[level; 30], half) {
                prop_assert!((value - level).abs() < 1e-6);
            }
        }
    }
}
