//! Where a body should be by when, between the places that are asked for.

use glam::Vec2;

use super::super::target::Target;
use crate::planar::{PlanarTransform, wrap_angle_rad};

/// A place to be at, and perhaps a heading.
#[derive(Clone, Copy, Debug)]
struct Stop {
    frame: u32,
    ground_m: Vec2,
    heading_rad: Option<f32>,
}

/// Stops in the order of their frames.
#[derive(Clone, Debug)]
pub(super) struct Schedule {
    stops: Vec<Stop>,
    fps: f32,
}

impl Schedule {
    /// For a motion of `n_frames`; `more` are places without a heading.
    pub(super) fn new(target: &Target, n_frames: u32, fps: f32, more: &[(u32, Vec2)]) -> Self {
        let stop = |frame, torso: PlanarTransform| Stop {
            frame,
            ground_m: torso.ground_m(),
            heading_rad: Some(torso.heading_rad()),
        };
        let mut stops = vec![stop(target.anchor_frame, target.anchor)];
        stops.extend(target.waypoints.iter().map(|&(frame, torso)| stop(frame, torso)));
        // The last checkpoint is read at the last frame, whatever its own is.
        stops.extend(target.last_torso.map(|torso| stop(n_frames - 1, torso)));
        stops.extend(more.iter().map(|&(frame, ground_m)| Stop {
            frame,
            ground_m,
            heading_rad: None,
        }));
        stops.sort_by_key(|stop| stop.frame);
        stops.dedup_by(|b, a| a.frame == b.frame);
        Self { stops, fps }
    }

    /// The first stop at or after `frame`.
    pub(super) fn next_frame(&self, frame: u32) -> Option<u32> {
        let next = self.stops.partition_point(|stop| stop.frame < frame);
        self.stops.get(next).map(|stop| stop.frame)
    }

    /// How far `at` is from where it should be at `frame`, in squared slacks: what may still be made
    /// up for until the next stop counts little.
    #[inline]
    pub(super) fn error(&self, frame: u32, at: PlanarTransform) -> f32 {
        let after = self.stops.partition_point(|stop| stop.frame < frame);
        let Some(next) = self.stops.get(after) else { return 0.0 };
        if after == 0 {
            return 0.0;
        }
        let last = &self.stops[after - 1];
        let t = (frame - last.frame) as f32 / (next.frame - last.frame).max(1) as f32;
        let should_m = last.ground_m.lerp(next.ground_m, t);
        let secs_left = (next.frame - frame) as f32 / self.fps;
        let secs_past = (frame - last.frame) as f32 / self.fps;
        let slack_m = 0.3 + 0.6 * secs_left.min(secs_past);
        let place = at.ground_m().distance_squared(should_m) / (slack_m * slack_m);
        let Some(heading_rad) = next.heading_rad else { return place };
        // Which way it looks matters towards the end of a leg.
        let slack_rad = 0.17 + 1.2 * secs_left;
        let turn = wrap_angle_rad(at.heading_rad() - heading_rad) / slack_rad;
        place + turn * turn
    }
}
