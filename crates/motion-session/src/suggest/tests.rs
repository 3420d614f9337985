//! Changes that are suggested help, and are small.

use std::path::Path as FilePath;

use motion_core::cancel::CancelToken;
use motion_io::project_file::Tolerance;

use super::*;
use crate::command::{apply, apply_all};
use crate::document::{CharacterIdx, ConstraintRef, Document};
use crate::fixture::{ready_library, walk_to};
use crate::problem::problem_of;
use crate::solve_job::{Alternative, Found, SolveRequest, solve};
use crate::unmet::missed::missed;

const ROUNDS: u64 = 40;

/// What is found for a document on the small library.
fn found_for(document: &Document) -> (crate::problem::CharacterProblem, Found) {
    let ready = ready_library();
    let project = document.to_project();
    let character = &project.characters[0];
    let asked = problem_of(&project, character, &ready.library, true, FilePath::new("p"));
    let asked = asked.expect("it can be asked");
    let request = SolveRequest {
        library: ready.search,
        problem: asked.problem.clone(),
        seed: 1,
        kind: Default::default(),
        budget: crate::budget::Budget::Iterations(ROUNDS),
        n_alternatives: 4,
    };
    let found = solve(request, &CancelToken::new(), &mut |_, _| ()).expect("it can be searched");
    (asked, found)
}

fn suggested(document: &Document) -> Vec<Suggestion> {
    let ready = ready_library();
    let (asked, found) = found_for(document);
    let ground = Ground {
        document,
        character: CharacterIdx(0),
        library: &ready.library,
        project_path: FilePath::new("p"),
        bridges: true,
    };
    let budget = crate::budget::Budget::Iterations(ROUNDS);
    let cancel = CancelToken::new();
    after_solve::suggest(&ground, &asked, (&ready.search, 1), &found, budget, &cancel)
}

#[test]
fn nothing_is_suggested_where_nothing_is_missed() {
    let tolerance = Tolerance {
        position_m: Some(2.0),
        heading_deg: Some(90.0),
        frames: Some(60.0),
        ..Tolerance::default()
    };
    let at = ConstraintRef::new(CharacterIdx(0), "end");
    let wide = Command::SetTolerance { at, tolerance: Some(tolerance) };
    let document = apply(&walk_to(0.8, 4.0), &wide).expect("a tolerance");
    let (asked, found) = found_for(&document);
    assert_eq!(missed(&asked.problem.wishes, &found.alternatives[0].judgement), []);
    assert_eq!(suggested(&document), []);
}

#[test]
fn changes_that_meet_what_was_missed_the_smallest_first() {
    // So far that nobody walks there in the time.
    let document = walk_to(0.8, 5.6);
    let all = suggested(&document);
    assert!((2..=3).contains(&all.len()), "{all:?}");
    assert_eq!(all[0].change, Change::Length, "a few frames are the least: {all:?}");
    for one in &all {
        assert!(one.score_after < one.score_before, "{one:?}");
        assert!(one.sentence.contains(": score −") && !one.sentence.contains("still"), "{one:?}");
        assert!(one.sentence.contains(" %"), "{one:?}");
        let changed = apply_all(&document, &one.commands).expect("it was tried");
        let (asked, found) = found_for(&changed);
        let is_met = |alternative: &Alternative| {
            missed(&asked.problem.wishes, &alternative.judgement).is_empty()
        };
        assert!(found.alternatives.iter().any(is_met), "{}", one.sentence);
    }
    assert_eq!(all, suggested(&document), "equal rounds, equal words");
}

#[test]
fn everything_behind_a_longer_stretch_comes_later() {
    let document = walk_to(0.8, 5.6);
    let style = Command::AddStyle {
        character: CharacterIdx(0),
        from: 100,
        to: 119,
        tag: "walk".to_owned(),
    };
    let document = apply(&document, &style).expect("a style");
    let (asked, found) = found_for(&document);
    let best = &found.alternatives[0];
    let ready = ready_library();
    let of = (&document, CharacterIdx(0));
    let case = Case::new(of, &asked, &ready.library, &best.path, &best.judgement);
    let longer = length::candidates(&case.expect("it is missed"))
        .into_iter()
        .find(|candidate| {
            candidate.words.starts_with("give it") && candidate.words.ends_with("more")
        })
        .expect("more frames");
    let n: u32 = longer.words.split(' ').nth(2).and_then(|n| n.parse().ok()).expect("a number");
    let changed = apply_all(&document, &longer.commands).expect("a change of the document");
    let frame = |document: &Document, id: &str| {
        let at = ConstraintRef::new(CharacterIdx(0), id);
        document.constraint(&at).map(|constraint| constraint.kind.last_frame())
    };
    assert_eq!(frame(&changed, "end"), Some(119 + n));
    assert_eq!(frame(&changed, "style-1"), Some(119 + n), "a style that goes on to the end does");
    assert_eq!(frame(&changed, "corner"), Some(60), "what comes before stays");
    let length = changed.character(CharacterIdx(0)).and_then(|c| c.length.as_ref()?.frames);
    assert_eq!(length, Some(120 + n));
}
