//! Cameras that show all of something and as little else as possible.

use glam::{Vec2, Vec3};
use motion_scene::camera::{FOV_RAD, OrbitCamera, Projection, Viewport};

/// How much of the picture stays free at its edges, as shares of its width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Left and right, each.
    pub side: f32,
    /// At the top: more where words stand over heads.
    pub top: f32,
    /// At the bottom.
    pub bottom: f32,
}

/// Words over a head need so many pixels at scale 1.
const LABEL_ROOM_PX: f32 = 30.0;

impl Margins {
    /// Margins of a picture; `pixels_per_point` is how large words are on it, 0 for none.
    pub fn new(viewport: Viewport, pixels_per_point: f32) -> Self {
        let words = pixels_per_point * LABEL_ROOM_PX;
        Self {
            side: (0.045 + words / viewport.width_px).min(0.3),
            top: (0.05 + words / viewport.height_px).min(0.3),
            bottom: 0.06,
        }
    }

    /// The same room in all, as much of it at the top as at the bottom.
    #[must_use]
    pub fn evened(self) -> Self {
        let each = 0.5 * (self.top + self.bottom);
        Self { top: each, bottom: each, ..self }
    }

    /// Moves a camera so that what it looked at is in the middle between the margins.
    pub fn aim(self, camera: &mut OrbitCamera) {
        let up_m = (self.top - self.bottom) * camera.half_height_at_target_m();
        camera.target_m += camera.world_from_view_rotation() * Vec3::Y * up_m;
    }

    /// The tangents of the angles between the middle of the view and what is inside the margins:
    /// half the width, up, down.
    fn slopes(self, camera: &OrbitCamera, viewport: Viewport) -> Slopes {
        let fov_rad = match camera.projection {
            Projection::Perspective { vertical_fov_rad } => vertical_fov_rad,
            Projection::Orthographic => FOV_RAD,
        };
        let half = (0.5 * fov_rad).tan();
        let share = |margin: f32| (1.0 - 2.0 * margin).max(0.1);
        Slopes {
            side: half * viewport.aspect() * share(self.side),
            up: half * share(self.top),
            down: half * share(self.bottom),
        }
    }
}

struct Slopes {
    side: f32,
    up: f32,
    down: f32,
}

/// No camera comes nearer than this, metres.
const MIN_DISTANCE_M: f32 = 0.5;

/// Moves a camera, without turning it, as near as it can be with all of `points_m` in the picture
/// inside the margins. Without points nothing is moved.
///
/// An eye at (X, Y, Z) in the view's axes, Z towards the viewer, sees a point (x, y, z) inside the
/// right edge, whose slope is s, where x + s·z ≤ X + s·Z; and so for the other edges. The nearest
/// eye is where two opposite edges touch points.
pub fn frame_points(
    camera: &mut OrbitCamera,
    points_m: &[Vec3],
    viewport: Viewport,
    margins: Margins,
) {
    let slopes = margins.slopes(camera, viewport);
    let is_flat = camera.projection == Projection::Orthographic;
    let into_view = camera.world_from_view_rotation().inverse();
    let in_view: Vec<Vec3> =
        points_m.iter().filter(|p| p.is_finite()).map(|&p| into_view * p).collect();
    let Some(depth) = middle_of(in_view.iter().map(|p| p.z)) else { return };
    // How far the planes of one slope must be from the origin to have all points inside.
    let reach = |direction: Vec2, slope: f32| {
        let towards = if is_flat { 0.0 } else { slope };
        let each = in_view.iter().map(|p| p.truncate().dot(direction) + towards * (p.z - depth));
        each.fold(f32::NEG_INFINITY, f32::max)
    };
    let (right, left) = (reach(Vec2::X, slopes.side), reach(Vec2::NEG_X, slopes.side));
    let (up, down) = (reach(Vec2::Y, slopes.up), reach(Vec2::NEG_Y, slopes.down));
    let across_m = (right + left) / (2.0 * slopes.side);
    let along_m = (up + down) / (slopes.up + slopes.down);
    let distance_m = across_m.max(along_m).max(MIN_DISTANCE_M);
    // What is left of the room in the other direction is shared by both sides.
    let x = 0.5 * (right - left);
    let y = 0.5 * ((up - slopes.up * distance_m) + (slopes.down * distance_m - down));
    camera.target_m = camera.world_from_view_rotation() * Vec3::new(x, y, depth);
    camera.distance_m = distance_m;
}

/// How far a camera that looks at `target_m` must stay away to have all points inside the margins,
/// metres.
pub fn distance_to_hold(
    camera: &OrbitCamera,
    target_m: Vec3,
    points_m: &[Vec3],
    viewport: Viewport,
    margins: Margins,
) -> f32 {
    let slopes = margins.slopes(camera, viewport);
    let into_view = camera.world_from_view_rotation().inverse();
    let is_flat = camera.projection == Projection::Orthographic;
    let needs = points_m.iter().filter(|p| p.is_finite()).map(|&point| {
        let off = into_view * (point - target_m);
        let vertical = if off.y > 0.0 { off.y / slopes.up } else { -off.y / slopes.down };
        (off.x.abs() / slopes.side).max(vertical) + if is_flat { 0.0 } else { off.z }
    });
    needs.fold(MIN_DISTANCE_M, f32::max)
}

/// Half way between the least and the greatest.
fn middle_of(values: impl Iterator<Item = f32> + Clone) -> Option<f32> {
    let (min, max) = (values.clone().reduce(f32::min)?, values.reduce(f32::max)?);
    Some(0.5 * (min + max))
}

#[cfg(test)]
mod tests {
    use motion_scene::camera::StandardView;

    use super::*;

    fn some_points() -> Vec<Vec3> {
        let at = |i: i32| {
            let t = i as f32;
            Vec3::new((1.7 * t).sin() * 3.0, 1.0 + (2.3 * t).cos(), t * 0.4)
        };
        (0..20).map(at).collect()
    }

    /// The least room that is left at each edge, as shares: left, right, top, bottom.
    fn room(camera: &OrbitCamera, points: &[Vec3], viewport: Viewport) -> [f32; 4] {
        let mut room = [f32::INFINITY; 4];
        for &point in points {
            let px = camera.project(point, viewport).unwrap().px;
            let (x, y) = (px.x / viewport.width_px, px.y / viewport.height_px);
            room = [room[0].min(x), room[1].min(1.0 - x), room[2].min(y), room[3].min(1.0 - y)];
        }
        room
    }

    #[test]
    fn all_is_inside_and_something_touches() {
        let points = some_points();
        let margins = Margins { side: 0.05, top: 0.15, bottom: 0.08 };
        for view in [StandardView::ThreeQuarter, StandardView::Front, StandardView::Top] {
            for viewport in [Viewport::new(640.0, 360.0), Viewport::new(200.0, 500.0)] {
                let mut camera = OrbitCamera::standard(view, Vec3::ZERO, 1.0);
                frame_points(&mut camera, &points, viewport, margins);
                let [left, right, top, bottom] = room(&camera, &points, viewport);
                let over = [left - 0.05, right - 0.05, top - 0.15, bottom - 0.08];
                assert!(over.iter().all(|&over| over > -1e-3), "{view:?}: {over:?}");
                let sides_touch = over[0].max(over[1]) < 2e-3;
                let ends_touch = over[2].max(over[3]) < 2e-3;
                assert!(sides_touch || ends_touch, "{view:?}: {over:?}");
            }
        }
    }

    #[test]
    fn from_the_distance_to_hold_all_is_seen() {
        let (points, viewport) = (some_points(), Viewport::new(640.0, 360.0));
        let margins = Margins { side: 0.05, top: 0.1, bottom: 0.05 };
        let mut camera = OrbitCamera::default();
        camera.target_m = Vec3::new(0.5, 1.0, 3.0);
        camera.distance_m = distance_to_hold(&camera, camera.target_m, &points, viewport, margins);
        let [left, right, top, bottom] = room(&camera, &points, viewport);
        let over = [left - 0.05, right - 0.05, top - 0.1, bottom - 0.05];
        assert!(over.iter().all(|&over| over > -1e-3), "{over:?}");
        assert!(over.iter().any(|&over| over < 1e-3), "{over:?}");
    }

    #[test]
    fn what_is_aimed_at_is_between_the_margins() {
        let viewport = Viewport::new(300.0, 200.0);
        let margins = Margins { side: 0.1, top: 0.3, bottom: 0.1 };
        let mut camera = OrbitCamera::default();
        let point = camera.target_m;
        margins.aim(&mut camera);
        let px = camera.project(point, viewport).unwrap().px;
        assert!(px.distance(Vec2::new(150.0, 0.6 * 200.0)) < 0.5, "{px}");
        assert_eq!(margins.evened(), Margins { side: 0.1, top: 0.2, bottom: 0.2 });
    }

    #[test]
    fn nothing_to_see_moves_nothing() {
        let mut camera = OrbitCamera::default();
        let viewport = Viewport::new(100.0, 100.0);
        frame_points(&mut camera, &[Vec3::NAN], viewport, Margins::new(viewport, 1.0));
        assert_eq!(camera, OrbitCamera::default());
        frame_points(&mut camera, &[Vec3::ONE], viewport, Margins::new(viewport, 1.0));
        assert!(camera.distance_m >= MIN_DISTANCE_M && camera.target_m.is_finite());
    }
}
