//! Opens the window.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::sync::Arc;

use egui::ViewportBuilder;
use egui_wgpu::{WgpuSetup, WgpuSetupCreateNew, wgpu};

use crate::app::EditorApp;
use crate::state::EditorOptions;
use crate::window::{SavedWork, Window};

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Neither X11 nor Wayland answers.
    #[error("there is no display to open a window on ({0})")]
    NoDisplay(String),
    /// There is a display, but nothing draws on it.
    #[error("the window could not be opened ({0})")]
    NoWindow(String),
}

/// How a window ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Closed {
    /// Somebody closed it.
    ByUser,
    /// Its graphics device was lost; the work is in this file.
    DeviceLost(PathBuf),
}

/// Opens the editor and returns when its window is closed, or went down with its device.
pub fn run(editor: EditorOptions) -> Result<Closed, OpenError> {
    let saved = SavedWork::default();
    let opened = catch_unwind(AssertUnwindSafe(|| open(editor, saved.clone())));
    if let Some(path) = saved.take() {
        return Ok(Closed::DeviceLost(path));
    }
    opened.unwrap_or_else(|panic| resume_unwind(panic)).map(|()| Closed::ByUser)
}

fn open(editor: EditorOptions, saved: SavedWork) -> Result<(), OpenError> {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.device_descriptor = Arc::new(|adapter| wgpu::DeviceDescriptor {
        label: Some("gaitway"),
        required_limits: motion_render::gpu::required_limits(&adapter.limits()),
        ..Default::default()
    });
    let mut options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_app_id("gaitway")
            .with_title("Gaitway")
            .with_inner_size([1600.0, 1000.0])
            .with_min_inner_size([960.0, 600.0]),
        ..Default::default()
    };
    options.wgpu_options.wgpu_setup = WgpuSetup::CreateNew(setup);
    let create = Box::new(move |cc: &eframe::CreationContext<'_>| {
        let app = EditorApp::new(cc, editor)?;
        let window: Box<dyn eframe::App> = Box::new(Window::new(app, saved));
        Ok(window)
    });
    eframe::run_native("gaitway", options, create).map_err(|error| {
        // The last part of the chain says it; what is before names places in libraries.
        let text = error.to_string();
        let first = text.lines().next().unwrap_or_default();
        let first = first.rsplit(": ").next().unwrap_or(first).trim_end_matches('.').to_owned();
        match error {
            eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => {
                OpenError::NoDisplay(first)
            }
            _ => OpenError::NoWindow(first),
        }
    })
}
