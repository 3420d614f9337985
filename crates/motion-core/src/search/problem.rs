//! What a search is asked, prepared for scoring.

use super::hard::{HardWish, hard_stretches};
use crate::constraint::LengthMode;
use crate::score::Wishes;

/// What one character's search is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Everything that is wished of the motion.
    pub wishes: Wishes,
    /// For each clip of the library, whether it may be used (the palette).
    pub allowed_clips: Vec<bool>,
    /// Whether bridges may be used.
    pub bridges: bool,
}

/// Why a problem cannot be searched.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProblemError {
    /// The palette is empty.
    #[error("no clip of the library is in the palette; include at least one")]
    NoClips,
    /// Checkpoints out of order, or two at one frame.
    #[error("two body constraints are at frame {0}; move one of them")]
    SameFrame(u32),
    /// An exact length that ends before an inner checkpoint.
    #[error(
        "the length is {length} frames but a body constraint stands at frame {frame}; make the motion longer or move the constraint"
    )]
    TooShort {
        /// The exact length.
        length: u32,
        /// The frame that cannot be reached.
        frame: u32,
    },
    /// A number that is no number, a tolerance of 0, a stretch that ends before it begins, a curve of
    /// fewer than two points.
    #[error(
        "a position, heading, weight, tolerance, size or stretch of time makes no sense; correct it"
    )]
    NotFinite,
    /// Two poses or locks that ask for different frames of clips at one frame.
    #[error(
        "two poses or locked stretches ask for different things at one frame; move one of them"
    )]
    HardConflict(HardWish, HardWish),
    /// A pose or lock of clips or frames that the library or the palette does not have.
    #[error(
        "a pose or locked stretch shows frames that the clips in use do not have; choose others"
    )]
    HardNotThere(HardWish),
    /// Locked pieces that follow each other where the library has no cut.
    #[error(
        "a locked stretch has a cut that this library does not have; lock a take of this library"
    )]
    HardNoCut(HardWish),
    /// No way from one pose or lock to the next in the frames between them.
    #[error(
        "from one pose or locked stretch to the next it takes {} frames and there are {available}; move them apart or choose others",
        needed.map_or("more than any".to_owned(), |n| n.to_string())
    )]
    HardTooFar {
        /// The first of the two.
        from: HardWish,
        /// The second.
        to: HardWish,
        /// The least number of frames from the one to the other; `None` where there is no way.
        needed: Option<u32>,
        /// The number of frames that there are.
        available: u32,
    },
}

impl Problem {
    /// Checks what is asked by itself; every search begins with this.
    pub fn check(&self) -> Result<(), ProblemError> {
        if !self.allowed_clips.contains(&true) {
            return Err(ProblemError::NoClips);
        }
        let body = &self.wishes.body;
        for pair in body.windows(2) {
            if pair[0].frame >= pair[1].frame {
                return Err(ProblemError::SameFrame(pair[1].frame));
            }
        }
        if !self.makes_sense() {
            return Err(ProblemError::NotFinite);
        }
        let hard = hard_stretches(&self.wishes)
            .map_err(|(one, other)| ProblemError::HardConflict(one, other))?;
        if let Some(length) = self.wishes.length.filter(|l| l.mode == LengthMode::Exact) {
            // The last checkpoint is read at the last frame, whatever its own frame is.
            let inner = &body[..body.len().saturating_sub(usize::from(body.len() > 1))];
            let inner = inner.iter().map(|c| c.frame);
            let joints = self.wishes.joints.iter().map(|c| c.frame);
            let hard = hard.iter().map(|stretch| stretch.last);
            let mut all = inner.chain(joints).chain(hard);
            if let Some(frame) = all.find(|&frame| frame >= length.frames) {
                return Err(ProblemError::TooShort { length: length.frames, frame });
            }
        }
        Ok(())
    }

    /// Whether poses, locks and joints, and the clips and cuts that lead to them, are the same.
    pub(crate) fn asks_for_the_same_frames(&self, other: &Self) -> bool {
        let (a, b) = (&self.wishes, &other.wishes);
        a.poses == b.poses
            && a.locks == b.locks
            && a.joints == b.joints
            && self.allowed_clips == other.allowed_clips
            && self.bridges == other.bridges
    }

    fn makes_sense(&self) -> bool {
        let w = &self.wishes;
        let is_weight = |weight: f32| weight.is_finite() && weight >= 0.0;
        let places = w.poses.iter().filter_map(|pose| pose.place());
        w.body.iter().copied().chain(places).all(|c| {
            c.position_m.is_finite()
                && c.heading_rad.is_finite()
                && c.height_m.is_none_or(f32::is_finite)
                && is_weight(c.weight)
                && c.tolerance.is_valid()
        }) && w.joints.iter().all(|c| {
            c.position_m.is_finite()
                && c.velocity_m_s.is_none_or(|v| v.is_finite())
                && is_weight(c.weight)
                && c.tolerance_m > 0.0
        }) && w.styles.iter().all(|c| c.from <= c.to && is_weight(c.weight))
            && w.follows.iter().all(|c| {
                c.from < c.to
                    && c.points_m.len() >= 2
                    && c.points_m.iter().all(|p| p.is_finite())
                    && is_weight(c.weight)
                    && c.tolerance_m > 0.0
                    && c.tolerance_rad > 0.0
            })
            && w.locks.iter().all(|c| {
                let n_frames: usize = c.pieces.iter().map(|piece| piece.n_frames()).sum();
                n_frames > 0
                    && c.pieces.iter().all(|piece| piece.n_frames() > 0)
                    && i64::from(c.to) - i64::from(c.from) + 1 == n_frames as i64
            })
            && w.obstacles.iter().all(|o| o.is_valid())
            && w.others.iter().all(|o| !o.ground_m.is_empty())
            && w.length.is_none_or(|l| is_weight(l.weight))
            && w.weights.all().into_iter().all(is_weight)
    }
}
