//! A test for each rule of a history, and for what follows from them together.

use std::sync::Arc;

use motion_io::project_file;
use proptest::prelude::*;

use super::*;
use crate::command::arbitrary::{commands, is_sound};
use crate::document::{CharacterIdx, ConstraintRef};
use crate::sample;

fn history() -> History {
    History::new(Document::from_project(sample::sample().unwrap()))
}

fn at(id: &str) -> ConstraintRef {
    ConstraintRef::new(CharacterIdx(0), id)
}

fn moved(id: &str, x_m: f64) -> Command {
    Command::Move { at: at(id), position_m: [x_m, 2.0] }
}

fn bytes(document: &Document) -> String {
    project_file::write(&document.to_project())
}

#[test]
fn what_changes_nothing_makes_no_step() {
    let mut history = history();
    history.apply(&Command::SetSeed { seed: 1 }).unwrap();
    assert_eq!(history.n_steps(), (0, 0));
}

#[test]
fn what_is_refused_changes_nothing() {
    let mut history = history();
    let before = bytes(history.present());
    let both = [moved("end", 3.0), Command::Remove { at: at("start") }];
    assert_eq!(history.apply_all("Both", &both), Err(CommandError::StartStays));
    assert_eq!((bytes(history.present()), history.n_steps()), (before, (0, 0)));
}

#[test]
fn a_gesture_is_one_step_however_much_is_previewed() {
    let mut history = history();
    let before = bytes(history.present());
    history.begin_gesture("Move end");
    for step in 0..60 {
        history.preview(&[moved("end", f64::from(step))]).unwrap();
        history.preview(&[moved("corner", 1.0)]).unwrap();
        history.note_frame();
    }
    history.preview(&[moved("end", 3.0)]).unwrap();
    history.commit();
    let corner = history.present().constraint(&at("corner")).cloned();
    assert_eq!(history.n_steps(), (1, 0));
    assert_eq!(history.undo_label(), Some("Move end"));
    assert!(history.undo());
    assert_eq!(bytes(history.present()), before);
    assert_eq!(history.present().constraint(&at("corner")).cloned(), corner, "each preview anew");
}

#[test]
fn a_gesture_that_comes_to_nothing_leaves_no_step_and_what_can_be_redone() {
    let mut history = history();
    history.apply(&moved("end", 3.0)).unwrap();
    history.undo();
    for cancelled in [true, false] {
        history.begin_gesture("Move end");
        history.preview(&[moved("end", 4.0)]).unwrap();
        if cancelled {
            assert!(history.cancel());
        } else {
            history.preview(&[]).unwrap();
            history.commit();
        }
        assert_eq!(history.n_steps(), (0, 1));
    }
}

#[test]
fn a_new_step_drops_what_could_be_redone() {
    let mut history = history();
    history.apply(&moved("end", 3.0)).unwrap();
    history.undo();
    assert_eq!(history.redo_label(), Some("Move"));
    history.apply(&moved("end", 4.0)).unwrap();
    assert_eq!(history.n_steps(), (1, 0));
    assert!(!history.redo());
}

#[test]
fn undo_redo_and_edits_cancel_a_gesture_under_way() {
    let mut history = history();
    let first = bytes(history.present());
    history.apply(&moved("end", 3.0)).unwrap();
    let before = bytes(history.present());
    history.begin_gesture("Move end");
    history.preview(&[moved("end", 9.0)]).unwrap();
    assert!(history.undo());
    assert_eq!((bytes(history.present()), history.n_steps()), (before, (1, 0)));
    history.begin_gesture("Move end");
    history.preview(&[moved("end", 9.0)]).unwrap();
    history.apply(&moved("corner", 1.0)).unwrap();
    assert!(!history.is_in_gesture());
    history.undo();
    history.undo();
    assert_eq!(bytes(history.present()), first);
}

#[test]
fn undo_and_redo_bring_back_the_very_documents() {
    let mut history = history();
    let first = Arc::clone(&history.present().characters);
    history.apply(&moved("end", 3.0)).unwrap();
    let second = Arc::clone(&history.present().characters);
    history.undo();
    assert!(Arc::ptr_eq(&history.present().characters, &first));
    history.redo();
    assert!(Arc::ptr_eq(&history.present().characters, &second));
}

#[test]
fn the_oldest_steps_are_forgotten() {
    let document = Document::from_project(sample::sample().unwrap());
    let mut few = History::with_limits(document.clone(), 3, usize::MAX);
    let mut small = History::with_limits(document, usize::MAX, 1);
    for nth in 0..10 {
        few.apply(&moved("end", f64::from(nth))).unwrap();
        small.apply(&moved("end", f64::from(nth))).unwrap();
    }
    assert_eq!(few.n_steps(), (3, 0));
    assert_eq!(small.n_steps(), (1, 0), "one step back there always is");
    assert!(few.undo() && few.undo() && few.undo() && !few.undo());
}

#[test]
fn a_step_every_frame_is_noticed() {
    let mut history = history();
    for nth in 0..60 {
        history.apply(&moved("end", f64::from(nth / 4))).unwrap();
        history.note_frame();
    }
    assert!(!history.has_a_step_every_frame(), "a step every fourth frame is a person's");
    for nth in 0..60 {
        history.apply(&moved("end", f64::from(nth))).unwrap();
        history.note_frame();
    }
    assert!(history.has_a_step_every_frame());
}

#[test]
fn two_hundred_edits_undone_give_the_same_bytes() {
    let mut history = history();
    let mut texts = vec![bytes(history.present())];
    let mut nth = 0.0;
    while history.n_steps().0 < 200 {
        nth += 1.0;
        let frame = 20 + (nth as u32) % 80;
        let commands = [
            Command::AddCheckpoint {
                character: CharacterIdx(0),
                frame,
                position_m: [nth / 7.0, 0.1 * nth],
                heading_deg: frame.is_multiple_of(2).then_some(nth / 3.0),
            },
            moved("end", nth / 9.0),
            Command::SetTermWeight { term: "body".to_owned(), weight: Some(nth / 11.0) },
            Command::RenameProject { name: format!("p{nth}") },
        ];
        for command in &commands {
            // A frame that is taken is refused; that is fine here.
            if history.apply(command).is_ok() {
                texts.push(bytes(history.present()));
            }
        }
    }
    for text in texts.iter().rev() {
        assert_eq!(bytes(history.present()), *text);
        history.undo();
    }
    for text in &texts[1..] {
        history.redo();
        assert_eq!(bytes(history.present()), *text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_is_done_is_sound_and_can_be_undone(commands in commands(1..60)) {
        let mut history = history();
        let first = bytes(history.present());
        for command in commands {
            let before = history.present().clone();
            let steps = history.n_steps();
            match history.apply(&command) {
                Ok(()) => is_sound(history.present())?,
                Err(error) => {
                    prop_assert!(!error.to_string().is_empty(), "a refusal is a sentence");
                    prop_assert_eq!(history.present(), &before);
                    prop_assert_eq!(history.n_steps(), steps);
                }
            }
        }
        let last = bytes(history.present());
        while history.undo() {
            is_sound(history.present())?;
        }
        prop_assert_eq!(bytes(history.present()), first);
        while history.redo() {}
        prop_assert_eq!(bytes(history.present()), last);
    }
}

/// What a window does to a history.
#[derive(Clone, Debug)]
enum Op {
    Apply(Command),
    Begin,
    Preview(Command),
    Commit,
    Cancel,
    Undo,
    Redo,
}

fn ops() -> impl Strategy<Value = Vec<Op>> {
    let command = || commands(1..2).prop_map(|mut commands| commands.remove(0));
    let op = prop_oneof![
        3 => command().prop_map(Op::Apply),
        2 => Just(Op::Begin),
        4 => command().prop_map(Op::Preview),
        2 => Just(Op::Commit),
        1 => Just(Op::Cancel),
        2 => Just(Op::Undo),
        2 => Just(Op::Redo),
    ];
    prop::collection::vec(op, 1..60)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn gestures_and_undo_in_any_order_keep_every_document_sound(ops in ops()) {
        let mut history = history();
        let first = bytes(history.present());
        for op in ops {
            let settled = bytes(history.settled());
            let (n_past, n_future) = history.n_steps();
            match op {
                Op::Apply(command) => drop(history.apply(&command)),
                Op::Begin => history.begin_gesture("Drag"),
                Op::Preview(command) => {
                    // A refusal leaves the last preview.
                    drop(history.preview(&[command]));
                    prop_assert_eq!(history.n_steps(), (n_past, n_future), "no step yet");
                    if history.is_in_gesture() {
                        prop_assert_eq!(bytes(history.settled()), settled);
                    }
                }
                Op::Commit => history.commit(),
                Op::Cancel => {
                    history.cancel();
                    prop_assert_eq!(bytes(history.present()), settled);
                    prop_assert_eq!(history.n_steps(), (n_past, n_future));
                }
                Op::Undo => {
                    history.undo();
                }
                Op::Redo => {
                    history.redo();
                }
            }
            is_sound(history.present())?;
            prop_assert!(history.n_steps().0 <= n_past + 1, "one step at a time");
        }
        while history.undo() {}
        prop_assert_eq!(bytes(history.present()), first);
    }
}
