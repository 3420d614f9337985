//! The editor: how soon something moves in it, how long a frame takes, how soon what is dragged is
//! followed, how much memory it takes. Each time in a process of its own.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail, ensure};
use cpu_time::ThreadTime;
use egui_kittest::Harness;
use motion_bench::clips::Source;
use motion_bench::stopwatch::Spent;
use motion_editor::app::EditorApp;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::EditorOptions;
use motion_session::command::Command as Edit;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::live::SearchState;

use super::Bench;
use super::quantile::quantile;
use crate::machine::{memory_mib, peak_memory_mib};
use crate::table::Row;

/// Frames whose time is taken.
const N_FRAMES: usize = 400;
/// Steps of a drag whose time is taken.
const N_DRAGS: usize = 200;
/// Longer than this nothing takes unless something is broken.
const LIMIT: Duration = Duration::from_secs(120);
/// A window is drawn so often, about; the search has the time between.
const BETWEEN_FRAMES: Duration = Duration::from_millis(8);

/// What the child says, in this order.
#[derive(Clone, Copy, Debug)]
struct Said {
    launch_s: f64,
    takes_s: f64,
    frame_ms: [f64; 2],
    total_ms: [f64; 2],
    answer_ms: [f64; 2],
    memory_mib: f64,
    peak_mib: f64,
}

/// The editor on the sample, then on the motion capture.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let said = match child("sample") {
        Ok(said) => said,
        Err(error) => {
            eprintln!("editor: {error:#}");
            return Ok(Vec::new());
        }
    };
    let mut rows = vec![
        row("editor, launch to a moving character", "3 s", said.launch_s, "s", 3.0),
        row("editor, three takes in the sample", "3 s", said.takes_s - said.launch_s, "s", 3.0),
        row("editor, frame of the UI thread (p95)", "8 ms", said.frame_ms[1], "ms", 8.0),
        row("editor, arrow moved to redrawn (p95)", "100 ms", said.answer_ms[1], "ms", 100.0),
    ];
    rows[1].notes.push("after the first moved".to_owned());
    let [p50, p95] = said.total_ms;
    rows[2].notes.push(format!(
        "CPU time of the thread, laying out and cutting to triangles; median {:.1} ms; on the \
         clock {p50:.1} and {p95:.1} ms",
        said.frame_ms[0]
    ));
    rows[3].notes.push(format!("on the clock; median {:.1} ms", said.answer_ms[0]));
    if let Source::Cmu(_) = bench.source {
        let said = child("cmu")?;
        let mut memory = row("editor, memory with CMU", "600 MB", said.memory_mib, "MiB", 572.0);
        memory.notes.push(format!(
            "peak {:.0} MiB, while the library is built; frame p95 {:.1} ms, answer p95 {:.0} ms",
            said.peak_mib, said.frame_ms[1], said.answer_ms[1]
        ));
        rows.push(memory);
    }
    Ok(rows)
}

fn row(figure: &str, target: &'static str, measured: f64, unit: &str, limit: f64) -> Row {
    Row {
        figure: figure.to_owned(),
        target,
        measured: format!("{measured:.2} {unit}"),
        is_met: measured <= limit,
        spent: Spent::default(),
        notes: Vec::new(),
    }
}

fn child(which: &str) -> anyhow::Result<Said> {
    let program = std::env::current_exe().context("where this program is")?;
    let output = Command::new(program).args(["--editor-once", which]).output()?;
    let error = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "the editor failed: {error}");
    let text = String::from_utf8(output.stdout)?;
    let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let [launch_s, takes_s, f50, f95, t50, t95, a50, a95, memory_mib, peak_mib] =
        <[f64; 10]>::try_from(numbers).ok().context("the editor said something else")?;
    let (frame_ms, total_ms, answer_ms) = ([f50, f95], [t50, t95], [a50, a95]);
    Ok(Said { launch_s, takes_s, frame_ms, total_ms, answer_ms, memory_mib, peak_mib })
}

/// The body of the child: opens the editor on `sample` or `cmu`, works in it, prints ten numbers.
pub(crate) fn editor_once(source: &Source, which: &str) -> anyhow::Result<()> {
    let folder = tempfile::tempdir()?;
    let project = match (which, source) {
        ("cmu", Source::Cmu(clips)) => {
            ProjectSource::File(project_on(clips, &folder.path().join("cmu.gaitway"))?)
        }
        _ => ProjectSource::Sample,
    };
    let start = Instant::now();
    let builder = Harness::builder().with_size(egui::Vec2::new(1600.0, 1000.0)).wgpu();
    let options = EditorOptions::new(project);
    let mut window = builder.build_eframe(|cc| match EditorApp::new(cc, options) {
        Ok(app) => app,
        // Without threads there is nothing to be measured.
        Err(error) => panic!("{error}"),
    });
    wait(&mut window, start, |app| app.state.is_playing() && !app.state.cards.is_empty())?;
    let launch_s = start.elapsed().as_secs_f64();
    wait(&mut window, start, |app| app.state.cards.len() >= 3)?;
    let takes_s = start.elapsed().as_secs_f64();
    let (frames, totals) = frames(&mut window);
    let answers = drag(&mut window)?;
    // What the search has made by now is what it keeps.
    let until = Instant::now() + Duration::from_secs(5);
    while Instant::now() < until {
        step(&mut window);
    }
    print!("{launch_s} {takes_s}");
    for values in [&frames, &totals, &answers] {
        print!(" {} {}", quantile(values, 0.5), quantile(values, 0.95));
    }
    let (now, peak) = (memory_mib().unwrap_or(f64::NAN), peak_memory_mib().unwrap_or(f64::NAN));
    println!(" {now} {peak}");
    Ok(())
}

/// The sample on another library.
fn project_on(library: &Path, path: &Path) -> anyhow::Result<std::path::PathBuf> {
    let mut project = motion_session::sample::sample()?;
    project.library = library.to_string_lossy().into_owned();
    motion_io::project_file::save(&project, path)?;
    Ok(path.to_owned())
}

fn step(window: &mut Harness<'_, EditorApp>) {
    std::thread::sleep(BETWEEN_FRAMES);
    window.step();
}

fn wait(
    window: &mut Harness<'_, EditorApp>,
    start: Instant,
    is_there: impl Fn(&EditorApp) -> bool,
) -> anyhow::Result<()> {
    while !is_there(window.state()) {
        if let SearchState::Error(sentence) = window.state().state.search_state() {
            bail!("{sentence}");
        }
        ensure!(start.elapsed() < LIMIT, "nothing came in {} s", LIMIT.as_secs());
        step(window);
    }
    Ok(())
}

/// CPU time and time on the clock of frames while it plays and searches, milliseconds.
fn frames(window: &mut Harness<'_, EditorApp>) -> (Vec<f64>, Vec<f64>) {
    let (mut cpu_ms, mut wall_ms) = (Vec::new(), Vec::new());
    for nth in 0..N_FRAMES {
        std::thread::sleep(BETWEEN_FRAMES);
        if nth % 50 == 0 {
            // A search that has settled would flatter.
            window.state_mut().state.session.search().shake();
        }
        let at = egui::Pos2::new(300.0 + (nth * 7 % 1000) as f32, 100.0 + (nth * 5 % 800) as f32);
        window.event(egui::Event::PointerMoved(at));
        let (cpu, wall) = (ThreadTime::now(), Instant::now());
        window.step();
        let shapes = window.output().shapes.clone();
        let triangles = window.ctx.tessellate(shapes, 1.0);
        cpu_ms.push(cpu.elapsed().as_secs_f64() * 1e3);
        wall_ms.push(wall.elapsed().as_secs_f64() * 1e3);
        drop(triangles);
    }
    (cpu_ms, wall_ms)
}

/// Drags a checkpoint; gives how long each step took to be answered and drawn, milliseconds.
fn drag(window: &mut Harness<'_, EditorApp>) -> anyhow::Result<Vec<f64>> {
    let at = ConstraintRef::new(CharacterIdx(0), "corner");
    window.state_mut().state.begin_gesture("Move checkpoint");
    let mut answers_ms = Vec::new();
    for nth in 0..N_DRAGS {
        let app = window.state_mut();
        let before = app.state.session.snapshot().request;
        let n_drawn = app.viewport.n_drawn();
        let angle = nth as f64 * 0.1;
        let position_m = [0.4 * angle.sin(), 5.0 + 0.4 * angle.cos()];
        let start = Instant::now();
        app.state.preview(&[Edit::Move { at: at.clone(), position_m }]);
        loop {
            window.step();
            let app = window.state();
            let is_answered = app.state.session.snapshot().request > before
                && app.state.shown_card().is_some_and(|card| !card.is_stale)
                && app.viewport.n_drawn() > n_drawn;
            if is_answered {
                break;
            }
            ensure!(start.elapsed() < LIMIT, "a drag is not answered");
            std::thread::sleep(Duration::from_millis(1));
        }
        answers_ms.push(start.elapsed().as_secs_f64() * 1e3);
    }
    window.state_mut().state.commit();
    Ok(answers_ms)
}
