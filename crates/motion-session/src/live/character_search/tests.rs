//! A test for each rule about the shown take.

use std::path::Path as FilePath;

use motion_core::score::ScoreTerms;

use super::*;
use crate::document::Document;
use crate::fixture::{ready_library, walk_to};
use crate::problem::problem_of;

fn asked(document: &Document) -> CharacterProblem {
    let project = document.to_project();
    let library = ready_library().library;
    problem_of(&project, &project.characters[0], &library, true, FilePath::new("p")).unwrap()
}

fn search() -> CharacterSearch {
    CharacterSearch::new(ready_library(), asked(&walk_to(0.8, 4.0)), 1, &[]).unwrap()
}

fn rounds(search: &mut CharacterSearch, n: usize) {
    for _ in 0..n {
        assert!(search.round(&CancelToken::new()));
    }
}

/// Another place for the end, and refined until that is done.
fn drag_to(search: &mut CharacterSearch, x_m: f64, passing: Passing) {
    search.ask(asked(&walk_to(x_m, 4.0)), 1, passing).unwrap();
    while search.is_refining() {
        search.refine(&CancelToken::new());
    }
}

fn shown(search: &mut CharacterSearch) -> Take {
    search.snapshot().shown().expect("something is shown").clone()
}

#[test]
fn at_first_the_best_is_shown_until_it_is_acceptable() {
    let mut search = search();
    let mut n_changes = 0;
    let mut last = None;
    for _ in 0..FIRST_ROUNDS_AT_MOST {
        rounds(&mut search, 1);
        let snapshot = search.snapshot();
        let is_provisional = search.shown.as_ref().is_some_and(|shown| shown.is_provisional);
        if is_provisional {
            assert_eq!(snapshot.shown, snapshot.takes.first().map(|take| take.id));
        }
        n_changes += usize::from(snapshot.shown != last);
        last = snapshot.shown;
    }
    assert!(n_changes > 0);
    assert!(search.shown.as_ref().is_some_and(|shown| !shown.is_provisional));
}

#[test]
fn then_it_changes_only_by_choice_and_what_is_better_is_a_badge() {
    let mut search = search();
    rounds(&mut search, 2);
    let worst = search.snapshot().takes.last().unwrap().id;
    search.pick(worst);
    rounds(&mut search, 40);
    let snapshot = search.snapshot();
    assert_eq!((snapshot.shown, snapshot.picked), (Some(worst), Some(worst)));
    let better = snapshot.better.expect("forty rounds find something better");
    assert_eq!(Some(better.take), snapshot.takes.first().map(|take| take.id));
    assert!(better.by_percent > 1.0 && better.by_percent <= 100.0, "{better:?}");
    search.follow_best(true);
    let snapshot = search.snapshot();
    assert_eq!(snapshot.shown, Some(better.take));
    assert_eq!(snapshot.better, None);
}

#[test]
fn after_a_hundred_drags_the_shown_take_descends_from_the_picked_one() {
    let mut search = search();
    rounds(&mut search, 20);
    let picked = search.snapshot().takes.last().unwrap().id;
    search.pick(picked);
    let mut n_changes = 0;
    let mut before = picked;
    for nth in 0..100 {
        drag_to(&mut search, 0.8 + 1.5 * f64::from(nth) / 100.0, Passing::By);
        if nth % 10 == 0 {
            rounds(&mut search, 1);
        }
        let take = shown(&mut search);
        assert!(search.shown_descends_from(picked), "drag {nth}");
        n_changes += usize::from(take.id != before);
        before = take.id;
    }
    assert!(n_changes > 0, "it was refined on the way");
    let snapshot = search.snapshot();
    assert_eq!(snapshot.picked, Some(picked));
    let take = snapshot.shown().unwrap();
    let unrefined = search.seen.iter().find(|(id, _)| *id == picked).unwrap().1.clone();
    let unrefined = search.search.judge(&unrefined).unwrap().terms.total();
    assert!(take.score < unrefined, "{} is not below {unrefined}", take.score);
}

#[test]
fn back_at_earlier_constraints_their_takes_are_there_at_once() {
    let mut search = search();
    rounds(&mut search, 30);
    let second = search.snapshot().takes[1].id;
    search.pick(second);
    let first = search.snapshot();
    for nth in 1..=20 {
        let passing = if nth == 20 { Passing::Not } else { Passing::By };
        drag_to(&mut search, 0.8 + 0.1 * f64::from(nth), passing);
        rounds(&mut search, 1);
    }
    let moved = search.snapshot();
    assert_ne!(moved.version, first.version);
    search.ask(asked(&walk_to(0.8, 4.0)), 1, Passing::Not).unwrap();
    let back = search.snapshot();
    let ids = |s: &CharacterSnapshot| s.takes.iter().map(|take| take.id).collect::<Vec<_>>();
    assert_eq!(back.version, first.version);
    assert_eq!(ids(&back), ids(&first));
    assert_eq!(back.shown, Some(second));
    search.ask(asked(&walk_to(2.8, 4.0)), 1, Passing::Not).unwrap();
    assert_eq!(search.snapshot().shown, moved.shown, "redo brings back what undo took");
}

#[test]
fn scores_are_those_of_a_search_that_begins_with_the_same_paths() {
    let mut search = search();
    rounds(&mut search, 10);
    drag_to(&mut search, 2.0, Passing::Not);
    let snapshot = search.snapshot();
    let fresh = Search::new(search.ready.search.clone(), asked(&walk_to(2.0, 4.0)).problem, 1);
    let fresh = fresh.unwrap();
    for take in &snapshot.takes {
        let path = search.ready.path(&take.pieces).expect("pieces name the path");
        let judged = fresh.judge(&path).unwrap();
        // Edges of two levels between the same frames differ in what they cost.
        let but_cuts = |terms: ScoreTerms| ScoreTerms { continuity: 0.0, ..terms };
        assert_eq!(but_cuts(judged.terms), but_cuts(take.terms));
        assert_eq!(take.misses.len(), 3);
        assert_eq!(judged.n_frames, take.n_frames);
    }
}

#[test]
fn motions_are_made_the_shown_one_first_and_are_stale_after_an_edit() {
    let mut search = search();
    rounds(&mut search, 10);
    let last = search.snapshot().takes.last().unwrap().id;
    search.pick(last);
    assert!(search.finish_one(false));
    let snapshot = search.snapshot();
    let made: Vec<TakeId> =
        snapshot.takes.iter().filter(|take| !snapshot.is_stale(take)).map(|take| take.id).collect();
    assert_eq!(made, [last]);
    while search.finish_one(false) {}
    let snapshot = search.snapshot();
    assert!(snapshot.takes.iter().all(|take| !snapshot.is_stale(take)));
    search.ask(asked(&walk_to(1.0, 4.0)), 1, Passing::By).unwrap();
    let snapshot = search.snapshot();
    assert!(snapshot.is_stale(snapshot.shown().unwrap()));
    assert!(snapshot.shown().unwrap().made.is_some(), "there is something to see meanwhile");
    assert!(search.finish_one(true));
    let snapshot = search.snapshot();
    assert!(!snapshot.is_stale(snapshot.shown().unwrap()));
}

#[test]
fn kept_takes_are_always_there() {
    let mut search = search();
    rounds(&mut search, 1);
    let worst = search.snapshot().takes.last().unwrap().clone();
    let path = search.ready.path(&worst.pieces).unwrap();
    search.pin(&[path]);
    rounds(&mut search, 60);
    drag_to(&mut search, 2.0, Passing::Not);
    let snapshot = search.snapshot();
    assert!(snapshot.take(worst.id).is_some_and(|take| take.is_pinned));
}
