//! Scenes drawn, with the models of a stage.

use motion_render::gpu::AdapterChoice;
use motion_render::offscreen::{Offscreen, RenderError};
use motion_render::picture::Picture;
use motion_render::view::View;
use motion_scene::camera::OrbitCamera;
use motion_scene::scene::Scene;
use motion_session::stage::Stage;

use crate::args::render::Size;
use crate::output::Failure;

/// Draws scenes of a stage.
pub(crate) struct Painter {
    offscreen: Offscreen,
}

impl Painter {
    /// Opens an adapter and makes the stage's models known to it.
    pub(crate) fn new(choice: AdapterChoice, stage: &Stage) -> Result<Self, Failure> {
        let mut offscreen = Offscreen::new(choice).map_err(anyhow::Error::from)?;
        for actor in &stage.actors {
            offscreen.set_model(actor.figure.mesh, &actor.figure.model);
        }
        Ok(Self { offscreen })
    }

    /// What draws, for a person.
    pub(crate) fn adapter_name(&self) -> &str {
        self.offscreen.adapter_name()
    }

    /// Draws a scene. A size that this adapter cannot draw is wrong input.
    pub(crate) fn paint(
        &mut self,
        scene: &Scene,
        camera: OrbitCamera,
        size: Size,
        pixels_per_point: f32,
    ) -> Result<Picture, Failure> {
        let view = View { camera, width_px: size.width, height_px: size.height, pixels_per_point };
        self.offscreen.render(scene, &view).map_err(|error| match error {
            RenderError::Size { most_px, .. } => {
                Failure::wrong(format!("{error}; use --size with no side above {most_px}"))
            }
            RenderError::DeviceLost(_) => Failure::Other(error.into()),
        })
    }
}

/// How large a point is on a picture of this height: words stay readable on small pictures and do
/// not get lost on large ones.
pub(crate) fn pixels_per_point(height_px: u32) -> f32 {
    0.35 + height_px as f32 / 720.0
}
