//! What it costs to draw a full timeline.

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::{EditorOptions, EditorState};
use motion_editor::take_card::{Cut, Piece};
use motion_editor::theme;
use motion_editor::timeline::TimelinePanel;
use motion_session::command::Command;
use motion_session::document::CharacterIdx;

/// Frames of the motion.
const N_FRAMES: usize = 1800;
/// Pieces, one more than cuts.
const N_PIECES: usize = 41;

/// A minute of motion with 40 cuts and 30 constraints. Run it alone and optimised:
/// `cargo test --release -p motion-editor --test editor -- --ignored --nocapture full_timeline`.
#[test]
#[ignore = "measures; alone, and optimised"]
fn a_full_timeline_is_drawn_in_time() {
    let ctx = egui::Context::default();
    let mut state = EditorState::new(EditorOptions::new(ProjectSource::Sample), &ctx).unwrap();
    let character = CharacterIdx(0);
    let at = motion_session::document::ConstraintRef::new(character, "end");
    let mut commands = vec![Command::Retime { at, frame: N_FRAMES as u32 - 1 }];
    commands.push(Command::SetLength {
        character,
        frames: Some(N_FRAMES as u32),
        mode: motion_session::LengthMode::Preferred,
    });
    for nth in 0..10u32 {
        let (from, to, tag) = (150 * nth, 150 * nth + 120, "walk".to_owned());
        commands.push(Command::AddStyle { character, from, to, tag });
        let (joint, position_m) = ("Head".to_owned(), [0.0, 1.6, 1.0]);
        let frame = 160 * nth + 7;
        commands.push(Command::AddJointTarget {
            character,
            frame,
            joint,
            position_m,
            velocity_m_s: None,
        });
    }
    for nth in 0..7u32 {
        let (frame, position_m) = (200 + 200 * nth, [0.0, 4.0 + f64::from(nth)]);
        commands.push(Command::AddCheckpoint { character, frame, position_m, heading_deg: None });
    }
    assert!(state.apply_all("Add", &commands));
    assert_eq!(state.marks.len(), 30);
    let start = Instant::now();
    while state.n_frames() < N_FRAMES / 2 || state.shown_card().is_none() {
        assert!(start.elapsed() < Duration::from_secs(300), "the search finds nothing");
        std::thread::sleep(Duration::from_millis(20));
        state.poll(0.0);
    }
    state.session.search().pause();
    let n_frames = state.n_frames();
    let shown = state.shown().unwrap();
    let card = state.cards.iter_mut().find(|card| card.id == shown).unwrap();
    let lane = Arc::make_mut(&mut card.lane);
    let edge = |nth: usize| nth * n_frames / N_PIECES;
    let piece = |nth: usize| Piece {
        clip: format!("clip_{nth}"),
        frames: edge(nth)..edge(nth + 1),
        of_clip: (3, 3 + (edge(nth + 1) - edge(nth)) as u32),
    };
    lane.pieces = (0..N_PIECES).map(piece).collect();
    let cut = |nth: usize| Cut { frame: edge(nth), cost: 0.1, is_bridge: false };
    lane.cuts = (1..N_PIECES).map(cut).collect();
    state.settings.curves_open = true;
    state.stop_at(900);

    let mut panel = TimelinePanel::default();
    let mut times: Vec<Duration> = Vec::new();
    let mut is_ready = false;
    let size = egui::Vec2::new(1920.0, 480.0);
    {
        let times = &mut times;
        let mut harness = Harness::builder().with_size(size).build_ui(move |ui| {
            if !is_ready {
                theme::install(ui.ctx());
                is_ready = true;
                return;
            }
            let start = Instant::now();
            panel.ui(ui, &mut state);
            times.push(start.elapsed());
        });
        harness.run_steps(200);
    }
    times.sort();
    let [median, most] = [times[times.len() / 2], times[times.len() * 95 / 100]];
    println!("{n_frames} frames: half are below {median:?}, 95 % below {most:?}");
    let limit = Duration::from_micros(if cfg!(debug_assertions) { 15_000 } else { 1_500 });
    assert!(median < limit, "{median:?}");
}
