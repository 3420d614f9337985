//! A session as a window has it, without one.

use std::fs;
use std::thread;
use std::time::Duration;

use motion_core::by_hand::{Limb, Space};
use motion_io::project_file::{self, ConstraintKind};
use motion_scene::color::Theme;
use serde_json::json;

use super::*;
use crate::document::{ByHand, ConstraintRef, HandChange, HandEdit};
use crate::fixture::{ready_library, walk_to};

pub(super) fn session(state_folder: Option<&Path>) -> Session {
    let options = SessionOptions {
        state_folder: state_folder.map(Path::to_owned),
        wake: Arc::new(|| ()),
        builtin: Some(ready_library()),
        project: Some(walk_to(0.8, 4.0).to_project()),
    };
    Session::new(options).unwrap()
}

pub(super) fn moved(x_m: f64) -> Command {
    let at = ConstraintRef::new(CharacterIdx(0), "end");
    Command::Move { at, position_m: [x_m, 4.0] }
}

/// Polls until it is as wanted.
#[track_caller]
pub(super) fn until(session: &mut Session, what: &str, wanted: impl Fn(&Session) -> bool) {
    for _ in 0..4_000 {
        session.poll(0.0);
        if wanted(session) {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    panic!("never {what}: {:?}", session.state());
}

pub(super) fn has_motion(session: &Session) -> bool {
    session.shown().is_some_and(|shown| shown.take.made.is_some())
}

fn autosaves(folder: &Path) -> usize {
    let ending = |path: &Path| path.extension().is_some_and(|e| e == "autosave");
    fs::read_dir(folder).unwrap().filter(|entry| ending(&entry.as_ref().unwrap().path())).count()
}

/// Polls until so many autosaves are there, letting no time pass.
#[track_caller]
fn until_autosaves(session: &mut Session, folder: &Path, n: usize) {
    until(session, "autosaved", |_| autosaves(folder) == n);
}

#[test]
fn a_motion_comes_and_plays_without_a_click() {
    let mut session = session(None);
    until(&mut session, "with a motion", has_motion);
    session.play(PlaybackCommand::Play);
    assert!(session.poll(0.5).frame);
    let frame = session.shown().unwrap().frame;
    assert!((frame - 15.0).abs() < 1e-9, "half a second at 30 frames per second, {frame}");
    assert!(session.playback().n_frames() > 60);
}

#[test]
fn everything_that_is_done_is_undone_and_the_search_follows() {
    let mut session = session(None);
    until(&mut session, "with a motion", has_motion);
    let first = session.snapshot().characters[0].version;
    let text = project_file::write(&session.document().to_project());
    session.begin_gesture("Move end");
    for nth in 0..30 {
        session.preview(&[moved(0.8 + 0.02 * f64::from(nth))]).unwrap();
        session.poll(1.0 / 60.0);
    }
    session.commit();
    assert_eq!(session.history().undo_label(), Some("Move end"));
    until(&mut session, "re-scored", |s| s.snapshot().characters[0].version != first);
    assert!(session.undo());
    assert_eq!(project_file::write(&session.document().to_project()), text);
    until(&mut session, "back", |s| s.snapshot().characters[0].version == first);
    assert!(session.redo() && !session.redo());
    assert!(!session.history().has_a_step_every_frame());
}

#[test]
fn a_saved_project_is_opened_as_it_was() {
    let (dir, state) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let path = dir.path().join("walk.gaitway");
    let mut first = session(Some(state.path()));
    assert!(!first.is_changed());
    assert!(first.save().is_err(), "it has no file yet");
    until(&mut first, "with a motion", has_motion);
    let take = first.shown().unwrap().take.stored("A");
    let id = take.id();
    first.apply(&Command::PinTake { take }).unwrap();
    first.view().set("camera", json!([1, 2, 3]));
    assert!(first.is_changed());
    first.save_as(&path).unwrap();
    assert!(!first.is_changed());
    let bytes = fs::read(&path).unwrap();

    let mut second = session(Some(state.path()));
    let error = second.open(&path).unwrap_err();
    assert_eq!(error.what, "it is open in another window");
    first.close();
    second.open(&path).unwrap();
    assert_eq!(second.path(), Some(path.as_path()));
    assert_eq!(second.view().get("camera"), Some(&json!([1, 2, 3])));
    assert!(second.document().takes().get("A", id).is_some_and(|take| take.pinned));
    until(&mut second, "with the kept take", |s| {
        s.snapshot().character(CharacterIdx(0)).is_some_and(|c| c.take(id).is_some())
    });
    second.save().unwrap();
    assert_eq!(fs::read(&path).unwrap(), bytes);
}

#[test]
fn what_was_not_saved_is_recovered_after_a_crash() {
    let (dir, state) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let path = dir.path().join("walk.gaitway");
    let mut crashing = session(Some(state.path()));
    crashing.save_as(&path).unwrap();
    crashing.apply(&moved(1.0)).unwrap();
    crashing.poll(AUTOSAVE_SECS / 2.0);
    assert_eq!(autosaves(state.path()), 0, "not yet");
    crashing.poll(AUTOSAVE_SECS / 2.0);
    until_autosaves(&mut crashing, state.path(), 1);
    let text = project_file::write(&crashing.document().to_project());
    // A session that is not closed leaves what a crash would.
    drop(crashing);

    let mut next = session(Some(state.path()));
    let recoveries = next.recoveries();
    assert_eq!(recoveries.len(), 1);
    assert_eq!(recoveries[0].file.as_deref(), Some(path.as_path()));
    next.recover(&recoveries[0]).unwrap();
    assert_eq!(project_file::write(&next.document().to_project()), text);
    assert!(next.is_changed() && next.recoveries().is_empty());
    next.save().unwrap();
    assert!(!next.is_changed());
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
    until_autosaves(&mut next, state.path(), 0);
}

#[test]
fn a_gesture_under_way_is_not_kept_and_saving_removes_the_autosave() {
    let state = tempfile::tempdir().unwrap();
    let mut session = session(Some(state.path()));
    session.begin_gesture("Move end");
    session.preview(&[moved(1.0)]).unwrap();
    session.poll(10.0 * AUTOSAVE_SECS);
    session.cancel();
    session.poll(10.0 * AUTOSAVE_SECS);
    assert_eq!((autosaves(state.path()), session.is_changed()), (0, false));
    session.apply(&moved(1.0)).unwrap();
    session.poll(AUTOSAVE_SECS);
    until_autosaves(&mut session, state.path(), 1);
    session.undo();
    session.poll(0.0);
    until_autosaves(&mut session, state.path(), 0);
    session.redo();
    session.poll(AUTOSAVE_SECS);
    session.close();
    assert_eq!(autosaves(state.path()), 0);
}

#[test]
fn a_library_that_is_not_there_is_said_and_the_session_goes_on() {
    let mut session = session(None);
    until(&mut session, "with a motion", has_motion);
    session.apply(&Command::SetLibrary { library: "none.gwlib".to_owned() }).unwrap();
    until(&mut session, "an error", |s| matches!(s.state(), SearchState::Error(_)));
    let SearchState::Error(sentence) = session.state() else { panic!("it was one just now") };
    assert!(sentence.contains("there is no such file; check the path"), "{sentence}");
    session.undo();
    until(&mut session, "searching again", |s| s.state() == SearchState::Searching);
}

#[test]
fn other_windows_keep_their_hands_off_a_broken_file() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("broken.gaitway");
    motion_io::atomic_write::atomic_write(&path, b"{\"gaitway\": 1,").unwrap();
    let mut session = session(None);
    let before = session.document().clone();
    assert!(session.open(&path).is_err());
    assert_eq!((session.document(), session.path()), (&before, None));
}

#[test]
fn the_stage_has_the_document_at_once_and_the_shown_take_as_soon_as_there_is_one() {
    let mut session = session(None);
    let stage = session.stage(Theme::Dark);
    assert_eq!((stage.actors.len(), stage.roles[0].constraints.len()), (0, 3));
    until(&mut session, "with a motion", has_motion);
    let stage = session.stage(Theme::Dark);
    let shown = session.shown().unwrap().take;
    assert_eq!(stage.actors[0].motion, shown.made.as_ref().unwrap().motion);
    assert_eq!(stage.roles[0].misses.len(), 3);
    assert!(!stage.scene_at(3.5, Default::default()).scene.bodies.is_empty());
    assert!(session.actor_in(CharacterIdx(0), shown.id, Theme::Dark).is_some());
    assert!(session.actor_in(CharacterIdx(0), TakeId(0), Theme::Dark).is_none());
    // What is dragged is where it is dragged to, whatever the search does meanwhile.
    session.begin_gesture("Move end");
    session.preview(&[moved(1.7)]).unwrap();
    let stage = session.stage(Theme::Dark);
    let ConstraintKind::Body { position_m, .. } = stage.roles[0].constraints[2].kind else {
        panic!("the end is a place")
    };
    assert_eq!(position_m, [1.7, 4.0]);
}

/// The shown take's motion, if it is made for what the document says now.
fn motion_now(session: &Session) -> Option<Arc<motion_core::motion::Motion>> {
    let snapshot = session.snapshot().character(CharacterIdx(0))?;
    let shown = snapshot.shown().filter(|take| !snapshot.is_stale(take))?;
    Some(Arc::clone(&shown.made.as_ref()?.motion))
}

fn hand_up(y_m: f64) -> HandEdit {
    let (limb, space) = (Limb::LeftFoot, Space::World);
    let change = HandChange::Hand { limb, shift_m: [0.0, y_m, 0.0], space };
    HandEdit { change, from: 30, to: 40, ease_in: 10, ease_out: 10 }
}

#[test]
fn a_change_by_hand_is_dragged_undone_redone_and_saved() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("walk.gaitway");
    let mut session = session(None);
    until(&mut session, "with a motion", has_motion);
    session.search().pause();
    until(&mut session, "paused", |s| s.state() == SearchState::Paused && motion_now(s).is_some());
    session.pick(CharacterIdx(0), session.shown().unwrap().take.id);
    let (before, take) = (motion_now(&session).unwrap(), session.shown().unwrap().take.clone());
    let rounds = session.snapshot().characters[0].iterations;

    let stored = take.stored("A");
    session.begin_gesture("Lift foot");
    for nth in 1..=10 {
        let edit = hand_up(0.01 * f64::from(nth));
        session.preview(&[Command::AddByHand { take: stored.clone(), edit }]).unwrap();
        session.poll(1.0 / 60.0);
    }
    session.commit();
    let layer = session.document().takes().get("A", take.id).unwrap().by_hand.clone().unwrap();
    assert_eq!(layer.edit("hand-1"), Some(&hand_up(0.1)));
    let is_lifted = |s: &Session| motion_now(s).is_some_and(|motion| motion != before);
    let has = |s: &Session, layer: &ByHand| {
        let shown = s.shown().and_then(|shown| shown.take.by_hand.clone());
        shown.is_some_and(|by_hand| *by_hand.layer == *layer && by_hand.from == take.id)
    };
    until(&mut session, "lifted", |s| is_lifted(s) && has(s, &layer));
    let lifted = motion_now(&session).unwrap();
    let made = session.shown().unwrap().take.made.clone().unwrap();
    assert_eq!(made.before_hand.as_ref(), Some(&before), "there is a ghost of what it was");
    assert_eq!(session.snapshot().characters[0].iterations, rounds, "nothing was searched");

    assert!(session.undo());
    until(&mut session, "as before", |s| motion_now(s).is_some_and(|motion| motion == before));
    assert!(session.document().takes().get("A", take.id).is_none());
    assert!(session.redo());
    until(&mut session, "lifted again", |s| motion_now(s).is_some_and(|motion| motion == lifted));

    session.save_as(&path).unwrap();
    session.begin_new(&walk_to(0.8, 4.0).to_project());
    session.open(&path).unwrap();
    let takes = session.document().takes();
    assert_eq!(takes.get("A", take.id).and_then(|take| take.by_hand.as_ref()), Some(&layer));
    session.search().resume();
    session.pick(CharacterIdx(0), take.id);
    until(&mut session, "with the kept take", |s| {
        s.snapshot().characters[0].take(take.id).is_some_and(|take| take.by_hand.is_some())
    });
}

/// Whoever opens a project after a crash before he looks at what can be recovered loses nothing.
#[test]
fn what_a_crash_has_left_of_a_file_outlives_opening_it_and_working_on() {
    let (dir, state) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let path = dir.path().join("walk.gaitway");
    let mut crashing = session(Some(state.path()));
    crashing.save_as(&path).unwrap();
    crashing.apply(&moved(1.0)).unwrap();
    crashing.poll(AUTOSAVE_SECS);
    until_autosaves(&mut crashing, state.path(), 1);
    let text = project_file::write(&crashing.document().to_project());
    drop(crashing);

    let mut next = session(Some(state.path()));
    next.open(&path).unwrap();
    next.apply(&moved(2.0)).unwrap();
    next.poll(AUTOSAVE_SECS);
    until_autosaves(&mut next, state.path(), 2);
    next.save().unwrap();
    until_autosaves(&mut next, state.path(), 1);
    let recoveries = next.recoveries();
    assert_eq!(project_file::write(&recoveries[0].project), text);
    assert!(recoveries[0].file_is_newer);
    assert_eq!(recoveries[0].file.as_deref(), Some(path.as_path()));

    next.recover(&recoveries[0]).unwrap();
    assert!(next.is_changed() && next.recoveries().is_empty());
    assert!(session(Some(state.path())).open(&path).is_err(), "the file is held, too");
    assert_eq!(autosaves(state.path()), 1, "until it is saved");
    next.save().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
    until_autosaves(&mut next, state.path(), 0);
}

#[test]
fn an_autosave_that_fails_is_tried_again_and_said_once() {
    let state = tempfile::tempdir().unwrap();
    let folder = state.path().join("state");
    let mut session = session(Some(&folder));
    let aside = state.path().join("aside");
    fs::rename(&folder, &aside).unwrap();
    session.apply(&moved(1.0)).unwrap();
    for _ in 0..20 {
        session.poll(AUTOSAVE_SECS);
        thread::sleep(Duration::from_millis(10));
    }
    let remarks = session.take_remarks();
    let failed = remarks.iter().filter(|remark| remark.contains("the autosave failed"));
    assert_eq!(failed.count(), 1, "{remarks:?}");
    fs::rename(&aside, &folder).unwrap();
    for _ in 0..200 {
        session.poll(AUTOSAVE_SECS);
        if autosaves(&folder) == 1 {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    panic!("never tried again");
}

#[test]
fn a_pose_and_its_place_are_met() {
    let mut session = session(None);
    until(&mut session, "with a motion", has_motion);
    session.search().pause();
    until(&mut session, "paused", |s| s.state() == SearchState::Paused && motion_now(s).is_some());
    let piece = session.shown().unwrap().take.pieces[0].clone();
    let pose = |position_m: Option<[f64; 2]>| Command::AddPose {
        character: CharacterIdx(0),
        frame: 0,
        clip: piece.clip.clone(),
        clip_frame: piece.from,
        position_m,
        heading_deg: None,
    };
    // It begins at the origin with this very pose.
    session.apply_all("Pose", &[pose(None), pose(Some([3.0, -4.0]))]).unwrap();
    let pose_report = |s: &Session, nth: usize| {
        let made = s.shown()?.take.made.as_ref()?;
        let mut poses = made.report.final_.iter().filter(|report| report.kind == "pose");
        poses.nth(nth).cloned()
    };
    until(&mut session, "measured", |s| pose_report(s, 1).is_some());
    let anywhere = pose_report(&session, 0).unwrap();
    assert_eq!((anywhere.met, anywhere.position_error_m), (Some(true), None));
    let placed = pose_report(&session, 1).unwrap();
    assert_eq!(placed.met, Some(true));
    assert!(placed.position_error_m.is_some_and(|m| m < 1e-3), "{placed:?}");
}
