//! From the pointer to the world and back.

use egui::{Pos2, Rect};
use glam::{Vec2, Vec3};
use motion_scene::camera::{OrbitCamera, Ray, Viewport};

/// A camera and where its picture is.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// From where it is looked.
    pub camera: OrbitCamera,
    /// Where the picture is, points.
    pub rect: Rect,
}

impl Sight {
    /// The picture's size.
    pub fn viewport(&self) -> Viewport {
        Viewport::new(self.rect.width(), self.rect.height())
    }

    /// What lies under a place of the window.
    pub fn ray(&self, at: Pos2) -> Ray {
        let off = at - self.rect.min;
        self.camera.ray_through(Vec2::new(off.x, off.y), self.viewport())
    }

    /// The place on the floor under a place of the window, `[x, z]` in metres; nothing near the
    /// horizon, where a pixel is a street.
    pub fn floor(&self, at: Pos2) -> Option<[f64; 2]> {
        self.level(at, 0.0)
    }

    /// The same at another height, metres.
    pub fn level(&self, at: Pos2, height_m: f32) -> Option<[f64; 2]> {
        const FARTHEST_M: f32 = 200.0;
        let hit = self.ray(at).at_height(height_m)?;
        let is_near = hit.distance(self.camera.target_m.with_y(height_m)) < FARTHEST_M;
        is_near.then(|| [f64::from(hit.x), f64::from(hit.z)])
    }

    /// Where a point of the world is in the window; nothing behind the eye.
    pub fn place(&self, point_m: Vec3) -> Option<Pos2> {
        let px = self.camera.project(point_m, self.viewport())?.px;
        Some(self.rect.min + egui::Vec2::new(px.x, px.y))
    }

    /// Where a point gets when it is dragged by a pointer that goes from one place to another, in
    /// the plane of the picture, or straight up and down.
    pub fn dragged(&self, point_m: Vec3, (from, to): (Pos2, Pos2), is_vertical: bool) -> Vec3 {
        /// A camera that looks down sees heights too short to be followed.
        const LEAST_SLOPE: f32 = 0.3;
        let Some(projected) = self.camera.project(point_m, self.viewport()) else { return point_m };
        let m_per_pt = self.camera.metres_per_px(projected.depth_m, self.viewport());
        let by = (to - from) * m_per_pt;
        if is_vertical {
            point_m - Vec3::Y * by.y / self.camera.pitch_rad.cos().max(LEAST_SLOPE)
        } else {
            point_m + self.camera.world_from_view_rotation() * Vec3::new(by.x, -by.y, 0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use motion_scene::camera::StandardView;

    use super::*;

    fn sight(view: StandardView) -> Sight {
        let camera = OrbitCamera::standard(view, Vec3::new(0.3, 1.0, 0.2), 5.0);
        let rect = Rect::from_min_size(Pos2::new(100.0, 50.0), egui::Vec2::new(800.0, 600.0));
        Sight { camera, rect }
    }

    #[test]
    fn a_dragged_point_stays_under_the_pointer() {
        let point_m = Vec3::new(0.5, 1.7, 0.1);
        for view in [StandardView::Front, StandardView::ThreeQuarter, StandardView::Top] {
            let sight = sight(view);
            let from = sight.place(point_m).unwrap();
            let to = from + egui::Vec2::new(60.0, -40.0);
            let there = sight.dragged(point_m, (from, to), false);
            assert!(sight.place(there).unwrap().distance(to) < 0.5, "{view:?}");
        }
    }

    #[test]
    fn straight_up_is_straight_up() {
        let point_m = Vec3::new(0.5, 1.7, 0.1);
        let sight = sight(StandardView::Front);
        let from = sight.place(point_m).unwrap();
        let to = from + egui::Vec2::new(60.0, -40.0);
        let there = sight.dragged(point_m, (from, to), true);
        assert_eq!((there.x, there.z), (point_m.x, point_m.z));
        assert!((sight.place(there).unwrap().y - to.y).abs() < 0.5);
    }

    #[test]
    fn the_floor_under_a_point_is_found_again() {
        let sight = sight(StandardView::ThreeQuarter);
        let at = sight.place(Vec3::new(1.0, 0.0, -0.5)).unwrap();
        let [x, z] = sight.floor(at).unwrap();
        assert!((x - 1.0).abs() < 1e-3 && (z + 0.5).abs() < 1e-3);
        assert_eq!(sight.floor(sight.rect.center_top() - egui::Vec2::Y * 2000.0), None, "the sky");
    }
}
