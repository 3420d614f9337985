//! Local minima kept as alternatives, each a different motion.
//!
//! Two motions are distinct when, placed in the world, their joints are on average at least
//! [`DISTINCT_M`] apart at equal times (over the frames that both have). It is a distance between
//! motions, not between labels: two paths through different clips may be the same walk.

use std::sync::OnceLock;

use super::library::SearchLibrary;
use super::route::Route;
use super::sketch::Sketch;
use crate::path::Path;

/// Mean joint distance from which two motions are different, metres.
pub const DISTINCT_M: f32 = 0.10;

/// The search asks for a little more, since correcting both onto the same checkpoints brings
/// them nearer to each other.
const DISTINCT_IN_SEARCH_M: f32 = 1.2 * DISTINCT_M;

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
    sketch: Sketch,
    /// Whether it is within every tolerance, once somebody has looked.
    pub(super) acceptable: OnceLock<bool>,
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
        if self.is_beneath(route) {
            return false;
        }
        self.offer_sketched(route, Sketch::of(library, route), round, improves)
    }

    /// [`Self::offer`], with the motion's sketch made before.
    pub(crate) fn offer_sketched(
        &mut self,
        route: &Route,
        sketch: Sketch,
        round: u64,
        improves: Option<Path>,
    ) -> bool {
        if self.is_beneath(route) {
            return false;
        }
        let at = self.kept.partition_point(|kept| kept.route.score <= route.score);
        let same = |kept: &Kept| kept.sketch.is_nearer(&sketch, DISTINCT_IN_SEARCH_M);
        if self.kept[..at].iter().any(same) {
            return false;
        }
        let mut behind = self.kept.split_off(at);
        let replaced = behind.iter().find(|kept| same(kept)).map(|kept| kept.route.path.clone());
        behind.retain(|kept| !same(kept));
        let improves = improves.or(replaced);
        self.kept.push(Kept {
            route: route.clone(),
            found_in: round,
            improves,
            sketch,
            acceptable: OnceLock::new(),
        });
        self.kept.append(&mut behind);
        self.kept.truncate(self.n_max);
        true
    }

    /// Whether there are enough that are no worse.
    fn is_beneath(&self, route: &Route) -> bool {
        let full = self.kept.len() >= self.n_max;
        full && self.kept.last().is_some_and(|worst| worst.route.score <= route.score)
    }

    /// Drops the motion with this path, from which a better one has come.
    pub(crate) fn drop_path(&mut self, path: &Path) {
        self.kept.retain(|kept| kept.route.path != *path);
    }
}
