use std::sync::Arc;

use glam::Vec2;
use rayon::ThreadPoolBuilder;

use crate::cancel::CancelToken;
use crate::constraint::{BodyConstraint, LengthMode, LengthWish, PoseConstraint, Tolerance};
use crate::ids::ClipId;
use crate::score::Wishes;
use crate::search::{Problem, Search, SearchKind, SearchLibrary};
use crate::testing::wander;
use crate::units::FrameIdx;

const RIVALS: [SearchKind; 2] = [SearchKind::Af02, SearchKind::AStar];

fn library() -> Arc<SearchLibrary> {
    let clips = wander::clips(6, 90, true, 21);
    let graph = wander::graph(&clips);
    Arc::new(SearchLibrary::new(Arc::new(clips), Arc::new(graph)))
}

fn problem() -> Problem {
    let checkpoint = |frame, x, z, heading_rad| BodyConstraint {
        frame,
        position_m: Vec2::new(x, z),
        heading_rad,
        height_m: None,
        weight: 1.0,
        tolerance: Tolerance::default(),
    };
    let wishes = Wishes {
        length: Some(LengthWish { frames: 150, mode: LengthMode::Preferred, weight: 1.0 }),
        body: vec![checkpoint(0, 0.0, 0.0, 0.0), checkpoint(149, 2.0, 4.5, 0.8)],
        ..Wishes::default()
    };
    Problem { wishes, allowed_clips: vec![true; 6], bridges: true }
}

fn searched(problem: &Problem, kind: SearchKind, n_rounds: usize) -> Search {
    let mut search = Search::of_kind(library(), problem.clone(), 3, kind).expect("a problem");
    for _ in 0..n_rounds {
        assert!(search.step(&CancelToken::new()), "{kind:?} is not cancelled");
    }
    search
}

#[test]
fn what_they_find_are_valid_paths_with_their_true_scores() {
    for kind in RIVALS {
        let search = searched(&problem(), kind, 60);
        assert!(search.progress().n_minima > 0, "{kind:?}: {:?}", search.progress());
        for found in search.alternatives() {
            assert!(found.path.is_valid(search.library().graph()), "{kind:?}: {:?}", found.path);
            let judged = search.judge(&found.path).expect("long enough");
            let error = (judged.terms.total() - found.score).abs();
            assert!(error <= 2e-3 * found.score + 2e-3, "{kind:?}: {found:?} {judged:?}");
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for kind in RIVALS {
        let run = |n_threads| {
            let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().expect("a pool");
            pool.install(|| {
                let search = searched(&problem(), kind, 20);
                (search.progress(), search.alternatives())
            })
        };
        let alone = run(1);
        assert_eq!(run(2), alone, "{kind:?}");
        assert_eq!(run(8), alone, "{kind:?}");
    }
}

#[test]
fn a_cancelled_round_changes_nothing() {
    for kind in RIVALS {
        let mut search = searched(&problem(), kind, 5);
        let before = (search.progress(), search.alternatives());
        let stop = CancelToken::new();
        stop.cancel();
        assert!(!search.step(&stop), "{kind:?}: a cancelled round says so");
        assert_eq!((search.progress(), search.alternatives()), before, "{kind:?}");
        assert!(search.step(&CancelToken::new()), "{kind:?}: and the next one goes on");
        assert_eq!(search.progress().iteration, 6, "{kind:?}");
    }
}

#[test]
fn hard_poses_are_shown_at_their_frames() {
    let mut problem = problem();
    for (frame, clip, clip_frame) in [(50, 1, 40), (100, 4, 30)] {
        let pose = PoseConstraint::new(frame, ClipId::from_idx(clip), FrameIdx(clip_frame));
        problem.wishes.poses.push(pose);
    }
    for kind in RIVALS {
        let search = searched(&problem, kind, 60);
        let found = search.alternatives();
        assert!(!found.is_empty(), "{kind:?} finds a way from pose to pose");
        for found in found {
            let judged = search.judge(&found.path).expect("long enough");
            assert!(judged.poses.iter().all(|(shown, _)| *shown), "{kind:?}: {judged:?}");
        }
    }
}
