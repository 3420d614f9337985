//! The page on what the library can do.

use std::time::{Duration, Instant};

use egui::{Key, Role};
use egui_kittest::kittest::Queryable as _;
use motion_editor::ui_command::UiCommand;

use crate::window::solved;

#[test]
fn the_page_says_what_to_record_and_goes_at_escape() {
    const LIMIT: Duration = Duration::from_secs(60);
    let Some(mut window) = solved() else { return };
    window.state_mut().state.ask(UiCommand::Coverage);
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::Window, "Coverage").is_some());
    let start = Instant::now();
    while window.query_by_label("To record").is_none() {
        assert!(start.elapsed() < LIMIT, "no report comes");
        std::thread::sleep(Duration::from_millis(20));
        window.step();
    }
    window.run_steps(3);
    for label in ["No run comes to a stand", "Copy list"] {
        assert!(window.query_by_label_contains(label).is_some(), "{label}");
    }
    let cell = window.get_by_label_contains("walking, straight: ");
    assert!(cell.rect().width() > 40.0, "{:?}", cell.rect());
    if let Some(folder) = std::env::var_os("GAITWAY_KEEP_PICTURES") {
        let picture = window.render().expect("a software device renders");
        picture.save(std::path::Path::new(&folder).join("coverage.png")).expect("there is room");
    }
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::Window, "Coverage").is_none(), "it is gone");
}
