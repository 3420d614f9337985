//! What must be shown: poses and locked stretches as frames of clips at frames of the motion.

use super::route::Span;
use crate::path::Piece;
use crate::score::Wishes;

/// Which wish a hard stretch comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum HardWish {
    /// `Wishes::poses[i]`.
    Pose(usize),
    /// `Wishes::locks[i]`.
    Lock(usize),
}

/// A stretch that must be shown as it is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HardStretch {
    pub(crate) wish: HardWish,
    /// The motion's frame that shows the first frame of the first piece.
    pub(crate) first: u32,
    /// The motion's last frame that is spoken of.
    pub(crate) last: u32,
    pub(crate) pieces: Vec<Piece>,
}

impl HardStretch {
    fn new(wish: HardWish, first: u32, pieces: Vec<Piece>) -> Self {
        let n_frames: usize = pieces.iter().map(|piece| piece.n_frames()).sum();
        Self { wish, first, last: first + n_frames.saturating_sub(1) as u32, pieces }
    }

    /// Whether these spans show it.
    pub(crate) fn is_shown(&self, spans: &[Span]) -> bool {
        let nth = spans.partition_point(|span| span.starts_at <= self.first);
        let Some(mut at) = nth.checked_sub(1) else { return false };
        let mut frame = self.first;
        for (nth, piece) in self.pieces.iter().enumerate() {
            let Some(span) = spans.get(at) else { return false };
            let shown_from = span.from + frame - span.starts_at;
            // Inner cuts of a lock are where they were.
            let ends = nth + 1 == self.pieces.len() || span.to == piece.to.0 + 1;
            let begins = nth == 0 || span.from == piece.from.0;
            let fits = span.clip == piece.clip
                && shown_from == piece.from.0
                && piece.to.0 < span.to
                && ends
                && begins;
            if !fits {
                return false;
            }
            frame += piece.n_frames() as u32;
            at += 1;
        }
        true
    }
}

/// The frame of the motion's piece that shows hard frame `frame`, if `pieces` show it: `(piece index, frame in clip)`.
fn shown_at(stretch: &HardStretch, frame: u32) -> Option<(usize, u32)> {
    let mut starts = stretch.first;
    for (nth, piece) in stretch.pieces.iter().enumerate() {
        let n_frames = piece.n_frames() as u32;
        if (starts..starts + n_frames).contains(&frame) {
            return Some((nth, piece.from.0 + frame - starts));
        }
        starts += n_frames;
    }
    None
}

/// All hard stretches in the order of their frames. Poses that a lock shows anyway are left out;
/// two that ask for different frames at one frame are the error.
pub(crate) fn hard_stretches(wishes: &Wishes) -> Result<Vec<HardStretch>, (HardWish, HardWish)> {
    let locks = wishes.locks.iter().enumerate();
    let mut all: Vec<HardStretch> = locks
        .map(|(nth, lock)| HardStretch::new(HardWish::Lock(nth), lock.from, lock.pieces.clone()))
        .collect();
    all.sort_by_key(|stretch| (stretch.first, stretch.wish));
    for pair in all.windows(2) {
        if pair[1].first <= pair[0].last {
            return Err((pair[0].wish, pair[1].wish));
        }
    }
    let mut poses: Vec<HardStretch> = Vec::new();
    for (nth, pose) in wishes.poses.iter().enumerate() {
        let wish = HardWish::Pose(nth);
        let over = all.iter().chain(&poses).find(|s| (s.first..=s.last).contains(&pose.frame));
        if let Some(over) = over {
            let same = shown_at(over, pose.frame).is_some_and(|(piece, clip_frame)| {
                over.pieces[piece].clip == pose.clip && clip_frame == pose.clip_frame.0
            });
            if same {
                continue;
            }
            return Err((over.wish, wish));
        }
        poses.push(HardStretch::new(wish, pose.frame, vec![pose.piece()]));
    }
    all.extend(poses);
    all.sort_by_key(|stretch| stretch.first);
    Ok(all)
}
