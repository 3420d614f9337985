//! What a camera may see at all.

use glam::{Mat4, Vec4};
use motion_scene::bounds::Bounds;

/// The planes left, right, below and above of a picture, and the one through the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frustum {
    planes: [Vec4; 5],
}

impl Frustum {
    /// The frustum of a matrix `clip_from_world` (Gribb and Hartmann 2001).
    pub(crate) fn new(clip_from_world: Mat4) -> Self {
        let rows = clip_from_world.transpose();
        let w = rows.w_axis;
        Self { planes: [w + rows.x_axis, w - rows.x_axis, w + rows.y_axis, w - rows.y_axis, w] }
    }

    /// Whether some of the box may be in the picture; never wrong when it says no.
    pub(crate) fn may_see(&self, bounds: &Bounds) -> bool {
        let corners = bounds.corners();
        let all_outside = |plane: &Vec4| corners.iter().all(|c| plane.dot(c.extend(1.0)) < 0.0);
        !self.planes.iter().any(all_outside)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use motion_scene::camera::{OrbitCamera, StandardView, Viewport};

    use super::*;

    #[test]
    fn what_is_beside_behind_and_inside() {
        let viewport = Viewport::new(160.0, 90.0);
        let target_m = Vec3::new(0.0, 1.0, 0.0);
        for view in [StandardView::ThreeQuarter, StandardView::Front, StandardView::Top] {
            let camera = OrbitCamera::standard(view, target_m, 5.0);
            let frustum = Frustum::new(camera.clip_from_world(viewport));
            let rotation = camera.world_from_view_rotation();
            let box_at = |off: Vec3| Bounds::of_point(target_m + rotation * off).grown(0.3);
            assert!(frustum.may_see(&box_at(Vec3::ZERO)), "{view:?}: in the middle");
            assert!(!frustum.may_see(&box_at(Vec3::X * 9.0)), "{view:?}: to the right");
            assert!(!frustum.may_see(&box_at(Vec3::NEG_Y * 5.0)), "{view:?}: below");
        }
        let camera = OrbitCamera::standard(StandardView::ThreeQuarter, target_m, 5.0);
        let behind = Bounds::of_point(camera.eye_m() - camera.forward() * 4.0).grown(0.3);
        assert!(!Frustum::new(camera.clip_from_world(viewport)).may_see(&behind), "behind");
    }
}
