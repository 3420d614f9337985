//! Casts on the library of wanderers.

use super::testing::{checkpoint, library, meeting, problem};
use super::track::corrected_track_m;
use super::*;
use crate::ids::ClipId;
use crate::planar::PlanarTransform;
use crate::score::lay_end_to_end;
use crate::search::Search;
use crate::units::FrameIdx;

fn rounds(cast: &mut Cast, n: u64) {
    for _ in 0..n {
        assert!(cast.step(&CancelToken::new()), "nobody cancels");
    }
}

/// Two who come from two sides, meet and go on.
fn meeting_cast() -> CastProblem {
    CastProblem {
        characters: vec![
            problem(vec![checkpoint(0, -3.4, 0.0, 90.0)]),
            problem(vec![checkpoint(0, 3.4, 0.3, 270.0)]),
        ],
        interactions: vec![meeting(75, 1.0)],
    }
}

fn meeting_search(library: &Arc<SearchLibrary>, seed: u64) -> Cast {
    let libraries = [Arc::clone(library), Arc::clone(library)];
    Cast::new(&libraries, meeting_cast(), seed).expect("a cast")
}

/// Torsos of every frame in the world, before correction.
fn torsos(
    library: &SearchLibrary,
    solution: &CastSolution,
    character: usize,
) -> Vec<PlanarTransform> {
    let pieces = solution.paths[character].pieces(library.graph());
    let start = solution.judgements[character].world_from_start;
    lay_end_to_end(library.clips(), &pieces).into_iter().map(|torso| start * torso).collect()
}

/// The least distance of the two once both are corrected onto their places.
fn least_distance_m(library: &SearchLibrary, solution: &CastSolution) -> f32 {
    let track =
        |c: usize| corrected_track_m(&torsos(library, solution, c), &solution.problems[c].wishes);
    let distances = track(0).into_iter().zip(track(1)).map(|(a, b)| a.distance(b));
    distances.fold(f32::INFINITY, f32::min)
}

#[test]
fn two_meet_in_their_poses_at_their_places_to_each_other() {
    let library = library();
    let mut cast = meeting_search(&library, 1);
    rounds(&mut cast, 40);
    let found = cast.alternatives(6);
    assert!(!found.is_empty(), "they meet");
    let interaction = &cast.problem().interactions[0];
    for solution in &found {
        for character in 0..2 {
            let (is_shown, _) = solution.judgements[character].poses[0];
            assert!(is_shown, "poses are hard");
        }
    }
    let best = &found[0];
    let at = |c: usize| torsos(&library, best, c)[75];
    let b_from_a = at(1).inverse() * at(0);
    let members = &interaction.members;
    let wished = members[1].interaction_from_torso.inverse() * members[0].interaction_from_torso;
    let off_m = b_from_a.ground_m().distance(wished.ground_m());
    let off_deg = (wished.inverse() * b_from_a).heading_rad().to_degrees().abs();
    // Each of the two is within a tolerance.
    assert!(off_m <= 0.6, "{off_m} m, {:?}", best.judgements);
    assert!(off_deg <= 20.0, "{off_deg}");
    for (judged, problem) in best.judgements.iter().zip(&best.problems) {
        let pose = problem.wishes.poses[0];
        assert!(judged.poses[0].1.is_within(&pose.tolerance), "{:?}", judged.poses);
    }
}

#[test]
fn places_of_both_members_are_one_place() {
    let library = library();
    let mut cast = meeting_search(&library, 2);
    rounds(&mut cast, 24);
    for solution in cast.alternatives(4) {
        for (character, problem) in solution.problems.iter().enumerate() {
            let member = cast.problem().interactions[0].members[character];
            let place = solution.places[0] * member.interaction_from_torso;
            let pose = problem.wishes.poses[0].place().expect("it is placed");
            assert!(pose.position_m.distance(place.ground_m()) < 1e-5, "{pose:?}");
            assert_eq!(pose.frame, 75);
        }
    }
}

#[test]
fn combinations_are_best_first_and_each_has_a_new_motion() {
    let library = library();
    let mut cast = meeting_search(&library, 3);
    rounds(&mut cast, 24);
    let found = cast.alternatives(8);
    assert!(found.is_sorted_by(|a, b| a.score <= b.score), "best first");
    for (nth, solution) in found.iter().enumerate() {
        let is_new = (0..2).any(|c| found[..nth].iter().all(|s| s.paths[c] != solution.paths[c]));
        assert!(found.len() == 1 || is_new, "{nth}");
        let sum: f32 = solution.judgements.iter().map(|judged| judged.terms.total()).sum();
        // Nobody comes near anybody here but in the meeting.
        assert!((sum - solution.score).abs() < 1e-2 * (1.0 + sum), "{sum} {}", solution.score);
    }
}

#[test]
fn two_whose_ways_cross_keep_out_of_each_other() {
    let library = library();
    let cast = CastProblem {
        characters: vec![
            problem(vec![checkpoint(0, 0.0, -2.2, 0.0), checkpoint(119, 0.0, 2.2, 0.0)]),
            problem(vec![checkpoint(0, -2.2, 0.0, 90.0), checkpoint(119, 2.2, 0.0, 90.0)]),
        ],
        interactions: vec![],
    };
    let libraries = [Arc::clone(&library), Arc::clone(&library)];
    let mut cast = Cast::new(&libraries, cast, 1).expect("a cast");
    // One steps aside, then the other: that takes more than a few turns.
    rounds(&mut cast, 224);
    let found = cast.alternatives(4);
    let best = &found[0];
    let least_m = least_distance_m(&library, best);
    assert!(least_m >= 0.4, "{least_m}");
    for judged in &best.judgements {
        assert!(judged.body.iter().all(|error| error.position_m < 0.6), "{:?}", judged.body);
    }
    // By themselves they would walk through each other.
    let alone: Vec<Search> = cast
        .problem()
        .characters
        .iter()
        .zip(1..)
        .map(|(problem, seed)| {
            let mut search = Search::new(Arc::clone(&library), problem.clone(), seed).expect("one");
            for _ in 0..48 {
                assert!(search.step(&CancelToken::new()));
            }
            search
        })
        .collect();
    let tracks: Vec<Vec<PlanarTransform>> = alone
        .iter()
        .map(|search| {
            let path = search.best().expect("a motion").path;
            let start = search.judge(&path).expect("judged").world_from_start;
            let laid = lay_end_to_end(library.clips(), &path.pieces(library.graph()));
            laid.into_iter().map(|torso| start * torso).collect()
        })
        .collect();
    let pairs = tracks[0].iter().zip(&tracks[1]);
    let through_m =
        pairs.map(|(a, b)| a.ground_m().distance(b.ground_m())).fold(f32::INFINITY, f32::min);
    assert!(through_m < 0.4, "{through_m}: it proves nothing");
}

#[test]
fn equal_seeds_find_equal_casts_on_any_number_of_threads() {
    let library = library();
    let found = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().expect("a pool");
        pool.install(|| {
            let mut cast = meeting_search(&library, 7);
            rounds(&mut cast, 24);
            cast.alternatives(6)
        })
    };
    let one = found(1);
    assert!(!one.is_empty(), "there is something to compare");
    for n_threads in [2, 8] {
        assert!(found(n_threads) == one, "{n_threads} threads");
    }
}

#[test]
fn a_cast_of_one_is_a_plain_search() {
    let library = library();
    let alone = problem(vec![checkpoint(0, 0.0, 0.0, 0.0), checkpoint(110, 2.0, 3.0, 60.0)]);
    let one = CastProblem { characters: vec![alone.clone()], interactions: vec![] };
    let mut cast = Cast::new(&[Arc::clone(&library)], one, 5).expect("a cast");
    let mut search = Search::new(Arc::clone(&library), alone, 5).expect("a search");
    for _ in 0..40 {
        assert!(cast.step(&CancelToken::new()) && search.step(&CancelToken::new()));
        assert_eq!(cast.progress(), [search.progress()]);
    }
    let (found, plain) = (cast.alternatives(10), search.alternatives());
    assert_eq!(found.len(), plain.len().min(10));
    for (solution, plain) in found.iter().zip(&plain) {
        assert_eq!(solution.paths, std::slice::from_ref(&plain.path));
        assert_eq!(solution.iterations, [plain.iteration]);
        assert_eq!(Some(&solution.judgements[0]), search.judge(&plain.path).as_ref());
    }
}

#[test]
fn who_has_nothing_to_do_with_anybody_is_searched_as_if_alone() {
    let library = library();
    let there = |x: f32| problem(vec![checkpoint(0, x, 0.0, 0.0), checkpoint(110, x, 3.5, 0.0)]);
    let far = CastProblem { characters: vec![there(0.0), there(40.0)], interactions: vec![] };
    let libraries = [Arc::clone(&library), Arc::clone(&library)];
    let mut cast = Cast::new(&libraries, far, 5).expect("a cast");
    rounds(&mut cast, 32);
    let found = cast.alternatives(6);
    for (character, x) in [(0, 0.0), (1, 40.0)] {
        let seed = 5 + character as u64;
        let mut search = Search::new(Arc::clone(&library), there(x), seed).expect("a search");
        for _ in 0..32 {
            assert!(search.step(&CancelToken::new()), "nobody cancels");
        }
        for (rank, solution) in found.iter().enumerate() {
            let plain = search.alternatives();
            let expected = plain.get(rank).unwrap_or(&plain[0]);
            assert_eq!(solution.paths[character], expected.path, "{character} {rank}");
        }
    }
}

#[test]
fn a_cancelled_round_is_gone_on_with() {
    let library = library();
    let mut cast = meeting_search(&library, 4);
    let cancelled = CancelToken::new();
    cancelled.cancel();
    assert!(!cast.step(&cancelled));
    assert_eq!(cast.iteration(), 0);
    rounds(&mut cast, 20);
    let mut other = meeting_search(&library, 4);
    rounds(&mut other, 20);
    assert!(cast.alternatives(3) == other.alternatives(3), "as if nothing had been");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let library = library();
    let two = || vec![problem(vec![]), problem(vec![])];
    let libraries = [Arc::clone(&library), Arc::clone(&library)];
    let refused = |interaction: Interaction| {
        let cast = CastProblem { characters: two(), interactions: vec![interaction] };
        Cast::new(&libraries, cast, 1).expect_err("it makes no sense")
    };
    let mut nobody = meeting(75, 1.0);
    nobody.members[1].character = 2;
    assert_eq!(refused(nobody), CastError::NobodyThere { interaction: 0 });
    let mut twice = meeting(75, 1.0);
    twice.members[1].character = 0;
    assert_eq!(refused(twice), CastError::Twice { interaction: 0 });
    assert_eq!(refused(meeting(75, f32::NAN)), CastError::NotFinite { interaction: 0 });
    let mut conflict = two();
    conflict[1].wishes.poses.push(crate::constraint::PoseConstraint::new(
        75,
        ClipId(3),
        FrameIdx(7),
    ));
    let cast = CastProblem { characters: conflict, interactions: vec![meeting(75, 1.0)] };
    let error = Cast::new(&libraries, cast, 1).expect_err("two poses at one frame");
    assert!(matches!(error, CastError::Character { character: 1, .. }), "{error:?}");
    let cast = CastProblem { characters: two(), interactions: vec![] };
    let error = Cast::new(&libraries[..1], cast, 1).expect_err("a library is missing");
    assert_eq!(error, CastError::Libraries { libraries: 1, characters: 2 });
}
