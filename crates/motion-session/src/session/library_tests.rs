//! Imports and libraries of a session: in the background, undoable, leaving nothing behind.

use std::fs;
use std::thread;
use std::time::Duration;

use motion_tests::walker::{Walk, small_library};

use super::tests::{has_motion, moved, session, until};
use super::*;
use crate::import_report::ImportOutcome;

const REPLACE: ImportChoices = ImportChoices { present: PresentLibrary::Replace, recursive: false };
const KEEP: ImportChoices = ImportChoices { present: PresentLibrary::Keep, recursive: false };

/// The small library's walks as files.
fn walks() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    for (name, walk) in small_library() {
        put(dir.path(), &format!("{name}.bvh"), &walk.bvh());
    }
    dir
}

fn put(folder: &Path, name: &str, text: &str) {
    motion_io::atomic_write::atomic_write(&folder.join(name), text.as_bytes()).unwrap();
}

/// Walks that the small library does not have, of another body.
fn others() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let walk = |phase| Walk { n_frames: 50, speed_m_s: 1.0, phase, size: 1.1, ..Walk::default() };
    put(dir.path(), "stroll.bvh", &walk(0.3).bvh());
    put(dir.path(), "amble.bvh", &walk(0.6).bvh());
    dir
}

#[track_caller]
fn imported(session: &mut Session, what: &str) -> crate::import_report::ImportReport {
    let is_over = |s: &Session| !matches!(s.import(), ImportState::Running(_));
    until(session, what, is_over);
    match session.import() {
        ImportState::Done(report) => report.clone(),
        other => panic!("{what}: {other:?}"),
    }
}

fn libraries(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| name.contains("gwlib"));
    names.sort();
    names
}

fn ids(session: &Session) -> Vec<String> {
    let clips = session.library().map(|ready| ready.library.clips.clips().iter());
    clips.into_iter().flatten().map(|clip| clip.id.clone()).collect()
}

#[test]
fn a_folder_takes_the_place_of_the_built_in_library_in_one_step() {
    let (state, walks) = (tempfile::tempdir().unwrap(), walks());
    put(walks.path(), "broken.bvh", "HIERARCHY\n");
    let mut session = session(Some(state.path()));
    until(&mut session, "with a motion", has_motion);
    let before = session.library().unwrap().clone();
    let inputs = vec![walks.path().to_owned(), walks.path().join("walk.bvh")];
    session.begin_import(inputs, ImportChoices::default()).unwrap();
    let again = session.begin_import(Vec::new(), ImportChoices::default());
    assert!(matches!(again, Err(ImportRefusal::UnderWay)));
    let (mut share, mut stages) = (0.0, Vec::new());
    for _ in 0..4_000 {
        session.poll(0.0);
        let ImportState::Running(progress) = session.import() else { break };
        assert!((share..=1.0).contains(&progress.share), "{progress:?} after {share}");
        share = progress.share;
        if stages.last() != Some(&progress.stage) {
            stages.push(progress.stage.clone());
        }
        thread::sleep(Duration::from_millis(1));
    }
    assert!(stages.len() > 1, "{stages:?}");
    let report = imported(&mut session, "imported");
    let totals = &report.totals;
    let n_walks = small_library().len();
    assert_eq!((totals.n_imported, totals.n_skipped, totals.n_refused), (n_walks, 1, 1));
    assert_eq!((totals.n_kept, totals.n_clips), (0, n_walks));
    let broken = report.lines.iter().find(|line| line.path.ends_with("broken.bvh")).unwrap();
    assert_eq!(
        broken.text(),
        "broken.bvh: refused: line 1: the file ends before MOTION; export it again, it is cut off"
    );
    assert!(
        report.text().contains("walk.bvh: skipped, the same as clip walk"),
        "{}",
        report.text()
    );

    assert_eq!(libraries(&state.path().join("libraries")), ["walk.gwlib"]);
    assert_eq!(session.history().undo_label(), Some("Import clips"));
    assert_eq!(session.history().n_steps(), (1, 0));
    assert!(Path::new(session.document().library()).is_absolute());
    // What was built is in use at once, and not opened again.
    assert!(session.library_progress().is_none() && ids(&session).len() == n_walks);
    until(&mut session, "with a motion of the new one", |s| {
        has_motion(s) && s.snapshot().request > 0
    });
    session.undo();
    assert!(session.library().unwrap().is(&before));
    session.redo();
    until(&mut session, "redone", |s| ids(s).len() == n_walks);
    let state = session.import().clone();
    assert!(matches!(state, ImportState::Done(_)));
    session.dismiss_import();
    assert_eq!(*session.import(), ImportState::Idle);
}

#[test]
fn clips_join_a_library_and_every_library_stays_a_file_of_its_own() {
    let (project, walks, others) = (tempfile::tempdir().unwrap(), walks(), others());
    let mut session = session(None);
    let nowhere = session.begin_import(vec![walks.path().to_owned()], REPLACE);
    assert!(matches!(nowhere, Err(ImportRefusal::NoPlace)));
    session.save_as(&project.path().join("My walk.gaitway")).unwrap();
    session.begin_import(vec![walks.path().to_owned()], REPLACE).unwrap();
    imported(&mut session, "imported");
    assert_eq!(session.document().library(), "My walk.gwlib");
    let first = session.library().unwrap().clone();

    session.begin_import(vec![others.path().to_owned()], ImportChoices::default()).unwrap();
    let report = imported(&mut session, "joined");
    assert_eq!(session.document().library(), "My walk-2.gwlib");
    assert_eq!((report.totals.n_imported, report.totals.n_kept), (2, small_library().len()));
    let brought = report.lines.iter().all(|line| {
        matches!(line.outcome, ImportOutcome::Imported { is_retargeted: true, n_frames: 50, .. })
    });
    assert!(brought, "{}", report.text());
    let (old, new) = (&first.library.clips, &session.library().unwrap().library.clips);
    assert_eq!(new.clips()[..old.clips().len()], old.clips()[..], "what was there is as it was");
    assert_eq!(new.skeleton(), old.skeleton());

    // Once more the same: nothing to do, and it is said.
    session.begin_import(vec![others.path().to_owned()], KEEP).unwrap();
    until(&mut session, "refused", |s| matches!(s.import(), ImportState::Failed(..)));
    let ImportState::Failed(sentence, report) = session.import() else { panic!("just now") };
    assert_eq!(sentence, "all of these clips are in the library already");
    assert_eq!(report.totals.n_skipped, 2);
    assert_eq!(libraries(project.path()), ["My walk-2.gwlib", "My walk.gwlib"]);

    session.undo();
    until(&mut session, "undone", |s| ids(s).len() == old.clips().len());
    assert_eq!(session.document().library(), "My walk.gwlib");
    session.undo();
    assert_eq!(session.document().library(), "builtin");
}

#[test]
fn a_mirrored_library_stays_mirrored() {
    let (state, others) = (tempfile::tempdir().unwrap(), others());
    let mut session = session(Some(state.path()));
    session.begin_import(vec![others.path().to_owned()], KEEP).unwrap();
    imported(&mut session, "joined");
    let ids = ids(&session);
    assert!(ids.contains(&"amble@mirror".to_owned()) && ids.contains(&"walk@mirror".to_owned()));
    assert_eq!(ids.len(), 2 * (small_library().len() + 2));
}

#[test]
fn what_is_cancelled_has_never_been() {
    let (state, walks) = (tempfile::tempdir().unwrap(), walks());
    let folder = state.path().join("libraries");
    for wait_ms in [0, 5, 50, 200, 400] {
        let mut session = session(Some(state.path()));
        let before = session.document().clone();
        session.begin_import(vec![walks.path().to_owned()], REPLACE).unwrap();
        // At the latest when it is done and not taken in yet.
        thread::sleep(Duration::from_millis(wait_ms));
        assert!(session.cancel_import() && !session.cancel_import());
        assert_eq!(*session.import(), ImportState::Cancelled);
        session.poll(0.0);
        assert_eq!((session.document(), session.history().n_steps()), (&before, (0, 0)));
        session.begin_import(vec![walks.path().to_owned()], REPLACE).unwrap();
        let other = sample::sample().unwrap();
        session.begin_new(&other);
        assert_eq!(*session.import(), ImportState::Cancelled, "another project");
    }
    // Threads that were cancelled may be about to remove what they have written.
    for _ in 0..400 {
        if libraries(&folder).is_empty() {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    panic!("left: {:?}", libraries(&folder));
}

#[test]
fn a_gesture_is_not_ended_by_an_import() {
    let (state, walks) = (tempfile::tempdir().unwrap(), walks());
    let mut session = session(Some(state.path()));
    session.begin_gesture("Move end");
    session.preview(&[moved(1.0)]).unwrap();
    session.begin_import(vec![walks.path().to_owned()], REPLACE).unwrap();
    let folder = state.path().join("libraries");
    until(&mut session, "written", |_| libraries(&folder) == ["walk.gwlib"]);
    for _ in 0..50 {
        session.poll(0.0);
        thread::sleep(Duration::from_millis(10));
    }
    assert_eq!(session.document().library(), "builtin");
    session.commit();
    imported(&mut session, "imported");
    let labels: Vec<&str> = session.history().past_labels().collect();
    assert_eq!(labels, ["Import clips", "Move end"]);
}

#[test]
fn a_library_that_is_dropped_is_one_step_and_can_be_stopped() {
    let (state, walks) = (tempfile::tempdir().unwrap(), walks());
    let mut session = session(Some(state.path()));
    session.begin_import(vec![walks.path().to_owned()], REPLACE).unwrap();
    imported(&mut session, "imported");
    let file = PathBuf::from(session.document().library());
    session.undo();
    let before = session.library().unwrap().clone();
    assert!(session.use_library(&walks.path().join("walk.bvh")).is_err());
    assert!(session.use_library(&walks.path().join("none.gwlib")).is_err());
    session.use_library(&file).unwrap();
    assert_eq!(session.history().undo_label(), Some("Change library"));
    assert!(session.library_progress().is_some());
    assert!(session.cancel_library() && !session.cancel_library());
    assert!(session.library_note().unwrap().contains("the one before it is still in use"));
    assert!(session.library().unwrap().is(&before));
    until(&mut session, "searching on the old one", has_motion);
    assert!(session.library_note().is_some(), "it is still so");
    session.reopen_library();
    assert!(session.library_note().is_none());
    until(&mut session, "open", |s| ids(s).len() == small_library().len());
    // Undone while it is opened again, the one before is there at once.
    session.undo();
    assert!(session.library().unwrap().is(&before) && session.library_note().is_none());
}
