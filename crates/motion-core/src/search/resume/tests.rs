//! Kept paths scored anew, against a fresh walk over their frames.

use glam::Vec2;

use super::*;
use crate::constraint::{BodyConstraint, LengthWish, Tolerance};
use crate::score::judge;
use crate::testing::wander;

fn library() -> Arc<SearchLibrary> {
    let clips = wander::clips(6, 90, false, 5);
    let graph = wander::graph(&clips);
    Arc::new(SearchLibrary::new(Arc::new(clips), Arc::new(graph)))
}

/// From the origin past a checkpoint to a place `x` metres to the left.
fn problem(x: f32, mode: LengthMode) -> Problem {
    let checkpoint = |frame, x, z| BodyConstraint {
        frame,
        position_m: Vec2::new(x, z),
        heading_rad: 0.3,
        height_m: None,
        weight: 1.0,
        tolerance: Tolerance::default(),
    };
    let length = Some(LengthWish { frames: 150, mode, weight: 1.0 });
    let body = vec![checkpoint(0, 0.0, 0.0), checkpoint(70, 0.5 * x, 2.5), checkpoint(149, x, 4.5)];
    let wishes = Wishes { length, body, ..Wishes::default() };
    Problem { wishes, allowed_clips: vec![true; 6], bridges: true }
}

fn run(search: &mut Search, n_rounds: u64) {
    for _ in 0..n_rounds {
        assert!(search.step(&CancelToken::new()));
    }
}

#[test]
fn rescored_paths_score_what_a_fresh_walk_over_their_frames_finds() {
    let library = library();
    let mut search =
        Search::new(Arc::clone(&library), problem(2.0, LengthMode::Preferred), 1).unwrap();
    run(&mut search, 12);
    let known = search.paths();
    assert!(known.len() > 10, "there is something to score");
    for x in [1.9f32, 0.0, -3.0] {
        let asked = problem(x, LengthMode::Preferred);
        let again = search.rescored(asked.clone(), &[]).unwrap();
        let found = again.alternatives();
        let mut best = f32::INFINITY;
        for path in &known {
            let Some(judged) = judge(library.graph(), library.clips(), &asked.wishes, path) else {
                continue;
            };
            best = best.min(judged.terms.total());
        }
        assert!((found[0].score - best).abs() <= 2e-3 * best + 1e-3, "{} {best}", found[0].score);
        for solution in &found {
            assert!(known.contains(&solution.path), "nothing is made up");
            let judged = again.judge(&solution.path).expect("it was scored").terms.total();
            assert!((solution.score - judged).abs() <= 2e-3 * judged + 1e-3);
        }
        assert!(found.is_sorted_by(|a, b| a.score <= b.score));
    }
}

#[test]
fn a_search_goes_on_from_what_it_knows_and_depends_on_nothing_else() {
    let library = library();
    let mut search =
        Search::new(Arc::clone(&library), problem(2.0, LengthMode::Preferred), 1).unwrap();
    run(&mut search, 12);
    let asked = problem(1.0, LengthMode::Preferred);
    let mut again = search.rescored(asked.clone(), &[]).unwrap();
    let at_first = again.progress().best;
    run(&mut again, 40);
    assert!(again.progress().best < at_first, "lines go downhill from kept paths");
    assert_eq!(again.progress().iteration, 52);
    let improved = again.alternatives().into_iter().filter(|s| s.improves.is_some()).count();
    assert!(improved > 0, "minima know what they came from");
    let mut twin = search.rescored(asked, &[]).unwrap();
    run(&mut twin, 40);
    assert_eq!(twin.alternatives(), again.alternatives());
}

#[test]
fn paths_that_may_not_be_used_are_left_out() {
    let library = library();
    let mut search =
        Search::new(Arc::clone(&library), problem(2.0, LengthMode::Preferred), 1).unwrap();
    run(&mut search, 8);
    let mut narrow = problem(2.0, LengthMode::Preferred);
    narrow.allowed_clips[0] = false;
    let again = search.rescored(narrow, &[]).unwrap();
    for solution in again.alternatives() {
        let pieces = solution.path.pieces(library.graph());
        assert!(pieces.iter().all(|piece| piece.clip.idx() != 0));
    }
    let exact = search.rescored(problem(2.0, LengthMode::Exact), &[]).unwrap();
    for solution in exact.alternatives() {
        assert_eq!(exact.judge(&solution.path).unwrap().n_frames, 150);
    }
}

#[test]
fn a_path_is_improved_step_by_step_until_it_is_a_minimum() {
    let library = library();
    for mode in [LengthMode::Preferred, LengthMode::Exact] {
        let mut search =
            Search::new(Arc::clone(&library), problem(2.0, LengthMode::Preferred), 3).unwrap();
        run(&mut search, 3);
        let mut path = search.best().unwrap().path;
        // Far longer than what it was found for: the checkpoint in the middle is out of reach.
        let mut asked = problem(2.0, mode);
        for constraint in &mut asked.wishes.body[1..] {
            constraint.frame += 120;
        }
        if let Some(length) = &mut asked.wishes.length {
            length.frames += 120;
        }
        let search = search.rescored(asked.clone(), &[]).unwrap();
        assert!(search.judge(&path).is_none());
        let mut score = f32::INFINITY;
        let mut n_steps = 0;
        while let Some(better) = search.improve(&path, &CancelToken::new()) {
            assert_eq!(better.improves.as_ref(), Some(&path));
            assert!(better.score < score || score.is_infinite(), "{} {score}", better.score);
            (path, score) = (better.path, better.score);
            n_steps += 1;
            assert!(n_steps < 200, "downhill must end");
        }
        let judged = search.judge(&path).expect("it is long enough now");
        assert!((judged.terms.total() - score).abs() < 2e-3 * score + 1e-3);
        assert!(mode != LengthMode::Exact || judged.n_frames == 270);
    }
}

#[test]
fn shaking_keeps_what_was_found() {
    let mut search = Search::new(library(), problem(2.0, LengthMode::Preferred), 1).unwrap();
    run(&mut search, 8);
    let before = search.alternatives();
    search.shake();
    assert_eq!(search.alternatives(), before);
    run(&mut search, 1);
    assert!(search.progress().best <= before[0].score);
}

#[test]
fn varied_paths_are_other_paths_and_the_same_every_time() {
    let library = library();
    let mut search =
        Search::new(Arc::clone(&library), problem(1.0, LengthMode::Preferred), 1).unwrap();
    run(&mut search, 12);
    let path = search.alternatives()[0].path.clone();
    let varied = |search: &Search| -> Vec<Path> {
        (0..40).filter_map(|nth| search.varied(&path, nth)).map(|found| found.path).collect()
    };
    let first = varied(&search);
    assert!(first.len() > 5, "{} of 40 draws fit", first.len());
    assert!(first.iter().all(|other| *other != path && other.is_valid(library.graph())));
    run(&mut search, 3);
    assert_eq!(varied(&search), first, "it does not depend on how far the search is");
}
