//! A camera that gets somewhere in a moment rather than at once.

use motion_scene::camera::OrbitCamera;

/// How long it takes, seconds.
const GLIDE_SECS: f32 = 0.12;

/// A camera under way.
#[derive(Clone, Copy, Debug)]
pub struct Glide {
    from: OrbitCamera,
    to: OrbitCamera,
    /// From 0 to 1.
    share: f32,
}

impl Glide {
    /// A way from one camera to another.
    pub fn new(from: OrbitCamera, to: OrbitCamera) -> Self {
        Self { from, to, share: 0.0 }
    }

    /// Where it will be.
    pub fn end(&self) -> OrbitCamera {
        self.to
    }

    /// Goes on by so much time. Gives where the camera is, and whether it has arrived.
    pub fn advance(&mut self, dt_secs: f32) -> (OrbitCamera, bool) {
        self.share = (self.share + dt_secs.max(0.0) / GLIDE_SECS).min(1.0);
        if self.share >= 1.0 {
            return (self.to, true);
        }
        // Fast at first, and slow where it arrives.
        let t = 1.0 - (1.0 - self.share).powi(3);
        let (from, to) = (self.from, self.to);
        let turn = std::f32::consts::TAU;
        let yaw = (to.yaw_rad - from.yaw_rad + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
        let camera = OrbitCamera {
            target_m: from.target_m.lerp(to.target_m, t),
            yaw_rad: from.yaw_rad + yaw * t,
            pitch_rad: from.pitch_rad + (to.pitch_rad - from.pitch_rad) * t,
            // Doubling is as far as doubling again.
            distance_m: from.distance_m * (to.distance_m / from.distance_m).powf(t),
            projection: to.projection,
        };
        (camera, false)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use motion_scene::camera::StandardView;

    use super::*;

    #[test]
    fn it_takes_the_short_way_round_and_arrives() {
        let view = |view| OrbitCamera::standard(view, Vec3::Y, 4.0);
        let (from, mut to) = (view(StandardView::Back), view(StandardView::Right));
        to.distance_m = 8.0;
        let mut glide = Glide::new(from, to);
        let (half, arrived) = glide.advance(0.06);
        assert!(!arrived && half.yaw_rad > from.yaw_rad, "through 180°, not through 0°");
        assert!((4.0..8.0).contains(&half.distance_m));
        assert_eq!(glide.advance(0.06), (to, true));
    }
}
