//! How much memory a session takes on real data; asked for with `--ignored`, as it takes minutes.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use motion_io::library_file::LibraryFile;

use super::super::tests::has_motion;
use super::super::*;

/// Resident memory of this process in MB: now, and at its highest.
fn resident_mb() -> Option<(f64, f64)> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let of = |key: &str| {
        let line = status.lines().find(|line| line.starts_with(key))?;
        line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kb| kb / 1024.0)
    };
    Some((of("VmRSS:")?, of("VmHWM:")?))
}

fn say(what: &str) {
    let (now, highest) = resident_mb().unwrap_or_default();
    println!("{what:<44} {now:>7.1} MB, at most {highest:>7.1} MB");
}

#[test]
#[ignore = "a measurement on clips that are not part of the project"]
fn a_session_on_real_clips() {
    let clips = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/mocap/cmu");
    if !clips.is_dir() || resident_mb().is_none() {
        println!("skipped: there is no {}", clips.display());
        return;
    }
    say("begun");
    let state = tempfile::tempdir().unwrap();
    let options = SessionOptions {
        state_folder: Some(state.path().to_owned()),
        wake: Arc::new(|| ()),
        builtin: Some(crate::fixture::ready_library()),
        project: None,
    };
    let mut session = Session::new(options).unwrap();
    say("a session on the small library");
    // A library that another process has built is measured purest: `GAITWAY_MEMORY_LIBRARY` names
    // its file, which is put there by the first run.
    let file = std::env::var_os("GAITWAY_MEMORY_LIBRARY").map(PathBuf::from);
    if std::env::var_os("GAITWAY_MEMORY_MIRROR").is_some() {
        session.apply(&Command::SetMirror { mirror: Some(true) }).unwrap();
    }
    let built = file.as_ref().filter(|file| file.exists());
    if let Some(file) = built {
        session.use_library(file).unwrap();
    } else {
        session.begin_import(vec![clips], ImportChoices::default()).unwrap();
    }
    let start = Instant::now();
    let mut last = String::new();
    loop {
        session.poll(0.05);
        let progress = match session.import() {
            ImportState::Running(progress) => Some(progress),
            _ => session.library_progress(),
        };
        let Some(progress) = progress else { break };
        if progress.stage != last {
            last.clone_from(&progress.stage);
            let counts = progress.counts.map(|counts| counts.to_string()).unwrap_or_default();
            let eta = progress.eta_secs.map(|s| format!("{s:.1} s left")).unwrap_or_default();
            say(&format!("{last} at {:.0} % {counts} {eta}", 100.0 * progress.share));
        }
        thread::sleep(Duration::from_millis(50));
    }
    say(&format!("the library is there after {:.1} s", start.elapsed().as_secs_f64()));
    if let ImportState::Done(report) = session.import() {
        println!("{}", report.summary());
    }
    let ready = session.library().unwrap().clone();
    let (clips, graph) = (&ready.library.clips, &ready.library.graph);
    let n_joints = clips.skeleton().n_joints();
    let mb = |bytes: usize| bytes as f64 / 1e6;
    println!("motions {:.1} MB", mb(clips.n_frames() * (16 * n_joints + 12)));
    println!(
        "forest {:.1} MB of {} nodes",
        mb(graph.forest.n_nodes() * 16),
        graph.forest.n_nodes()
    );
    println!("the search's joints {:.1} MB", mb(clips.n_frames() * 12 * n_joints));
    if let (None, Some(to)) = (built, &file) {
        fs::copy(session.document().library(), to).unwrap();
    }
    if built.is_none() {
        let file = LibraryFile::load(Path::new(session.document().library()));
        assert!(file.is_ok(), "what was written can be opened");
        say("the library read once more, and dropped");
    }
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        session.poll(0.05);
        if start.elapsed().as_secs().is_multiple_of(15) && start.elapsed().subsec_millis() < 50 {
            say(&format!("searching, has a motion: {}", has_motion(&session)));
        }
        thread::sleep(Duration::from_millis(50));
    }
    let rounds = session.snapshot().characters[0].iterations;
    say(&format!("after a minute, {rounds} rounds"));
}
