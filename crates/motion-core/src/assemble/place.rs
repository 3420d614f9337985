//! Pieces of clips laid end to end.
//!
//! A cut at motion frame d leads from frame s of one clip to frame t of another. The two are the
//! same instant: the motion shows …, s − 1, t, t + 1, …, and the new piece is placed so that the
//! torso frame of t lies on that of s, heading, ground point and level.

use glam::{Quat, Vec3};

use crate::clip::{Clip, ClipSet};
use crate::ground::Contacts;
use crate::ids::ClipId;
use crate::motion::Motion;
pub use crate::path::Piece;
use crate::planar::PlanarTransform;
use crate::rotation;
use crate::units::FrameIdx;

/// Why pieces make no motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AssembleError {
    /// There is nothing to show.
    #[error("a motion needs at least one piece")]
    Empty,
    /// A piece names a clip or frames that the library does not have.
    #[error("piece {piece} shows frames {from} to {to} of clip {clip}, which the library lacks")]
    Piece {
        /// Index of the piece.
        piece: usize,
        /// The clip's index.
        clip: ClipId,
        /// First frame asked for.
        from: FrameIdx,
        /// Last frame asked for.
        to: FrameIdx,
    },
    /// Body targets are not in the order of their frames, or beyond the motion's end.
    #[error("body target {target} at frame {frame} is out of order or beyond the last frame")]
    Target {
        /// Index of the target.
        target: usize,
        /// Its frame.
        frame: FrameIdx,
    },
}

/// Pieces in their places, cut hard: nothing is smoothed yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The motion.
    pub motion: Motion,
    /// Height of the support in every frame, metres.
    pub levels_m: Vec<f32>,
    /// Planted feet, as they are in the clips.
    pub contacts: Vec<Contacts>,
    /// The first frame of every piece.
    pub starts: Vec<usize>,
    /// Where every piece's clip lies in the world.
    pub world_from_clip: Vec<PlanarTransform>,
}

/// Lays pieces end to end; the first frame's torso frame is `start`.
///
/// Where a piece ends with its clip there is no next frame to align with; the last step is then
/// taken once more.
pub fn place(
    set: &ClipSet,
    pieces: &[Piece],
    start: PlanarTransform,
) -> Result<Placed, AssembleError> {
    check(set, pieces)?;
    let n_frames: usize = pieces.iter().map(|piece| piece.n_frames()).sum();
    let n_joints = set.skeleton().n_joints();
    let mut roots_m = Vec::with_capacity(n_frames);
    let mut rotations = Vec::with_capacity(n_frames * n_joints);
    let mut levels_m = Vec::with_capacity(n_frames);
    let mut contacts = Vec::with_capacity(n_frames);
    let mut starts = Vec::with_capacity(pieces.len());
    let mut world_from_clip: Vec<PlanarTransform> = Vec::with_capacity(pieces.len());

    let mut world_from_next = start;
    for piece in pieces {
        let clip = set.clip(piece.clip);
        let (from, to) = (piece.from.idx(), piece.to.idx());
        let world_from_piece = world_from_next * clip.track.world_from_torso[from].inverse();
        let turn = world_from_piece.rotation();
        starts.push(roots_m.len());
        for frame in from..=to {
            roots_m.push(world_from_piece.apply(clip.motion.root_positions_m()[frame]));
            let pose = clip.motion.rotations(frame);
            rotations.push((turn * pose[0]).normalize());
            rotations.extend_from_slice(&pose[1..]);
            levels_m.push(world_from_piece.level_m + clip.track.world_from_torso[frame].level_m);
        }
        contacts.extend_from_slice(&clip.track.contacts[from..=to]);
        world_from_clip.push(world_from_piece);
        world_from_next = world_from_piece * torso_at(clip, to + 1);
    }
    let motion = Motion::from_unit_parts(set.fps(), n_joints, roots_m, rotations);
    Ok(Placed { motion, levels_m, contacts, starts, world_from_clip })
}

fn check(set: &ClipSet, pieces: &[Piece]) -> Result<(), AssembleError> {
    if pieces.is_empty() {
        return Err(AssembleError::Empty);
    }
    for (idx, &Piece { clip, from, to }) in pieces.iter().enumerate() {
        let known =
            clip.idx() < set.clips().len() && from <= to && to.idx() < set.clip(clip).n_frames();
        if !known {
            return Err(AssembleError::Piece { piece: idx, clip, from, to });
        }
    }
    Ok(())
}

/// The torso frame at `frame`, or one step beyond the last.
fn torso_at(clip: &Clip, frame: usize) -> PlanarTransform {
    let track = &clip.track.world_from_torso;
    if let Some(&torso) = track.get(frame) {
        return torso;
    }
    let last = track[track.len() - 1];
    let before = track[track.len().saturating_sub(2)];
    last * (before.inverse() * last)
}

/// A pose that is not shown: what a clip does just before or after the piece taken from it.
#[derive(Clone, Debug, Default)]
pub(super) struct Ghost {
    pub(super) root_m: Vec3,
    pub(super) rotations: Vec<Quat>,
}

impl Ghost {
    /// Overwrites the ghost with `clip` at `frame`, as placed. Before the first and after the
    /// last frame the clip is carried on at the speed that it has there.
    pub(super) fn load(&mut self, clip: &Clip, world_from_clip: PlanarTransform, frame: isize) {
        let last = clip.n_frames() as isize - 1;
        let near = frame.clamp(0, last);
        let inner = if frame < 0 { 1.min(last) } else { (near - 1).max(0) };
        let beyond = (frame - near).unsigned_abs() as f32;
        let (near, inner) = (near as usize, inner as usize);
        let motion = &clip.motion;
        let mut root_m = motion.root_positions_m()[near];
        self.rotations.clear();
        self.rotations.extend_from_slice(motion.rotations(near));
        if beyond > 0.0 {
            root_m += (root_m - motion.root_positions_m()[inner]) * beyond;
            for (q, &before) in self.rotations.iter_mut().zip(motion.rotations(inner)) {
                *q *= rotation::exp(rotation::log(before.inverse() * *q) * beyond);
            }
        }
        self.root_m = world_from_clip.apply(root_m);
        self.rotations[0] = world_from_clip.rotation() * self.rotations[0];
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use proptest::prelude::*;

    use super::*;
    use crate::ground::yaw_series_rad;
    use crate::planar::wrap_angle_rad;
    use crate::testing::{piece, walks};

    #[test]
    fn one_piece_is_its_clip_moved() {
        let set = walks();
        let start = PlanarTransform::new(1.0, Vec2::new(2.0, -3.0), 0.0);
        let placed = place(&set, &[piece(0, 5, 30)], start).expect("a valid piece");
        assert_eq!(placed.motion.n_frames(), 26);
        assert_eq!(placed.starts, [0]);
        let yaw = yaw_series_rad(&placed.motion)[0];
        let root = placed.motion.root_positions_m()[0];
        assert!(wrap_angle_rad(yaw - 1.0).abs() < 1e-5, "{yaw}");
        assert!(Vec2::new(root.x, root.z).distance(start.ground_m()) < 1e-5, "{root}");
        let source = &set.clips()[0].motion;
        assert_eq!(&placed.motion.rotations(7)[1..], &source.rotations(12)[1..]);
    }

    proptest! {
        #[test]
        fn a_cut_within_a_clip_to_the_same_frame_shows_the_clip(cut in 1u32..59) {
            let set = walks();
            let parts = [piece(1, 0, cut - 1), piece(1, cut, 59)];
            let cut = place(&set, &parts, PlanarTransform::IDENTITY).expect("valid");
            let whole =
                place(&set, &[piece(1, 0, 59)], PlanarTransform::IDENTITY).expect("valid");
            for frame in 0..60 {
                let (a, b) =
                    (cut.motion.root_positions_m()[frame], whole.motion.root_positions_m()[frame]);
                prop_assert!(a.distance(b) < 1e-4, "frame {frame}: {a} is not {b}");
            }
        }

        #[test]
        fn the_new_piece_starts_where_the_old_one_would_have_gone_on(
            out in 3u32..50, into in 0u32..50,
        ) {
            let set = walks();
            let placed =
                place(&set, &[piece(0, 2, out), piece(2, into, 55)], PlanarTransform::IDENTITY)
                    .expect("valid");
            let start = placed.starts[1];
            let expected = placed.world_from_clip[0]
                * set.clips()[0].track.world_from_torso[out as usize + 1];
            let root = placed.motion.root_positions_m()[start];
            prop_assert!(Vec2::new(root.x, root.z).distance(expected.ground_m()) < 1e-4);
            let yaw = yaw_series_rad(&placed.motion)[start];
            prop_assert!(wrap_angle_rad(yaw - expected.heading_rad()).abs() < 1e-4);
            prop_assert!((placed.levels_m[start] - expected.level_m).abs() < 1e-5);
        }
    }

    #[test]
    fn a_piece_that_ends_with_its_clip_takes_its_last_step_again() {
        let set = walks();
        let placed = place(&set, &[piece(0, 0, 59), piece(0, 0, 9)], PlanarTransform::IDENTITY)
            .expect("valid");
        let z = |frame: usize| placed.motion.root_positions_m()[frame].z;
        assert!((z(60) - z(59) - (z(59) - z(58))).abs() < 1e-4, "steps on");
    }

    #[test]
    fn impossible_pieces_are_refused() {
        let set = walks();
        let refuse = |pieces: &[Piece]| {
            place(&set, pieces, PlanarTransform::IDENTITY).expect_err("must be refused").to_string()
        };
        assert_eq!(refuse(&[]), "a motion needs at least one piece");
        assert_eq!(
            refuse(&[piece(0, 0, 5), piece(9, 0, 5)]),
            "piece 1 shows frames 0 to 5 of clip 9, which the library lacks"
        );
        assert!(refuse(&[piece(0, 6, 5)]).contains("frames 6 to 5"));
        assert!(refuse(&[piece(0, 0, 60)]).contains("frames 0 to 60"));
    }

    #[test]
    fn ghosts_go_on_where_clips_end() {
        let set = walks();
        let clip = &set.clips()[0];
        let (mut inside, mut beyond) = (Ghost::default(), Ghost::default());
        inside.load(clip, PlanarTransform::IDENTITY, 59);
        beyond.load(clip, PlanarTransform::IDENTITY, 60);
        let step = inside.root_m - clip.motion.root_positions_m()[58];
        assert!(beyond.root_m.distance(inside.root_m + step) < 1e-5, "{}", beyond.root_m);
        beyond.load(clip, PlanarTransform::IDENTITY, -1);
        assert!(beyond.root_m.z < clip.motion.root_positions_m()[0].z, "one step back");
    }
}
