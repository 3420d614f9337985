//! More like this: takes that share at least half of their frames with one that somebody likes.
//!
//! A stretch of the liked path is replaced by chance, and the outcome goes downhill as far as it
//! stays kindred. What is found is kept beside the search's own alternatives, among which it might
//! not last: it was asked for.

use std::collections::{HashSet, VecDeque};

use motion_core::cancel::CancelToken;
use motion_core::graph::MotionGraph;
use motion_core::ids::ClipId;
use motion_core::path::Path;
use motion_core::search::Search;

/// The least share of frames that kindred takes have in common.
pub(crate) const LEAST_SHARED: f64 = 0.5;
/// A take that has more in common is hardly another one.
const MOST_SHARED: f64 = 0.95;
/// So many are looked for at a time.
const N_WANTED: usize = 4;
/// Draws that do not fit or lead back to the liked take are many.
const MAX_DRAWS: u64 = 160;
/// Draws of one round, until one fits.
const DRAWS_PER_ROUND: u64 = 8;
/// Downhill steps of one round; each costs about what a line of the search costs.
const STEPS_PER_ROUND: usize = 4;
/// So many are kept, the latest.
const MAX_KEPT: usize = 12;

/// The search for kindred takes, and what it has found.
#[derive(Clone, Debug, Default)]
pub(super) struct Kindred {
    liked: Option<Liked>,
    found: VecDeque<Path>,
    /// Counts over all that was ever liked, so that who asks again gets others.
    n_draws: u64,
}

/// The take that more like it are looked for.
#[derive(Clone, Debug)]
struct Liked {
    path: Path,
    under_way: Option<Path>,
    n_draws: u64,
    n_found: usize,
}

impl Kindred {
    /// Looks for some like `path` in the next rounds.
    pub(super) fn begin(&mut self, path: Path) {
        self.liked = Some(Liked { path, under_way: None, n_draws: 0, n_found: 0 });
    }

    /// Whether it goes on.
    pub(super) fn is_looking(&self) -> bool {
        self.liked.is_some()
    }

    /// What was found, as far as it may be used for what `search` is asked now.
    pub(super) fn paths<'a>(&'a self, search: &'a Search) -> impl Iterator<Item = Path> + 'a {
        self.found.iter().filter(|path| search.judge(path).is_some()).cloned()
    }

    /// A little of the way; gives a take that was found and the liked one.
    pub(super) fn step(&mut self, search: &Search, cancel: &CancelToken) -> Option<(Path, Path)> {
        let liked = self.liked.as_mut()?;
        if liked.n_found >= N_WANTED || liked.n_draws >= MAX_DRAWS {
            self.liked = None;
            return None;
        }
        let graph = search.library().graph();
        let is_kindred = |path: &Path| shared(graph, path, &liked.path) >= LEAST_SHARED;
        if liked.under_way.is_none() {
            for _ in 0..DRAWS_PER_ROUND {
                let varied = search.varied(&liked.path, self.n_draws).map(|found| found.path);
                self.n_draws += 1;
                liked.n_draws += 1;
                if let Some(varied) = varied.filter(&is_kindred) {
                    liked.under_way = Some(varied);
                    break;
                }
            }
        }
        for _ in 0..STEPS_PER_ROUND {
            let path = liked.under_way.as_ref()?;
            let better = search.improve(path, cancel).map(|found| found.path);
            if cancel.is_cancelled() {
                return None;
            }
            if let Some(better) = better.filter(&is_kindred) {
                liked.under_way = Some(better);
                continue;
            }
            let done = liked.under_way.take()?;
            let is_other = shared(graph, &done, &liked.path) <= MOST_SHARED
                && self.found.iter().all(|known| shared(graph, &done, known) <= MOST_SHARED)
                && search.judge(&done).is_some();
            if !is_other {
                return None;
            }
            liked.n_found += 1;
            let of = liked.path.clone();
            self.found.push_back(done.clone());
            if self.found.len() > MAX_KEPT {
                self.found.pop_front();
            }
            return Some((done, of));
        }
        None
    }
}

/// The share of the longer path's frames that the other shows too, whenever it does.
pub(crate) fn shared(graph: &MotionGraph, a: &Path, b: &Path) -> f64 {
    let frames = |path: &Path| -> HashSet<(ClipId, u32)> {
        let pieces = path.pieces(graph).into_iter();
        pieces.flat_map(|piece| (piece.from.0..=piece.to.0).map(move |f| (piece.clip, f))).collect()
    };
    let (a, b) = (frames(a), frames(b));
    a.intersection(&b).count() as f64 / a.len().max(b.len()).max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::live::character_search::CharacterSearch;
    use crate::live::character_search::tests::{rounds, search};

    #[test]
    fn more_like_this_are_new_takes_that_share_half_and_descend_from_it() {
        let found = || {
            let mut search = search();
            rounds(&mut search, 30);
            let liked = search.snapshot().takes[1].clone();
            let before: HashSet<_> = search.snapshot().takes.iter().map(|t| t.id).collect();
            search.more_like(liked.id);
            assert!(!search.is_settled());
            rounds(&mut search, 60);
            let snapshot = search.snapshot();
            let is_new = |take: &&crate::live::Take| {
                take.parent == Some(liked.id) && !before.contains(&take.id)
            };
            let children: Vec<_> = snapshot.takes.iter().filter(is_new).cloned().collect();
            assert!(!children.is_empty(), "nothing like it was found");
            let ready = CharacterSearch::ready(&search).clone();
            let path = |take: &crate::live::Take| ready.path(&take.pieces).unwrap();
            for child in &children {
                let common = shared(&ready.library.graph, &path(child), &path(&liked));
                assert!(common >= LEAST_SHARED, "{common}");
                assert!(child.score.is_finite());
            }
            assert!(snapshot.take(liked.id).is_some());
            children.iter().map(|take| take.id).collect::<Vec<_>>()
        };
        assert_eq!(found(), found(), "equal seeds find equal takes");
    }

    #[test]
    fn sharing_counts_frames_of_clips() {
        use motion_core::units::FrameIdx;
        let ready = crate::fixture::ready_library();
        let stretch = |from, to| Path {
            first_clip: ClipId(0),
            start: FrameIdx(from),
            cuts: Vec::new(),
            end: FrameIdx(to),
        };
        let graph = &ready.library.graph;
        for (a, b, expected) in [
            ((0, 9), (0, 9), 1.0),
            ((0, 9), (5, 14), 0.5),
            ((0, 4), (0, 9), 0.5),
            ((0, 4), (5, 9), 0.0),
        ] {
            assert_eq!(shared(graph, &stretch(a.0, a.1), &stretch(b.0, b.1)), expected);
        }
    }
}
