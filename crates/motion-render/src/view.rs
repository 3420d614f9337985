//! From where and how large a scene is drawn.

use motion_scene::camera::{OrbitCamera, Viewport};

/// A picture to be made: camera and size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From where.
    pub camera: OrbitCamera,
    /// Columns, at least 1.
    pub width_px: u32,
    /// Rows, at least 1.
    pub height_px: u32,
    /// How large a point is: 1 on ordinary screens, 2 on fine ones. Lines and letters grow with it.
    pub pixels_per_point: f32,
}

impl View {
    /// The picture's size for the camera's mathematics.
    pub fn viewport(&self) -> Viewport {
        Viewport::new(self.width_px as f32, self.height_px as f32)
    }
}
