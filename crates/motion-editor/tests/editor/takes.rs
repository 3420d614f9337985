//! Takes are kept, looked at, compared and named; nothing but a choice changes what is shown.

use egui::{Key, Modifiers, Role};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use motion_editor::app::EditorApp;
use motion_editor::panels::takes::rename;
use motion_editor::state::CompareMode;
use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef, TakeId};
use motion_session::playback::{PlayRange, PlaybackCommand};

use crate::window::{quiet, settle, solved};

type Window = Harness<'static, EditorApp>;

fn corner() -> ConstraintRef {
    ConstraintRef::new(CharacterIdx(0), "corner")
}

fn ids(harness: &Window) -> Vec<TakeId> {
    let mut ids: Vec<TakeId> = harness.state().state.cards.iter().map(|card| card.id).collect();
    ids.sort();
    ids
}

/// Goes on until something is so.
fn until(harness: &mut Window, what: &str, is_so: impl Fn(&EditorApp) -> bool) {
    let start = std::time::Instant::now();
    while !is_so(harness.state()) {
        assert!(start.elapsed().as_secs() < 120, "never {what}");
        std::thread::sleep(std::time::Duration::from_millis(20));
        harness.step();
    }
}

/// Until so many takes have cards.
fn with_takes(harness: &mut Window, n: usize) {
    until(harness, "enough takes", |app| app.state.cards.len() >= n);
}

fn pinned(harness: &Window) -> Vec<TakeId> {
    let cards = harness.state().state.cards.iter();
    cards.filter(|card| card.is_pinned).map(|card| card.id).collect()
}

#[test]
fn pinned_takes_survive_everything() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 4);
    quiet(&mut harness);
    let last = harness.state().state.cards.len();
    let id = harness.state().state.cards[last - 1].id;
    let before = harness.state().state.session.history().n_steps();
    harness.state_mut().state.toggle_pin(id);
    assert_eq!(harness.state().state.session.history().n_steps().0, before.0 + 1, "one step");
    harness.state_mut().state.session.search().resume();
    settle(&mut harness);
    assert_eq!(pinned(&harness), [id]);
    assert_eq!(harness.state().state.cards[0].id, id, "the pinned ones stand first");

    let to = |x, z| Command::Move { at: corner(), position_m: [x, z] };
    harness.state_mut().state.apply(&to(1.0, 3.0));
    settle(&mut harness);
    assert_eq!(pinned(&harness), [id], "after an edit");
    harness.state_mut().state.session.search().shake();
    harness.run_steps(20);
    assert_eq!(pinned(&harness), [id], "after a shake");
    let palette = motion_session::Palette {
        include: vec!["*".to_owned()],
        exclude: vec!["run*".to_owned()],
        tags: Vec::new(),
        extra: Default::default(),
    };
    harness.state_mut().state.apply(&Command::SetPalette { palette: Some(palette) });
    settle(&mut harness);
    assert_eq!(pinned(&harness), [id], "after other clips");
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(pinned(&harness), [id], "after undo of what was done later");
    let saved = harness.state().state.session.document().to_project();
    let again = motion_session::document::Document::from_project(saved);
    assert!(again.takes().iter().any(|take| take.id() == id && take.pinned), "it is saved");
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert!(pinned(&harness).is_empty(), "pinning is undone like everything");
}

#[test]
fn back_at_earlier_constraints_their_takes_are_back_at_once() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 4);
    quiet(&mut harness);
    let (before, shown) = (ids(&harness), harness.state().state.shown());
    let request = |app: &EditorApp| app.state.session.snapshot().request;
    let command = Command::Move { at: corner(), position_m: [1.5, 3.5] };
    harness.state_mut().state.apply(&command);
    let first = request(harness.state());
    until(&mut harness, "answered", |app| request(app) > first);
    harness.run_steps(10);
    harness.state_mut().state.run(motion_editor::ui_command::UiCommand::Undo);
    let second = request(harness.state());
    // The search is paused: nothing is found anew.
    until(&mut harness, "answered", |app| {
        request(app) > second && app.state.shown_card().is_some_and(|card| !card.is_stale)
    });
    quiet(&mut harness);
    assert_eq!(ids(&harness), before);
    assert_eq!(harness.state().state.shown(), shown);
}

#[test]
fn after_a_hundred_drags_the_shown_take_is_of_the_picked_one() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 3);
    let picked = harness.state().state.cards[2].id;
    harness.state_mut().state.show_take(picked);
    until(&mut harness, "shown", |app| app.state.shown() == Some(picked));
    let pick_of = |app: &EditorApp| app.state.session.snapshot().characters[0].picked;
    for nth in 0..100 {
        let state = &mut harness.state_mut().state;
        state.begin_gesture("Move");
        for step in 1..=2 {
            let x = 0.01 * f64::from(nth) + 0.005 * f64::from(step);
            state.preview(&[Command::Move { at: corner(), position_m: [x, 3.0] }]);
        }
        state.commit();
        harness.step();
        assert_eq!(pick_of(harness.state()), Some(picked), "drag {nth}");
    }
    settle(&mut harness);
    assert_eq!(pick_of(harness.state()), Some(picked));
    // The lineage itself is the session's to test; here, that the window shows what it says.
    let state = &harness.state().state;
    assert_eq!(state.shown(), state.session.snapshot().characters[0].shown);
    let n_steps = state.session.history().n_steps().0;
    assert_eq!(n_steps, 100, "a drag is a step");
}

#[test]
fn a_card_under_the_pointer_is_a_ghost_and_a_click_shows_it() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 3);
    quiet(&mut harness);
    let shown = harness.state().state.shown();
    let other = harness.state().state.cards.iter().find(|card| Some(card.id) != shown);
    let (id, title) = other.map(|card| (card.id, card.title())).expect("another");
    let n_bodies = |harness: &Window| {
        motion_editor::viewport::show::staged(&harness.state().state, None)
            .unwrap()
            .scene
            .bodies
            .len()
    };
    assert_eq!(n_bodies(&harness), 1);
    let card = harness.place_of_card(&title);
    harness.event(egui::Event::PointerMoved(card));
    harness.run_steps(3);
    assert_eq!(harness.state().state.hovered_card, Some(id));
    assert_eq!((n_bodies(&harness), harness.state().state.shown()), (2, shown));
    harness.event(egui::Event::PointerMoved(egui::Pos2::new(600.0, 300.0)));
    harness.run_steps(3);
    assert_eq!(n_bodies(&harness), 1, "it goes with the pointer");
    click(&mut harness, card, Modifiers::NONE);
    until(&mut harness, "shown", |app| app.state.shown() == Some(id));
}

#[test]
fn shift_and_a_click_compare_and_keys_say_how() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 4);
    quiet(&mut harness);
    let shown = harness.state().state.shown();
    let others: Vec<_> = {
        let cards = harness.state().state.cards.iter().filter(|card| Some(card.id) != shown);
        cards.take(2).map(|card| (card.id, card.title())).collect()
    };
    for (_, title) in &others {
        let at = harness.place_of_card(title);
        click(&mut harness, at, Modifiers::SHIFT);
    }
    harness.event(egui::Event::PointerMoved(egui::Pos2::new(600.0, 300.0)));
    harness.run_steps(3);
    let state = &harness.state().state;
    assert_eq!((state.comparing.mode, state.shown()), (CompareMode::Overlay, shown));
    assert_eq!(state.compared_cards().len(), 2);
    let scene = motion_editor::viewport::show::staged(state, None).unwrap().scene;
    assert_eq!(scene.bodies.len(), 3, "each is there, at the same time");
    harness.key_press_modifiers(Modifiers::SHIFT, Key::U);
    harness.run_steps(3);
    for (_, title) in &others {
        harness.get_by_role_and_label(Role::Canvas, &format!("View of {title}"));
    }
    harness.key_press(Key::U);
    harness.run_steps(3);
    assert_eq!(harness.state().state.comparing.mode, CompareMode::Off);
    harness.key_press(Key::U);
    harness.run_steps(3);
    assert_eq!(harness.state().state.compared_cards().len(), 2, "they are remembered");
}

#[test]
fn a_name_is_typed_on_the_card_and_is_one_step() {
    let Some(mut harness) = solved() else { return };
    quiet(&mut harness);
    let id = harness.state().state.shown().expect("something is shown");
    harness.key_press(Key::F2);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::TextInput, rename::LABEL);
    harness.event(egui::Event::Text("Over the corner".to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    let name = |harness: &Window| harness.state().state.card(id).and_then(|card| card.name.clone());
    assert_eq!(name(&harness).as_deref(), Some("Over the corner"));
    assert_eq!(harness.state().state.session.history().n_steps().0, 1);
    let saved = harness.state().state.session.document().to_project();
    let again = motion_session::document::Document::from_project(saved);
    assert!(again.takes().iter().any(|take| take.name.as_deref() == Some("Over the corner")));
    harness.key_press_modifiers(Modifiers::CTRL, Key::Z);
    harness.run_steps(2);
    assert_eq!(name(&harness), None);
    harness.key_press(Key::F2);
    harness.run_steps(3);
    harness.event(egui::Event::Text("no".to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(name(&harness), None, "Escape types nothing");
}

#[test]
fn keys_pin_and_lock() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 3);
    quiet(&mut harness);
    let second = harness.state().state.cards[1].id;
    harness.key_press_modifiers(Modifiers::SHIFT, Key::Num2);
    harness.run_steps(3);
    assert_eq!(pinned(&harness), [second]);
    let range = Some(PlayRange { from: 30, to: 80 });
    harness.state_mut().state.session.play(PlaybackCommand::SetRange(range));
    harness.key_press(Key::Y);
    harness.run_steps(3);
    let state = &harness.state().state;
    let lock = state.marks.iter().find(|mark| mark.title().starts_with("Locked")).expect("a lock");
    assert_eq!(lock.span(), (30, 80));
    let motion_session::ConstraintKind::Lock { pieces, .. } = &lock.constraint.kind else {
        panic!("{lock:?}")
    };
    let n_frames: u32 = pieces.iter().map(|piece| piece.to - piece.from + 1).sum();
    assert_eq!(n_frames, 51);
}

#[test]
fn more_like_this_brings_takes_made_of_it() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 3);
    let id = harness.state().state.cards[1].id;
    harness.state_mut().state.more_like(id);
    until(&mut harness, "found", |app| {
        let found = &app.state.session.snapshot().characters[0];
        found.takes.iter().any(|take| take.parent == Some(id) && take.made.is_some())
    });
}

#[test]
fn many_takes_are_few_controls_and_each_has_a_picture() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 6);
    quiet(&mut harness);
    harness.run_steps(40);
    let n_found = harness.state().state.cards.len();
    assert_eq!(harness.state().takes().n_minis(), n_found);
    // As many as a long search keeps.
    let cards = &mut harness.state_mut().state.cards;
    for nth in n_found..24 {
        let mut more = cards[nth % n_found].clone();
        (more.id, more.number) = (TakeId(nth as u64), nth + 1);
        cards.push(more);
    }
    harness.run_steps(3);
    let roles = [Role::Button, Role::TextInput, Role::ComboBox, Role::Slider, Role::CheckBox];
    let n: usize = roles.into_iter().map(|role| harness.query_all_by_role(role).count()).sum();
    assert!(n <= 40, "{n} controls");
    let in_view = harness.query_all_by_role(Role::ListItem).count();
    assert!(in_view > 4, "cards are items of a list");
}

#[test]
fn what_is_better_is_said_and_shown_by_a_click() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 4);
    quiet(&mut harness);
    let worst = harness.state().state.cards.last().map(|card| card.id).expect("a take");
    harness.state_mut().state.show_take(worst);
    until(&mut harness, "shown", |app| app.state.shown() == Some(worst));
    let (best, _) = harness.state().state.better().expect("the worst is not the best");
    harness.state_mut().state.session.search().resume();
    harness.run_steps(20);
    assert_eq!(harness.state().state.shown(), Some(worst), "it is said, not done");
    quiet(&mut harness);
    let button = harness.query_all_by_label_contains("Show the better take").next();
    let at = button.expect("it is said").rect().center();
    let best = harness.state().state.better().map_or(best, |(id, _)| id);
    click(&mut harness, at, Modifiers::NONE);
    until(&mut harness, "shown", |app| app.state.shown() == Some(best));
    assert_eq!(harness.state().state.better(), None);
}

#[test]
fn a_card_that_is_dropped_on_the_timeline_locks_its_stretch() {
    let Some(mut harness) = solved() else { return };
    with_takes(&mut harness, 3);
    quiet(&mut harness);
    let card = harness.state().state.cards[1].clone();
    let from = harness.place_of_card(&card.title());
    let ruler = harness.get_by_label(motion_editor::timeline::ruler::LABEL).rect();
    let to = egui::Pos2::new(ruler.center().x, ruler.bottom() + 60.0);
    harness.drag_at(from);
    harness.run_steps(2);
    for share in [0.2, 0.6, 1.0] {
        harness.event(egui::Event::PointerMoved(from.lerp(to, share)));
        harness.run_steps(2);
    }
    harness.drop_at(to);
    harness.run_steps(3);
    let state = &harness.state().state;
    let lock = state.marks.iter().find(|mark| mark.title().starts_with("Locked")).expect("a lock");
    let (first, last) = lock.span();
    let piece = |piece: &&motion_editor::take_card::Piece| {
        (piece.frames.start, piece.frames.end) == (first as usize, last as usize + 1)
    };
    assert!(card.lane.pieces.iter().any(|p| piece(&p)), "{first}–{last} is a piece of it");
    assert_eq!(state.session.history().n_steps().0, 1);
}

fn click(harness: &mut Window, at: egui::Pos2, modifiers: Modifiers) {
    harness.event(egui::Event::PointerMoved(at));
    harness.run_steps(2);
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        harness.event_modifiers(
            egui::Event::PointerButton { pos: at, button, pressed, modifiers },
            modifiers,
        );
        harness.run_steps(1);
    }
    harness.run_steps(2);
}

/// Where a take's card is.
trait Cards {
    fn place_of_card(&self, title: &str) -> egui::Pos2;
}

impl Cards for Window {
    fn place_of_card(&self, title: &str) -> egui::Pos2 {
        self.get_by_label_contains(&format!("{title}, cost")).rect().center()
    }
}
