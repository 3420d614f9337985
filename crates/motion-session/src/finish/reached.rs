//! How far joints and poses that are asked for are off in a finished motion.

use glam::Vec3;
use motion_core::constraint::JointConstraint;
use motion_core::ground::GroundTrack;
use motion_core::motion::Motion;
use motion_core::planar::PlanarTransform;
use motion_io::report_file::ConstraintReport;

use super::digits_of;
use crate::Library;
use crate::problem::{CharacterProblem, PlacedPose};

/// A report for each joint and pose constraint. One behind the motion's end is read at its last
/// frame and is early by the frames between.
pub(super) fn reports(
    character: &CharacterProblem,
    library: &Library,
    motion: &Motion,
    track: &GroundTrack,
) -> Vec<ConstraintReport> {
    let last = motion.n_frames() - 1;
    let read_at = |frame: u32| (frame as usize).min(last);
    let early = |frame: u32| (read_at(frame) as i64 - i64::from(frame)).min(0);
    let joints = character.joints.iter().map(|(id, wish)| {
        let (away_m, slip_m_s) = joint_error(library, motion, wish, read_at(wish.frame));
        ConstraintReport {
            constraint: id.clone(),
            kind: "joint".to_owned(),
            position_error_m: Some(digits_of(away_m)),
            velocity_error_m_s: slip_m_s.map(digits_of),
            frame_error: Some(early(wish.frame)).filter(|&frames| frames != 0),
            ..ConstraintReport::default()
        }
    });
    let poses = character.poses.iter().filter_map(|(id, wish)| {
        let frame = wish.pose.frame;
        let away_m = pose_error_m(library, motion, track, wish, read_at(frame))?;
        Some(ConstraintReport {
            constraint: id.clone(),
            kind: "pose".to_owned(),
            position_error_m: Some(digits_of(away_m)),
            frame_error: Some(early(frame)).filter(|&frames| frames != 0),
            ..ConstraintReport::default()
        })
    });
    joints.chain(poses).collect()
}

/// The joint's distance from where it is to be, metres, and where a velocity is asked for the
/// length of the difference, metres per second: over the frames on both sides, as far as there are
/// any.
fn joint_error(
    library: &Library,
    motion: &Motion,
    wish: &JointConstraint,
    frame: usize,
) -> (f32, Option<f32>) {
    let (before, after) = (frame.saturating_sub(1), (frame + 1).min(motion.n_frames() - 1));
    let around = motion.slice(before, after + 1);
    let path_m = around.joint_path_m(library.clips.skeleton(), wish.joint);
    let away_m = path_m[frame - before].distance(wish.position_m);
    let slip_m_s = wish.velocity_m_s.map(|wished_m_s| {
        let secs = motion.fps().duration_secs(path_m.len()) as f32;
        let way_m = path_m[path_m.len() - 1] - path_m[0];
        let velocity_m_s = if secs > 0.0 { way_m / secs } else { Vec3::ZERO };
        velocity_m_s.distance(wished_m_s)
    });
    (away_m, slip_m_s)
}

/// How far joints are from those of the pose, metres, on average, where it is to be taken; what is
/// left open of that is as it is in the motion. `None` where the clip has no such frame.
fn pose_error_m(
    library: &Library,
    motion: &Motion,
    track: &GroundTrack,
    wish: &PlacedPose,
    frame: usize,
) -> Option<f32> {
    let PlacedPose { pose: wish, ground_m, heading_rad } = wish;
    let clip = library.clips.clip(wish.clip);
    let clip_torso = *clip.track.world_from_torso.get(wish.clip_frame.idx())?;
    let torso = *track.world_from_torso.get(frame)?;
    let skeleton = library.clips.skeleton();
    let (mut is_m, mut asked_m, mut rotations) = (Vec::new(), Vec::new(), Vec::new());
    motion.forward_kinematics(skeleton, frame, &mut is_m, &mut rotations);
    let clip_frame = wish.clip_frame.idx();
    clip.motion.forward_kinematics(skeleton, clip_frame, &mut asked_m, &mut rotations);
    let (heading_rad, ground_m) =
        (heading_rad.unwrap_or(torso.heading_rad()), ground_m.unwrap_or(torso.ground_m()));
    let place = PlanarTransform::new(heading_rad, ground_m, torso.level_m);
    let world_from_clip = place * clip_torso.inverse();
    let pairs = is_m.iter().zip(&asked_m);
    let away_m: f32 = pairs.map(|(is, ask)| is.distance(world_from_clip.apply(*ask))).sum();
    Some(away_m / is_m.len() as f32)
}
