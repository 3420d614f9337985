//! The camera: a point looked at, from where, and how the world falls on the picture.
//!
//! Pixels count from the upper left corner of the picture, x to the right, y down. Depth is
//! reversed (1 at the near plane, 0 at infinity), which keeps precision far away.

use glam::camera::rh::proj::directx;
use glam::{Mat4, Quat, Vec2, Vec3};

use crate::bounds::Bounds;

/// How the world falls on the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// As seen by an eye.
    Perspective {
        /// Angle from the lower to the upper edge.
        vertical_fov_rad: f32,
    },
    /// Without vanishing points.
    Orthographic,
}

/// A direction from which things are commonly looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardView {
    /// From +Z: a person at rest looks into the camera.
    Front,
    /// From −Z.
    Back,
    /// From +X, the person's left.
    Left,
    /// From −X, the person's right.
    Right,
    /// From above, +Z down the picture.
    Top,
    /// From the front left and a little above.
    ThreeQuarter,
}

/// Width and height of a picture, pixels; both at least 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Columns.
    pub width_px: f32,
    /// Rows.
    pub height_px: f32,
}

impl Viewport {
    /// A viewport; sizes under 1 are taken for 1.
    pub fn new(width_px: f32, height_px: f32) -> Self {
        Self { width_px: width_px.max(1.0), height_px: height_px.max(1.0) }
    }

    /// Width over height.
    pub fn aspect(self) -> f32 {
        self.width_px / self.height_px
    }
}

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins, metres.
    pub origin_m: Vec3,
    /// Unit length.
    pub direction: Vec3,
}

impl Ray {
    /// Where it meets the horizontal plane at `height_m`, if it does.
    pub fn at_height(&self, height_m: f32) -> Option<Vec3> {
        let along = (height_m - self.origin_m.y) / self.direction.y;
        (along.is_finite() && along > 0.0).then(|| self.origin_m + self.direction * along)
    }

    /// Where it meets the plane through `point_m` across `normal`, if it does.
    pub fn at_plane(&self, point_m: Vec3, normal: Vec3) -> Option<Vec3> {
        let along = (point_m - self.origin_m).dot(normal) / self.direction.dot(normal);
        (along.is_finite() && along > 0.0).then(|| self.origin_m + self.direction * along)
    }

    /// How near it passes to a point, and how far along itself.
    pub fn distance_to(&self, point_m: Vec3) -> (f32, f32) {
        let along = (point_m - self.origin_m).dot(self.direction).max(0.0);
        ((self.origin_m + self.direction * along).distance(point_m), along)
    }
}

/// Where a point of the world falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// On the picture, pixels; may lie outside it.
    pub px: Vec2,
    /// Distance from the eye along its view, metres; always positive.
    pub depth_m: f32,
}

/// A camera that circles a point.
///
/// Yaw 0 stands at +Z of the target and looks along −Z; yaw grows to the right around it (a
/// camera at +X has a quarter turn). Pitch is how far it looks down: positive stands above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitCamera {
    /// What is looked at, metres.
    pub target_m: Vec3,
    /// Around the vertical.
    pub yaw_rad: f32,
    /// Above the horizon.
    pub pitch_rad: f32,
    /// From the eye to the target, metres. In an orthographic picture it sets the size.
    pub distance_m: f32,
    /// How the world falls on the picture.
    pub projection: Projection,
}

/// A lens of some 45 mm: bodies keep their proportions.
pub const FOV_RAD: f32 = 0.52;
/// Straight down is possible, upside down is not.
const MAX_PITCH_RAD: f32 = std::f32::consts::FRAC_PI_2;
const MIN_DISTANCE_M: f32 = 0.05;
const MAX_DISTANCE_M: f32 = 2_000.0;
/// Nothing nearer than this is drawn, as a share of the distance.
const NEAR_SHARE: f32 = 0.02;
/// Half the depth of an orthographic picture, metres.
const ORTHO_REACH_M: f32 = 1_000.0;

impl Default for OrbitCamera {
    fn default() -> Self {
        Self::standard(StandardView::ThreeQuarter, Vec3::new(0.0, 0.9, 0.0), 5.5)
    }
}

impl OrbitCamera {
    /// A view of `target_m` from a common direction. All but three-quarter are orthographic.
    pub fn standard(view: StandardView, target_m: Vec3, distance_m: f32) -> Self {
        use std::f32::consts::{FRAC_PI_2, PI};
        let (yaw_rad, pitch_rad) = match view {
            StandardView::Front => (0.0, 0.0),
            StandardView::Back => (PI, 0.0),
            StandardView::Left => (FRAC_PI_2, 0.0),
            StandardView::Right => (-FRAC_PI_2, 0.0),
            StandardView::Top => (0.0, FRAC_PI_2),
            StandardView::ThreeQuarter => (0.65, 0.28),
        };
        let projection = match view {
            StandardView::ThreeQuarter => Projection::Perspective { vertical_fov_rad: FOV_RAD },
            _ => Projection::Orthographic,
        };
        Self { target_m, yaw_rad, pitch_rad, distance_m, projection }
    }

    /// From the view's axes (x right, y up, z towards the viewer) to the world's.
    pub fn world_from_view_rotation(&self) -> Quat {
        Quat::from_rotation_y(self.yaw_rad) * Quat::from_rotation_x(-self.pitch_rad)
    }

    /// Where the eye is.
    pub fn eye_m(&self) -> Vec3 {
        self.target_m + self.world_from_view_rotation() * Vec3::Z * self.distance_m
    }

    /// Where the eye looks, unit length.
    pub fn forward(&self) -> Vec3 {
        self.world_from_view_rotation() * Vec3::NEG_Z
    }

    /// From the world to the eye.
    pub fn view_from_world(&self) -> Mat4 {
        Mat4::from_rotation_translation(self.world_from_view_rotation(), self.eye_m()).inverse()
    }

    /// From the eye to the clip cube, with depth reversed.
    pub fn clip_from_view(&self, viewport: Viewport) -> Mat4 {
        match self.projection {
            Projection::Perspective { vertical_fov_rad } => {
                let near = self.distance_m * NEAR_SHARE;
                directx::perspective_infinite_reverse(vertical_fov_rad, viewport.aspect(), near)
            }
            Projection::Orthographic => {
                let half = Vec2::new(viewport.aspect(), 1.0) * self.half_height_at_target_m();
                let (near, far) =
                    (self.distance_m - ORTHO_REACH_M, self.distance_m + ORTHO_REACH_M);
                // Near and far change places: depth is reversed.
                directx::orthographic(-half.x, half.x, -half.y, half.y, far, near)
            }
        }
    }

    /// From the world to the clip cube.
    pub fn clip_from_world(&self, viewport: Viewport) -> Mat4 {
        self.clip_from_view(viewport) * self.view_from_world()
    }

    /// Half the height of the picture at the target's distance, metres.
    pub fn half_height_at_target_m(&self) -> f32 {
        match self.projection {
            Projection::Perspective { vertical_fov_rad } => {
                self.distance_m * (0.5 * vertical_fov_rad).tan()
            }
            // What a perspective picture would show, so that changing over keeps the size.
            Projection::Orthographic => self.distance_m * (0.5 * FOV_RAD).tan(),
        }
    }

    /// How large a pixel is in the world at a depth, metres.
    pub fn metres_per_px(&self, depth_m: f32, viewport: Viewport) -> f32 {
        let at_target = 2.0 * self.half_height_at_target_m() / viewport.height_px;
        match self.projection {
            Projection::Perspective { .. } => at_target * depth_m / self.distance_m,
            Projection::Orthographic => at_target,
        }
    }

    /// Where a point falls on the picture; `None` behind the eye.
    pub fn project(&self, point_m: Vec3, viewport: Viewport) -> Option<Projected> {
        let in_view = self.view_from_world().transform_point3(point_m);
        let depth_m = -in_view.z;
        let is_perspective = matches!(self.projection, Projection::Perspective { .. });
        if is_perspective && depth_m < self.distance_m * NEAR_SHARE {
            return None;
        }
        let clip = self.clip_from_view(viewport).project_point3(in_view);
        let share = Vec2::new(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y);
        let px = share * Vec2::new(viewport.width_px, viewport.height_px);
        Some(Projected { px, depth_m: depth_m.max(f32::MIN_POSITIVE) })
    }

    /// What lies under a pixel's place on the picture.
    pub fn ray_through(&self, px: Vec2, viewport: Viewport) -> Ray {
        let share = px / Vec2::new(viewport.width_px, viewport.height_px);
        let on_screen = Vec2::new(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y);
        let half = Vec2::new(viewport.aspect(), 1.0) * self.half_height_at_target_m();
        let rotation = self.world_from_view_rotation();
        let across = on_screen * half;
        match self.projection {
            Projection::Perspective { .. } => Ray {
                origin_m: self.eye_m(),
                direction: (rotation * across.extend(-self.distance_m))
                    .normalize_or(self.forward()),
            },
            Projection::Orthographic => {
                let back = rotation * Vec3::Z * ORTHO_REACH_M;
                let origin_m = self.target_m + rotation * across.extend(0.0) + back;
                Ray { origin_m, direction: self.forward() }
            }
        }
    }

    /// Circles the target.
    pub fn orbit(&mut self, yaw_rad: f32, pitch_rad: f32) {
        let turn = std::f32::consts::TAU;
        self.yaw_rad = (self.yaw_rad + yaw_rad + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
        self.pitch_rad = (self.pitch_rad + pitch_rad).clamp(-MAX_PITCH_RAD, MAX_PITCH_RAD);
    }

    /// Moves so that what is at the target's depth follows a pointer that moved `by_px`.
    pub fn pan(&mut self, by_px: Vec2, viewport: Viewport) {
        let m_per_px = 2.0 * self.half_height_at_target_m() / viewport.height_px;
        let by = Vec2::new(-by_px.x, by_px.y) * m_per_px;
        self.target_m += self.world_from_view_rotation() * by.extend(0.0);
    }

    /// Comes nearer (`factor` under 1) or goes away, keeping what is under `px` where it is.
    pub fn dolly(&mut self, factor: f32, px: Vec2, viewport: Viewport) {
        let before_m = self.distance_m;
        self.distance_m = (before_m * factor).clamp(MIN_DISTANCE_M, MAX_DISTANCE_M);
        let from_center = px - 0.5 * Vec2::new(viewport.width_px, viewport.height_px);
        let across = Vec2::new(from_center.x, -from_center.y)
            * (2.0 * self.half_height_at_target_m() / viewport.height_px)
            * (before_m / self.distance_m - 1.0);
        self.target_m += self.world_from_view_rotation() * across.extend(0.0);
    }

    /// Looks at all of `bounds` from the direction it looks from, with `margin` around (0.1 leaves
    /// a tenth of the picture free on every side).
    pub fn frame(&mut self, bounds: &Bounds, viewport: Viewport, margin: f32) {
        let into_view = self.world_from_view_rotation().inverse();
        let corners: Vec<Vec3> = bounds.corners().map(|c| into_view * c).to_vec();
        let Some(in_view) = Bounds::of_points(&corners) else { return };
        let center = in_view.center();
        let slope = match self.projection {
            Projection::Perspective { vertical_fov_rad } => (0.5 * vertical_fov_rad).tan(),
            Projection::Orthographic => (0.5 * FOV_RAD).tan(),
        };
        let free = (1.0 - 2.0 * margin).max(0.1);
        let half_slope = Vec2::new(slope * viewport.aspect(), slope) * free;
        let mut distance_m = MIN_DISTANCE_M;
        for corner in &corners {
            let off = *corner - center;
            let needs = (off.truncate().abs() / half_slope).max_element();
            let towards = match self.projection {
                Projection::Perspective { .. } => off.z,
                Projection::Orthographic => 0.0,
            };
            distance_m = distance_m.max(needs + towards);
        }
        self.target_m = self.world_from_view_rotation() * center;
        self.distance_m = distance_m.clamp(MIN_DISTANCE_M, MAX_DISTANCE_M);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const VIEWPORT: Viewport = Viewport { width_px: 640.0, height_px: 360.0 };

    fn cameras() -> impl Strategy<Value = OrbitCamera> {
        let target = (-20.0_f32..20.0, -2.0_f32..4.0, -20.0_f32..20.0);
        (target, -3.0_f32..3.0, -1.5_f32..1.5, 0.5_f32..50.0, any::<bool>()).prop_map(
            |((x, y, z), yaw_rad, pitch_rad, distance_m, is_perspective)| OrbitCamera {
                target_m: Vec3::new(x, y, z),
                yaw_rad,
                pitch_rad,
                distance_m,
                projection: if is_perspective {
                    Projection::Perspective { vertical_fov_rad: FOV_RAD }
                } else {
                    Projection::Orthographic
                },
            },
        )
    }

    proptest! {
        /// The ray through the pixel that a point falls on passes through the point.
        #[test]
        fn rays_go_where_points_fall(
            camera in cameras(),
            off in (-0.4_f32..0.4, -0.4_f32..0.4, -0.4_f32..0.4),
        ) {
            let point = camera.target_m + Vec3::from(off) * camera.distance_m;
            let at = camera.project(point, VIEWPORT).unwrap();
            let ray = camera.ray_through(at.px, VIEWPORT);
            let (miss, along) = ray.distance_to(point);
            prop_assert!(miss < 2e-3 * camera.distance_m, "misses by {miss}");
            prop_assert!(along > 0.0);
            prop_assert!((ray.direction.length() - 1.0).abs() < 1e-5);
        }

        /// What is framed is in the picture, with the margin, and touches it.
        #[test]
        fn framed_boxes_fill_the_picture(
            mut camera in cameras(),
            size in (0.1_f32..5.0, 0.1_f32..5.0, 0.1_f32..5.0),
        ) {
            let bounds = Bounds::of_point(Vec3::new(3.0, 1.0, -2.0))
                .union(Bounds::of_point(Vec3::new(3.0, 1.0, -2.0) + Vec3::from(size)));
            camera.frame(&bounds, VIEWPORT, 0.1);
            let mut nearest = f32::INFINITY;
            for corner in bounds.corners() {
                let px = camera.project(corner, VIEWPORT).unwrap().px;
                let share = px / Vec2::new(VIEWPORT.width_px, VIEWPORT.height_px);
                let free = share.min(1.0 - share).min_element();
                prop_assert!(free > 0.098, "{corner} is {free} from the edge");
                nearest = nearest.min(free);
            }
            prop_assert!(nearest < 0.35, "much too small: {nearest}");
        }

        /// Dolly keeps what is under the pointer at the target's depth.
        #[test]
        fn dolly_keeps_what_is_under_the_pointer(
            mut camera in cameras(),
            px in (50.0_f32..590.0, 50.0_f32..310.0),
            factor in 0.5_f32..2.0,
        ) {
            let px = Vec2::from(px);
            let before = camera.ray_through(px, VIEWPORT);
            let point = before.at_plane(camera.target_m, camera.forward()).unwrap();
            camera.dolly(factor, px, VIEWPORT);
            let after = camera.project(point, VIEWPORT).unwrap().px;
            prop_assert!(after.distance(px) < 0.2, "{px} went to {after}");
        }

        /// Pan moves what is at the target's depth with the pointer.
        #[test]
        fn pan_follows_the_pointer(mut camera in cameras(), by in (-90.0_f32..90.0, -90.0_f32..90.0)) {
            let by = Vec2::from(by);
            let before = camera.project(camera.target_m, VIEWPORT).unwrap().px;
            let point = camera.target_m;
            camera.pan(by, VIEWPORT);
            let after = camera.project(point, VIEWPORT).unwrap().px;
            prop_assert!((after - before).distance(by) < 0.2);
        }
    }

    #[test]
    fn standard_views_stand_where_they_say() {
        let from = |view| {
            let camera = OrbitCamera::standard(view, Vec3::Y, 5.0);
            (camera.eye_m() - Vec3::Y) / 5.0
        };
        let sides = [
            (StandardView::Front, Vec3::Z),
            (StandardView::Back, Vec3::NEG_Z),
            (StandardView::Left, Vec3::X),
            (StandardView::Right, Vec3::NEG_X),
            (StandardView::Top, Vec3::Y),
        ];
        for (view, expected) in sides {
            assert!(from(view).distance(expected) < 1e-5, "{view:?}: {}", from(view));
        }
        let three_quarter = from(StandardView::ThreeQuarter);
        assert!(three_quarter.min_element() > 0.1, "front, left, above: {three_quarter}");
    }

    #[test]
    fn from_above_ahead_is_down_the_picture_and_left_is_right() {
        let camera = OrbitCamera::standard(StandardView::Top, Vec3::ZERO, 5.0);
        let middle = camera.project(Vec3::ZERO, VIEWPORT).unwrap().px;
        let ahead = camera.project(Vec3::Z, VIEWPORT).unwrap().px;
        let left = camera.project(Vec3::X, VIEWPORT).unwrap().px;
        assert!(ahead.y > middle.y + 10.0 && (ahead.x - middle.x).abs() < 0.1);
        assert!(left.x > middle.x + 10.0 && (left.y - middle.y).abs() < 0.1);
    }

    #[test]
    fn orthographic_keeps_the_size_at_the_target() {
        let mut camera = OrbitCamera { target_m: Vec3::Y, ..OrbitCamera::default() };
        let size = |camera: &OrbitCamera| {
            let up = camera.world_from_view_rotation() * Vec3::Y;
            let at = |p| camera.project(p, VIEWPORT).unwrap().px;
            at(Vec3::Y + up).distance(at(Vec3::Y))
        };
        let perspective = size(&camera);
        camera.projection = Projection::Orthographic;
        assert!((size(&camera) / perspective - 1.0).abs() < 1e-4);
    }

    #[test]
    fn depth_is_reversed_and_within_the_cube() {
        for view in [StandardView::ThreeQuarter, StandardView::Front] {
            let camera = OrbitCamera::standard(view, Vec3::Y, 5.0);
            let depth = |along: f32| {
                let point = camera.eye_m() + camera.forward() * along;
                camera.clip_from_world(VIEWPORT).project_point3(point).z
            };
            let depths = [0.2, 1.0, 5.0, 100.0, 900.0].map(depth);
            assert!(depths.windows(2).all(|pair| pair[0] > pair[1]), "{view:?}: {depths:?}");
            assert!(depths.iter().all(|z| (0.0..=1.0).contains(z)), "{view:?}: {depths:?}");
        }
    }

    #[test]
    fn what_is_behind_the_eye_falls_nowhere() {
        let camera = OrbitCamera::default();
        let behind = camera.eye_m() - camera.forward();
        assert_eq!(camera.project(behind, VIEWPORT), None);
    }

    #[test]
    fn rays_meet_the_floor_before_the_eye_only() {
        let down = Ray { origin_m: Vec3::new(1.0, 2.0, 3.0), direction: Vec3::NEG_Y };
        assert_eq!(down.at_height(0.0), Some(Vec3::new(1.0, 0.0, 3.0)));
        assert_eq!(down.at_height(5.0), None, "it is behind");
        let level = Ray { direction: Vec3::X, ..down };
        assert_eq!(level.at_height(0.0), None, "it is parallel");
        assert_eq!(level.at_plane(Vec3::X * 4.0, Vec3::X), Some(Vec3::new(4.0, 2.0, 3.0)));
    }

    #[test]
    fn orbits_stay_upright_and_turn_without_end() {
        let mut camera = OrbitCamera::default();
        for _ in 0..100 {
            camera.orbit(1.0, 0.5);
        }
        assert!(camera.yaw_rad.abs() <= std::f32::consts::PI + 1e-5);
        assert!(camera.pitch_rad <= MAX_PITCH_RAD);
        assert!((camera.world_from_view_rotation() * Vec3::Y).y > -1e-5, "never upside down");
    }

    #[test]
    fn nothing_panics_on_sizes_that_make_no_sense() {
        let mut camera = OrbitCamera::default();
        let viewport = Viewport::new(0.0, -3.0);
        camera.frame(&Bounds::of_point(Vec3::ZERO), viewport, 0.9);
        camera.dolly(0.0, Vec2::ZERO, viewport);
        camera.dolly(1e30, Vec2::ZERO, viewport);
        assert!(camera.distance_m.is_finite() && camera.distance_m > 0.0);
    }
}
