//! A set of as many frames as are wished for, made of one of a few: mirrored, time-warped and
//! disturbed copies, the same for the same seed.
//!
//! A copy of `16_15` is called `16_15~w03`, its mirror image `16_15~w03@mirror`: so the library
//! knows its family. Copies go from 20 % slower to 20 % faster with a swing of at most 0.08 s
//! within; each joint is turned by some 3° that are the copy's own and by as much that changes
//! slowly, so that copies differ by what two repetitions of one person do.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};
use motion_core::clip::{Clip, ClipSet};
use motion_core::ground::GroundTrack;
use motion_core::motion::Motion;
use motion_core::rotation;
use motion_core::skeleton::mirror::MirrorMap;
use motion_io::content_hash::ContentHash;
use motion_session::library_job::{Clips, with_mirror_images};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

/// How much slower or faster a copy is at most, as the logarithm of the factor.
const MAX_PACE: f32 = 0.2;

/// How far a moment of a copy is from where its pace alone would have it, at most, seconds.
const MAX_SWING_SECS: f32 = 0.08;

/// How far each joint is turned, on each axis: as a constant, and by each of two slow waves.
const TURN_RAD: f32 = 0.03;

/// `clips` and as many copies as make `n_frames` frames of all, or a few more. Mirror images of
/// all are among them. Fewer frames than there are with mirror images are a set of those first.
pub fn many_frames(clips: Clips, n_frames: usize, seed: u64) -> anyhow::Result<Clips> {
    let originals = clips.set.clips().len();
    let Clips { set, content_hashes } = with_mirror_images(clips);
    let mirror = MirrorMap::new(set.skeleton());
    let (mut all, mut hashes) = (set.clips().to_vec(), content_hashes.clone());
    let mut n_left = n_frames.saturating_sub(set.n_frames());
    for copy in 1u64.. {
        if n_left == 0 {
            break;
        }
        let copies: Vec<[Clip; 2]> = set.clips()[..originals]
            .par_iter()
            .enumerate()
            .map(|(at, clip)| {
                let mut rng = Pcg64Mcg::seed_from_u64(seed ^ (copy << 32) ^ at as u64);
                let disturbed = disturbed(clip, copy, &mut rng)?;
                let image = mirror.clip(&disturbed);
                Ok([disturbed, image])
            })
            .collect::<anyhow::Result<_>>()?;
        for (pair, hash) in copies.into_iter().zip(&content_hashes) {
            if n_left == 0 {
                break;
            }
            n_left = n_left.saturating_sub(2 * pair[0].n_frames());
            for clip in pair {
                hashes.push(ContentHash::of(format!("{hash} {}", clip.id).as_bytes()));
                all.push(clip);
            }
        }
    }
    let set = ClipSet::new(set.skeleton().clone(), set.fps(), all)?;
    Ok(Clips { set, content_hashes: hashes })
}

/// A slow wave about a random axis.
struct Wave {
    turn: Vec3,
    per_frame: f32,
    phase: f32,
}

impl Wave {
    fn random(rng: &mut Pcg64Mcg, fps: f32) -> Self {
        let hertz = rng.random_range(0.1f32..0.6);
        let phase = rng.random_range(0.0..TAU);
        Self { turn: random_turn(rng), per_frame: TAU * hertz / fps, phase }
    }

    fn at(&self, frame: usize) -> Vec3 {
        self.turn * (self.phase + self.per_frame * frame as f32).sin()
    }
}

fn random_turn(rng: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| rng.random_range(-TURN_RAD..TURN_RAD) * 1.7))
}

/// One copy of `clip` at another pace, disturbed.
fn disturbed(clip: &Clip, copy: u64, rng: &mut Pcg64Mcg) -> anyhow::Result<Clip> {
    let (motion, track) = (&clip.motion, &clip.track);
    let (n_joints, fps) = (motion.n_joints(), motion.fps().get() as f32);
    let last = (motion.n_frames() - 1) as f32;
    let pace = rng.random_range(-MAX_PACE..MAX_PACE).exp();
    let n_frames = ((last / pace).round() as usize).max(1) + 1;
    // Steep enough at most that time never runs backwards.
    let swing = (MAX_SWING_SECS * fps).min(0.1 * last) * rng.random_range(-1f32..1.0);
    let waves: Vec<(Vec3, [Wave; 2])> = (0..n_joints)
        .map(|_| (random_turn(rng), [Wave::random(rng, fps), Wave::random(rng, fps)]))
        .collect();

    let mut positions = Vec::with_capacity(n_frames);
    let mut rotations = Vec::with_capacity(n_frames * n_joints);
    let (mut levels, mut contacts) = (Vec::new(), Vec::new());
    for frame in 0..n_frames {
        let share = frame as f32 / (n_frames - 1) as f32;
        let at = (share * last + swing * (TAU * share).sin()).clamp(0.0, last);
        let (a, b) = (at.floor() as usize, at.ceil() as usize);
        let t = at - at.floor();
        positions.push(motion.root_positions_m()[a].lerp(motion.root_positions_m()[b], t));
        for (joint, (own, waves)) in waves.iter().enumerate() {
            let (q, r) = (motion.rotations(a)[joint], motion.rotations(b)[joint]);
            let shake: Vec3 = *own + waves.iter().map(|wave| wave.at(frame)).sum::<Vec3>();
            let turned: Quat = rotation::slerp(q, r, t) * rotation::exp(shake);
            rotations.push(turned.normalize());
        }
        let (from, to) = (track.world_from_torso[a].level_m, track.world_from_torso[b].level_m);
        levels.push(from + t * (to - from));
        contacts.push(track.contacts[at.round() as usize]);
    }
    let motion = Motion::new(motion.fps(), n_joints, positions, rotations)?;
    let track = GroundTrack::new(&motion, &levels, contacts);
    let (id, tags) = (format!("{}~w{copy:02}", clip.id), clip.tags.clone());
    // Nothing that is measured of these asks what is done in them.
    Ok(Clip { id, tags, tag_spans: Vec::new(), motion, track })
}

#[cfg(test)]
mod tests {
    use motion_core::similarity::families::take_of;
    use motion_session::library_source::builtin_clips;

    use super::*;

    #[test]
    fn copies_are_told_by_their_names_and_the_same_every_time() {
        let make = |seed| {
            let clips = builtin_clips().expect("the built-in clips");
            let n_frames = 3 * clips.set.n_frames();
            (n_frames, many_frames(clips, n_frames, seed).expect("copies"))
        };
        let (n_frames, many) = make(1);
        assert!((n_frames..n_frames + 4000).contains(&many.set.n_frames()));
        assert_eq!(many.set, make(1).1.set);
        assert_ne!(many.set, make(2).1.set);
        let copy = many.set.clips().iter().find(|clip| clip.id.contains("~w01@"));
        let (take, is_mirrored) = take_of(&copy.expect("a mirrored copy").id);
        assert!(is_mirrored && many.set.by_id(take).is_some(), "{take}");
        assert_eq!(many.content_hashes.len(), many.set.clips().len());
    }
}
