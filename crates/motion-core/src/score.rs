//! What makes one motion better than another (AF02 equation 1), by a plain walk over its frames.
//!
//! This is the slow, obvious twin of what the search computes incrementally, and what reports
//! print.

use glam::{Vec2, Vec3};

use crate::clip::ClipSet;
use crate::constraint::clearance::{CLEARANCE_LIMIT_M, CLEARANCE_TOLERANCE_M};
use crate::constraint::obstacle::{OBSTACLE_STRIDE, OBSTACLE_TOLERANCE_M, Solid};
use crate::constraint::style::TOLERANCE_SHARE;
use crate::constraint::{
    BodyConstraint, BodyError, FollowConstraint, FollowError, JointConstraint, JointError,
    LengthWish, LockConstraint, Obstacle, OtherBody, PoseConstraint, StyleConstraint, SupportCost,
};
use crate::graph::MotionGraph;
use crate::path::{Path, Piece};
use crate::planar::{PlanarTransform, wrap_angle_rad};
use crate::units::FrameIdx;

/// Factors of the terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// A cut of cost τ counts this much.
    pub continuity: f32,
    /// Of the length error.
    pub length: f32,
    /// Of the body constraints' errors, and of those of poses' places.
    pub body: f32,
    /// Of the joint constraints' errors.
    pub joint: f32,
    /// Of frames without a wished tag.
    pub style: f32,
    /// Of distances to followed curves.
    pub path: f32,
    /// Of the environment: feet planted on nothing, joints in obstacles, bodies in each other.
    pub environment: f32,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            continuity: 1.0,
            length: 1.0,
            body: 1.0,
            joint: 1.0,
            style: 1.0,
            path: 1.0,
            environment: 1.0,
        }
    }
}

impl Weights {
    /// All of them.
    pub fn all(&self) -> [f32; 7] {
        let Self { continuity, length, body, joint, style, path, environment } = *self;
        [continuity, length, body, joint, style, path, environment]
    }
}

/// The terms of a score, weighted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScoreTerms {
    /// Costs of the cuts in units of τ.
    pub continuity: f32,
    /// Length error.
    pub length: f32,
    /// Body constraints, and places of poses.
    pub body: f32,
    /// Joint constraints.
    pub joint: f32,
    /// Styles.
    pub style: f32,
    /// Followed curves.
    pub path: f32,
    /// Feet planted on nothing, joints in obstacles, bodies in each other.
    pub environment: f32,
}

impl ScoreTerms {
    /// Their sum: the score. Lower is better.
    pub fn total(&self) -> f32 {
        self.continuity
            + self.length
            + self.body
            + self.joint
            + self.style
            + self.path
            + self.environment
    }
}

/// What is asked of one character's motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wishes {
    /// The length, if one is wished.
    pub length: Option<LengthWish>,
    /// Checkpoints in the order of their frames.
    pub body: Vec<BodyConstraint>,
    /// Joints that shall be somewhere.
    pub joints: Vec<JointConstraint>,
    /// Poses that must be shown: hard.
    pub poses: Vec<PoseConstraint>,
    /// Stretches that must be shown: hard.
    pub locks: Vec<LockConstraint>,
    /// Styles by stretches of time.
    pub styles: Vec<StyleConstraint>,
    /// Curves on the ground.
    pub follows: Vec<FollowConstraint>,
    /// What is in the way.
    pub obstacles: Vec<Obstacle>,
    /// Who else is about.
    pub others: Vec<OtherBody>,
    /// Factors.
    pub weights: Weights,
}

impl Wishes {
    /// The first place that is asked for and where it is read: it places the motion. A checkpoint, or
    /// the place of a pose that comes before every checkpoint.
    pub fn anchor(&self) -> Option<(u32, PlanarTransform)> {
        let body = self.body.first().map(|c| (c.frame, c.world_from_torso()));
        let poses = self.poses.iter().filter_map(PoseConstraint::place).filter(|place| {
            place.tolerance.position_m.is_finite() && place.tolerance.heading_rad.is_finite()
        });
        let pose = poses.map(|place| (place.frame, place.world_from_torso()));
        body.into_iter().chain(pose).min_by_key(|(frame, _)| *frame)
    }
}

/// A path laid into the world and judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The terms.
    pub terms: ScoreTerms,
    /// Error of each body constraint, in their order.
    pub body: Vec<BodyError>,
    /// Error of each joint constraint, in their order.
    pub joints: Vec<JointError>,
    /// Whether each pose is shown at its frame, and the error of its place, in their order.
    pub poses: Vec<(bool, BodyError)>,
    /// Whether each lock is shown, in their order.
    pub locks: Vec<bool>,
    /// Share of frames without the tag for each style, in their order.
    pub styles: Vec<f32>,
    /// Error of each followed curve, in their order.
    pub follows: Vec<FollowError>,
    /// How deep any joint ever is within an obstacle and its margin, metres.
    pub deepest_m: f32,
    /// How much too near another body ever is, metres.
    pub too_near_m: f32,
    /// Frames in all.
    pub n_frames: u32,
    /// Where the first frame's torso stands in the world.
    pub world_from_start: PlanarTransform,
}

impl Judgement {
    /// Whether the length and every constraint lie within one tolerance before correction.
    pub fn is_acceptable(&self, wishes: &Wishes) -> bool {
        let body = wishes.body.iter().zip(&self.body);
        let joints = wishes.joints.iter().zip(&self.joints);
        let poses = wishes.poses.iter().zip(&self.poses);
        let follows = wishes.follows.iter().zip(&self.follows);
        self.has_length(wishes)
            && body.into_iter().all(|(wish, error)| error.is_within(&wish.tolerance))
            && joints.into_iter().all(|(wish, &error)| wish.is_within_tolerance(error))
            && poses
                .into_iter()
                .all(|(wish, (met, error))| *met && error.is_within(&wish.tolerance))
            && self.locks.iter().all(|&met| met)
            && self.styles.iter().all(|&lacking| has_style(lacking))
            && follows.into_iter().all(|(wish, &error)| wish.is_within_tolerance(error))
            && self.is_clear()
    }

    /// Whether the length is within one tolerance of what is wished.
    pub fn has_length(&self, wishes: &Wishes) -> bool {
        wishes.length.is_none_or(|wish| {
            let one = LengthWish { weight: 1.0, ..wish };
            one.cost(self.n_frames) <= 1.0
        })
    }

    /// Whether nothing is in the way, and nobody, by more than a tolerance.
    pub fn is_clear(&self) -> bool {
        self.deepest_m <= OBSTACLE_TOLERANCE_M && self.too_near_m <= CLEARANCE_LIMIT_M
    }
}

/// Whether a style is met where this share of its frames lacks the tag.
pub fn has_style(lacking: f32) -> bool {
    lacking <= TOLERANCE_SHARE + 1e-6
}

/// Torso frames of every frame of `pieces` laid end to end; the first is at the identity.
pub fn lay_end_to_end(clips: &ClipSet, pieces: &[Piece]) -> Vec<PlanarTransform> {
    let mut torsos = Vec::new();
    let mut next = PlanarTransform::IDENTITY;
    for piece in pieces {
        let track = &clips.clip(piece.clip).track.world_from_torso;
        let start_from_world = track[piece.from.idx()].inverse();
        let world_from_clip = next * start_from_world;
        torsos
            .extend(track[piece.from.idx()..=piece.to.idx()].iter().map(|&t| world_from_clip * t));
        // The frame that is not shown any more: the next piece's first frame is laid on it.
        let beyond = (piece.to.idx() + 1).min(track.len() - 1);
        next = world_from_clip * track[beyond];
    }
    torsos
}

/// A path laid out frame by frame.
struct LaidOut<'a> {
    clips: &'a ClipSet,
    /// Torsos of all frames in the world.
    torsos: Vec<PlanarTransform>,
    /// What each frame shows.
    shown: Vec<(crate::ids::ClipId, FrameIdx)>,
}

impl LaidOut<'_> {
    fn n_frames(&self) -> u32 {
        self.torsos.len() as u32
    }

    /// Joint positions of a frame of the clip that is shown at `frame`, `offset` frames beside it,
    /// in the motion's world.
    fn joints_m(&self, frame: usize, offset: i64) -> Vec<Vec3> {
        let (clip, clip_frame) = self.shown[frame];
        let clip = self.clips.clip(clip);
        let last = clip.n_frames() as i64 - 1;
        let read = (i64::from(clip_frame.0) + offset).clamp(0, last) as usize;
        let world_from_clip =
            self.torsos[frame] * clip.track.world_from_torso[clip_frame.idx()].inverse();
        let one = clip.motion.slice(read, read + 1);
        let mut joints = one.joint_positions_m(self.clips.skeleton());
        joints.iter_mut().for_each(|p| *p = world_from_clip.apply(*p));
        joints
    }

    fn joint_error(&self, wish: &JointConstraint) -> JointError {
        let frame = wish.frame as usize;
        let at = |offset| self.joints_m(frame, offset)[wish.joint.idx()];
        // Over two frames of the clip, one at its ends.
        let (clip, clip_frame) = self.shown[frame];
        let last = self.clips.clip(clip).n_frames() as u32 - 1;
        let n_steps = u32::from(clip_frame.0 > 0) + u32::from(clip_frame.0 < last);
        let secs = n_steps.max(1) as f32 * self.clips.fps().frame_secs() as f32;
        wish.error(at(0), (at(1) - at(-1)) / secs)
    }

    fn shows(&self, from: u32, pieces: &[Piece]) -> bool {
        let mut frame = from as usize;
        pieces.iter().all(|piece| {
            let n_frames = piece.n_frames();
            let shown = self.shown.get(frame..frame + n_frames);
            frame += n_frames;
            shown.is_some_and(|shown| {
                let wished = (piece.from.0..).map(|f| (piece.clip, FrameIdx(f)));
                shown.iter().copied().zip(wished).all(|(a, b)| a == b)
            })
        })
    }

    fn style_without(&self, wish: &StyleConstraint) -> f32 {
        let to = (wish.to + 1).min(self.n_frames());
        let shown = self.shown.get(wish.from as usize..to as usize).unwrap_or_default();
        // Runs of one clip, whose tags are looked up once.
        let runs = shown.chunk_by(|a, b| a.0 == b.0);
        let without: usize = runs
            .map(|run| {
                let has = wish.frames_with_tag(self.clips.clip(run[0].0));
                run.iter().filter(|(_, frame)| !has[frame.idx()]).count()
            })
            .sum();
        without as f32 / wish.n_frames() as f32
    }

    /// The error and the sum of squares in tolerances, the mean over all that should be read.
    fn follow_error(&self, wish: &FollowConstraint) -> (FollowError, f32) {
        let waypoints = wish.waypoints();
        let n_asked = waypoints.len() as f32;
        let (mut place, mut turn, mut n) = (0.0f32, 0.0f32, 0u32);
        for waypoint in waypoints.iter().filter(|w| w.frame < self.n_frames()) {
            let at = self.torsos[waypoint.frame as usize];
            place += at.ground_m().distance_squared(waypoint.position_m);
            if wish.looks_along {
                turn += wrap_angle_rad(at.heading_rad() - waypoint.heading_rad).powi(2);
            }
            n += 1;
        }
        let mean = |sum: f32| sum / n.max(1) as f32;
        let error = FollowError { position_m: mean(place).sqrt(), heading_rad: mean(turn).sqrt() };
        let squares = place / wish.tolerance_m.powi(2) + turn / wish.tolerance_rad.powi(2);
        (error, squares / n_asked)
    }

    /// How deep the body is within the solids at a frame, metres.
    fn depth_m(&self, solids: &[Solid], frame: usize) -> f32 {
        let joints = self.joints_m(frame, 0);
        let depths = solids.iter().flat_map(|solid| joints.iter().map(|&p| solid.depth_m(p)));
        depths.fold(0.0, f32::max)
    }
}

/// Judges `path` from scratch; `None` when it is too short to reach an inner constraint.
pub fn judge(
    graph: &MotionGraph,
    clips: &ClipSet,
    wishes: &Wishes,
    path: &Path,
) -> Option<Judgement> {
    let pieces = path.pieces(graph);
    let mut torsos = lay_end_to_end(clips, &pieces);
    let n_frames = torsos.len() as u32;
    let last_frame = n_frames - 1;
    let mut world_from_start = PlanarTransform::IDENTITY;
    if let Some((frame, world_from_torso)) = wishes.anchor() {
        world_from_start = world_from_torso * torsos.get(frame as usize)?.inverse();
    }
    torsos.iter_mut().for_each(|torso| *torso = world_from_start * *torso);
    let frames_of = |piece: &Piece| {
        let clip = piece.clip;
        (piece.from.0..=piece.to.0).map(move |frame| (clip, FrameIdx(frame)))
    };
    let shown = pieces.iter().flat_map(frames_of).collect();
    let laid = LaidOut { clips, torsos, shown };
    let weights = &wishes.weights;
    let mut terms = ScoreTerms::default();

    let mut body = Vec::with_capacity(wishes.body.len());
    for (nth, constraint) in wishes.body.iter().enumerate() {
        let is_last = nth > 0 && nth + 1 == wishes.body.len();
        let read_at = if is_last { last_frame } else { constraint.frame };
        let at = *laid.torsos.get(read_at as usize)?;
        let error = constraint.error(at, read_at as i32 - constraint.frame as i32);
        terms.body += weights.body * constraint.weight * error.squared(&constraint.tolerance);
        body.push(error);
    }
    let mut joints = Vec::with_capacity(wishes.joints.len());
    for wish in &wishes.joints {
        if wish.frame >= n_frames {
            return None;
        }
        let error = laid.joint_error(wish);
        terms.joint += weights.joint * wish.cost(error);
        joints.push(error);
    }
    let mut poses = Vec::with_capacity(wishes.poses.len());
    for pose in &wishes.poses {
        let at = *laid.torsos.get(pose.frame as usize)?;
        let place = pose.place();
        let error = place.map_or(BodyError::default(), |place| place.error(at, 0));
        if let Some(place) = place {
            terms.body += weights.body * place.weight * error.squared(&place.tolerance);
        }
        poses.push((laid.shows(pose.frame, &[pose.piece()]), error));
    }
    let locks = wishes.locks.iter().map(|lock| laid.shows(lock.from, &lock.pieces)).collect();
    let mut styles = Vec::with_capacity(wishes.styles.len());
    for wish in &wishes.styles {
        let without = laid.style_without(wish);
        terms.style += weights.style * wish.cost_of_a_frame() * without * wish.n_frames() as f32;
        styles.push(without);
    }
    let mut follows = Vec::with_capacity(wishes.follows.len());
    for wish in &wishes.follows {
        let (error, squares) = laid.follow_error(wish);
        terms.path += weights.path * wish.weight * squares;
        follows.push(error);
    }
    for &cut in &path.cuts {
        let cost = f64::from(graph.forest.edge(cut).cost) / graph.tau;
        terms.continuity += weights.continuity * cost as f32;
    }
    terms.length = weights.length * wishes.length.map_or(0.0, |wish| wish.cost(n_frames));

    let frame_secs = clips.fps().frame_secs() as f32;
    // On platforms that a constraint asks for, something is meant to be under the feet.
    let on_the_floor = wishes.body.iter().all(|c| c.height_m.unwrap_or(0.0) == 0.0)
        && wishes.poses.iter().all(|p| p.height_m.unwrap_or(0.0) == 0.0);
    if on_the_floor {
        let mut frame = 0;
        for piece in &pieces {
            let clip = clips.clip(piece.clip);
            let own = clip.track.world_from_torso[piece.from.idx()].level_m;
            let level = laid.torsos[frame].level_m - own;
            let sums = SupportCost::new(clip).between(piece.from.0, piece.to.0 + 1);
            terms.environment += weights.environment * sums.cost_at(level, frame_secs);
            frame += piece.n_frames();
        }
    }
    let solids: Vec<Solid> = wishes.obstacles.iter().map(Solid::new).collect();
    let (mut deepest_m, mut too_near_m) = (0.0f32, 0.0f32);
    for frame in 0..n_frames {
        let depth_m = if solids.is_empty() { 0.0 } else { laid.depth_m(&solids, frame as usize) };
        let ground_m: Vec2 = laid.torsos[frame as usize].ground_m();
        let near = wishes.others.iter().map(|other| other.too_near_m(frame, ground_m));
        let near_m = near.fold(0.0, f32::max);
        deepest_m = deepest_m.max(depth_m);
        too_near_m = too_near_m.max(near_m);
        if frame % OBSTACLE_STRIDE == 0 {
            let secs = frame_secs * OBSTACLE_STRIDE as f32;
            let squares =
                (depth_m / OBSTACLE_TOLERANCE_M).powi(2) + (near_m / CLEARANCE_TOLERANCE_M).powi(2);
            terms.environment += weights.environment * squares * secs;
        }
    }
    Some(Judgement {
        terms,
        body,
        joints,
        poses,
        locks,
        styles,
        follows,
        deepest_m,
        too_near_m,
        n_frames,
        world_from_start,
    })
}
