//! Frames of a clip that lie somewhere and are shown from some frame on: what they cost.

use glam::Vec2;

use super::library::SearchLibrary;
use super::reading::Reading;
use super::target::Target;
use crate::constraint::clearance::CLEARANCE_TOLERANCE_M;
use crate::constraint::environment::Sums;
use crate::constraint::obstacle::{OBSTACLE_STRIDE, OBSTACLE_TOLERANCE_M};
use crate::ids::{ClipId, JointIdx};
use crate::planar::PlanarTransform;

/// Frames `from..to` of a clip, shown from the motion's frame `starts_at` on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    pub(crate) clip: ClipId,
    pub(crate) world_from_clip: PlanarTransform,
    pub(crate) from: u32,
    pub(crate) to: u32,
    pub(crate) starts_at: u32,
}

/// What of a body is looked at where something is in the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Look {
    /// The first joint: soon done, and who walks through something does so with the hips.
    Hips,
    /// Every joint.
    Whole,
}

impl Stretch {
    /// The motion's frame after the last that is shown.
    #[inline]
    pub(crate) fn ends_at(&self) -> u32 {
        self.starts_at + self.to - self.from
    }

    /// All that it costs but for cuts, length and support; at least `enough` where it is that much.
    #[inline]
    pub(crate) fn cost(&self, library: &SearchLibrary, target: &Target, enough: f32) -> f32 {
        let cost = self.readings_cost(library, target) + self.styles_cost(target);
        if !target.has_surroundings() || cost >= enough {
            return cost;
        }
        cost + self.surroundings_cost(library, target, enough - cost)
    }

    /// What is read within it.
    #[inline]
    pub(crate) fn readings_cost(&self, library: &SearchLibrary, target: &Target) -> f32 {
        let readings = target.readings_within(self.starts_at, self.ends_at());
        let cost = |reading: &Reading| {
            let clip_frame = self.from + reading.frame - self.starts_at;
            reading.cost(library, self.world_from_clip, self.clip, clip_frame)
        };
        readings.iter().map(cost).sum()
    }

    /// Frames without a wished tag.
    #[inline]
    pub(crate) fn styles_cost(&self, target: &Target) -> f32 {
        let styles = target.styles.iter();
        styles.map(|style| style.cost(self.clip, self.from, self.to, self.starts_at)).sum()
    }

    /// Support sums with heights as they are in the world.
    #[inline]
    pub(crate) fn support(&self, library: &SearchLibrary) -> Sums {
        let sums = library.support(self.clip).between(self.from, self.to);
        sums.raised(self.world_from_clip.level_m)
    }

    /// Joints in obstacles and bodies in each other; at least `enough` where it is that much.
    pub(crate) fn surroundings_cost(
        &self,
        library: &SearchLibrary,
        target: &Target,
        enough: f32,
    ) -> f32 {
        if enough.is_finite() {
            let at_least = self.seen_by(Look::Hips, library, target, enough);
            if at_least >= enough {
                return at_least;
            }
        }
        self.seen_by(Look::Whole, library, target, enough)
    }

    /// The same as far as a look shows it: a lower bound for the hips alone.
    pub(crate) fn seen_by(
        &self,
        look: Look,
        library: &SearchLibrary,
        target: &Target,
        enough: f32,
    ) -> f32 {
        let mut cost = 0.0;
        self.look_around(look, library, target, |_, more| {
            cost += more;
            cost < enough
        });
        cost
    }

    /// Calls `see(frame, cost)` with frames of the motion that are in something's way, for as long as it wants more:
    /// only frames that are looked at, each with what it costs for those up to the next.
    #[inline]
    pub(crate) fn look_around(
        &self,
        look: Look,
        library: &SearchLibrary,
        target: &Target,
        mut see: impl FnMut(u32, f32) -> bool,
    ) {
        // Where the clip's frame 0 is or would be shown.
        let shown_at = i64::from(self.starts_at) - i64::from(self.from);
        library.circles(self.clip).near_blocks(
            (self.from, self.to),
            |place, first, level| {
                let there = place.placed(self.world_from_clip);
                target.may_meet(&there, shown_at + i64::from(first), level)
            },
            |from, to| {
                let starts_at = (shown_at + i64::from(from)) as u32;
                let ends_at = starts_at + to - from;
                let looked_at = starts_at.next_multiple_of(OBSTACLE_STRIDE)..ends_at;
                for frame in looked_at.step_by(OBSTACLE_STRIDE as usize) {
                    let at = (self.clip, from + frame - starts_at);
                    let cost =
                        surroundings_at(look, library, target, self.world_from_clip, at, frame);
                    if cost > 0.0 && !see(frame, cost) {
                        return false;
                    }
                }
                true
            },
        );
    }
}

/// What a frame that is looked at costs for being in something's way, with those up to the next.
#[inline]
pub(crate) fn surroundings_at(
    look: Look,
    library: &SearchLibrary,
    target: &Target,
    world_from_clip: PlanarTransform,
    (clip, clip_frame): (ClipId, u32),
    frame: u32,
) -> f32 {
    let torso = world_from_clip * library.torsos(clip)[clip_frame as usize];
    let depth_m = match look {
        Look::Hips => hips_depth_m(library, target, torso, (clip, clip_frame)),
        Look::Whole => depth_m(library, target, torso, (clip, clip_frame)),
    };
    let near_m = too_near_m(target, torso.ground_m(), frame);
    if depth_m == 0.0 && near_m == 0.0 {
        return 0.0;
    }
    seen_cost(library, target, depth_m, near_m)
}

/// What a frame that is looked at costs.
#[inline]
fn seen_cost(library: &SearchLibrary, target: &Target, depth_m: f32, near_m: f32) -> f32 {
    let squares =
        (depth_m / OBSTACLE_TOLERANCE_M).powi(2) + (near_m / CLEARANCE_TOLERANCE_M).powi(2);
    let secs = library.clips().fps().frame_secs() as f32 * OBSTACLE_STRIDE as f32;
    target.weights.environment * squares * secs
}

/// How deep the first joint is within obstacles, metres: no deeper than the body.
#[inline]
fn hips_depth_m(
    library: &SearchLibrary,
    target: &Target,
    world_from_torso: PlanarTransform,
    (clip, clip_frame): (ClipId, u32),
) -> f32 {
    let hips_m = world_from_torso.apply(library.bodies(clip).joint_m(clip_frame, JointIdx(0)));
    target.solids.iter().map(|solid| solid.depth_m(hips_m)).fold(0.0, f32::max)
}

/// How deep a body is within obstacles, metres.
#[inline]
pub(crate) fn depth_m(
    library: &SearchLibrary,
    target: &Target,
    world_from_torso: PlanarTransform,
    (clip, clip_frame): (ClipId, u32),
) -> f32 {
    let mut deepest_m = 0.0f32;
    for solid in &target.solids {
        let extent = library.extent(clip, clip_frame);
        let top_m = world_from_torso.level_m + extent.top_m;
        if !solid.is_near(world_from_torso.ground_m(), extent.reach_m, top_m) {
            continue;
        }
        let joints = library.bodies(clip).columns(clip_frame);
        deepest_m = deepest_m.max(solid.deepest_m(world_from_torso, &joints));
    }
    deepest_m
}

/// How much too near other bodies are at a frame, metres.
#[inline]
pub(crate) fn too_near_m(target: &Target, ground_m: Vec2, frame: u32) -> f32 {
    let near = target.others.iter().map(|other| other.body.too_near_m(frame, ground_m));
    near.fold(0.0, f32::max)
}
