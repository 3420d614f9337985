//! What the rules look at: a clip's motion in numbers that do not depend on the body's size.

use glam::Vec2;

use crate::contacts::{self, Side};
use crate::ground::GroundTrack;
use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::planar::wrap_angle_rad;
use crate::skeleton::{JointRole, Skeleton};
use crate::units::Fps;

/// The leg (hip joint to ankle) for which the rules' speeds are stated, metres. Speeds of other
/// bodies are divided by the square root of their leg's share of it, as bodies of different size
/// change their gait at the same Froude number v²/(g·leg) (Alexander 1989, *Optimization and
/// gaits in the locomotion of vertebrates*).
pub const REFERENCE_LEG_M: f32 = 0.8;

/// Travel is averaged over this span, seconds: half a stride, so that hips that sway with the
/// steps are not steps to the side.
pub const TRAVEL_SPAN_SECS: f64 = 0.5;

/// Turning is averaged over this span, seconds: nearly a stride, in which the hips turn to and
/// fro.
pub const TURN_SPAN_SECS: f64 = 0.8;

/// A back that leans less than this is upright, radians: 70 degrees.
pub(super) const UPRIGHT_RAD: f32 = 1.22;

/// Numbers of every frame. Lengths are in legs, speeds those of a body with the
/// [reference leg](REFERENCE_LEG_M).
#[derive(Clone, Debug, PartialEq)]
pub struct Signals {
    /// The clip's rate.
    pub fps: Fps,
    /// Velocity over the ground as the torso sees it: x to its left, y ahead; metres per second.
    pub travel_m_s: Vec<Vec2>,
    /// Turn of the torso, radians per second, to the left positive.
    pub turn_rad_s: Vec<f32>,
    /// Heading as one continuous series, radians.
    pub heading_rad: Vec<f32>,
    /// Middle of the hip joints above what supports the body, legs; standing is about 1.1.
    pub hip_height: Vec<f32>,
    /// How far the back leans from the vertical, radians; 0 for a body without a neck or head.
    pub lean_rad: Vec<f32>,
    /// The lower toe joint above its lowest level in the clip, legs.
    pub toe_height: Vec<f32>,
    /// Whether a foot is planted.
    pub is_planted: Vec<bool>,
    /// Speed of the fastest of head and hands, metres per second; 0 for a body without them.
    pub gesture_m_s: Vec<f32>,
}

impl Signals {
    /// The signals of a clip; `None` for a body without two legs that stand on the ground, about
    /// which the rules have nothing to say.
    pub fn new(skeleton: &Skeleton, motion: &Motion, track: &GroundTrack) -> Option<Self> {
        let leg_m = skeleton.leg_length_m().filter(|leg| *leg > 1e-3)?;
        let [left_toe, right_toe] = Side::BOTH.map(|side| contacts::toe_joint(skeleton, side));
        let toes = [left_toe?, right_toe?];
        let fps = motion.fps();
        let torso = &track.world_from_torso;
        let places: Vec<Vec2> = torso.iter().map(|torso| torso.ground_m()).collect();
        let heading_rad = unwrapped(torso.iter().map(|torso| torso.heading_rad()));
        let speed_scale = (REFERENCE_LEG_M / leg_m).sqrt();
        let level = |frame: usize| torso[frame].level_m;

        let path = |joint: JointIdx| motion.joint_path_m(skeleton, joint);
        let role = |role| skeleton.by_role(role).map(path);
        let root = motion.root_positions_m().to_vec();
        let hips = role(JointRole::Hips).unwrap_or_else(|| root.clone());
        let left_hip = role(JointRole::LeftUpLeg).unwrap_or_else(|| hips.clone());
        let right_hip = role(JointRole::RightUpLeg).unwrap_or_else(|| hips.clone());
        let above = |y: f32, frame: usize| (y - level(frame)) / leg_m;
        let frames = 0..motion.n_frames();
        let hip_height = frames
            .clone()
            .map(|frame| above(0.5 * (left_hip[frame].y + right_hip[frame].y), frame))
            .collect();

        let top = role(JointRole::Neck).or_else(|| role(JointRole::Head));
        let lean_rad = match top {
            Some(top) => {
                let leans = top.iter().zip(&hips);
                leans.map(|(top, hips)| (*top - *hips).angle_between(glam::Vec3::Y)).collect()
            }
            None => vec![0.0; motion.n_frames()],
        };

        let toe_paths = toes.map(path);
        let lowest = [0, 1].map(|toe: usize| {
            let mut heights: Vec<f32> =
                frames.clone().map(|frame| above(toe_paths[toe][frame].y, frame)).collect();
            contacts::percentile(&mut heights, 0.01)
        });
        let toe_at = |toe: usize, frame: usize| above(toe_paths[toe][frame].y, frame) - lowest[toe];
        let toe_height = frames.clone().map(|frame| toe_at(0, frame).min(toe_at(1, frame)));

        let mut gesture_m_s = vec![0.0_f32; motion.n_frames()];
        for part in [JointRole::Head, JointRole::LeftHand, JointRole::RightHand] {
            let Some(path) = role(part) else { continue };
            for (frame, fastest) in gesture_m_s.iter_mut().enumerate() {
                let (a, b) = span_around(frame, motion.n_frames(), 0.2, fps);
                if a < b {
                    let rate = fps.get() as f32 / (b - a) as f32;
                    *fastest = fastest.max(path[a].distance(path[b]) * rate * speed_scale);
                }
            }
        }

        Some(Self {
            fps,
            travel_m_s: travel_m_s(&places, &heading_rad, fps)
                .into_iter()
                .map(|travel| travel * speed_scale)
                .collect(),
            turn_rad_s: turn_rad_s(&heading_rad, fps),
            heading_rad,
            hip_height,
            lean_rad,
            toe_height: toe_height.collect(),
            is_planted: track.contacts.iter().map(|contacts| contacts.any()).collect(),
            gesture_m_s,
        })
    }

    /// How many frames there are.
    pub fn n_frames(&self) -> usize {
        self.heading_rad.len()
    }
}

/// Headings without jumps by whole turns.
fn unwrapped(headings_rad: impl IntoIterator<Item = f32>) -> Vec<f32> {
    let mut series: Vec<f32> = Vec::new();
    for heading in headings_rad {
        let next = series.last().map_or(heading, |last| last + wrap_angle_rad(heading - last));
        series.push(next);
    }
    series
}

/// First and last frame of a span of `secs` around `frame`: at the ends of a clip it is moved to
/// within, and a clip that is shorter is the span as a whole.
fn span_around(frame: usize, n_frames: usize, secs: f64, fps: Fps) -> (usize, usize) {
    let length = fps.frames_in_secs(secs).max(1).min(n_frames.saturating_sub(1));
    let from = frame.saturating_sub(length / 2).min(n_frames.saturating_sub(1 + length));
    (from, from + length)
}

/// Mean velocity over [`TRAVEL_SPAN_SECS`], seen from the mean heading of that span.
pub(crate) fn travel_m_s(places_m: &[Vec2], heading_rad: &[f32], fps: Fps) -> Vec<Vec2> {
    let n_frames = places_m.len();
    let mean_travel = |frame: usize| {
        let (a, b) = span_around(frame, n_frames, TRAVEL_SPAN_SECS, fps);
        if a >= b {
            return Vec2::ZERO;
        }
        let heading = heading_rad[a..=b].iter().sum::<f32>() / (b + 1 - a) as f32;
        let (sin, cos) = heading.sin_cos();
        let moved = (places_m[b] - places_m[a]) * (fps.get() as f32 / (b - a) as f32);
        // A heading looks along (sin, cos) and has (cos, −sin) on its left.
        Vec2::new(moved.x * cos - moved.y * sin, moved.x * sin + moved.y * cos)
    };
    (0..n_frames).map(mean_travel).collect()
}

/// Mean turn over [`TURN_SPAN_SECS`]: the mean heading of its later half less that of its earlier.
pub(crate) fn turn_rad_s(heading_rad: &[f32], fps: Fps) -> Vec<f32> {
    let n_frames = heading_rad.len();
    let mean_turn = |frame: usize| {
        let (a, b) = span_around(frame, n_frames, TURN_SPAN_SECS, fps);
        let half = (b + 1 - a) / 2;
        if half == 0 {
            return 0.0;
        }
        let mean = |from: usize| heading_rad[from..from + half].iter().sum::<f32>() / half as f32;
        let secs = (b + 1 - half - a) as f32 * fps.frame_secs() as f32;
        (mean(b + 1 - half) - mean(a)) / secs
    };
    (0..n_frames).map(mean_turn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_stay_within_the_clip() {
        assert_eq!(span_around(0, 100, 0.5, Fps::THIRTY), (0, 15));
        assert_eq!(span_around(50, 100, 0.5, Fps::THIRTY), (43, 58));
        assert_eq!(span_around(99, 100, 0.5, Fps::THIRTY), (84, 99));
        assert_eq!(span_around(3, 5, 0.5, Fps::THIRTY), (0, 4));
        assert_eq!(span_around(0, 1, 0.5, Fps::THIRTY), (0, 0));
    }

    #[test]
    fn travel_is_seen_from_the_torso() {
        // Looking along +X (a quarter turn to the left) and going along +Z: to its right.
        let places: Vec<Vec2> = (0..40).map(|f| Vec2::new(0.0, f as f32 / 30.0)).collect();
        let headings = vec![std::f32::consts::FRAC_PI_2; 40];
        for travel in travel_m_s(&places, &headings, Fps::THIRTY) {
            assert!(travel.distance(Vec2::new(-1.0, 0.0)) < 1e-4, "{travel}");
        }
    }

    #[test]
    fn turning_is_a_rate_at_any_place_of_the_clip() {
        let headings: Vec<f32> = (0..40).map(|f| 0.5 * f as f32 / 30.0).collect();
        for turn in turn_rad_s(&headings, Fps::THIRTY) {
            assert!((turn - 0.5).abs() < 1e-4, "{turn}");
        }
        assert_eq!(turn_rad_s(&[1.0], Fps::THIRTY), [0.0]);
    }
}
