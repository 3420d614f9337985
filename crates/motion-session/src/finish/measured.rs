//! How far a finished motion misses each wish.

use glam::Vec3;
use motion_core::constraint::{FollowConstraint, FollowError, JointConstraint, PoseConstraint};
use motion_core::ground::GroundTrack;
use motion_core::ids::ClipId;
use motion_core::motion::Motion;
use motion_core::path::Piece;
use motion_core::planar::{PlanarTransform, wrap_angle_rad};
use motion_core::units::FrameIdx;

use super::misses::{JointMiss, Misses, PoseMiss};
use super::targets::read_at;
use crate::Library;
use crate::problem::CharacterProblem;

/// A pose counts as taken with its joints this near to it on average, metres.
const POSE_MET_M: f32 = 0.01;

/// A finished motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Finish<'a> {
    pub(super) library: &'a Library,
    pub(super) motion: &'a Motion,
    pub(super) track: &'a GroundTrack,
    /// Which frame of which clip each frame shows.
    pub(super) shown: &'a [(ClipId, FrameIdx)],
}

impl Finish<'_> {
    /// Its misses. What lies behind its end is read at its last frame, and early by the frames
    /// between.
    pub(super) fn misses(&self, character: &CharacterProblem) -> Misses {
        let wishes = &character.problem.wishes;
        let last = self.n_frames() - 1;
        let body = wishes.body.iter().enumerate().map(|(nth, wish)| {
            // A motion that is shorter by hand is where it ends, and early.
            let frame = read_at(wishes, nth, self.n_frames()).min(last);
            wish.error(self.torso(frame), frame as i32 - wish.frame as i32)
        });
        let early = |frame: u32| (i64::from(last) - i64::from(frame)).min(0);
        let joints = wishes.joints.iter().map(|wish| JointMiss {
            error: self.joint_error(wish, wish.frame.min(last)),
            frames: early(wish.frame),
        });
        let poses = wishes.poses.iter().map(|wish| self.pose_miss(wish, early(wish.frame)));
        let locks = wishes.locks.iter().map(|lock| self.shows(lock.from, &lock.pieces));
        let styles = wishes.styles.iter().map(|style| {
            let to = (style.to as usize + 1).min(self.shown.len());
            let shown = self.shown.get(style.from as usize..to).unwrap_or_default();
            let clips = &self.library.clips;
            let lacking = |run: &[(ClipId, FrameIdx)]| {
                let has = style.frames_with_tag(clips.clip(run[0].0));
                run.iter().filter(|(_, frame)| !has[frame.idx()]).count()
            };
            let n_lacking: usize = shown.chunk_by(|a, b| a.0 == b.0).map(lacking).sum();
            n_lacking as f32 / style.n_frames() as f32
        });
        Misses {
            body: body.collect(),
            joints: joints.collect(),
            poses: poses.collect(),
            locks: locks.collect(),
            styles: styles.collect(),
            follows: wishes.follows.iter().map(|wish| self.follow_error(wish)).collect(),
            deepest_m: self.deepest_m(character),
        }
    }

    fn n_frames(&self) -> u32 {
        self.motion.n_frames() as u32
    }

    fn torso(&self, frame: u32) -> PlanarTransform {
        self.track.world_from_torso[frame as usize]
    }

    /// The joint's velocity is that over the frames on both sides, as far as there are any.
    fn joint_error(
        &self,
        wish: &JointConstraint,
        frame: u32,
    ) -> motion_core::constraint::JointError {
        let frame = frame as usize;
        let (before, after) =
            (frame.saturating_sub(1), (frame + 1).min(self.motion.n_frames() - 1));
        let around = self.motion.slice(before, after + 1);
        let path_m = around.joint_path_m(self.library.clips.skeleton(), wish.joint);
        let secs = self.motion.fps().duration_secs(path_m.len()) as f32;
        let way_m = path_m[path_m.len() - 1] - path_m[0];
        let velocity_m_s = if secs > 0.0 { way_m / secs } else { Vec3::ZERO };
        wish.error(path_m[frame - before], velocity_m_s)
    }

    fn pose_miss(&self, wish: &PoseConstraint, frames: i64) -> PoseMiss {
        let frame = wish.frame.min(self.n_frames() - 1);
        let place = wish.place().map(|place| place.error(self.torso(frame), 0));
        let apart_m = self.apart_from_m(wish, frame);
        PoseMiss {
            is_met: frames == 0 && apart_m <= POSE_MET_M,
            place: place.unwrap_or_default(),
            apart_m: Some(apart_m),
            frames,
        }
    }

    /// How far joints are from those of the pose, metres, on average, both placed by heading, position
    /// and support.
    fn apart_from_m(&self, wish: &PoseConstraint, frame: u32) -> f32 {
        let clip = self.library.clips.clip(wish.clip);
        let clip_torso = clip.track.world_from_torso[wish.clip_frame.idx()];
        let skeleton = self.library.clips.skeleton();
        let (mut is_m, mut asked_m, mut rotations) = (Vec::new(), Vec::new(), Vec::new());
        self.motion.forward_kinematics(skeleton, frame as usize, &mut is_m, &mut rotations);
        let clip_frame = wish.clip_frame.idx();
        clip.motion.forward_kinematics(skeleton, clip_frame, &mut asked_m, &mut rotations);
        let world_from_clip = self.torso(frame) * clip_torso.inverse();
        let pairs = is_m.iter().zip(&asked_m);
        let away_m: f32 = pairs.map(|(is, ask)| is.distance(world_from_clip.apply(*ask))).sum();
        away_m / is_m.len().max(1) as f32
    }

    /// Whether these pieces are shown from frame `from` on.
    fn shows(&self, from: u32, pieces: &[Piece]) -> bool {
        let frames_of = |piece: &Piece| {
            let clip = piece.clip;
            (piece.from.0..=piece.to.0).map(move |frame| (clip, FrameIdx(frame)))
        };
        let wished: Vec<(ClipId, FrameIdx)> = pieces.iter().flat_map(frames_of).collect();
        let from = from as usize;
        self.shown.get(from..from + wished.len()) == Some(&wished[..])
    }

    fn follow_error(&self, wish: &FollowConstraint) -> FollowError {
        let (mut place, mut turn, mut n) = (0.0f32, 0.0f32, 0u32);
        for waypoint in wish.waypoints().iter().filter(|w| w.frame < self.n_frames()) {
            let at = self.torso(waypoint.frame);
            place += at.ground_m().distance_squared(waypoint.position_m);
            if wish.looks_along {
                turn += wrap_angle_rad(at.heading_rad() - waypoint.heading_rad).powi(2);
            }
            n += 1;
        }
        let root_mean = |sum: f32| (sum / n.max(1) as f32).sqrt();
        FollowError { position_m: root_mean(place), heading_rad: root_mean(turn) }
    }

    fn deepest_m(&self, character: &CharacterProblem) -> f32 {
        let obstacles = &character.problem.wishes.obstacles;
        if obstacles.is_empty() {
            return 0.0;
        }
        let skeleton = self.library.clips.skeleton();
        let (mut positions_m, mut rotations) = (Vec::new(), Vec::new());
        let mut deepest_m = 0.0f32;
        for frame in 0..self.motion.n_frames() {
            self.motion.forward_kinematics(skeleton, frame, &mut positions_m, &mut rotations);
            for obstacle in obstacles {
                let depths = positions_m.iter().map(|&joint| obstacle.depth_m(joint));
                deepest_m = depths.fold(deepest_m, f32::max);
            }
        }
        deepest_m
    }
}
