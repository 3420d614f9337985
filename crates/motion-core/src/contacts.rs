//! Planted feet: when a foot stands still and carries its own place on the ground.
//!
//! Two questions are answered here, and they differ:
//!
//! * [`stills`] finds where a foot is held still at *any* height, each spell measured against
//!   its own support, so that steps and stools count; [`crate::floor`] decides which of them are
//!   plants and what they stand on.
//! * [`planted_on_lowest`] is the plain rule by which motions of any origin are judged
//!   (`docs/files.md`, `measure`): the support is the foot's own lowest level.

use std::ops::Range;

use glam::Vec3;

use crate::ground::Contacts;
use crate::ids::JointIdx;
use crate::skeleton::{JointRole, Skeleton};
use crate::units::Fps;

/// A planted toe joint is slower than this along the ground, metres per second.
pub const PLANT_SPEED_M_S: f32 = 0.15;

/// A plant that has begun goes on until the toe joint is faster than this, metres per second:
/// the hysteresis that keeps marker noise from cutting one plant in two.
pub const RELEASE_SPEED_M_S: f32 = 0.30;

/// A planted toe joint moves up or down no faster than this, metres per second: a foot that is
/// lifted straight up is not planted while it rises.
pub const PLANT_CLIMB_M_S: f32 = 0.50;

/// A planted toe joint is no higher above its support than this, metres.
pub const PLANT_HEIGHT_M: f32 = 0.05;

/// A plant lasts at least this long by the rule for motions of any origin, seconds.
pub const PLANT_SECS: f64 = 0.12;

/// A foot is held still for at least this long, seconds. Shorter than [`PLANT_SECS`], since the
/// toes of a runner rest for no more than a tenth of a second.
pub const STILL_SECS: f64 = 0.09;

/// Half the span over which speeds are taken, seconds: central differences over two frames at
/// 30 frames per second, over eight at 120, so that the rate does not change what is a plant.
pub const SPEED_HALF_SPAN_SECS: f64 = 1.0 / 30.0;

/// The definition of a carried contact in words, for `measure --explain`.
pub const DEFINITION: &str = "carried contact: the toe joint is held still (begins below 0.15 m/s \
     along the ground, ends above 0.30 m/s; no faster than 0.50 m/s up or down; speeds over \
     1/15 s) within 5 cm of the height of its own support for at least 0.09 s, on the floor or on \
     something that bears the body";

/// The definition of a planted foot on motions of any origin, for `measure --explain`.
pub const LOWEST_DEFINITION: &str = "planted: the toe joint is within 5 cm of its own lowest \
     level (1st percentile of its height), slower than 0.15 m/s along the ground (speed over \
     1/15 s), for at least 0.12 s on end";

/// A side of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The body's left, +X when it looks along +Z.
    Left,
    /// The body's right.
    Right,
}

impl Side {
    /// Left, then right.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// 0 for left, 1 for right.
    #[inline]
    pub fn idx(self) -> usize {
        self as usize
    }
}

impl Contacts {
    /// Whether the foot of that side is planted.
    #[inline]
    pub fn side(self, side: Side) -> bool {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }

    /// Says whether the foot of that side is planted.
    #[inline]
    pub fn set_side(&mut self, side: Side, planted: bool) {
        match side {
            Side::Left => self.left = planted,
            Side::Right => self.right = planted,
        }
    }
}

/// The joint by which a foot's contact is judged: the toe base, else the ankle, else none.
pub fn toe_joint(skeleton: &Skeleton, side: Side) -> Option<JointIdx> {
    let (toe, ankle) = match side {
        Side::Left => (JointRole::LeftToeBase, JointRole::LeftFoot),
        Side::Right => (JointRole::RightToeBase, JointRole::RightFoot),
    };
    skeleton.by_role(toe).or_else(|| skeleton.by_role(ankle))
}

/// A spell in which a foot is held still.
#[derive(Clone, Debug, PartialEq)]
pub struct Still {
    /// Frames, the end not included.
    pub frames: Range<usize>,
    /// Median height of the toe joint in the spell, metres.
    pub height_m: f32,
}

/// Speeds along the ground and upwards (signed) of a joint at every frame, metres per second.
///
/// Central differences over ± [`SPEED_HALF_SPAN_SECS`] (at least one frame), one-sided at the
/// ends. A path of one frame stands still.
pub fn speeds_m_s(path_m: &[Vec3], fps: Fps) -> Vec<(f32, f32)> {
    let half = fps.frames_in_secs(SPEED_HALF_SPAN_SECS).max(1);
    let last = path_m.len().saturating_sub(1);
    (0..path_m.len())
        .map(|frame| {
            let (a, b) = (frame.saturating_sub(half), (frame + half).min(last));
            if a == b {
                return (0.0, 0.0);
            }
            let rate = (fps.get() / (b - a) as f64) as f32;
            let step = (path_m[b] - path_m[a]) * rate;
            (step.x.hypot(step.z), step.y)
        })
        .collect()
}

/// The fewest frames that hold for `secs` seconds, at least 2: `n` frames hold for `n / fps`.
pub fn min_frames(secs: f64, fps: Fps) -> usize {
    (secs * fps.get() - 1e-6).ceil().max(2.0) as usize
}

/// Every spell in which the joint on `path_m` is held still, at whatever height.
///
/// A spell begins where the joint is slower than [`PLANT_SPEED_M_S`] and reaches both ways as
/// long as it stays slower than [`RELEASE_SPEED_M_S`] along the ground and [`PLANT_CLIMB_M_S`]
/// upwards. It is then cut to the frames within [`PLANT_HEIGHT_M`] of its lowest level (10th
/// percentile); what lasts [`STILL_SECS`] is returned, in order, without overlaps.
pub fn stills(path_m: &[Vec3], fps: Fps) -> Vec<Still> {
    let speeds = speeds_m_s(path_m, fps);
    let slow = |frame: usize| {
        speeds[frame].0 < RELEASE_SPEED_M_S && speeds[frame].1.abs() < PLANT_CLIMB_M_S
    };
    let min_frames = min_frames(STILL_SECS, fps);
    let mut found = Vec::new();
    for spell in runs(path_m.len(), slow) {
        if !spell.clone().any(|frame| speeds[frame].0 < PLANT_SPEED_M_S) {
            continue;
        }
        split_by_height(path_m, spell, min_frames, &mut found);
    }
    found
}

/// Cuts a slow spell into parts that each stay near one support.
fn split_by_height(
    path_m: &[Vec3],
    spell: Range<usize>,
    min_frames: usize,
    found: &mut Vec<Still>,
) {
    if spell.len() < min_frames {
        return;
    }
    let mut heights: Vec<f32> = spell.clone().map(|frame| path_m[frame].y).collect();
    let support = percentile(&mut heights, 0.1);
    let near = |offset: usize| path_m[spell.start + offset].y < support + PLANT_HEIGHT_M;
    let mut end_of_last = spell.start;
    for part in runs(spell.len(), near) {
        let part = spell.start + part.start..spell.start + part.end;
        if part.len() < min_frames {
            continue;
        }
        // What lies between low parts is higher; it may be a plant on a higher support.
        split_by_height(path_m, end_of_last..part.start, min_frames, found);
        let mut heights: Vec<f32> = part.clone().map(|frame| path_m[frame].y).collect();
        end_of_last = part.end;
        found.push(Still { frames: part, height_m: percentile(&mut heights, 0.5) });
    }
    if end_of_last > spell.start {
        split_by_height(path_m, end_of_last..spell.end, min_frames, found);
    }
}

/// Whether the joint on `path_m` is planted, frame by frame, by [`LOWEST_DEFINITION`].
pub fn planted_on_lowest(path_m: &[Vec3], fps: Fps) -> Vec<bool> {
    let mut planted = vec![false; path_m.len()];
    if path_m.is_empty() {
        return planted;
    }
    let lowest = percentile(&mut path_m.iter().map(|p| p.y).collect::<Vec<_>>(), 0.01);
    let speeds = speeds_m_s(path_m, fps);
    let touches = |frame: usize| {
        path_m[frame].y < lowest + PLANT_HEIGHT_M && speeds[frame].0 < PLANT_SPEED_M_S
    };
    let min_frames = min_frames(PLANT_SECS, fps);
    for run in runs(path_m.len(), touches) {
        if run.len() >= min_frames {
            planted[run].fill(true);
        }
    }
    planted
}

/// The maximal runs of frames in `0..n_frames` for which `holds`, in order.
pub fn runs(n_frames: usize, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = None;
    for frame in 0..n_frames {
        match (holds(frame), start) {
            (true, None) => start = Some(frame),
            (false, Some(from)) => {
                found.push(from..frame);
                start = None;
            }
            _ => {}
        }
    }
    found.extend(start.map(|from| from..n_frames));
    found
}

/// The `share` quantile (0 the smallest, 1 the largest) by the nearest rank; 0 of nothing.
/// Reorders `values`.
pub fn percentile(values: &mut [f32], share: f64) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let rank = ((values.len() - 1) as f64 * share.clamp(0.0, 1.0)).round() as usize;
    *values.select_nth_unstable_by(rank, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A foot that stands for `plant_secs` at `heights[i]`, swings 0.5 m ahead in 0.3 s over an
    /// arc of 0.15 m, stands again, and so on.
    fn stepping(fps: Fps, plant_secs: f64, heights: &[f32]) -> Vec<Vec3> {
        let (n_plant, n_swing) = (fps.frames_in_secs(plant_secs), fps.frames_in_secs(0.3));
        let mut path = Vec::new();
        for (step, &height) in heights.iter().enumerate() {
            let z = 0.5 * step as f32;
            path.extend((0..n_plant).map(|_| Vec3::new(0.1, height, z)));
            let Some(&next) = heights.get(step + 1) else { break };
            for frame in 1..n_swing {
                let t = frame as f32 / n_swing as f32;
                let arc = 0.15 * (std::f32::consts::PI * t).sin();
                path.push(Vec3::new(0.1, height + (next - height) * t + arc, z + 0.5 * t));
            }
        }
        path
    }

    #[test]
    fn every_step_is_one_plant_at_any_rate() {
        for rate in [24.0, 29.97, 30.0, 60.0, 120.0] {
            let fps = Fps::new(rate).expect("a rate");
            let path = stepping(fps, 0.5, &[0.02, 0.02, 0.20, 0.40]);
            let plants = stills(&path, fps);
            let heights: Vec<f32> = plants.iter().map(|p| p.height_m).collect();
            assert_eq!(heights, [0.02, 0.02, 0.20, 0.40], "{rate} frames per second");
            for plant in plants {
                let secs = plant.frames.len() as f64 / rate;
                // Speeds over 1/15 s blur each end by half of that, and by a frame at low rates.
                assert!((secs - 0.5).abs() < 0.09, "{secs} s at {rate}");
            }
        }
    }

    #[test]
    fn a_short_touch_is_no_plant() {
        let path = stepping(Fps::THIRTY, 0.04, &[0.0, 0.0, 0.0]);
        assert_eq!(stills(&path, Fps::THIRTY), []);
    }

    #[test]
    fn the_contract_rule_needs_the_lowest_level() {
        let path = stepping(Fps::THIRTY, 0.5, &[0.0, 0.2]);
        let planted = planted_on_lowest(&path, Fps::THIRTY);
        assert!(planted[7], "on the floor");
        assert!(!planted[planted.len() - 5], "on the step");
    }

    #[test]
    fn a_foot_lifted_on_the_spot_is_two_stills() {
        let mut path = vec![Vec3::ZERO; 30];
        path.extend((1..10).map(|f| Vec3::Y * 0.04 * f as f32));
        path.extend(vec![Vec3::Y * 0.4; 30]);
        let heights: Vec<f32> =
            stills(&path, Fps::THIRTY).into_iter().map(|s| s.height_m).collect();
        assert_eq!(heights, [0.0, 0.4]);
    }

    #[test]
    fn a_slow_lift_is_cut_where_it_leaves_its_support() {
        // 0.1 m/s upwards: never fast, yet not planted after 5 cm.
        let path: Vec<Vec3> = (0..60).map(|f| Vec3::Y * (f as f32 / 300.0)).collect();
        for still in stills(&path, Fps::THIRTY) {
            let rise = path[still.frames.end - 1].y - path[still.frames.start].y;
            assert!(rise <= 0.08, "{rise} m within one plant");
        }
    }

    #[test]
    fn tiny_paths_are_answered() {
        assert_eq!(stills(&[], Fps::THIRTY), []);
        assert_eq!(stills(&[Vec3::ZERO], Fps::THIRTY), []);
        assert_eq!(planted_on_lowest(&[], Fps::THIRTY), Vec::<bool>::new());
        assert_eq!(planted_on_lowest(&[Vec3::ZERO], Fps::THIRTY), [false]);
    }

    proptest! {
        #[test]
        fn stills_are_ordered_apart_and_long_enough(
            steps in prop::collection::vec((-0.01f32..0.01, -0.02f32..0.02), 1..200),
        ) {
            let mut at = Vec3::ZERO;
            let path: Vec<Vec3> = steps
                .iter()
                .map(|&(x, y)| { at += Vec3::new(x, y, 0.0); at })
                .collect();
            let mut end = 0;
            for still in stills(&path, Fps::THIRTY) {
                prop_assert!(still.frames.start >= end);
                prop_assert!(still.frames.len() >= min_frames(STILL_SECS, Fps::THIRTY));
                prop_assert!(still.frames.end <= path.len());
                end = still.frames.end;
            }
        }
    }
}
