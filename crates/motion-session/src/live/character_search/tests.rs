//! A test for each rule about the shown take.

use std::path::Path as FilePath;

use motion_core::by_hand::Knot;
use motion_core::score::ScoreTerms;

use super::*;
use crate::command::{Command, apply};
use crate::document::{CharacterIdx, Document, HandChange, HandEdit};
use crate::fixture::{ready_library, walk_to};
use crate::problem::problem_of;

fn asked(document: &Document) -> CharacterProblem {
    let project = document.to_project();
    let library = ready_library().library;
    problem_of(&project, &project.characters[0], &library, true, FilePath::new("p")).unwrap()
}

pub(in crate::live) fn search() -> CharacterSearch {
    CharacterSearch::new(ready_library(), asked(&walk_to(0.8, 4.0)), 1, &[]).unwrap()
}

pub(in crate::live) fn rounds(search: &mut CharacterSearch, n: usize) {
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

fn turned(joint: &str, degrees: f64) -> ByHand {
    let mut layer = ByHand::default();
    let change = HandChange::Joint { joint: joint.to_owned(), turn_deg: [degrees, 0.0, 0.0] };
    layer.add(HandEdit { change, from: 20, to: 40, ease_in: 8, ease_out: 8 }).unwrap();
    layer
}

fn made_now(search: &mut CharacterSearch) -> Made {
    while search.finish_one(true) {}
    shown(search).made.expect("it is made")
}

#[test]
fn what_is_changed_by_hand_lies_on_the_motion_and_the_search_goes_on() {
    let mut search = search();
    rounds(&mut search, 10);
    let id = search.snapshot().takes[0].id;
    search.pick(id);
    let before = made_now(&mut search);
    let (iterations, score) = (search.snapshot().iterations, shown(&mut search).score);
    let layer = turned("LeftUpLeg", 30.0);
    search.lay([(id, &layer)].into_iter());
    let snapshot = search.snapshot();
    assert!(snapshot.is_stale(snapshot.shown().unwrap()));
    assert_eq!((snapshot.iterations, snapshot.shown().unwrap().score), (iterations, score));
    let made = made_now(&mut search);
    assert_eq!(made.before_hand.as_ref(), Some(&before.motion));
    assert_ne!(made.motion, before.motion);
    assert_eq!(made.version, before.version);
    search.lay(std::iter::empty());
    let again = made_now(&mut search);
    assert_eq!(
        (again.motion, again.before_hand, again.report),
        (before.motion, None, before.report)
    );
    search.lay([(id, &turned("Tail", 1.0))].into_iter());
    let remarks = search.snapshot().remarks;
    assert!(remarks.iter().any(|r| r.contains("\"joint-1\" turns \"Tail\"")), "{remarks:?}");
}

#[test]
fn a_refined_take_keeps_what_was_changed_by_hand() {
    let mut search = search();
    rounds(&mut search, 20);
    let picked = search.snapshot().takes.last().unwrap().id;
    search.pick(picked);
    let layer = turned("LeftUpLeg", 30.0);
    search.lay([(picked, &layer)].into_iter());
    for nth in 0..40 {
        drag_to(&mut search, 0.8 + 0.04 * f64::from(nth), Passing::By);
    }
    let made = made_now(&mut search);
    let take = shown(&mut search);
    assert_ne!(take.id, picked, "it was refined on the way");
    let by_hand = take.by_hand.clone().expect("it descends from a take with a layer");
    assert_eq!((by_hand.from, &*by_hand.layer), (picked, &layer));
    assert!(made.before_hand.is_some() && made.by_hand == Some(by_hand));
    // Its own layer comes before that of the take that it was made of.
    let own = ByHand::default();
    assert_eq!(take.stored("A").by_hand, Some(layer.clone()));
    search.lay([(picked, &layer), (take.id, &own)].into_iter());
    assert_eq!(made_now(&mut search).before_hand, None);
    assert_eq!(shown(&mut search).by_hand.map(|by_hand| by_hand.from), Some(take.id));
}

#[test]
fn misses_are_measured_on_the_retimed_motion() {
    let mut search = search();
    rounds(&mut search, 30);
    let id = search.snapshot().takes[0].id;
    search.pick(id);
    let before = made_now(&mut search);
    let n_frames = before.report.frames;
    let mut layer = ByHand::default();
    layer.set_retime(&[Knot { output: 40, source: 20.0 }]).unwrap();
    search.lay([(id, &layer)].into_iter());
    let made = made_now(&mut search);
    assert_eq!(
        (made.report.frames, made.motion.n_frames()),
        (n_frames + 20, n_frames as usize + 20)
    );
    let frames = made.source_frames.as_ref().unwrap();
    assert_eq!((frames[40], frames.len()), (20.0, made.motion.n_frames()));
    let [start, corner, end] = &made.report.final_[..] else { panic!("three checkpoints") };
    assert!(start.position_error_m < Some(1e-3) && corner.position_error_m > Some(0.1));
    assert!(end.position_error_m < Some(1e-3), "the last one is met where the motion ends");
    let late = |made: &Made| made.report.final_[2].frame_error.unwrap();
    assert_eq!(late(&made), late(&before) + 20);
    for (seam, was) in made.report.seams.iter().zip(&before.report.seams) {
        assert!(frames[seam.frame as usize] >= f64::from(was.frame));
    }
}

#[test]
fn joint_targets_are_wishes_and_measured_in_the_motion() {
    let target = |y_m: f64| Command::AddJointTarget {
        character: CharacterIdx(0),
        frame: 30,
        joint: "LeftFoot".to_owned(),
        position_m: [0.0, y_m, 1.0],
        velocity_m_s: Some([0.0; 3]),
    };
    let with = |y_m| asked(&apply(&walk_to(0.8, 4.0), &target(y_m)).unwrap());
    let mut search = search();
    rounds(&mut search, 10);
    let id = search.snapshot().takes[0].id;
    search.pick(id);
    let version = made_now(&mut search).version;
    let skeleton = search.ready.skeleton.clone();
    let foot = skeleton.find("LeftFoot").unwrap();
    for y_m in [0.5, 0.9] {
        search.ask(with(y_m), 1, Passing::Not).unwrap();
        while search.is_refining() {
            search.refine(&CancelToken::new());
        }
        let made = made_now(&mut search);
        assert_ne!(made.version, version, "it is asked");
        let report = made.report.final_.last().unwrap();
        assert_eq!((report.constraint.as_str(), report.kind.as_str()), ("joint-1", "joint"));
        let path_m = made.motion.joint_path_m(&skeleton, foot);
        let away_m = path_m[30].distance(glam::Vec3::new(0.0, y_m as f32, 1.0));
        assert!((report.position_error_m.unwrap() - f64::from(away_m)).abs() < 1e-5);
        let speed_m_s = path_m[31].distance(path_m[29]) * 15.0;
        assert!((report.velocity_error_m_s.unwrap() - f64::from(speed_m_s)).abs() < 1e-3);
    }
}

#[test]
fn what_would_help_is_tried_and_forgotten_with_what_was_asked() {
    let (file, ready) = (FilePath::new("p"), ready_library());
    let document = walk_to(0.8, 5.6);
    let mut search = CharacterSearch::new(ready.clone(), asked(&document), 1, &[]).unwrap();
    rounds(&mut search, 40);
    let ground = Ground {
        document: &document,
        character: CharacterIdx(0),
        library: &ready.library,
        project_path: file,
        bridges: true,
    };
    let cancelled = CancelToken::new();
    cancelled.cancel();
    assert!(search.suggest_one(&ground, &cancelled), "a change waits");
    assert_eq!(search.snapshot().suggestions, [], "nothing was tried");
    while search.suggest_one(&ground, &CancelToken::new()) {}
    let suggestions = search.snapshot().suggestions;
    assert!(!suggestions.is_empty(), "somebody walks there with more time");
    for one in &suggestions {
        assert!(crate::command::apply_all(&document, &one.commands).is_ok(), "{one:?}");
    }
    search.ask(asked(&walk_to(0.8, 5.5)), 1, Passing::Not).unwrap();
    assert_eq!(search.snapshot().suggestions, []);
}

#[test]
fn what_cannot_be_shown_is_refused_and_the_takes_stay() {
    let mut search = search();
    rounds(&mut search, 10);
    let before = search.snapshot();
    let pose = Command::AddPose {
        character: CharacterIdx(0),
        frame: 30,
        clip: "walk".to_owned(),
        clip_frame: 5,
        position_m: None,
        heading_deg: None,
    };
    let mut hard = asked(&apply(&walk_to(0.8, 4.0), &pose).unwrap());
    let clips = ready_library().library.clips;
    hard.problem.allowed_clips = clips.clips().iter().map(|clip| clip.id != "walk").collect();
    let refusal = search.ask(hard, 1, Passing::Not).unwrap_err();
    let expected =
        "character \"A\": pose \"pose-1\" shows frames that the clips in use do not have";
    assert!(refusal.starts_with(expected), "{refusal}");
    let after = search.snapshot();
    assert_eq!(after.shown, before.shown);
    let ids = |snapshot: &CharacterSnapshot| -> Vec<TakeId> {
        snapshot.takes.iter().map(|take| take.id).collect()
    };
    assert_eq!(ids(&after), ids(&before), "nothing is lost");
}
