//! Bodies and motions for the tests of this crate.

pub(crate) mod bodies;
pub(crate) mod wander;

use glam::{Quat, Vec3};

use crate::assemble::Piece;
use crate::clip::{Clip, ClipSet};
use crate::floor;
use crate::ids::{ClipId, JointIdx};
use crate::ik;
use crate::motion::Motion;
use crate::skeleton::{Joint, Skeleton};
use crate::units::{Fps, FrameIdx};

/// How far the toe joints of [`legs`] are below the hips at rest, metres.
pub(crate) const TOE_BELOW_HIPS_M: f32 = 0.86;

/// A joint without an end site.
pub(crate) fn joint(name: &str, parent: Option<u32>, offset_m: [f32; 3]) -> Joint {
    let parent = parent.map(JointIdx);
    Joint { name: name.into(), parent, offset_m: offset_m.into(), end_site_m: None }
}

/// Hips and two legs of nine joints; thigh and shin of 0.4 m each.
pub(crate) fn legs() -> Skeleton {
    Skeleton::new(vec![
        joint("Hips", None, [0.0; 3]),
        joint("LeftUpLeg", Some(0), [0.1, 0.0, 0.0]),
        joint("LeftLeg", Some(1), [0.0, -0.4, 0.0]),
        joint("LeftFoot", Some(2), [0.0, -0.4, 0.0]),
        joint("LeftToeBase", Some(3), [0.0, -0.06, 0.1]),
        joint("RightUpLeg", Some(0), [-0.1, 0.0, 0.0]),
        joint("RightLeg", Some(5), [0.0, -0.4, 0.0]),
        joint("RightFoot", Some(6), [0.0, -0.4, 0.0]),
        joint("RightToeBase", Some(7), [0.0, -0.06, 0.1]),
    ])
    .expect("valid by construction")
}

/// A walk of [`legs`]: feet exactly planted for 60 % of a cycle of 1 s, toe joints at 3 cm, a
/// turn at a constant rate.
pub(crate) struct Walk {
    pub n_frames: usize,
    pub speed_m_s: f32,
    pub turn_rad_s: f32,
    /// Where in the cycle the walk begins, 0..1.
    pub phase: f32,
}

impl Walk {
    pub(crate) fn motion(&self) -> Motion {
        const STANCE: f32 = 0.6;
        let mut roots = Vec::new();
        let mut rotations = Vec::new();
        for frame in 0..self.n_frames {
            let secs = frame as f32 / 30.0;
            let (hips, heading) = self.hips_at(secs);
            roots.push(hips);
            let turn = Quat::from_rotation_y(heading);
            rotations.push(turn);
            for (side_m, offset) in [(0.1, 0.0), (-0.1, 0.5)] {
                let cycle = secs + self.phase + offset;
                let (n, at) = (cycle.floor(), cycle.fract());
                // Middle of the stance of the cycle's plant, and of the next one.
                let mid = n + 0.5 * STANCE - self.phase - offset;
                let place = |secs: f32| {
                    let (hips, heading) = self.hips_at(secs);
                    hips + Quat::from_rotation_y(heading) * Vec3::new(side_m, 0.0, 0.0)
                };
                let swing = ((at - STANCE) / (1.0 - STANCE)).max(0.0);
                let ease = swing * swing * (3.0 - 2.0 * swing);
                let mut ankle = place(mid).lerp(place(mid + 1.0), ease);
                ankle.y = 0.09 + 0.08 * (std::f32::consts::PI * swing).sin().powi(2);
                let hip = hips + turn * Vec3::new(side_m, 0.0, 0.0);
                let (knee, foot) = (hip - Vec3::Y * 0.4, hip - Vec3::Y * 0.8);
                let bend = ik::reach_for(hip, knee, foot, ankle, turn * Vec3::Z);
                let thigh = turn.inverse() * bend.upper * turn;
                let shin = (turn * thigh).inverse() * bend.lower * turn;
                // The foot stays flat and looks where the body looked at its plant.
                let flat = Quat::from_rotation_y(self.hips_at(mid + ease).1);
                let foot = (bend.lower * turn).inverse() * flat;
                rotations.extend([thigh, shin, foot, Quat::IDENTITY]);
            }
        }
        Motion::new(Fps::THIRTY, 9, roots, rotations).expect("valid by construction")
    }

    fn hips_at(&self, secs: f32) -> (Vec3, f32) {
        let heading = self.turn_rad_s * secs;
        let (x, z) = if self.turn_rad_s == 0.0 {
            (0.0, self.speed_m_s * secs)
        } else {
            let radius = self.speed_m_s / self.turn_rad_s;
            (radius * (1.0 - heading.cos()), radius * heading.sin())
        };
        (Vec3::new(x, 0.84, z), heading)
    }
}

/// Three walks of 60 frames: ahead, to the left, faster to the right.
pub(crate) fn walks() -> ClipSet {
    let walk =
        |speed_m_s, turn_rad_s, phase| Walk { n_frames: 60, speed_m_s, turn_rad_s, phase }.motion();
    set(vec![walk(0.5, 0.0, 0.0), walk(0.5, 0.6, 0.2), walk(0.7, -0.5, 0.4)])
}

/// Clips called 0, 1, … of motions on [`legs`], calibrated.
pub(crate) fn set(mut motions: Vec<Motion>) -> ClipSet {
    let tracks = floor::calibrate(&legs(), &mut motions);
    let clips = motions
        .into_iter()
        .zip(tracks)
        .enumerate()
        .map(|(idx, (motion, track))| Clip::found(&legs(), idx.to_string(), vec![], motion, track))
        .collect();
    ClipSet::new(legs(), Fps::THIRTY, clips).expect("valid by construction")
}

/// Frames `from..=to` of clip `clip`.
pub(crate) fn piece(clip: u32, from: u32, to: u32) -> Piece {
    Piece { clip: ClipId(clip), from: FrameIdx(from), to: FrameIdx(to) }
}
