//! What the rest of a motion is expected to cost: the heuristic `h` of A*.

use glam::Vec2;

use crate::ids::ClipId;
use crate::planar::{PlanarTransform, wrap_angle_rad};
use crate::search::library::SearchLibrary;
use crate::search::rivals::CoarseGraph;
use crate::search::target::Target;

/// Speeds are measured over so many frames.
const STRIDE: usize = 15;

/// A cut a second is expected, of a cost that this share of the cuts do not exceed.
const USUAL_SHARE: f32 = 0.5;

/// How far off a body may be that has a second to make up for it, metres and radians.
const SLACK_M_S: f32 = 0.6;
const SLACK_RAD_S: f32 = 1.2;

/// How far off it may be with no time left: one tolerance.
const SLACK_M: f32 = 0.30;
const SLACK_RAD: f32 = 0.17;

/// What is known of the clips and the checkpoints.
#[derive(Clone, Debug)]
pub(super) struct Expectation {
    /// Frame, ground position and heading of each checkpoint, the last one's frame open.
    points: Vec<(u32, Vec2, f32)>,
    last: Option<(Vec2, f32)>,
    top_speed_m_s: f32,
    top_turn_rad_s: f32,
    cuts_cost_per_s: f32,
    fps: f32,
}

impl Expectation {
    pub(super) fn new(library: &SearchLibrary, graph: &CoarseGraph, target: &Target) -> Self {
        let fps = library.clips().fps().get() as f32;
        let (mut top_speed_m_s, mut top_turn_rad_s) = (0.1f32, 0.1f32);
        for clip in (0..library.graph().n_clips()).map(ClipId::from_idx) {
            let torsos = library.torsos(clip);
            for (a, b) in torsos.iter().zip(torsos.iter().skip(STRIDE)) {
                let secs = STRIDE as f32 / fps;
                let way_m = a.ground_m().distance(b.ground_m());
                let turn_rad = wrap_angle_rad(b.heading_rad() - a.heading_rad()).abs();
                top_speed_m_s = top_speed_m_s.max(way_m / secs);
                top_turn_rad_s = top_turn_rad_s.max(turn_rad / secs);
            }
        }
        let mut costs: Vec<f32> = (0..graph.n_cuts()).map(|nth| graph.cut(nth).1.cost).collect();
        costs.sort_unstable_by(f32::total_cmp);
        let usual = costs.get((costs.len() as f32 * USUAL_SHARE) as usize).copied();
        let point = |frame, t: PlanarTransform| (frame, t.ground_m(), t.heading_rad());
        let mut points = vec![point(target.anchor_frame, target.anchor)];
        points.extend(target.waypoints.iter().map(|&(frame, torso)| point(frame, torso)));
        Self {
            points,
            last: target.last_torso.map(|torso| (torso.ground_m(), torso.heading_rad())),
            top_speed_m_s,
            top_turn_rad_s,
            cuts_cost_per_s: target.weights.continuity * usual.unwrap_or_default(),
            fps,
        }
    }

    /// The frame of the next checkpoint after `frame`, in a motion of `n_frames`.
    pub(super) fn next_frame(&self, frame: u32, n_frames: u32) -> u32 {
        let next = self.points.iter().map(|point| point.0).find(|&next| next > frame);
        next.unwrap_or(n_frames - 1)
    }

    /// What is expected from `frame` on of a motion of `n_frames` whose torso is at `torso` then.
    ///
    /// Three parts: cuts in proportion to time, so that what is nearly done comes first; what cannot be
    /// made up for at top speed, which is never too much; and how far it is from an even pace, which is
    /// no bound but leads.
    #[inline]
    pub(super) fn of(&self, frame: u32, torso: PlanarTransform, n_frames: u32) -> f32 {
        let cuts = self.cuts_cost_per_s * n_frames.saturating_sub(frame) as f32 / self.fps;
        let after = self.points.partition_point(|point| point.0 < frame);
        let next = self.points.get(after).copied();
        let Some((end, to_m, heading_rad)) =
            next.or(self.last.map(|(to_m, heading_rad)| (n_frames - 1, to_m, heading_rad)))
        else {
            return cuts;
        };
        let (start, from_m) = match after.checked_sub(1) {
            Some(before) => (self.points[before].0, self.points[before].1),
            None => return cuts,
        };
        let secs_left = end.saturating_sub(frame) as f32 / self.fps;
        let secs_past = (frame - start) as f32 / self.fps;
        let off_m = torso.ground_m().distance(to_m);
        let off_rad = wrap_angle_rad(torso.heading_rad() - heading_rad).abs();
        let short_m = (off_m - self.top_speed_m_s * secs_left).max(0.0) / SLACK_M;
        let short_rad = (off_rad - self.top_turn_rad_s * secs_left).max(0.0) / SLACK_RAD;
        let t = secs_past / (secs_past + secs_left).max(1e-3);
        let pace_m = torso.ground_m().distance(from_m.lerp(to_m, t));
        let pace_m = pace_m / (SLACK_M + SLACK_M_S * secs_left.min(secs_past));
        let pace_rad = off_rad / (SLACK_RAD + SLACK_RAD_S * secs_left);
        cuts + short_m * short_m + short_rad * short_rad + pace_m * pace_m + pace_rad * pace_rad
    }
}
