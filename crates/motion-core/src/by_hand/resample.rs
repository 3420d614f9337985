//! A motion at times between its frames.

use glam::{Quat, Vec3};

use crate::motion::Motion;
use crate::rotation;

/// The motion that shows, frame by frame, the motion's frame `source_frames[f]`.
///
/// Between frames root and rotations follow the cubic of Catmull & Rom 1974 through the four
/// frames around (rotations: of their quaternions, made unit), so that slow motion has no corner at
/// every frame; ends go on straight. At a whole number the frame is copied to the last bit. Times
/// outside of the motion count as its ends; no times at all make its first frame.
pub fn resample(motion: &Motion, source_frames: &[f64]) -> Motion {
    let n_joints = motion.n_joints();
    let last = motion.n_frames() - 1;
    let mut roots_m = Vec::with_capacity(source_frames.len());
    let mut rotations: Vec<Quat> = Vec::with_capacity(source_frames.len() * n_joints);
    let first = [0.0];
    let source_frames = if source_frames.is_empty() { &first } else { source_frames };
    for &at in source_frames {
        // A time that is no number counts as the first frame.
        let at = at.max(0.0).min(last as f64);
        let frame = at.floor() as usize;
        let t = (at - frame as f64) as f32;
        if t == 0.0 || frame == last {
            roots_m.push(motion.root_positions_m()[frame]);
            rotations.extend_from_slice(motion.rotations(frame));
            continue;
        }
        let around = [frame.checked_sub(1), Some(frame + 2).filter(|&after| after <= last)];
        roots_m.push(root_between_m(motion.root_positions_m(), frame, around, t));
        let [before, after] = around.map(|frame| frame.map(|frame| motion.rotations(frame)));
        let pairs = motion.rotations(frame).iter().zip(motion.rotations(frame + 1));
        rotations.extend(pairs.enumerate().map(|(joint, (&a, &b))| {
            rotation_between(before.map(|pose| pose[joint]), a, b, after.map(|pose| pose[joint]), t)
        }));
    }
    Motion::from_unit_parts(motion.fps(), n_joints, roots_m, rotations)
}

fn root_between_m(path_m: &[Vec3], frame: usize, around: [Option<usize>; 2], t: f32) -> Vec3 {
    let (a, b) = (path_m[frame], path_m[frame + 1]);
    let before = around[0].map_or(2.0 * a - b, |frame| path_m[frame]);
    let after = around[1].map_or(2.0 * b - a, |frame| path_m[frame]);
    let [w0, w1, w2, w3] = weights(t);
    before * w0 + a * w1 + b * w2 + after * w3
}

fn rotation_between(before: Option<Quat>, a: Quat, b: Quat, after: Option<Quat>, t: f32) -> Quat {
    let near = |q: Quat, to: Quat| if q.dot(to) < 0.0 { -q } else { q };
    let b = near(b, a);
    let before = before.map_or(a * 2.0 - b, |q| near(q, a));
    let after = after.map_or(b * 2.0 - a, |q| near(q, b));
    let [w0, w1, w2, w3] = weights(t);
    let mixed = before * w0 + a * w1 + b * w2 + after * w3;
    // Rotations that are worlds apart from frame to frame have no curve to follow.
    let is_curve = a.dot(b) > 0.5 && mixed.length_squared() > 0.25;
    if is_curve { mixed.normalize() } else { rotation::slerp(a, b, t).normalize() }
}

/// Catmull–Rom: how much the frames at −1, 0, 1 and 2 count at `t`.
fn weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        -0.5 * t + t2 - 0.5 * t3,
        1.0 - 2.5 * t2 + 1.5 * t3,
        0.5 * t + 2.0 * t2 - 1.5 * t3,
        -0.5 * t2 + 0.5 * t3,
    ]
}
