//! Pictures without a window.

use std::collections::BTreeMap;

use glam::Vec2;
use motion_scene::body::PickId;
use motion_scene::mesh::{BodyModel, MeshId};
use motion_scene::scene::Scene;

use crate::gpu::{AdapterChoice, Gpu, NoAdapter};
use crate::picking::Picker;
use crate::picture::Picture;
use crate::readback::Readback;
use crate::renderer::{DrawStats, Renderer};
use crate::targets::Targets;
use crate::view::View;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// The size is none a picture can have here.
    #[error(
        "a picture of {width_px} × {height_px} pixels cannot be drawn here; at most {most_px} a side"
    )]
    Size {
        /// Columns asked for.
        width_px: u32,
        /// Rows asked for.
        height_px: u32,
        /// The most columns or rows.
        most_px: u32,
    },
    /// The device went again and again, or no new one could be had.
    #[error("the graphics device was lost ({0})")]
    DeviceLost(String),
}

/// Draws scenes to memory with a device of its own. When the device is lost, it opens another,
/// uploads everything again and goes on.
#[derive(Debug)]
pub struct Offscreen {
    choice: AdapterChoice,
    models: BTreeMap<MeshId, BodyModel>,
    device: OnDevice,
    n_lost: u32,
}

/// Everything that goes with a device.
#[derive(Debug)]
struct OnDevice {
    renderer: Renderer,
    picker: Picker,
    targets: Option<(Targets, Readback)>,
    stats: Option<DrawStats>,
}

impl OnDevice {
    fn open(choice: AdapterChoice) -> Result<Self, NoAdapter> {
        let gpu = Gpu::open(choice)?;
        let renderer = Renderer::new(&gpu);
        Ok(Self { renderer, picker: Picker::new(&gpu), targets: None, stats: None })
    }
}

/// A picture is tried so many times before a device that is lost each time is given up.
const N_TRIES: u32 = 3;

impl Offscreen {
    /// Opens a device.
    pub fn new(choice: AdapterChoice) -> Result<Self, NoAdapter> {
        let device = OnDevice::open(choice)?;
        Ok(Self { choice, models: BTreeMap::new(), device, n_lost: 0 })
    }

    /// What draws, for a person.
    pub fn adapter_name(&self) -> &str {
        self.gpu().adapter_name()
    }

    /// The device in use now.
    pub fn gpu(&self) -> &Gpu {
        self.device.renderer.gpu()
    }

    /// How many devices were lost so far.
    pub fn n_lost(&self) -> u32 {
        self.n_lost
    }

    /// What the last picture took.
    pub fn stats(&self) -> Option<DrawStats> {
        self.device.stats
    }

    /// Makes a model known, in place of one with the same name.
    pub fn set_model(&mut self, id: MeshId, model: &BodyModel) {
        self.models.insert(id, model.clone());
        self.device.renderer.set_model(id, model);
    }

    /// Draws a scene.
    pub fn render(&mut self, scene: &Scene, view: &View) -> Result<Picture, RenderError> {
        let most_px = self.gpu().device().limits().max_texture_dimension_2d;
        let (width_px, height_px) = (view.width_px, view.height_px);
        if width_px == 0 || height_px == 0 || width_px.max(height_px) > most_px {
            return Err(RenderError::Size { width_px, height_px, most_px });
        }
        self.with_device(|device| {
            device.draw(scene, view)?;
            let (targets, readback) = device.targets.as_mut()?;
            let gpu = device.renderer.gpu();
            let mut encoder = gpu
                .device()
                .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("read") });
            readback.copy(&mut encoder, targets.picture());
            gpu.queue().submit([encoder.finish()]);
            readback.begin();
            let mut rgba = readback.wait(gpu)?;
            rgba.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
            Some(Picture { width_px, height_px, rgba })
        })
    }

    /// Draws a scene and waits until it is drawn, but does not fetch it: what a window would take.
    pub fn draw_only(&mut self, scene: &Scene, view: &View) -> Result<DrawStats, RenderError> {
        self.with_device(|device| {
            device.draw(scene, view)?;
            let gpu = device.renderer.gpu();
            gpu.device().poll(wgpu::PollType::wait_indefinitely()).ok()?;
            device.stats
        })
    }

    /// What is at a place of a scene's picture, pixels from its upper left corner.
    pub fn pick(
        &mut self,
        scene: &Scene,
        view: &View,
        px: Vec2,
    ) -> Result<Option<PickId>, RenderError> {
        self.with_device(|device| device.picker.pick(&mut device.renderer, scene, view, px))
    }

    /// Runs `work`, again on a new device as long as devices are lost over it.
    fn with_device<T>(
        &mut self,
        work: impl Fn(&mut OnDevice) -> Option<T>,
    ) -> Result<T, RenderError> {
        for _ in 0..N_TRIES {
            if self.gpu().is_lost() {
                self.reopen()?;
            }
            let done = work(&mut self.device);
            if !self.gpu().is_lost()
                && let Some(done) = done
            {
                return Ok(done);
            }
            // Loss is told by a callback that only polling calls.
            let _polled = self.gpu().device().poll(wgpu::PollType::Poll);
            if !self.gpu().is_lost() {
                return Err(RenderError::DeviceLost("it does not answer".to_owned()));
            }
        }
        Err(RenderError::DeviceLost(format!("{N_TRIES} times in a row")))
    }

    fn reopen(&mut self) -> Result<(), RenderError> {
        self.n_lost += 1;
        self.device = OnDevice::open(self.choice)
            .map_err(|error| RenderError::DeviceLost(error.to_string()))?;
        for (&id, model) in &self.models {
            self.device.renderer.set_model(id, model);
        }
        Ok(())
    }
}

impl OnDevice {
    fn draw(&mut self, scene: &Scene, view: &View) -> Option<()> {
        let gpu = self.renderer.gpu();
        let size_px = (view.width_px, view.height_px);
        if self.targets.as_ref().is_none_or(|(targets, _)| targets.size_px() != size_px) {
            let targets = Targets::new(gpu, view.width_px, view.height_px);
            let readback = Readback::new(gpu, view.width_px, view.height_px);
            self.targets = Some((targets, readback));
        }
        let (targets, _) = self.targets.as_mut()?;
        self.stats = Some(self.renderer.draw(scene, view, targets));
        Some(())
    }
}
