//! A search as the editor has it: on a thread, under edits.

use std::sync::mpsc::{Receiver, sync_channel};
use std::time::Duration;

use super::*;
use crate::command::{Command, apply};
use crate::fixture::{ready_library, walk_to};

/// A search, and something that hears of each snapshot.
fn start() -> (LiveSearch, Receiver<()>) {
    let (woken, is_woken) = sync_channel(1);
    // Whoever has not heard the last call yet will look anyway.
    let wake = Arc::new(move || woken.try_send(()).unwrap_or_default());
    (LiveSearch::start(wake).unwrap(), is_woken)
}

/// Polls until a snapshot is as wanted.
#[track_caller]
fn until(
    (search, woken): (&mut LiveSearch, &Receiver<()>),
    what: &str,
    wanted: impl Fn(&SearchSnapshot) -> bool,
) -> Arc<SearchSnapshot> {
    // Two minutes: machines that are busy with other tests are slow.
    for _ in 0..12_000 {
        if let Some(snapshot) = search.poll()
            && wanted(&snapshot)
        {
            return snapshot;
        }
        woken.recv_timeout(Duration::from_millis(10)).unwrap_or_default();
    }
    let latest = search.latest();
    let rounds = latest.characters.first().map(|c| (c.iterations, c.takes.len(), c.shown));
    panic!("no snapshot {what}; the last is {:?}, {rounds:?}", latest.state);
}

fn is_shown(snapshot: &SearchSnapshot) -> bool {
    snapshot.characters.first().and_then(CharacterSnapshot::shown).is_some_and(|t| t.made.is_some())
}

#[test]
fn takes_come_and_an_edit_is_answered_with_the_takes_that_there_are() {
    let (mut search, woken) = start();
    let file = Path::new("walk.gaitway");
    search.submit(&walk_to(0.8, 4.0), &ready_library(), file, Phase::Settled);
    let first = until((&mut search, &woken), "with a motion", |s| {
        is_shown(s) && s.characters[0].takes.len() > 2
    });
    assert_eq!((first.request, &first.state), (1, &SearchState::Searching));
    let picked = first.characters[0].takes[2].id;
    search.pick(CharacterIdx(0), picked);
    until((&mut search, &woken), "with the pick", |s| s.characters[0].shown == Some(picked));
    for nth in 1..=20 {
        let to = walk_to(0.8 + 0.05 * f64::from(nth), 4.0);
        search.submit(&to, &ready_library(), file, Phase::Dragging);
    }
    let number = search.submit(&walk_to(1.8, 4.0), &ready_library(), file, Phase::Settled);
    let answer = until((&mut search, &woken), "of the last request", |s| s.request == number);
    let character = &answer.characters[0];
    assert_ne!(character.version, first.characters[0].version);
    assert_eq!(character.picked, Some(picked));
    assert!(character.takes.len() > 2, "nothing begins from nothing");
    search.stop();
}

#[test]
fn pausing_and_settling_are_said() {
    let (mut search, woken) = start();
    let file = Path::new("walk.gaitway");
    search.pause();
    search.submit(&walk_to(0.8, 4.0), &ready_library(), file, Phase::Settled);
    let paused = until((&mut search, &woken), "paused", |s| s.state == SearchState::Paused);
    assert_eq!(paused.characters[0].iterations, 0);
    search.resume();
    until((&mut search, &woken), "with a motion", is_shown);
    until((&mut search, &woken), "settled", |s| s.state == SearchState::Settled);
    search.shake();
    until((&mut search, &woken), "searching again", |s| s.state == SearchState::Searching);
}

#[test]
fn what_cannot_be_is_said_and_the_nearest_is_shown() {
    let (mut search, woken) = start();
    let file = Path::new("walk.gaitway");
    search.submit(&walk_to(0.8, 20.0), &ready_library(), file, Phase::Settled);
    let found = until((&mut search, &woken), "with a motion", is_shown);
    let SearchState::Infeasible(reason) = &found.state else { panic!("{:?}", found.state) };
    assert!(reason.contains("m/s; the fastest clip in use goes"), "{reason}");
}

/// Of all snapshots, not of those alone that a window is quick enough to see: while there is no
/// motion nothing can be played.
#[test]
fn no_take_is_shown_before_its_motion_is_made() {
    let shared: Arc<Shared> = Arc::default();
    let (sent, came) = sync_channel(1);
    let of_worker = Arc::clone(&shared);
    let wake: Wake = Arc::new(move || {
        of_worker.snapshots.take().into_iter().for_each(|s| sent.send(s).unwrap());
    });
    let of_worker = Arc::clone(&shared);
    let worker = thread::Builder::new().spawn(move || worker::run(&of_worker, &wake)).unwrap();
    for (number, x_m) in [(1, 0.8), (2, 1.8)] {
        let request = Some(Arc::new(Request {
            number,
            document: walk_to(x_m, 4.0),
            library: ready_library(),
            path: "walk.gaitway".into(),
            phase: Phase::Settled,
        }));
        shared.wishes.put(Wish { request, follow_best: true, ..Wish::default() });
        let of_this = came.iter().filter(|snapshot| snapshot.request == number);
        for snapshot in of_this {
            let character = &snapshot.characters[0];
            let what = (character.iterations, character.shown);
            assert!(character.shown.is_none() || is_shown(&snapshot), "{what:?}");
            if snapshot.state == SearchState::Settled {
                break;
            }
        }
    }
    shared.wishes.put(Wish { is_over: true, ..Wish::default() });
    came.iter().for_each(drop);
    worker.join().unwrap();
}

#[test]
fn dropping_it_ends_the_worker() {
    let (mut search, woken) = start();
    search.submit(&walk_to(0.8, 4.0), &ready_library(), Path::new("p"), Phase::Settled);
    until((&mut search, &woken), "with a motion", is_shown);
    let shared = Arc::clone(&search.shared);
    drop(search);
    assert_eq!(Arc::strong_count(&shared), 1, "nobody else has it any more");
}

#[test]
fn the_shown_take_follows_however_fast_it_is_dragged() {
    let (mut search, woken) = start();
    let file = Path::new("walk.gaitway");
    search.submit(&walk_to(0.8, 4.0), &ready_library(), file, Phase::Settled);
    let first = until((&mut search, &woken), "with takes", |s| {
        is_shown(s) && s.characters[0].takes.len() > 3
    });
    let picked = first.characters[0].takes[3].id;
    search.pick(CharacterIdx(0), picked);
    until((&mut search, &woken), "with the pick", |s| s.characters[0].shown == Some(picked));
    let mut follows = false;
    for nth in 0..20_000 {
        // A new place every millisecond, back and forth, and never a pause.
        let x_m = 0.8 + 0.001 * f64::from(nth % 1_000);
        search.submit(&walk_to(x_m, 4.0), &ready_library(), file, Phase::Dragging);
        thread::sleep(Duration::from_millis(1));
        let Some(snapshot) = search.poll() else { continue };
        assert_eq!(snapshot.characters[0].picked, Some(picked));
        follows = snapshot.characters[0].shown != Some(picked);
        if follows {
            break;
        }
    }
    assert!(follows, "it never came nearer");
}

#[test]
fn everybody_is_searched_for_and_keeps_what_was_found_under_another_name_and_place() {
    let (mut search, woken) = start();
    let file = Path::new("walk.gaitway");
    let two = Command::AddCharacter { name: "B".to_owned() };
    let two = apply(&walk_to(0.8, 4.0), &two).unwrap();
    search.submit(&two, &ready_library(), file, Phase::Settled);
    let found = until((&mut search, &woken), "with both", |s| {
        s.characters.len() == 2 && s.characters.iter().all(|c| c.takes.len() > 2)
    });
    let picked = found.characters[1].takes[1].id;
    search.pick(CharacterIdx(1), picked);
    until((&mut search, &woken), "with the pick", |s| s.characters[1].shown == Some(picked));
    search.pause();
    let rename = Command::RenameCharacter { character: CharacterIdx(1), name: "C".to_owned() };
    let renamed = apply(&two, &rename).unwrap();
    let number = search.submit(&renamed, &ready_library(), file, Phase::Settled);
    let answer = until((&mut search, &woken), "renamed", |s| s.request == number);
    assert_eq!(answer.characters[1].name, "C");
    assert_eq!(answer.characters[1].shown, Some(picked));
    let alone = Command::RemoveCharacter { character: CharacterIdx(0) };
    let alone = apply(&renamed, &alone).unwrap();
    let number = search.submit(&alone, &ready_library(), file, Phase::Settled);
    let answer = until((&mut search, &woken), "alone", |s| s.request == number);
    assert_eq!((answer.characters.len(), answer.characters[0].name.as_str()), (1, "C"));
    assert_eq!(answer.characters[0].picked, Some(picked));
}

/// Two characters with these constraints on the small library, and what they do together.
fn two(a: &str, b: &str, interactions: &str) -> Document {
    let character = |name: &str, constraints: &str| {
        format!(
            "{{\"name\": \"{name}\", \"length\": {{\"frames\": 120}},
               \"constraints\": [{constraints}]}}"
        )
    };
    let (a, b) = (character("A", a), character("B", b));
    let text = format!(
        "{{\"gaitway\": 1, \"name\": \"two\", \"characters\": [{a}, {b}],
           \"interactions\": [{interactions}]}}"
    );
    let path = Path::new("two.gaitway");
    let project =
        motion_io::project_file::read(text.as_bytes(), path, &mut Default::default()).unwrap();
    Document::from_project(project)
}

fn place(frame: u32, x: f64, z: f64, heading: f64) -> String {
    format!(
        "{{\"kind\": \"body\", \"frame\": {frame}, \"position\": [{x}, {z}], \"heading\": {heading}}}"
    )
}

/// The motions that are shown.
fn shown_motions(snapshot: &SearchSnapshot) -> Vec<Arc<motion_core::motion::Motion>> {
    let shown = snapshot.characters.iter().filter_map(CharacterSnapshot::shown);
    shown.filter_map(|take| Some(Arc::clone(&take.made.as_ref()?.motion))).collect()
}

#[test]
fn two_whose_ways_cross_come_to_walk_around_each_other() {
    let (mut search, woken) = start();
    let document = two(
        &format!("{}, {}", place(0, 0.0, -2.1, 0.0), place(119, 0.0, 2.1, 0.0)),
        &format!("{}, {}", place(0, -2.1, 0.0, 90.0), place(119, 2.1, 0.0, 90.0)),
        "",
    );
    search.submit(&document, &ready_library(), Path::new("two.gaitway"), Phase::Settled);
    let least_m = |snapshot: &SearchSnapshot| {
        let motions = shown_motions(snapshot);
        let [a, b] = motions.as_slice() else { return 0.0 };
        let pairs = a.root_positions_m().iter().zip(b.root_positions_m());
        pairs.map(|(a, b)| (a.x - b.x).hypot(a.z - b.z)).fold(f32::INFINITY, f32::min)
    };
    until((&mut search, &woken), "of two ways apart", |s| least_m(s) > 0.4);
}

#[test]
fn two_who_interact_are_shown_at_their_places_to_each_other() {
    use motion_core::planar::PlanarTransform;
    let (mut search, woken) = start();
    let document = two(
        &place(0, -2.5, 0.0, 90.0),
        &place(0, 2.5, 0.0, 270.0),
        "{\"id\": \"shake\", \"frame\": 75, \"members\": [
            {\"character\": \"A\", \"clip\": \"walk\", \"clip_frame\": 60},
            {\"character\": \"B\", \"clip\": \"slow\", \"clip_frame\": 30}],
          \"relative\": [{\"position\": [0, 0], \"heading\": 0},
                         {\"position\": [0, 1], \"heading\": 180}]}",
    );
    search.submit(&document, &ready_library(), Path::new("two.gaitway"), Phase::Settled);
    let settled = until((&mut search, &woken), "settled", |s| s.state == SearchState::Settled);
    let at = |motion: &motion_core::motion::Motion| {
        let yaw_rad = motion_core::ground::yaw_series_rad(motion)[75];
        let root = motion.root_positions_m()[75];
        PlanarTransform::new(yaw_rad, glam::Vec2::new(root.x, root.z), 0.0)
    };
    let motions = shown_motions(&settled);
    let b_in_a = at(&motions[0]).inverse() * at(&motions[1]);
    let off_m = b_in_a.ground_m().distance(glam::Vec2::new(0.0, 1.0));
    assert!(off_m < 2e-3, "{b_in_a:?}");
    assert!(b_in_a.heading_rad().abs().to_degrees() > 179.8, "{b_in_a:?}");
}
