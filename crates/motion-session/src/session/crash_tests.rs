//! Sessions that are killed while somebody works: how much is lost, and whether anything is broken.
//!
//! A test starts itself over as a process that edits, saves and drags without a pause, and says what
//! it does and when; kills it at any moment; and opens what is left.

use std::io::{Read as _, Write as _};
use std::process::{Command as Process, Stdio};
use std::thread;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::*;
use crate::document::ConstraintRef;
use crate::fixture::walk_to;

const FOLDER: &str = "GAITWAY_TEST_CRASH_FOLDER";
const SECS: &str = "GAITWAY_TEST_CRASH_AUTOSAVE_SECS";
const SAVES_OFTEN: &str = "GAITWAY_TEST_CRASH_SAVES_OFTEN";

/// The project's file.
const FILE: &str = "walk.gaitway";
/// How often the process edits.
const FRAME: Duration = Duration::from_millis(16);

fn now_secs() -> f64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs_f64()
}

/// Numbers that look random, from a seed (a linear congruential generator, Knuth's constants).
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }
}

fn session_in(folder: &Path) -> Session {
    let mut project = walk_to(0.8, 4.0).to_project();
    project.name = "0".to_owned();
    // Nothing is searched: what is tried here is files.
    project.library = "none.gwlib".to_owned();
    let options = SessionOptions {
        state_folder: Some(folder.join("state")),
        wake: Arc::new(|| ()),
        builtin: None,
        project: Some(project),
    };
    Session::new(options).expect("the system has threads")
}

/// Not a test by itself: the process that is killed.
#[test]
fn works_until_it_is_killed() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    let secs: f64 = std::env::var(SECS).unwrap().parse().unwrap();
    let saves_often = std::env::var_os(SAVES_OFTEN).is_some();
    let mut dice = Dice(u64::from(std::process::id()));
    let say = |word: &str, n: u64| {
        let line = format!("\n{word} {n} {:.6}\n", now_secs());
        std::io::stdout().write_all(line.as_bytes()).unwrap();
        std::io::stdout().flush().unwrap();
    };
    let mut session = session_in(&folder);
    session.set_autosave_secs(secs);
    session.save_as(&folder.join(FILE)).unwrap();
    say("saved", 0);
    let mut last_secs = now_secs();
    for n in 1.. {
        session.apply(&Command::RenameProject { name: n.to_string() }).unwrap();
        say("edit", n);
        let at = ConstraintRef::new(CharacterIdx(0), "end");
        let position_m = [dice.below(100) as f64 / 50.0, 4.0];
        match dice.below(8) {
            0 => session.apply(&Command::Move { at, position_m }).unwrap(),
            1 => {
                session.begin_gesture("Move end");
                session.preview(&[Command::Move { at, position_m }]).unwrap();
            }
            2 => session.commit(),
            3 => session.cancel(),
            _ => {}
        }
        // A gesture that is under way is given up by the next edit, as in the window.
        if saves_often && dice.below(3) == 0 {
            session.save().unwrap();
            say("saved", n);
        }
        thread::sleep(FRAME);
        let t_secs = now_secs();
        session.poll(t_secs - last_secs);
        last_secs = t_secs;
    }
}

/// Lets a session work for so long, kills it, and looks at what is left. Gives how old the first edit
/// is that was lost, seconds.
fn kill_after(lives: Duration, autosave_secs: f64, saves_often: bool) -> f64 {
    let dir = tempfile::tempdir().expect("the system has room");
    let mut process = Process::new(std::env::current_exe().expect("this test runs"));
    process
        .args(["--exact", "session::crash_tests::works_until_it_is_killed", "--nocapture"])
        .env(FOLDER, dir.path())
        .env(SECS, autosave_secs.to_string())
        .stdout(Stdio::piped());
    if saves_often {
        process.env(SAVES_OFTEN, "1");
    }
    let mut process = process.spawn().expect("this test can start itself");
    let mut stdout = process.stdout.take().expect("it was asked for");
    let reader = thread::scope(|scope| {
        let reader = thread::Builder::new().spawn_scoped(scope, move || {
            let mut text = String::new();
            stdout.read_to_string(&mut text).map(|_| text)
        });
        thread::sleep(lives);
        let killed_secs = now_secs();
        process.kill().expect("it was running");
        process.wait().expect("it was running");
        let text = reader.expect("the system has threads").join().expect("it only reads");
        (killed_secs, text.expect("what was said is text"))
    });
    let (killed_secs, text) = reader;
    look_at(dir.path(), killed_secs, &text)
}

/// What was said: the word, its number, and when.
fn said<'a>(text: &'a str, wanted: &'a str) -> impl Iterator<Item = (u64, f64)> + 'a {
    text.lines().filter_map(move |line| {
        let mut words = line.split(' ');
        let (word, n, secs) = (words.next()?, words.next()?, words.next()?);
        (word == wanted && words.next().is_none()).then_some((n.parse().ok()?, secs.parse().ok()?))
    })
}

fn look_at(folder: &Path, killed_secs: f64, text: &str) -> f64 {
    let number = |project: &Project| -> u64 {
        project.name.parse().expect("projects are called by the number of the edit")
    };
    let path = folder.join(FILE);
    let Some((saved, _)) = said(text, "saved").last() else {
        // It was killed before it had begun; then there is no file, or a whole one.
        assert!(!path.exists() || load(&path).is_some(), "the first save broke the file");
        return 0.0;
    };
    let of_file = load(&path).expect("the saved file is whole");
    assert!(number(&of_file) >= saved, "what was said to be saved is saved");

    let mut next = session_in(folder);
    let n_autosaves = std::fs::read_dir(folder.join("state"))
        .expect("the session has made it")
        .filter_map(Result::ok)
        .filter(|entry| entry.path().extension().is_some_and(|ending| ending == "autosave"))
        .count();
    let recoveries = next.recoveries();
    assert_eq!(recoveries.len(), n_autosaves, "every autosave can be read");
    for recovery in &recoveries {
        assert_eq!(recovery.file.as_deref(), Some(path.as_path()), "it knows its file");
        assert!(
            !recovery.file_is_newer || number(&recovery.project) <= number(&of_file),
            "a newer file has more"
        );
    }
    let best = recoveries.iter().max_by_key(|recovery| number(&recovery.project));
    let kept = best.map_or(0, |best| number(&best.project)).max(number(&of_file));
    if let Some(best) = best {
        next.recover(best).expect("nobody else is at it");
        next.save().expect("the file can be written");
    } else {
        next.open(&path).expect("nobody else has it");
    }
    assert!(next.recoveries().is_empty(), "nothing is left to be recovered");
    next.close();
    // Its autosave goes on a thread that ends with it.
    drop(next);
    let left: Vec<String> = [folder.to_owned(), folder.join("state")]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).expect("it is there"))
        .map(|entry| entry.expect("it is there").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".tmp") || name.ends_with(".autosave"))
        .collect();
    assert!(left.is_empty(), "no crumbs: {left:?}");
    said(text, "edit").find(|(n, _)| *n > kept).map_or(0.0, |(_, secs)| killed_secs - secs)
}

fn load(path: &Path) -> Option<Project> {
    use motion_io::diagnostic::Warnings;
    motion_io::project_file::load(path, &mut Warnings::new()).ok()
}

/// A hundred sessions, half of which save all the time, with everything ten times as fast as usual.
#[test]
fn a_hundred_killed_sessions_lose_a_second_each_at_most_and_break_nothing() {
    const N_THREADS: u64 = 10;
    let scaled_secs = AUTOSAVE_SECS / 10.0;
    let worst = std::sync::Mutex::new(0.0f64);
    thread::scope(|scope| {
        for nth_thread in 0..N_THREADS {
            let worst = &worst;
            let work = move || {
                let mut dice = Dice(nth_thread);
                for nth in 0..100 / N_THREADS {
                    let lives = Duration::from_millis(100 + dice.below(2_000));
                    let lost_secs = kill_after(lives, scaled_secs, nth % 2 == 0);
                    let mut worst = worst.lock().expect("no test has failed");
                    *worst = worst.max(lost_secs);
                }
            };
            thread::Builder::new().spawn_scoped(scope, work).expect("the system has threads");
        }
    });
    let worst = worst.into_inner().unwrap();
    assert!(worst <= 1.0, "ten seconds, scaled; {worst} s were lost");
}

/// The same with the true interval, a few times, for it takes its time.
#[test]
fn killed_sessions_lose_ten_seconds_at_most() {
    thread::scope(|scope| {
        for lives_secs in [7.0, 9.9, 12.3, 14.8] {
            let work = move || {
                let lost_secs =
                    kill_after(Duration::from_secs_f64(lives_secs), AUTOSAVE_SECS, false);
                assert!(lost_secs <= 10.0, "{lost_secs} s were lost after {lives_secs} s");
            };
            thread::Builder::new().spawn_scoped(scope, work).expect("the system has threads");
        }
    });
}
