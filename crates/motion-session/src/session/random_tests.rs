//! Whatever a window asks of a session, in any order, while it searches.

use std::collections::BTreeMap;
use std::time::Duration;

use motion_io::project_file;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

use super::*;
use crate::command::arbitrary::{commands, is_sound};
use crate::document::{ConstraintRef, ObstacleIdx};
use crate::fixture::{ready_library, walk_to};
use crate::playback::PlayRange;
use crate::selection::Selectable;

/// What a window does.
#[derive(Clone, Debug)]
enum Op {
    Apply(Command),
    Begin,
    Preview(Command),
    Commit,
    Cancel,
    Undo,
    Redo,
    Select(Selectable),
    Activate(usize),
    Play(PlaybackCommand),
    PickAny(usize),
    Shake,
    FollowBest(bool),
    Poll(f64),
}

fn command() -> impl Strategy<Value = Command> {
    let good = prop_oneof![
        (-2.0..2.0f64, 2.0..6.0f64).prop_map(|(x_m, z_m)| Command::Move {
            at: ConstraintRef::new(CharacterIdx(0), "end"),
            position_m: [x_m, z_m],
        }),
        (20u32..110).prop_map(|frame| Command::Retime {
            at: ConstraintRef::new(CharacterIdx(0), "corner"),
            frame,
        }),
    ];
    // Without its library there would be nothing to search.
    let any = commands(1..2)
        .prop_map(|mut commands| commands.remove(0))
        .prop_filter("its library stays", |c| !matches!(c, Command::SetLibrary { .. }));
    prop_oneof![2 => good, 3 => any]
}

fn op() -> impl Strategy<Value = Op> {
    let selectable = prop_oneof![
        (0usize..3).prop_map(|nth| Selectable::Character(CharacterIdx(nth))),
        prop::sample::select(vec!["start", "corner", "end", "body-1", "none"])
            .prop_map(|id| Selectable::Constraint(ConstraintRef::new(CharacterIdx(0), id))),
        (0usize..3).prop_map(|nth| Selectable::Obstacle(ObstacleIdx(nth))),
        (1usize..3).prop_map(|nth| Selectable::Interaction(format!("interaction-{nth}"))),
    ];
    let range = (0u32..400, 0u32..400)
        .prop_map(|(from, to)| PlaybackCommand::SetRange(Some(PlayRange { from, to })));
    let play = prop_oneof![
        Just(PlaybackCommand::Play),
        Just(PlaybackCommand::Stop),
        Just(PlaybackCommand::ToEnd),
        Just(PlaybackCommand::SetRange(None)),
        (-50.0..500.0f64).prop_map(PlaybackCommand::GoTo),
        any::<i32>().prop_map(PlaybackCommand::Step),
        prop_oneof![-9.0..9.0f64, Just(f64::NAN)].prop_map(PlaybackCommand::SetSpeed),
        range,
    ];
    prop_oneof![
        6 => command().prop_map(Op::Apply),
        2 => Just(Op::Begin),
        5 => command().prop_map(Op::Preview),
        2 => Just(Op::Commit),
        1 => Just(Op::Cancel),
        3 => Just(Op::Undo),
        2 => Just(Op::Redo),
        2 => selectable.prop_map(Op::Select),
        1 => (0usize..3).prop_map(Op::Activate),
        3 => play.prop_map(Op::Play),
        1 => (0usize..5).prop_map(Op::PickAny),
        1 => Just(Op::Shake),
        1 => any::<bool>().prop_map(Op::FollowBest),
        6 => prop_oneof![0.0..0.2f64, Just(f64::NAN), Just(1e9)].prop_map(Op::Poll),
    ]
}

fn session() -> Session {
    let options = SessionOptions {
        state_folder: None,
        wake: Arc::new(|| ()),
        builtin: Some(ready_library()),
        project: Some(walk_to(0.8, 4.0).to_project()),
    };
    Session::new(options).expect("the system has threads")
}

fn carry_out(session: &mut Session, op: Op) {
    match op {
        // A refusal changes nothing, which the sweep sees.
        Op::Apply(command) => drop(session.apply(&command)),
        Op::Begin => session.begin_gesture("Drag"),
        Op::Preview(command) => drop(session.preview(&[command])),
        Op::Commit => session.commit(),
        Op::Cancel => session.cancel(),
        Op::Undo => drop(session.undo()),
        Op::Redo => drop(session.redo()),
        Op::Select(item) => session.selection_mut().add(item),
        Op::Activate(nth) => session.set_active(CharacterIdx(nth)),
        Op::Play(command) => session.play(command),
        Op::PickAny(nth) => {
            let takes = session.snapshot().characters.first().map(|c| c.takes.as_slice());
            if let Some(take) = takes.and_then(|takes| takes.get(nth)).map(|take| take.id) {
                session.pick(CharacterIdx(0), take);
            }
        }
        Op::Shake => session.search().shake(),
        Op::FollowBest(follow) => session.search().follow_best(follow),
        Op::Poll(dt_secs) => {
            std::thread::sleep(Duration::from_millis(3));
            session.poll(dt_secs);
        }
    }
}

/// Names of characters, in order.
fn names(document: &Document) -> Vec<String> {
    document.characters().iter().map(|character| character.name.clone()).collect()
}

/// What must hold after everything. `submitted` gathers whom each request was about.
fn sweep(
    session: &Session,
    submitted: &mut BTreeMap<u64, Vec<String>>,
) -> Result<(), TestCaseError> {
    let document = session.document();
    is_sound(document)?;
    is_sound(session.history().settled())?;
    let (n_past, n_future) = session.history().n_steps();
    // A gesture under way is what undo would take back.
    let can_undo = n_past > 0 || session.history().is_in_gesture();
    prop_assert_eq!(session.history().undo_label().is_some(), can_undo);
    prop_assert_eq!(session.history().redo_label().is_some(), n_future > 0);
    prop_assert_eq!(session.history().past_labels().count(), n_past);

    prop_assert!(document.character(session.active()).is_some(), "somebody is active");
    for item in session.selection().items(document) {
        prop_assert!(item.exists_in(document));
    }

    let playback = session.playback();
    let (range, n_frames) = (playback.range(), playback.n_frames());
    prop_assert!(n_frames >= 1 && range.from <= range.to && range.to < n_frames);
    let last = f64::from(n_frames - 1);
    prop_assert!((0.0..=last).contains(&playback.frame()), "{} of {last}", playback.frame());

    if let Some((number, asked)) = session.live.submitted() {
        let newest = submitted.last_key_value().map_or(0, |(number, _)| *number);
        prop_assert!(number <= newest + 1, "a step asks once");
        submitted.entry(number).or_insert_with(|| names(asked));
    }
    let snapshot = session.snapshot();
    if snapshot.request > 0 {
        let about: Vec<_> = snapshot.characters.iter().map(|c| c.name.clone()).collect();
        prop_assert_eq!(submitted.get(&snapshot.request), Some(&about));
    }
    for character in &snapshot.characters {
        let is_there = character.shown.is_none_or(|shown| character.take(shown).is_some());
        prop_assert!(is_there, "what is shown is among the takes");
    }
    prop_assert!(!session.live.has_died());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, max_shrink_iters: 60, ..Default::default() })]

    #[test]
    fn whatever_is_asked_in_any_order_everything_fits_together(
        ops in prop::collection::vec(op(), 20..80)
    ) {
        let mut session = session();
        let first = project_file::write(&session.document().to_project());
        let mut submitted = BTreeMap::new();
        sweep(&session, &mut submitted)?;
        for op in ops {
            carry_out(&mut session, op);
            sweep(&session, &mut submitted)?;
        }
        while session.undo() {
            sweep(&session, &mut submitted)?;
        }
        prop_assert_eq!(project_file::write(&session.document().to_project()), first);
    }
}

/// With the search at work on each of them, unlike in the history's own test.
#[test]
fn two_hundred_edits_undone_give_the_same_bytes_and_the_same_question() {
    let mut session = session();
    let bytes = |session: &Session| project_file::write(&session.document().to_project());
    let mut texts = vec![bytes(&session)];
    let mut nth = 0u32;
    while session.history().n_steps().0 < 200 {
        nth += 1;
        let position_m = [f64::from(nth % 17) / 10.0, 4.0];
        let at = ConstraintRef::new(CharacterIdx(0), "end");
        let command = match nth % 3 {
            0 => Command::RenameProject { name: format!("p{nth}") },
            1 => Command::SetSeed { seed: u64::from(nth) },
            _ => Command::Move { at, position_m },
        };
        let n_before = session.history().n_steps().0;
        session.apply(&command).unwrap();
        session.poll(1.0 / 60.0);
        if session.history().n_steps().0 > n_before {
            texts.push(bytes(&session));
        }
    }
    for text in texts.iter().rev() {
        assert_eq!(bytes(&session), *text);
        session.undo();
        session.poll(1.0 / 60.0);
    }
    for text in &texts[1..] {
        assert!(session.redo());
        assert_eq!(bytes(&session), *text);
    }
    while session.undo() {}
    assert_eq!(bytes(&session), texts[0]);
    let (_, asked) = session.live.submitted().unwrap();
    assert_eq!(asked, session.document(), "what is searched is what is there");
}
