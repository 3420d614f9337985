//! A small frozen library for graphs and searches: hips on legs that wander over the floor.
//!
//! Tests rest on this, never on the built-in library, which grows.

use glam::{Quat, Vec3};
use rand::{RngExt, SeedableRng};

use crate::clip::{Clip, ClipSet};
use crate::graph::{BuildOptions, MotionGraph, build};
use crate::ground::{Contacts, GroundTrack};
use crate::motion::Motion;
use crate::skeleton::Skeleton;
use crate::testing::joint;
use crate::units::Fps;

/// A hip with a swinging shin on each side, and nothing else.
pub(crate) fn skeleton() -> Skeleton {
    let joints = vec![
        joint("Hips", None, [0.0, 0.0, 0.0]),
        joint("LeftLeg", Some(0), [0.1, -0.45, 0.0]),
        joint("LeftFoot", Some(1), [0.0, -0.45, 0.0]),
        joint("RightLeg", Some(0), [-0.1, -0.45, 0.0]),
        joint("RightFoot", Some(3), [0.0, -0.45, 0.0]),
    ];
    Skeleton::new(joints).expect("a valid skeleton")
}

/// `n_clips` walks of `n_frames` frames each: curving at random, legs swinging in one rhythm,
/// the last clip up a slope of steps when `climbs`.
pub(crate) fn clips(n_clips: usize, n_frames: usize, climbs: bool, seed: u64) -> ClipSet {
    let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
    let skeleton = skeleton();
    let clips = (0..n_clips)
        .map(|number| {
            let phase = rng.random_range(0.0f32..6.0);
            let bend = rng.random_range(-0.02f32..0.02);
            let speed_m = rng.random_range(0.03f32..0.05);
            let (mut yaw, mut at) = (rng.random_range(-3f32..3.0), Vec3::new(0.0, 0.9, 0.0));
            let (mut path, mut rotations, mut levels) = (vec![], vec![], vec![]);
            for frame in 0..n_frames {
                yaw += bend + 0.005 * (frame as f32 * 0.1).sin();
                at += Quat::from_rotation_y(yaw) * Vec3::Z * speed_m;
                let swing = 0.5 * (phase + frame as f32 * 0.2).sin();
                let level = if climbs && number + 1 == n_clips { 0.01 * frame as f32 } else { 0.0 };
                levels.push(level);
                path.push(at + Vec3::Y * level);
                rotations.extend([
                    Quat::from_rotation_y(yaw),
                    Quat::from_rotation_x(swing),
                    Quat::IDENTITY,
                    Quat::from_rotation_x(-swing),
                    Quat::IDENTITY,
                ]);
            }
            let motion = Motion::new(Fps::THIRTY, 5, path, rotations).expect("a valid motion");
            let contacts = (0..n_frames)
                .map(|frame| Contacts { left: frame % 20 < 12, right: frame % 20 >= 10 })
                .collect();
            let track = GroundTrack::new(&motion, &levels, contacts);
            Clip::found(&skeleton, format!("walk_{number}"), vec![], motion, track)
        })
        .collect();
    ClipSet::new(skeleton, Fps::THIRTY, clips).expect("a valid set")
}

/// The graph of `clips` with the default options.
pub(crate) fn graph(clips: &ClipSet) -> MotionGraph {
    let cancel = crate::cancel::CancelToken::new();
    build(clips, &BuildOptions::default(), &cancel, &|_| ()).expect("a graph")
}
