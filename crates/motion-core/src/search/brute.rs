//! The slow twin of the scoring: every mutation laid out and judged from scratch.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use proptest::prelude::*;

use super::Search;
use super::best::Best;
use super::evaluate::Evaluator;
use super::hard::HardWish;
use super::library::SearchLibrary;
use super::mutation::Mutation;
use super::problem::{Problem, ProblemError};
use super::rng::stream;
use super::route::Route;
use super::seeds::{self, Anchors, Growth};
use super::tables::Tables;
use super::target::Target;
use crate::cancel::CancelToken;
use crate::clip::ClipSet;
use crate::constraint::{
    BodyConstraint, FollowConstraint, JointConstraint, LengthMode, LengthWish, LockConstraint,
    Obstacle, OtherBody, PoseConstraint, StyleConstraint, Tolerance,
};
use crate::ids::{ClipId, JointIdx};
use crate::path::Piece;
use crate::score::{Wishes, judge};
use crate::tags::HandTags;
use crate::testing::wander;
use crate::units::{Fps, FrameIdx};

/// One of the scans of an evaluator.
type Scan = fn(&mut Evaluator<'_>);

fn library(climbs: bool, seed: u64) -> Arc<SearchLibrary> {
    let mut clips = wander::clips(6, 90, climbs, seed).clips().to_vec();
    clips.iter_mut().step_by(2).for_each(|clip| clip.tags.push("even".into()));
    let clips = ClipSet::new(wander::skeleton(), Fps::THIRTY, clips).expect("a valid set");
    let graph = wander::graph(&clips);
    assert!(graph.forest.n_nodes() > 200, "the fixture must have edges");
    Arc::new(SearchLibrary::new(Arc::new(clips), Arc::new(graph)))
}

fn checkpoint(frame: u32, x: f32, z: f32, heading_rad: f32) -> BodyConstraint {
    let position_m = Vec2::new(x, z);
    let tolerance = Tolerance::default();
    BodyConstraint { frame, position_m, heading_rad, height_m: None, weight: 1.0, tolerance }
}

/// From the origin past a checkpoint to another; the first at frame `first`.
fn wishes(first: u32, mode: LengthMode) -> Wishes {
    Wishes {
        length: Some(LengthWish { frames: 150, mode, weight: 1.0 }),
        body: vec![
            checkpoint(first, 0.0, 0.0, 0.0),
            checkpoint(70, 0.5, 2.5, 0.3),
            checkpoint(149, 2.0, 4.5, 0.8),
        ],
        ..Wishes::default()
    }
}

/// The same with wishes of every soft kind.
fn of_every_kind(first: u32) -> Wishes {
    let mut joint = JointConstraint::new(90, JointIdx(2), Vec3::new(0.8, 0.2, 2.9));
    joint.velocity_m_s = Some(Vec3::new(0.5, 0.0, 1.0));
    let mut wishes = wishes(first, LengthMode::Preferred);
    wishes.body.insert(2, checkpoint(110, 1.2, 3.4, 0.5));
    wishes.body[1].tolerance = Tolerance { position_m: 0.1, heading_rad: 0.5, frames: 5.0 };
    wishes.body[2].tolerance.heading_rad = f32::INFINITY;
    wishes.joints = vec![joint];
    wishes.styles = vec![StyleConstraint {
        from: 30,
        to: 100,
        tag: "EVEN".into(),
        weight: 0.5,
        by_hand: HandTags::default(),
    }];
    wishes.follows = vec![FollowConstraint {
        from: 40,
        to: 145,
        points_m: vec![Vec2::new(0.1, 1.5), Vec2::new(0.5, 2.5), Vec2::new(2.0, 4.4)],
        looks_along: true,
        weight: 2.0,
        tolerance_m: 0.3,
        tolerance_rad: 0.3,
    }];
    wishes.obstacles = vec![
        Obstacle::Box {
            center_m: Vec3::new(0.5, 0.5, 1.5),
            size_m: Vec3::new(0.6, 1.0, 0.4),
            heading_rad: 0.4,
        },
        Obstacle::Ceiling {
            center_m: Vec3::new(1.0, 0.95, 3.5),
            size_m: Vec2::new(1.0, 1.0),
            heading_rad: 0.0,
        },
    ];
    let ground_m = (0..200).map(|f| Vec2::new(2.0 - 0.01 * f as f32, 0.02 * f as f32)).collect();
    wishes.others = vec![OtherBody { ground_m, together: vec![(60, 70)] }];
    wishes
}

/// A seed, with every clip allowed.
fn grow(library: &SearchLibrary, target: &Target, rng: &mut rand_pcg::Pcg64Mcg) -> Option<Route> {
    let all = vec![true; library.graph().n_clips()];
    let cuts = vec![Vec::new(); target.hard.len()];
    let anchors = Anchors::new(library, target, (&all, true), cuts);
    seeds::grow(library, target, (&all, true), &anchors, Growth { width: 4, n_cuts: 32 }, rng)
}

/// A path that has come some way downhill.
fn some_route(library: &SearchLibrary, target: &Target, seed: u64) -> Route {
    (0..100)
        .find_map(|item| grow(library, target, &mut stream(seed, 1, item)))
        .expect("a seed within a hundred")
}

#[test]
fn a_route_scores_what_a_walk_over_its_frames_finds() {
    let cases =
        [(false, 0, 1, false), (true, 0, 2, false), (true, 12, 3, true), (false, 0, 4, true)];
    for (climbs, first, seed, every) in cases {
        let library = library(climbs, seed);
        let preferred = wishes(first, LengthMode::Preferred);
        let wishes = if every { of_every_kind(first) } else { preferred };
        let mut n_routes = 0;
        let target = Target::new(&library, &wishes);
        for item in 0..20 {
            let rng = &mut stream(seed, 9, item);
            let Some(route) = grow(&library, &target, rng) else { continue };
            let judged =
                judge(library.graph(), library.clips(), &wishes, &route.path).expect("long enough");
            let (fast, slow) = (route.score, judged.terms.total());
            assert!(
                (fast - slow).abs() <= 2e-3 * slow + 1e-3,
                "{fast} is not {slow}: {:?}",
                judged.terms
            );
            n_routes += 1;
        }
        assert!(n_routes > 10, "most seeds grow");
    }
}

/// Every candidate that any scan keeps with no limit must score what its path scores.
#[test]
fn candidates_score_what_their_paths_score() {
    let cases =
        [(false, 1, 0), (true, 2, 0), (true, 3, 0), (false, 4, 1), (true, 5, 1), (true, 6, 2)];
    for (climbs, seed, kind) in cases {
        let library = library(climbs, seed);
        let wishes = match kind {
            0 => wishes(0, LengthMode::Preferred),
            1 => of_every_kind(0),
            _ => of_every_kind(9),
        };
        let target = Target::new(&library, &wishes);
        let route = some_route(&library, &target, seed);
        let tables = Tables::new(&library, &target, &route);
        let all = vec![true; 6];
        let scans: [(&str, Scan); 6] = [
            ("reconnect", |e| e.reconnect()),
            ("detours", |e| e.detours(|| true)),
            ("rejoin", |e| e.rejoin()),
            ("new starts", |e| e.new_starts(&[0, -4, 4])),
            ("new ends", |e| e.new_ends(&[0, -4, 4])),
            ("moved ends", |e| e.move_ends()),
        ];
        for (name, scan) in scans {
            let best = Best::new(500, f32::MAX);
            let mut evaluator =
                Evaluator::new(&library, &target, (&all, true), &route, &tables, best);
            scan(&mut evaluator);
            let mut n = 0;
            for candidate in evaluator.best.candidates() {
                let path = candidate.mutation.apply(&route.path, &library.graph().forest);
                assert!(path.is_valid(library.graph()), "{name}: {:?}", candidate.mutation);
                let laid_out = Route::new(&library, &target, path).expect("a valid path");
                let error = (laid_out.score - candidate.score).abs();
                assert!(
                    error <= 1e-3 * laid_out.score + 2e-3,
                    "{name}: {:?} scores {} and was said to score {}",
                    candidate.mutation,
                    laid_out.score,
                    candidate.score
                );
                n += 1;
            }
            assert!(n > 0 || name == "rejoin", "{name} offers something");
        }
    }
}

/// The best reconnection and detour over all cuts, found by laying out every path.
#[test]
fn the_best_reconnection_and_detour_are_those_of_a_loop_over_all() {
    let library = library(true, 5);
    let target = Target::new(&library, &wishes(0, LengthMode::Preferred));
    let forest = &library.graph().forest;
    let all = vec![true; 6];
    for seed in 0..3 {
        let route = some_route(&library, &target, seed);
        let tables = Tables::new(&library, &target, &route);
        let n = route.spans.len();
        let mut least = [f32::INFINITY; 2];
        let mut n_paths = 0;
        let mut consider = |kind: usize, mutation: Mutation| {
            let path = mutation.apply(&route.path, forest);
            if let Some(new) = Route::new(&library, &target, path) {
                least[kind] = least[kind].min(new.score);
                n_paths += 1;
            }
        };
        for keep in 0..n {
            for resume in 0..n {
                let (from, to) = (route.spans[keep].clip, route.spans[resume].clip);
                for cut in library.pair(from, to).map_or(&[][..], |pair| pair.leaves) {
                    let there = resume == keep + 1 && route.path.cuts[keep] == cut.id;
                    if !there {
                        consider(0, Mutation::Reconnect { keep, resume, cut: cut.id });
                    }
                }
                for &(middle, out) in library.out(from) {
                    for back in library.pair(middle, to).map_or(&[][..], |pair| pair.chosen) {
                        let (out, back) = (out.id, back.id);
                        consider(1, Mutation::Detour { keep, resume, out, back });
                    }
                }
            }
        }
        let scans: [Scan; 2] = [|e| e.reconnect(), |e| e.detours(|| true)];
        for (kind, scan) in scans.into_iter().enumerate() {
            let best = Best::new(1, f32::MAX);
            let mut evaluator =
                Evaluator::new(&library, &target, (&all, true), &route, &tables, best);
            scan(&mut evaluator);
            let found = evaluator.best.least().unwrap_or(f32::INFINITY);
            assert!(
                (found - least[kind]).abs() <= 1e-3 * least[kind] + 2e-3,
                "kind {kind}: found {found}, the loop {}",
                least[kind]
            );
        }
        let problem = Problem {
            wishes: wishes(0, LengthMode::Preferred),
            allowed_clips: all.clone(),
            bridges: true,
        };
        let search = Search::new(Arc::clone(&library), problem, 0).expect("a problem");
        let whole = search.score_neighbourhood(&route.path).expect("a valid path");
        assert_eq!(whole.counts.scored, n_paths, "with no limit, every candidate is scored");
        let expected = least[0].min(least[1]);
        assert!((whole.least - expected).abs() <= 1e-3 * expected + 2e-3, "{whole:?} {expected}");
    }
}

#[test]
fn searching_is_the_same_on_any_number_of_threads() {
    let library = library(true, 7);
    let problem = Problem {
        wishes: wishes(0, LengthMode::Preferred),
        allowed_clips: vec![true; 6],
        bridges: true,
    };
    let run = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().expect("a pool");
        pool.install(|| {
            let mut search =
                Search::new(Arc::clone(&library), problem.clone(), 3).expect("a problem");
            for _ in 0..25 {
                assert!(search.step(&CancelToken::new()), "not cancelled");
            }
            (search.progress(), search.alternatives())
        })
    };
    let alone = run(1);
    assert!(alone.0.n_alternatives > 0, "{:?}", alone.0);
    assert_eq!(run(2), alone);
    assert_eq!(run(8), alone);
}

#[test]
fn a_cancelled_round_changes_nothing_and_the_search_goes_on() {
    let library = library(false, 8);
    let problem = Problem {
        wishes: wishes(0, LengthMode::Exact),
        allowed_clips: vec![true; 6],
        bridges: true,
    };
    let mut search = Search::new(library, problem, 3).expect("a problem");
    let go = CancelToken::new();
    for _ in 0..10 {
        search.step(&go);
    }
    let before = (search.progress(), search.alternatives());
    let stop = CancelToken::new();
    stop.cancel();
    assert!(!search.step(&stop), "a cancelled round says so");
    assert_eq!((search.progress(), search.alternatives()), before);
    assert!(search.step(&go), "and the next one goes on");
    assert_eq!(search.progress().iteration, 11);
    for found in search.alternatives() {
        let judged = search.judge(&found.path).expect("long enough");
        assert_eq!(judged.n_frames, 150, "an exact length is met");
    }
}

#[test]
fn a_palette_is_kept_to() {
    let library = library(false, 9);
    let allowed_clips = vec![true, false, true, true, false, true];
    let problem = Problem {
        wishes: wishes(0, LengthMode::Preferred),
        allowed_clips: allowed_clips.clone(),
        bridges: true,
    };
    let mut search = Search::new(Arc::clone(&library), problem, 3).expect("a problem");
    for _ in 0..20 {
        search.step(&CancelToken::new());
    }
    let found = search.alternatives();
    assert!(!found.is_empty(), "something is found");
    for found in found {
        for piece in found.path.pieces(library.graph()) {
            assert!(allowed_clips[piece.clip.idx()], "{piece:?} is not in the palette");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    /// The path rule: whatever the search does, pieces follow each other and show something.
    #[test]
    fn paths_of_any_search_are_valid(seed in 0u64..1000, first in 0u32..20, free: bool) {
        let library = library(seed % 2 == 0, 11);
        let mode = if free { LengthMode::Free } else { LengthMode::Preferred };
        let problem = Problem { wishes: wishes(first, mode), allowed_clips: vec![true; 6], bridges: true };
        let mut search = Search::new(Arc::clone(&library), problem, seed).expect("a problem");
        let mut before = f32::INFINITY;
        for _ in 0..6 {
            search.step(&CancelToken::new());
            let best = search.progress().best;
            prop_assert!(best <= before, "the best never gets worse");
            before = best;
        }
        for found in search.alternatives() {
            prop_assert!(found.path.is_valid(library.graph()), "{:?}", found.path);
            let pieces = found.path.pieces(library.graph());
            let n_frames: usize = pieces.iter().map(|piece| piece.n_frames()).sum();
            let judged = search.judge(&found.path).expect("long enough");
            prop_assert_eq!(n_frames, judged.n_frames as usize);
            prop_assert!((judged.terms.total() - found.score).abs() <= 2e-3 * found.score + 2e-3);
        }
    }
}

/// A pose and a lock of two pieces: whatever the search does, they are shown at their frames.
fn hard_wishes(library: &SearchLibrary) -> Wishes {
    let mut wishes = wishes(0, LengthMode::Preferred);
    wishes.poses = vec![PoseConstraint::new(60, ClipId(1), FrameIdx(50))];
    // Any cut of the library will do for the lock's.
    let cut = library.out(ClipId(2)).iter().map(|(to, cut)| (*to, *cut));
    let (to, cut) = cut
        .filter(|(to, cut)| cut.from >= 30 && cut.to + 50 < library.n_frames(*to))
        .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))
        .expect("a way out");
    let piece = |clip, from, to| Piece { clip, from: FrameIdx(from), to: FrameIdx(to) };
    let pieces = vec![piece(ClipId(2), cut.from - 6, cut.from - 1), piece(to, cut.to, cut.to + 5)];
    wishes.locks = vec![LockConstraint { from: 110, to: 121, pieces }];
    wishes
}

#[test]
fn what_is_hard_is_shown_at_its_time() {
    for seed in [1, 2, 4] {
        let library = library(false, seed);
        let wishes = hard_wishes(&library);
        let problem =
            Problem { wishes: wishes.clone(), allowed_clips: vec![true; 6], bridges: true };
        let mut search = Search::new(Arc::clone(&library), problem, seed).expect("possible");
        for _ in 0..12 {
            search.step(&CancelToken::new());
        }
        let found = search.alternatives();
        assert!(!found.is_empty(), "seed {seed}: something is found for {:?}", wishes.locks);
        for found in found {
            let judged = search.judge(&found.path).expect("long enough");
            assert!(judged.poses[0].0 && judged.locks[0], "{:?}", found.path);
            let (fast, slow) = (found.score, judged.terms.total());
            assert!((fast - slow).abs() <= 2e-3 * slow + 2e-3, "{fast} is not {slow}");
        }
    }
}

#[test]
fn hard_wishes_that_cannot_be_are_refused() {
    let library = library(false, 2);
    let search = |wishes: Wishes| {
        let problem = Problem { wishes, allowed_clips: vec![true; 6], bridges: true };
        Search::new(Arc::clone(&library), problem, 1).map(|_| ())
    };
    let pose =
        |frame, clip, clip_frame| PoseConstraint::new(frame, ClipId(clip), FrameIdx(clip_frame));
    let with = |poses| Wishes { poses, ..wishes(0, LengthMode::Preferred) };
    assert_eq!(
        search(with(vec![pose(40, 0, 10), pose(40, 1, 10)])),
        Err(ProblemError::HardConflict(HardWish::Pose(0), HardWish::Pose(1)))
    );
    assert_eq!(
        search(with(vec![pose(40, 0, 900)])),
        Err(ProblemError::HardNotThere(HardWish::Pose(0)))
    );
    // Cuts over a few frames of one clip are no cuts, and other clips may not be used.
    let wishes = with(vec![pose(40, 0, 10), pose(41, 0, 13)]);
    let allowed_clips = (0..6).map(|clip| clip == 0).collect();
    let problem = Problem { wishes, allowed_clips, bridges: true };
    let too_far = Search::new(Arc::clone(&library), problem, 1).map(|_| ());
    let (from, to) = (HardWish::Pose(0), HardWish::Pose(1));
    let expected = ProblemError::HardTooFar { from, to, needed: Some(2), available: 1 };
    assert_eq!(too_far, Err(expected));
    assert_eq!(search(with(vec![pose(40, 0, 10), pose(41, 0, 11)])), Ok(()));
}
