//! Local minima kept as alternatives, each a different motion.
//!
//! Two motions are distinct when, placed in the world, their joints are on average at least
//! [`DISTINCT_M`] apart at equal times (over the frames that both have). It is a distance between
//! motions, not between labels: two paths through different clips may be the same walk.

use glam::Vec3;

use super::library::SearchLibrary;
use super::route::Route;
use crate::path::Path;
use crate::planar::PlanarTransform;

/// Mean joint distance from which two motions are different, metres.
pub const DISTINCT_M: f32 = 0.10;

/// The search asks for a little more, since correcting both onto the same checkpoints brings
/// them nearer to each other.
const DISTINCT_IN_SEARCH_M: f32 = 1.2 * DISTINCT_M;

/// Frames between the samples of the first, coarse look.
const STRIDE: u32 = 12;

/// Distinct local minima, best first.
#[derive(Clone, Debug)]
pub(crate) struct Alternatives {
    kept: Vec<Kept>,
    n_max: usize,
}

/// An alternative and the round in which it was found.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    pub(crate) route: Route,
    pub(crate) found_in: u64,
    /// The kept motion that it came from or took the place of.
    pub(crate) improves: Option<Path>,
}

impl Alternatives {
    pub(crate) fn new(n_max: usize) -> Self {
        Self { kept: Vec::new(), n_max }
    }

    pub(crate) fn kept(&self) -> &[Kept] {
        &self.kept
    }

    /// Takes a motion in unless a better one is the same motion; a better one replaces
    /// those that it is the same motion as. Returns whether it was taken.
    pub(crate) fn offer(
        &mut self,
        library: &SearchLibrary,
        route: &Route,
        round: u64,
        improves: Option<Path>,
    ) -> bool {
        let full = self.kept.len() >= self.n_max;
        if full && self.kept.last().is_some_and(|worst| worst.route.score <= route.score) {
            return false;
        }
        let at = self.kept.partition_point(|kept| kept.route.score <= route.score);
        let same = |kept: &Kept| are_same_motion(library, &kept.route, route);
        if self.kept[..at].iter().any(same) {
            return false;
        }
        let mut behind = self.kept.split_off(at);
        let replaced = behind.iter().find(|kept| same(kept)).map(|kept| kept.route.path.clone());
        behind.retain(|kept| !same(kept));
        let improves = improves.or(replaced);
        self.kept.push(Kept { route: route.clone(), found_in: round, improves });
        self.kept.append(&mut behind);
        self.kept.truncate(self.n_max);
        true
    }

    /// Drops the motion with this path, from which a better one has come.
    pub(crate) fn drop_path(&mut self, path: &Path) {
        self.kept.retain(|kept| kept.route.path != *path);
    }
}

fn are_same_motion(library: &SearchLibrary, a: &Route, b: &Route) -> bool {
    // The mean of distances is no less than the distance of means: that settles most pairs.
    if mean_middle_distance_m(library, a, b, STRIDE) >= 2.0 * DISTINCT_IN_SEARCH_M {
        return false;
    }
    let coarse = mean_joint_distance_m(library, a, b, STRIDE);
    if coarse >= 2.0 * DISTINCT_IN_SEARCH_M {
        return false;
    }
    if coarse <= 0.5 * DISTINCT_IN_SEARCH_M {
        return true;
    }
    mean_joint_distance_m(library, a, b, 1) < DISTINCT_IN_SEARCH_M
}

/// Mean distance of joints at equal times, over every `stride`-th frame that both motions have,
/// metres.
pub(crate) fn mean_joint_distance_m(
    library: &SearchLibrary,
    a: &Route,
    b: &Route,
    stride: u32,
) -> f32 {
    let n_frames = a.n_frames.min(b.n_frames);
    let (mut sum, mut n) = (0.0f64, 0usize);
    for frame in (0..n_frames).step_by(stride as usize) {
        let (torso_a, joints_a) = frame_of(library, a, frame);
        let (torso_b, joints_b) = frame_of(library, b, frame);
        let b_from_a = torso_b.inverse() * torso_a;
        let distances = joints_a.iter().zip(joints_b).map(|(&p, &q)| b_from_a.apply(p).distance(q));
        sum += f64::from(distances.sum::<f32>());
        n += joints_a.len();
    }
    (sum / n.max(1) as f64) as f32
}

/// Mean distance of the joints' means at equal times, metres: no more than that of the joints.
fn mean_middle_distance_m(library: &SearchLibrary, a: &Route, b: &Route, stride: u32) -> f32 {
    let n_frames = a.n_frames.min(b.n_frames);
    let middle_m = |route: &Route, frame: u32| {
        let span = route.span_at(frame);
        let clip_frame = span.from + frame - span.starts_at;
        let torso = span.world_from_clip * library.torsos(span.clip)[clip_frame as usize];
        torso.apply(library.extent(span.clip, clip_frame).middle_m)
    };
    let (mut sum, mut n) = (0.0f64, 0usize);
    for frame in (0..n_frames).step_by(stride as usize) {
        sum += f64::from(middle_m(a, frame).distance(middle_m(b, frame)));
        n += 1;
    }
    (sum / n.max(1) as f64) as f32
}

fn frame_of<'a>(
    library: &'a SearchLibrary,
    route: &Route,
    frame: u32,
) -> (PlanarTransform, &'a [Vec3]) {
    let span = route.span_at(frame);
    let clip_frame = span.from + frame - span.starts_at;
    let torso = span.world_from_clip * library.torsos(span.clip)[clip_frame as usize];
    (torso, library.joints(span.clip, clip_frame))
}
