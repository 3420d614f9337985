//! The timeline, with the mouse and keys.

use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::mark::Mark;
use motion_editor::timeline;
use motion_editor::timeline::length_handle::wished;
use motion_editor::timeline::time_unit::TimeUnit;
use motion_session::LengthMode;
use motion_session::command::Command;
use motion_session::document::CharacterIdx;
use motion_session::playback::PlayRange;

use crate::window::{quiet, solved};

type Window = Harness<'static, EditorApp>;

/// The sample, solved and quiet, with a style from frame 20 to 60 besides.
fn with_style() -> Option<Window> {
    let mut harness = solved()?;
    quiet(&mut harness);
    let (character, tag) = (CharacterIdx(0), "run".to_owned());
    let style = Command::AddStyle { character, from: 20, to: 60, tag };
    assert!(harness.state_mut().state.apply(&style), "the style is one of the library's");
    harness.run_steps(2);
    Some(harness)
}

fn spans(harness: &Window) -> Vec<(u32, u32)> {
    harness.state().state.marks.iter().map(Mark::span).collect()
}

fn selected(harness: &Window) -> Vec<usize> {
    harness.state().state.selected_marks().map(Mark::frame).collect()
}

fn n_undo(harness: &Window) -> usize {
    harness.state().state.session.history().n_steps().0
}

fn place(harness: &Window, label: &str) -> Rect {
    harness.get_by_label_contains(label).rect()
}

/// Presses, moves in several steps, and holds.
fn hold(harness: &mut Window, from: Pos2, to: Pos2, modifiers: Modifiers) {
    harness.event(Event::ModifiersChanged(modifiers));
    harness.event(Event::PointerMoved(from));
    harness.run_steps(3);
    let button = PointerButton::Primary;
    harness.event(Event::PointerButton { pos: from, button, pressed: true, modifiers });
    harness.run_steps(2);
    for step in 1..=4 {
        let at = from + (to - from) * (step as f32 / 4.0);
        harness.event(Event::PointerMoved(at));
        harness.run_steps(2);
    }
}

fn release(harness: &mut Window, at: Pos2, modifiers: Modifiers) {
    let button = PointerButton::Primary;
    harness.event(Event::PointerButton { pos: at, button, pressed: false, modifiers });
    harness.run_steps(3);
    harness.event(Event::ModifiersChanged(Modifiers::NONE));
    harness.run_steps(1);
}

fn drag(harness: &mut Window, from: Pos2, by: Vec2) {
    hold(harness, from, from + by, Modifiers::NONE);
    release(harness, from + by, Modifiers::NONE);
}

/// Turns the wheel, up where positive.
fn wheel(harness: &mut Window, by: f32, modifiers: Modifiers) {
    let wheel = Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: Vec2::new(0.0, by),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers,
    };
    harness.event_modifiers(wheel, modifiers);
    harness.run_steps(20);
}

/// How far apart frames are, points.
fn pt_per_frame(harness: &Window) -> f32 {
    let panel = &harness.state().timeline;
    let [a, b] = [400.0, 500.0].map(|x| panel.frame_at(x).expect("it was drawn"));
    (100.0 / (b - a)) as f32
}

#[test]
fn several_selected_marks_are_retimed_as_one_step() {
    let Some(mut harness) = with_style() else { return };
    harness.key_press_modifiers(Modifiers::CTRL, Key::A);
    harness.run_steps(2);
    assert_eq!(selected(&harness), [0, 20, 110, 239]);
    let before = n_undo(&harness);
    let corner = place(&harness, "Body checkpoint 2").center();
    let ten = 10.0 * pt_per_frame(&harness);
    hold(&mut harness, corner, corner + Vec2::new(ten, 0.0), Modifiers::ALT);
    release(&mut harness, corner + Vec2::new(ten, 0.0), Modifiers::ALT);
    assert_eq!(spans(&harness), [(0, 0), (30, 70), (120, 120), (249, 249)], "the start stays");
    assert_eq!(n_undo(&harness), before + 1);
    assert_eq!(wished(&harness.state().state).0, 250, "the motion gets as long as it must be");
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert_eq!(spans(&harness), [(0, 0), (20, 60), (110, 110), (239, 239)]);

    // Keys: a frame each, a step each.
    let keys = Modifiers::CTRL | Modifiers::ALT;
    harness.key_press_modifiers(keys, Key::ArrowLeft);
    harness.run_steps(2);
    assert_eq!(spans(&harness), [(0, 0), (19, 59), (109, 109), (238, 238)]);
    assert_eq!(n_undo(&harness), before + 1);
    harness.key_press_modifiers(Modifiers::ALT, Key::A);
    harness.run_steps(2);
    assert!(selected(&harness).is_empty());
}

#[test]
fn a_drag_is_longer_than_six_points_and_escape_ends_it() {
    let Some(mut harness) = with_style() else { return };
    let before = spans(&harness);
    let corner = place(&harness, "Body checkpoint 2").center();
    drag(&mut harness, corner, Vec2::new(5.0, 0.0));
    assert_eq!(spans(&harness), before, "though it is pressed for long");
    harness.get_by_label_contains("Body checkpoint 2").click();
    harness.run_steps(2);
    assert_eq!(harness.state().state.frame_number(), 110, "a click goes there");
    let far = corner + Vec2::new(80.0, 0.0);
    hold(&mut harness, corner, far, Modifiers::NONE);
    assert!(spans(&harness)[2].0 > 112);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(spans(&harness), before);
    release(&mut harness, far, Modifiers::NONE);
    assert_eq!(spans(&harness), before);
    // With Shift what comes later goes along.
    hold(&mut harness, corner, corner - Vec2::new(80.0, 0.0), Modifiers::SHIFT);
    release(&mut harness, corner - Vec2::new(80.0, 0.0), Modifiers::SHIFT);
    let after = spans(&harness);
    let by = 110 - after[2].0;
    assert!(by > 5, "{after:?}");
    assert_eq!(after[3].0, 239 - by);
    assert_eq!(after[1], before[1]);
}

#[test]
fn a_bar_is_moved_by_its_middle_and_stretched_by_its_ends() {
    let Some(mut harness) = with_style() else { return };
    let step = pt_per_frame(&harness);
    let end = place(&harness, "End of Style run").center();
    drag(&mut harness, end, Vec2::new(20.0 * step, 0.0));
    let (from, to) = spans(&harness)[1];
    assert!(from == 20 && to.abs_diff(80) <= 2, "{from} {to}");
    let before = n_undo(&harness);
    let middle = harness.get_by_label_contains("Style run, frames").rect().center();
    drag(&mut harness, middle, Vec2::new(30.0 * step, 0.0));
    let (new_from, new_to) = spans(&harness)[1];
    assert_eq!(new_to - new_from, to - from);
    assert!(new_from.abs_diff(50) <= 2, "{new_from}");
    assert_eq!(n_undo(&harness), before + 1);
}

#[test]
fn a_rubber_band_selects_what_it_touches() {
    let Some(mut harness) = with_style() else { return };
    let corner = place(&harness, "Body checkpoint 2");
    let style = place(&harness, "Style run, frames");
    // Below the row of styles, where a drag would draw another.
    let from = Pos2::new(style.left() - 12.0, style.bottom() + 5.0);
    let to = Pos2::new(corner.right() + 30.0, corner.top() - 1.0);
    hold(&mut harness, from, to, Modifiers::NONE);
    assert_eq!(selected(&harness), [20, 110]);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(selected(&harness).is_empty(), "as it was before");
    release(&mut harness, to, Modifiers::NONE);
    drag(&mut harness, from, to - from);
    assert_eq!(selected(&harness), [20, 110]);
    assert_eq!(n_undo(&harness), 1, "the style; selecting is no step");
    harness.key_press_modifiers(Modifiers::SHIFT, Key::D);
    harness.run_steps(2);
    assert!(harness.state().state.notices.refusal().is_none());
    assert_eq!(spans(&harness), [(0, 0), (0, 40), (20, 60), (90, 90), (110, 110), (239, 239)]);
    assert_eq!(selected(&harness), [0, 90], "the copies");
}

#[test]
fn the_length_handle_sets_the_length_as_one_step() {
    let Some(mut harness) = with_style() else { return };
    let before = n_undo(&harness);
    assert_eq!(wished(&harness.state().state), (240, LengthMode::Preferred));
    let handle = place(&harness, "Length, 240 frames, preferred").center();
    let step = pt_per_frame(&harness);
    hold(&mut harness, handle, handle - Vec2::new(60.0 * step, 0.0), Modifiers::ALT);
    release(&mut harness, handle - Vec2::new(60.0 * step, 0.0), Modifiers::ALT);
    let (frames, _) = wished(&harness.state().state);
    assert!(frames.abs_diff(180) <= 3, "{frames}");
    assert_eq!(n_undo(&harness), before + 1);
    // An exact length must hold all constraints, and says so.
    let (character, mode) = (CharacterIdx(0), LengthMode::Exact);
    let state = &mut harness.state_mut().state;
    assert!(!state.apply(&Command::SetLength { character, frames: Some(frames), mode }));
    assert!(state.notices.refusal().is_some());
}

#[test]
fn playback_stays_in_the_loop_range() {
    let Some(mut harness) = with_style() else { return };
    for (frame, key) in [(60, Key::OpenBracket), (90, Key::CloseBracket)] {
        harness.state_mut().state.stop_at(frame);
        harness.key_press(key);
        harness.run_steps(2);
    }
    let range = PlayRange { from: 60, to: 90 };
    assert_eq!(harness.state().state.chosen_range(), Some(range));
    harness.key_press(Key::J);
    for _ in 0..100 {
        harness.step();
        let state = &harness.state().state;
        assert!(state.is_playing() && (60.0..=90.0).contains(&state.frame()));
    }
    harness.key_press(Key::K);
    harness.run_steps(2);
    assert!(!harness.state().state.is_playing());
    let end = place(&harness, "End of the loop range").center();
    let step = pt_per_frame(&harness);
    hold(&mut harness, end, end + Vec2::new(30.0 * step, 0.0), Modifiers::ALT);
    release(&mut harness, end + Vec2::new(30.0 * step, 0.0), Modifiers::ALT);
    let to = harness.state().state.chosen_range().unwrap().to;
    assert!(to.abs_diff(120) <= 2, "{to}");
    assert_eq!(n_undo(&harness), 1, "only the style: what is played is no part of the document");
    harness.key_press_modifiers(Modifiers::SHIFT, Key::Backslash);
    harness.run_steps(2);
    assert_eq!(harness.state().state.chosen_range(), None);
}

#[test]
fn zoom_keeps_the_frame_under_the_pointer() {
    let Some(mut harness) = with_style() else { return };
    let ruler = place(&harness, timeline::ruler::LABEL);
    let at = Pos2::new(ruler.left() + 0.4 * ruler.width(), ruler.bottom() + 40.0);
    harness.event(Event::PointerMoved(at));
    harness.run_steps(2);
    let before = harness.state().timeline.frame_at(at.x).unwrap();
    let scale = pt_per_frame(&harness);
    wheel(&mut harness, 120.0, Modifiers::CTRL);
    let after = harness.state().timeline.frame_at(at.x).unwrap();
    assert!(pt_per_frame(&harness) > 1.2 * scale);
    assert!((after - before).abs() < 0.05, "{before} {after}");
    harness.key_press(Key::Home);
    harness.run_steps(2);
    assert_eq!(harness.state().state.frame_number(), 0, "over the timeline it is the first frame");
}

#[test]
fn rows_are_there_when_they_have_something_in_them() {
    let Some(mut harness) = with_style() else { return };
    let state = &mut harness.state_mut().state;
    let character = CharacterIdx(0);
    let (joint, position_m) = ("Head".to_owned(), [0.0, 1.6, 1.0]);
    let commands = [
        Command::AddJointTarget { character, frame: 80, joint, position_m, velocity_m_s: None },
        Command::AddCharacter { name: "Other".to_owned() },
    ];
    assert!(state.apply_all("Add", &commands));
    state.settings.curves_open = true;
    harness.run_steps(3);
    let head = place(&harness, "Head target, frame 80").center();
    let scale = pt_per_frame(&harness);
    harness.event(Event::PointerMoved(head));
    wheel(&mut harness, -400.0, Modifiers::NONE);
    assert_eq!(pt_per_frame(&harness), scale, "rows scroll where they do not fit");
    assert!(harness.query_by_label_contains("Head target, frame 80").is_none());
    harness.get_by_label_contains("Speed curve");
    assert!(harness.query_by_label_contains("Off path curve").is_none(), "nothing is drawn");
    harness.get_by_label("Clock").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state.settings.time_unit, TimeUnit::Seconds);
    harness.get_by_label("Character Other").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state.session.active(), CharacterIdx(1));
}
