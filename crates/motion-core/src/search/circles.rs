//! Where bodies are over stretches of frames, roughly: circles on the ground around eight frames, sixteen, and
//! so on. Of a long stretch only what comes near something is looked at frame by frame.

use glam::Vec2;

use super::tracks::Extent;
use crate::planar::PlanarTransform;

/// Frames that the smallest circles are around.
pub(crate) const BLOCK: u32 = 8;

/// The level whose blocks are no shorter than so many frames.
pub(crate) fn level_of(n_frames: u32) -> usize {
    n_frames.div_ceil(BLOCK).next_power_of_two().ilog2() as usize
}

/// Where a body is during a block of frames of a clip, in the clip's world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whereabouts {
    /// The middle of the circles.
    pub(crate) ground_m: Vec2,
    /// Around every torso, metres.
    pub(crate) torso_radius_m: f32,
    /// Around every joint, metres.
    pub(crate) joints_radius_m: f32,
    /// No joint is higher, metres.
    pub(crate) top_m: f32,
}

impl Whereabouts {
    /// Both together.
    pub(crate) fn joined(&self, other: &Self) -> Self {
        let apart_m = self.ground_m.distance(other.ground_m);
        // The torsos' circles side by side say where the middle is best.
        let reach_m = (apart_m + self.torso_radius_m + other.torso_radius_m) * 0.5;
        let radius_m = reach_m.max(self.torso_radius_m).max(other.torso_radius_m);
        let share = if apart_m > 0.0 { (radius_m - self.torso_radius_m) / apart_m } else { 0.0 };
        let ground_m = self.ground_m.lerp(other.ground_m, share.clamp(0.0, 1.0));
        let (to_self_m, to_other_m) =
            (ground_m.distance(self.ground_m), ground_m.distance(other.ground_m));
        Self {
            ground_m,
            torso_radius_m: (to_self_m + self.torso_radius_m)
                .max(to_other_m + other.torso_radius_m),
            joints_radius_m: (to_self_m + self.joints_radius_m)
                .max(to_other_m + other.joints_radius_m),
            top_m: self.top_m.max(other.top_m),
        }
    }

    /// Seen from where the clip's world lies at `world_from_clip`.
    #[inline]
    pub(crate) fn placed(&self, world_from_clip: PlanarTransform) -> Self {
        Self {
            ground_m: world_from_clip.apply_ground(self.ground_m),
            top_m: self.top_m + world_from_clip.level_m,
            ..*self
        }
    }
}

/// Circles around the blocks of a clip. Level `l` has blocks of `BLOCK << l` frames.
#[derive(Clone, Debug)]
pub(crate) struct ClipCircles {
    levels: Vec<Vec<Whereabouts>>,
}

impl ClipCircles {
    /// Of a clip's torsos and how far the joints reach from each. As many of both.
    pub(crate) fn new(torsos: &[PlanarTransform], extents: &[Extent]) -> Self {
        let mut levels = Vec::new();
        let mut n_frames = BLOCK as usize;
        loop {
            let blocks = torsos.chunks(n_frames).zip(extents.chunks(n_frames));
            levels.push(blocks.map(|(torsos, extents)| around(torsos, extents)).collect());
            if n_frames >= torsos.len() {
                return Self { levels };
            }
            n_frames *= 2;
        }
    }

    /// The blocks of frames, first and last but one, within `from..to` (`from < to`) during which a body may be
    /// near something, in their order.
    ///
    /// `is_near(whereabouts, first, level)` says so for the block of `BLOCK << level` frames that begins with
    /// `first`; a block reaches beyond `from..to` where these lie within it.
    #[inline]
    pub(crate) fn near_blocks(
        &self,
        (from, to): (u32, u32),
        mut is_near: impl FnMut(&Whereabouts, u32, usize) -> bool,
        mut visit: impl FnMut(u32, u32) -> bool,
    ) {
        let (mut block, end) = (from / BLOCK, to.div_ceil(BLOCK));
        'blocks: while block < end {
            let room = (end - block).ilog2().min(self.levels.len() as u32 - 1);
            let mut level = block.trailing_zeros().min(room) as usize;
            while is_near(&self.levels[level][(block >> level) as usize], block * BLOCK, level) {
                if level == 0 {
                    let first = (block * BLOCK).max(from);
                    if !visit(first, ((block + 1) * BLOCK).min(to)) {
                        return;
                    }
                    block += 1;
                    continue 'blocks;
                }
                level -= 1;
            }
            block += 1 << level;
        }
    }
}

/// Where a body is over all these frames, in the world that the torsos stand in.
pub(crate) fn around(torsos: &[PlanarTransform], extents: &[Extent]) -> Whereabouts {
    let places = torsos.iter().map(|torso| torso.ground_m());
    let ground_m = middle_of(places.clone());
    let mut all =
        Whereabouts { ground_m, torso_radius_m: 0.0, joints_radius_m: 0.0, top_m: f32::MIN };
    for ((place, torso), extent) in places.zip(torsos).zip(extents) {
        let distance_m = place.distance(ground_m);
        all.torso_radius_m = all.torso_radius_m.max(distance_m);
        all.joints_radius_m = all.joints_radius_m.max(distance_m + extent.reach_m);
        all.top_m = all.top_m.max(torso.level_m + extent.top_m);
    }
    all
}

/// The middle of the rectangle around places.
fn middle_of(places: impl Iterator<Item = Vec2>) -> Vec2 {
    let (low, high) = places.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), place| {
        (low.min(place), high.max(place))
    });
    0.5 * (low + high)
}

/// Circles around where something is over time. Entry `i` of level `l` is around the `2 · BLOCK << l`
/// frames from `i · (BLOCK << l)` on, so that one of them holds any `BLOCK << l` frames.
#[derive(Clone, Debug)]
pub(crate) struct TimeCircles {
    levels: Vec<Vec<(Vec2, f32)>>,
    last_m: Vec2,
}

impl TimeCircles {
    /// Of a place a frame, at least one; it stays at the last.
    pub(crate) fn new(ground_m: &[Vec2]) -> Self {
        let mut levels = Vec::new();
        let mut step = BLOCK as usize;
        loop {
            let starts = (0..ground_m.len()).step_by(step);
            levels.push(
                starts
                    .map(|first| {
                        let places = &ground_m[first..ground_m.len().min(first + 2 * step)];
                        let middle_m = middle_of(places.iter().copied());
                        let radius_m =
                            places.iter().map(|p| p.distance(middle_m)).fold(0.0, f32::max);
                        (middle_m, radius_m)
                    })
                    .collect(),
            );
            if step >= ground_m.len() {
                break;
            }
            step *= 2;
        }
        Self { levels, last_m: ground_m[ground_m.len() - 1] }
    }

    /// A circle that it is in during the `BLOCK << level` frames from `first` on; frames before the first
    /// do not count.
    #[inline]
    pub(crate) fn during(&self, first: i64, level: usize) -> (Vec2, f32) {
        let Some(circles) = self.levels.get(level) else {
            // The whole way is in the last level's first circle.
            return self.levels[self.levels.len() - 1][0];
        };
        let nth = first.max(0) as usize / ((BLOCK as usize) << level);
        circles.get(nth).copied().unwrap_or((self.last_m, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn every_frame_that_is_near_lies_in_a_block_that_is_visited(
            steps in prop::collection::vec((-0.2f32..0.2, -0.2f32..0.2), 1..150),
            (from, n) in (0usize..150, 1usize..150),
            (x, z, radius_m) in (-4f32..4.0, -4f32..4.0, 0.01f32..2.0),
        ) {
            let mut at = Vec2::ZERO;
            let torsos: Vec<PlanarTransform> = steps
                .iter()
                .map(|&(x, z)| {
                    at += Vec2::new(x, z);
                    PlanarTransform::new(0.0, at, 0.0)
                })
                .collect();
            let extents = vec![Extent::of(&[Vec3::new(0.3, 1.7, 0.0)]); torsos.len()];
            let circles = ClipCircles::new(&torsos, &extents);
            let from = from.min(torsos.len() - 1);
            let to = (from + n).min(torsos.len());
            let there_m = Vec2::new(x, z);
            let mut seen = vec![false; torsos.len()];
            circles.near_blocks(
                (from as u32, to as u32),
                |place, first, level| {
                    let own = first as usize..torsos.len().min(first as usize + (BLOCK << level) as usize);
                    for torso in &torsos[own] {
                        let off_m = torso.ground_m().distance(place.ground_m);
                        assert!(off_m <= place.torso_radius_m + 1e-5);
                        assert!(off_m + 0.3 <= place.joints_radius_m + 1e-5 && place.top_m >= 1.7);
                    }
                    place.ground_m.distance(there_m) < place.torso_radius_m + radius_m
                },
                |first, end| {
                    seen[first as usize..end as usize].fill(true);
                    true
                },
            );
            for (frame, torso) in torsos.iter().enumerate() {
                let is_asked = (from..to).contains(&frame);
                let is_near = torso.ground_m().distance(there_m) < radius_m - 1e-4;
                prop_assert!(!is_near || !is_asked || seen[frame], "{}", frame);
                prop_assert!(is_asked || !seen[frame], "{}", frame);
            }
        }

        #[test]
        fn a_circle_of_a_time_holds_every_place_of_it(
            places in prop::collection::vec((-9f32..9.0, -9f32..9.0), 1..100),
            (first, level) in (-40i64..140, 0usize..9),
        ) {
            let places: Vec<Vec2> = places.into_iter().map(Vec2::from).collect();
            let (middle_m, radius_m) = TimeCircles::new(&places).during(first, level);
            for frame in first.max(0)..first + (i64::from(BLOCK) << level) {
                let place = places[(frame as usize).min(places.len() - 1)];
                prop_assert!(place.distance(middle_m) <= radius_m + 1e-4, "{}", frame);
            }
        }

        #[test]
        fn a_circle_around_both_holds_both(
            a in (-9f32..9.0, -9f32..9.0, 0f32..3.0),
            b in (-9f32..9.0, -9f32..9.0, 0f32..3.0),
        ) {
            let place = |(x, z, radius_m): (f32, f32, f32)| Whereabouts {
                ground_m: Vec2::new(x, z),
                torso_radius_m: radius_m,
                joints_radius_m: radius_m + 0.5,
                top_m: x,
            };
            let (a, b) = (place(a), place(b));
            let both = a.joined(&b);
            for one in [a, b] {
                let off_m = one.ground_m.distance(both.ground_m);
                prop_assert!(off_m + one.torso_radius_m <= both.torso_radius_m + 1e-4);
                prop_assert!(off_m + one.joints_radius_m <= both.joints_radius_m + 1e-4);
                prop_assert!(both.top_m >= one.top_m);
            }
        }
    }
}
