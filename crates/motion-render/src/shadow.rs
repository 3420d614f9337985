//! What the key light sees: a map of depths around everything that stops light.

use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_to_mat4;
use glam::{Mat4, Vec3};
use motion_scene::bounds::Bounds;

/// Texels are this wide where the map is large enough: six of them make a soft edge of 3–4 cm.
const TEXEL_M: f32 = 0.006;
/// Columns and rows of a map, at least and at most.
const LEAST_PX: u32 = 256;
const MOST_PX: u32 = 2048;
/// Casters further apart than this share one coarse map around the middle of the picture.
const MOST_EXTENT_M: f32 = 60.0;
/// Empty texels around the casters, for the taps of soft edges.
const BORDER_PX: f32 = 4.0;

/// The key light's view of all casters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShadowFit {
    /// From the world to the light's clip cube.
    pub(crate) clip_from_world: Mat4,
    /// Columns and rows in use.
    pub(crate) size_px: u32,
    /// Columns and rows of the texture; the part in use is its upper left.
    pub(crate) texture_px: u32,
    /// A texel's width, metres.
    pub(crate) texel_m: f32,
}

impl ShadowFit {
    /// The least map that holds `casters`, seen along `towards_key`. `texture_px` is what the
    /// texture has already; it never becomes smaller.
    pub(crate) fn new(
        casters: Option<Bounds>,
        towards_key: Vec3,
        middle_m: Vec3,
        texture_px: u32,
    ) -> Self {
        let Some(casters) = casters else { return Self::empty(texture_px) };
        let reach = Vec3::splat(0.5 * MOST_EXTENT_M);
        let casters = Bounds {
            min_m: casters.min_m.max(middle_m - reach),
            max_m: casters.max_m.min(middle_m + reach),
        };
        if !(casters.min_m.cmple(casters.max_m).all()) {
            return Self::empty(texture_px);
        }
        let up = if towards_key.y.abs() > 0.99 { Vec3::Z } else { Vec3::Y };
        let light_from_world = look_to_mat4(Vec3::ZERO, -towards_key, up);
        let corners = casters.corners().map(|corner| light_from_world.transform_point3(corner));
        let Some(seen) = Bounds::of_points(&corners) else { return Self::empty(texture_px) };
        let extent_m = seen.size().x.max(seen.size().y).max(0.1);
        let size_px = ((extent_m / TEXEL_M + 2.0 * BORDER_PX).ceil() as u32)
            .next_multiple_of(64)
            .clamp(LEAST_PX, MOST_PX);
        let texel_m = (extent_m / (size_px as f32 - 2.0 * BORDER_PX)).max(TEXEL_M);
        let half_m = 0.5 * texel_m * size_px as f32;
        // Whole texels, so that edges do not crawl while a body moves.
        let center = (seen.center() / texel_m).round() * texel_m;
        let (near, far) = (-seen.max_m.z - 1.0, -seen.min_m.z + 1.0);
        let clip_from_light = directx::orthographic(
            center.x - half_m,
            center.x + half_m,
            center.y - half_m,
            center.y + half_m,
            near,
            far,
        );
        Self {
            clip_from_world: clip_from_light * light_from_world,
            size_px,
            texture_px: texture_px.max(size_px.next_power_of_two()).max(LEAST_PX),
            texel_m,
        }
    }

    fn empty(texture_px: u32) -> Self {
        Self {
            clip_from_world: Mat4::IDENTITY,
            size_px: LEAST_PX,
            texture_px: texture_px.max(LEAST_PX),
            texel_m: TEXEL_M,
        }
    }

    /// From the world to the texture: x right, y down, both 0 to 1 over the whole texture; z depth.
    pub(crate) fn texture_from_world(&self) -> Mat4 {
        let share = self.size_px as f32 / self.texture_px as f32;
        let scale = Vec3::new(0.5 * share, -0.5 * share, 1.0);
        let shift = Vec3::new(0.5 * share, 0.5 * share, 0.0);
        Mat4::from_translation(shift) * Mat4::from_scale(scale) * self.clip_from_world
    }

    /// A texel's width in texture coordinates.
    pub(crate) fn texel_share(&self) -> f32 {
        1.0 / self.texture_px as f32
    }
}
