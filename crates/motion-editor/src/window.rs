//! The editor in a window whose graphics device may go.
//!
//! A driver is reset, a card is unplugged, a laptop changes cards: then everything on the device is
//! gone, and egui's own painting panics over it. The work is not: whichever notices first, it is
//! saved to a file before the window goes down, and whoever opened the window can open another on
//! it. (Not in this process: the event loop of a window that went down like that cannot be used
//! again.)

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use egui::Ui;
use motion_session::recovery::{recovery_folder, save_for_recovery};

use crate::app::EditorApp;

/// Where the work was saved when a window lost its device.
#[derive(Clone, Debug, Default)]
pub struct SavedWork(Arc<Mutex<Option<PathBuf>>>);

impl SavedWork {
    /// The file, once.
    pub fn take(&self) -> Option<PathBuf> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn set(&self, path: PathBuf) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(path);
    }
}

/// An [`EditorApp`] in a window.
pub struct Window {
    app: EditorApp,
    saved: SavedWork,
    /// Whether the work was saved for a lost device already.
    is_given_up: bool,
}

impl Window {
    /// A window on an app. Where it loses its device, `saved` tells where the work is.
    pub fn new(app: EditorApp, saved: SavedWork) -> Self {
        Self { app, saved, is_given_up: false }
    }

    /// The editor in it.
    pub fn app(&self) -> &EditorApp {
        &self.app
    }

    /// Saves the work to `folder` if the device is lost and this was not done yet. Gives whether the
    /// device is lost.
    pub fn save_if_lost(&mut self, folder: &Path) -> bool {
        if !self.app.viewport.is_device_lost() {
            return false;
        }
        if !std::mem::replace(&mut self.is_given_up, true) {
            let project = self.app.state.session.document().to_project();
            let fallback = std::env::temp_dir();
            let saved = save_for_recovery(&project, folder)
                .or_else(|_| save_for_recovery(&project, &fallback));
            if let Ok(path) = saved {
                self.saved.set(path);
                // It would be offered beside what is saved.
                self.app.state.session.close();
            }
        }
        true
    }

    /// For trying it out: Ctrl+Shift+F12 destroys the device.
    #[cfg(debug_assertions)]
    fn destroy_device_on_key(&self, ui: &Ui) {
        let keys = egui::Modifiers::COMMAND | egui::Modifiers::SHIFT;
        if ui.input_mut(|input| input.consume_key(keys, egui::Key::F12)) {
            self.app.viewport.destroy_device();
        }
    }
}

/// What unwinds from a window whose device was found lost.
#[derive(Debug)]
pub struct DeviceLost;

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        #[cfg(debug_assertions)]
        self.destroy_device_on_key(ui);
        if self.save_if_lost(&recovery_folder()) {
            // Not a panic, so nothing is said; painting would be one.
            std::panic::resume_unwind(Box::new(DeviceLost));
        }
        self.app.ui(ui, frame);
    }

    fn on_exit(&mut self) {
        self.app.on_exit();
    }
}

impl Drop for Window {
    /// Painting may meet the loss first, and unwinds through here.
    fn drop(&mut self) {
        if std::thread::panicking() {
            // Loss is told only when the device has nothing left to do.
            self.app.viewport.wait_for_device();
        }
        self.save_if_lost(&recovery_folder());
    }
}
