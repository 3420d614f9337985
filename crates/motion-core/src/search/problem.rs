//! What a search is asked, prepared for scoring.

use crate::constraint::body::BodyTarget;
use crate::constraint::{LengthMode, TOLERANCE_FRAMES};
use crate::planar::PlanarTransform;
use crate::score::Wishes;

/// What one character's search is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Length, checkpoints, weights.
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
    /// A number that is no number.
    #[error("a position, heading or weight is not a finite number; correct it")]
    NotFinite,
}

impl Problem {
    /// Checks what is asked; every search begins with this.
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
        let w = self.wishes.weights;
        let weights = [w.continuity, w.length, w.body, w.environment];
        let finite = body.iter().all(|c| {
            c.position_m.is_finite()
                && c.heading_rad.is_finite()
                && c.height_m.is_none_or(f32::is_finite)
                && c.weight.is_finite()
                && c.weight >= 0.0
        });
        let length_finite =
            self.wishes.length.is_none_or(|l| l.weight.is_finite() && l.weight >= 0.0);
        if !finite || !length_finite || weights.iter().any(|w| !w.is_finite() || *w < 0.0) {
            return Err(ProblemError::NotFinite);
        }
        if let Some(length) = self.wishes.length.filter(|l| l.mode == LengthMode::Exact) {
            // The last checkpoint is read at the last frame, whatever its own frame is.
            let inner = &body[..body.len().saturating_sub(usize::from(body.len() > 1))];
            if let Some(late) = inner.iter().find(|c| c.frame >= length.frames) {
                return Err(ProblemError::TooShort { length: length.frames, frame: late.frame });
            }
        }
        Ok(())
    }
}

/// A [`Problem`] in the shape that scoring wants.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// Where the first checkpoint's torso stands (the origin without one) …
    pub(crate) anchor: PlanarTransform,
    /// … and its frame. 0 almost always.
    pub(crate) anchor_frame: u32,
    /// Checkpoints between the first and the last.
    pub(crate) inner: Vec<BodyTarget>,
    /// The last checkpoint, read at the motion's last frame.
    pub(crate) last: Option<BodyTarget>,
    /// The number of frames that the search aims at, where anything says so.
    pub(crate) frames: Option<u32>,
    exact: bool,
    length_factor: f32,
    length_frames: f32,
    pub(crate) weights: crate::score::Weights,
    /// Whether feet planted on nothing cost.
    pub(crate) on_the_floor: bool,
}

/// `length_factor · (N − length)² + last_factor · (N − last)²` for `N` frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FramesQuadratic {
    pub(crate) length_factor: f32,
    pub(crate) length: f32,
    pub(crate) last_factor: f32,
    pub(crate) last: f32,
}

impl Target {
    pub(crate) fn new(wishes: &Wishes) -> Self {
        let body = &wishes.body;
        let targets: Vec<BodyTarget> = body.iter().map(BodyTarget::new).collect();
        let (last, inner) = match targets.len() {
            0 | 1 => (None, Vec::new()),
            n => (Some(targets[n - 1]), targets[1..n - 1].to_vec()),
        };
        let wish = wishes.length.filter(|l| l.mode != LengthMode::Free);
        let first = targets.first();
        Self {
            anchor: first.map_or(PlanarTransform::IDENTITY, |t| t.world_from_torso),
            anchor_frame: first.map_or(0, |t| t.frame),
            frames: wish.map(|l| l.frames).or(last.map(|t| t.frame + 1)),
            exact: wish.is_some_and(|l| l.mode == LengthMode::Exact),
            length_factor: wish.map_or(0.0, |l| {
                wishes.weights.length * l.weight / (TOLERANCE_FRAMES * TOLERANCE_FRAMES)
            }),
            length_frames: wish.map_or(0.0, |l| l.frames as f32),
            inner,
            last,
            weights: wishes.weights,
            on_the_floor: body.iter().all(|c| c.height_m.unwrap_or(0.0) == 0.0),
        }
    }

    /// The parts of [`Self::frames_cost`] as squares; exact lengths and checkpoints that are not
    /// reached are not in them, so they are a lower bound.
    pub(crate) fn frames_quadratic(&self) -> FramesQuadratic {
        let last_factor = self.last.map_or(0.0, |t| self.weights.body * t.frame_cost(1.0));
        FramesQuadratic {
            length_factor: self.length_factor,
            length: self.length_frames,
            last_factor,
            last: self.last.map_or(0.0, |t| t.frame as f32 + 1.0),
        }
    }

    /// The numbers of frames, first and last, whose own cost may lie under `budget`; a bound, not
    /// exact to the frame.
    pub(crate) fn frames_window(&self, budget: f32) -> (i64, i64) {
        if self.exact {
            return (self.length_frames as i64, self.length_frames as i64);
        }
        // a (N − L)² + b (N − 1 − t)² ≤ budget is an interval around the weighted mean.
        let squares = self.frames_quadratic();
        let (a, b) = (f64::from(squares.length_factor), f64::from(squares.last_factor));
        let wished_last = f64::from(squares.last);
        if a + b <= 0.0 || !budget.is_finite() {
            return (0, i64::from(u32::MAX));
        }
        let length = f64::from(self.length_frames);
        let centre = (a * length + b * wished_last) / (a + b);
        let least = a * (centre - length).powi(2) + b * (centre - wished_last).powi(2);
        let reach = ((f64::from(budget) - least).max(0.0) / (a + b)).sqrt() + 1.0;
        if f64::from(budget) < least {
            return (1, 0);
        }
        (((centre - reach).floor() as i64).max(0), (centre + reach).ceil() as i64)
    }

    /// What a number of frames costs by itself: the length wish, and the last checkpoint being
    /// early or late. Infinite where an inner checkpoint is not reached or an exact length missed.
    #[inline]
    pub(crate) fn frames_cost(&self, n_frames: u32) -> f32 {
        let needed = self.inner.last().map_or(self.anchor_frame, |t| t.frame);
        if n_frames <= needed {
            return f32::INFINITY;
        }
        let error = n_frames as f32 - self.length_frames;
        if self.exact && error != 0.0 {
            return f32::INFINITY;
        }
        let late = self.last.map_or(0.0, |last| {
            self.weights.body * last.frame_cost(n_frames as f32 - 1.0 - last.frame as f32)
        });
        self.length_factor * error * error + late
    }
}
