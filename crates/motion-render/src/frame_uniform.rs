//! What every shader knows of a picture.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use motion_scene::camera::Projection;
use motion_scene::color::LinearRgba;
use motion_scene::ground::Surroundings;
use motion_scene::scene::Scene;

use crate::shadow::ShadowFit;
use crate::view::View;

/// Keep in sync with `Frame` in common/frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FrameUniform {
    clip_from_world: Mat4,
    shadow_from_world: Mat4,
    eye: Vec4,
    forward: Vec4,
    right: Vec4,
    up: Vec4,
    viewport: Vec4,
    towards_key: Vec4,
    key: Vec4,
    sky_light: Vec4,
    bounce_light: Vec4,
    sky_top: Vec4,
    horizon: Vec4,
    floor_color: Vec4,
    grid: Vec4,
    x_axis: Vec4,
    z_axis: Vec4,
    misc: Vec4,
}

/// The floor fades at this many camera distances, but not nearer than [`LEAST_FADE_M`].
const FADE_DISTANCES: f32 = 5.0;
const LEAST_FADE_M: f32 = 30.0;

impl FrameUniform {
    /// The uniform of a scene in a view. `clip_from_world` is the camera's, or that of a part of
    /// its picture.
    pub(crate) fn new(scene: &Scene, view: &View, clip_from_world: Mat4, fit: &ShadowFit) -> Self {
        let camera = &view.camera;
        let viewport = view.viewport();
        let rotation = camera.world_from_view_rotation();
        let half_height = match camera.projection {
            Projection::Perspective { vertical_fov_rad } => (0.5 * vertical_fov_rad).tan(),
            Projection::Orthographic => camera.half_height_at_target_m(),
        };
        let is_perspective = match camera.projection {
            Projection::Perspective { .. } => 1.0,
            Projection::Orthographic => 0.0,
        };
        let fade_m = (FADE_DISTANCES * camera.distance_m).max(LEAST_FADE_M);
        let light = &scene.light;
        let vec = |rgb: [f32; 3]| Vec3::from(rgb).extend(0.0);
        let rgba = |color: LinearRgba| Vec4::from(color.to_srgb());
        let around = Surroundings::of(scene.theme);
        let has_grid = scene.ground.is_some_and(|ground| ground.has_grid);
        Self {
            clip_from_world,
            shadow_from_world: fit.texture_from_world(),
            eye: camera.eye_m().extend(is_perspective),
            forward: camera.forward().extend(fade_m),
            right: (rotation * Vec3::X).extend(half_height * viewport.aspect()),
            up: (rotation * Vec3::Y).extend(half_height),
            viewport: Vec4::new(
                viewport.width_px,
                viewport.height_px,
                1.0 / viewport.width_px,
                1.0 / viewport.height_px,
            ),
            towards_key: light.towards_key.extend(light.shadow),
            key: vec(light.key),
            sky_light: vec(light.sky),
            bounce_light: vec(light.bounce),
            sky_top: rgba(around.sky_top),
            horizon: rgba(around.horizon),
            floor_color: rgba(around.floor),
            grid: rgba(around.grid),
            x_axis: rgba(around.x_axis),
            z_axis: rgba(around.z_axis),
            misc: Vec4::new(
                view.pixels_per_point,
                fit.texel_share(),
                fit.texel_m,
                if has_grid { 1.0 } else { 0.0 },
            ),
        }
    }

    /// The same for a square target of that size.
    pub(crate) fn with_viewport_px(self, size_px: f32) -> Self {
        Self { viewport: Vec4::new(size_px, size_px, 1.0 / size_px, 1.0 / size_px), ..self }
    }

    /// The uniform with which the shadow map is drawn: only the matrix counts.
    pub(crate) fn of_light(fit: &ShadowFit) -> Self {
        Self { clip_from_world: fit.clip_from_world, ..Self::zeroed() }
    }
}
