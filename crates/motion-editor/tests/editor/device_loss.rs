//! A window whose device goes saves the work first.

use egui_kittest::Harness;
use motion_editor::app::EditorApp;
use motion_editor::project_source::ProjectSource;
use motion_editor::state::{EditorOptions, EditorState};
use motion_editor::window::{SavedWork, Window};
use motion_session::Warnings;
use motion_session::load_project;

use crate::window::can_draw;

#[test]
fn work_is_saved_when_the_device_goes() {
    if !can_draw() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let saved = SavedWork::default();
    let builder = Harness::builder().with_size(egui::Vec2::new(1000.0, 700.0)).wgpu();
    let of_window = saved.clone();
    let mut harness = builder.build_eframe(move |cc| {
        let app = EditorApp::new(cc, EditorOptions::new(ProjectSource::Sample)).expect("threads");
        Window::new(app, of_window)
    });
    harness.step();
    let window = harness.state_mut();
    assert!(!window.save_if_lost(folder.path()), "nothing is lost yet");
    assert_eq!(saved.take(), None);
    let before = window.app().state.session.document().to_project();

    window.app().viewport.destroy_device();
    window.app().viewport.wait_for_device();
    assert!(window.save_if_lost(folder.path()));
    let work = saved.take().expect("the work is in a file");
    assert!(work.starts_with(folder.path()));
    let again = load_project(&work, &mut Warnings::new()).unwrap();
    assert_eq!(again, before);
    assert!(window.save_if_lost(folder.path()), "it stays lost");
    assert_eq!(saved.take(), None, "and is saved once");

    // What opens again is the same project, under the name of the first.
    let source = ProjectSource::Recovered { work, project: None };
    let state = EditorState::new(EditorOptions::new(source), &egui::Context::default()).unwrap();
    assert_eq!(state.session.document().to_project(), before);
    assert!(state.session.is_changed(), "it is not saved yet");
}
