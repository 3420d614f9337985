//! Tags of clips: found, shown, given by hand.

use egui::{Key, Modifiers, PointerButton, Role};
use egui_kittest::kittest::Queryable as _;

use crate::window::{quiet, solved};

#[test]
fn what_a_pattern_finds_is_switched_as_one_step() {
    let Some(mut window) = solved() else { return };
    quiet(&mut window);
    window.get_by_role_and_label(Role::TextInput, "Find clips").click();
    window.run_steps(2);
    window.event(egui::Event::Text("run*".to_owned()));
    window.run_steps(3);
    window.get_by_role_and_label(Role::Button, "Use none of these").click();
    window.run_steps(3);
    let is_in = |id: &str, window: &egui_kittest::Harness<'_, motion_editor::app::EditorApp>| {
        let rows = &window.state().state.clips;
        rows.iter().find(|row| row.id == id).map(|row| row.is_in_palette)
    };
    assert_eq!((is_in("run", &window), is_in("walk", &window)), (Some(false), Some(true)));
    window.get_by_role_and_label(Role::Button, "Use these").click();
    window.run_steps(3);
    assert_eq!(is_in("run", &window), Some(true));
    assert_eq!(window.state().state.session.document().palette(), None, "all are in use again");
}

#[test]
fn a_clip_is_tagged_from_its_line_and_the_tag_is_undone() {
    let Some(mut window) = solved() else { return };
    quiet(&mut window);
    let clip = window.state().state.clips[0].clone();
    assert!(!clip.spans.is_empty(), "rules find something in each of our clips");
    let line = window.get_by_label_contains(&format!("Clip {},", clip.id)).rect().center();
    for pressed in [true, false] {
        window.event(egui::Event::PointerMoved(line));
        window.event(egui::Event::PointerButton {
            pos: line,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.run_steps(2);
    }
    window.get_by_role_and_label(Role::TextInput, "New tag").click();
    window.run_steps(2);
    window.event(egui::Event::Text("tired".to_owned()));
    window.run_steps(2);
    if let Some(folder) = std::env::var_os("GAITWAY_KEEP_PICTURES") {
        let picture = window.render().expect("a software device renders");
        picture.save(std::path::Path::new(&folder).join("tag_menu.png")).expect("there is room");
    }
    window.get_by_role_and_label(Role::Button, "Tag clip").click();
    window.run_steps(3);
    let state = &window.state().state;
    assert_eq!(state.session.document().hand_tags().of(&clip.id).len(), 1);
    assert!(state.clips[0].tags.iter().any(|tag| tag == "tired"), "{:?}", state.clips[0].tags);
    assert!(window.query_by_label_contains("Take away tired").is_some(), "the menu stays");
    window.key_press(Key::Escape);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::CTRL, Key::Z);
    window.run_steps(3);
    assert!(window.state().state.session.document().hand_tags().is_empty(), "undone");
    assert_eq!(window.state().state.clips[0].tags, clip.tags);
}
