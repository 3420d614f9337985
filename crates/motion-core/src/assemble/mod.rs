//! From a path to motion (`docs/method.md`, A6), in four stages, a file each:
//!
//! 1. [`place`](mod@place): pieces of clips are laid end to end by planar transforms.
//! 2. [`seam`]: the jump at every cut is spread over the frames around it.
//! 3. [`satisfy`]: what is left of each body target's error is spread over the frames before it.
//! 4. [`footlock`]: planted feet are held in place, without moving the root.
//!
//! Frames are never added or dropped: a motion has as many as its pieces show.
//!
//! ```no_run
//! # use motion_core::{assemble::*, clip::ClipSet, planar::PlanarTransform};
//! # fn example(set: &ClipSet, pieces: &[Piece], targets: &[BodyTarget]) -> Result<(), AssembleError> {
//! let assembler = Assembler::new(set);
//! let plan = Plan { pieces, start: PlanarTransform::IDENTITY, targets, hard_frames: &[] };
//! let assembled = assembler.assemble(&plan, Policies::BEST)?;
//! assert_eq!(assembled.errors.len(), targets.len());
//! # Ok(())
//! # }
//! ```

pub mod footlock;
pub mod leg;
pub mod place;
pub mod plants;
pub mod satisfy;
pub mod seam;
pub mod seam_curve;

use crate::clip::ClipSet;
use crate::contacts::Side;
use crate::floor::{self, Soles};
use crate::ground::Contacts;
use crate::motion::Motion;
use crate::planar::PlanarTransform;
use crate::units::FrameIdx;
pub use footlock::FootPolicy;
use leg::Leg;
pub use place::{AssembleError, Piece, Placed, place};
pub use satisfy::{BodyTarget, SpreadPolicy, TargetError};
pub use seam::SeamPolicy;

/// What is to be made into motion.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// Stretches of clips in order.
    pub pieces: &'a [Piece],
    /// The torso frame of the first frame.
    pub start: PlanarTransform,
    /// Where the body must be, by frame.
    pub targets: &'a [BodyTarget],
    /// Frames whose poses must stay as they are in their clips.
    pub hard_frames: &'a [FrameIdx],
}

/// How each stage works.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policies {
    /// Cuts.
    pub seam: SeamPolicy,
    /// Corrections towards targets.
    pub spread: SpreadPolicy,
    /// Feet.
    pub feet: FootPolicy,
}

impl Policies {
    /// What AF02 does.
    pub const PAPER: Self =
        Self { seam: SeamPolicy::Paper, spread: SpreadPolicy::Even, feet: FootPolicy::Free };
    /// What looks best; the default.
    pub const BEST: Self = Self {
        seam: SeamPolicy::VelocityMatched,
        spread: SpreadPolicy::ByTravel,
        feet: FootPolicy::Locked,
    };
}

/// A motion made of pieces, with what is known about it frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembled {
    /// The motion.
    pub motion: Motion,
    /// Planted feet per frame, carried from the clips.
    pub contacts: Vec<Contacts>,
    /// Height of the support per frame, metres.
    pub levels_m: Vec<f32>,
    /// The first frame of every piece; all but the first are seams.
    pub starts: Vec<FrameIdx>,
    /// Errors of the targets before correction, in order.
    pub raw_errors: Vec<TargetError>,
    /// Errors of the targets in the finished motion, in order.
    pub errors: Vec<TargetError>,
}

/// Makes motions of a library's clips; holds what is the same for all of them.
#[derive(Clone, Debug)]
pub struct Assembler<'a> {
    set: &'a ClipSet,
    legs: [Option<Leg>; 2],
    soles: Soles,
}

impl<'a> Assembler<'a> {
    /// An assembler for a library. Reads every clip once to learn how high the soles are.
    pub fn new(set: &'a ClipSet) -> Self {
        let clips = set.clips().iter().map(|clip| (&clip.motion, &clip.track));
        Self::with_soles(set, floor::soles_of(set.skeleton(), clips))
    }

    /// An assembler for a library whose sole heights are known.
    pub fn with_soles(set: &'a ClipSet, soles: Soles) -> Self {
        let legs = Side::BOTH.map(|side| Leg::new(set.skeleton(), side));
        Self { set, legs, soles }
    }

    /// Sole heights of the library.
    pub fn soles(&self) -> Soles {
        self.soles
    }

    /// Makes the motion. Fails on pieces that the library does not have and on targets out of
    /// order or beyond the end; anything else has a motion.
    pub fn assemble(
        &self,
        plan: &Plan<'_>,
        policies: Policies,
    ) -> Result<Assembled, AssembleError> {
        let mut placed = place(self.set, plan.pieces, plan.start)?;
        satisfy::check_targets(plan.targets, placed.motion.n_frames())?;
        let mut hard: Vec<usize> = plan.hard_frames.iter().map(|frame| frame.idx()).collect();
        hard.sort_unstable();
        seam::smooth_seams(self.set, plan.pieces, &mut placed, &hard, policies.seam);
        let raw_errors = satisfy::target_errors(&placed, plan.targets);
        satisfy::satisfy(&mut placed, plan.targets, policies.spread);
        if policies.feet == FootPolicy::Locked {
            let skeleton = self.set.skeleton();
            footlock::lock_feet(skeleton, &self.legs, self.soles, &mut placed, &hard);
        }
        let errors = satisfy::target_errors(&placed, plan.targets);
        let Placed { motion, levels_m, contacts, starts, .. } = placed;
        let starts = starts.into_iter().map(FrameIdx::from_idx).collect();
        Ok(Assembled { motion, contacts, levels_m, starts, raw_errors, errors })
    }
}

/// [`Assembler::assemble`] for a single motion.
pub fn assemble(
    set: &ClipSet,
    plan: &Plan<'_>,
    policies: Policies,
) -> Result<Assembled, AssembleError> {
    Assembler::new(set).assemble(plan, policies)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use proptest::prelude::*;

    use super::*;
    use crate::testing::{piece, walks};

    fn plans() -> impl Strategy<Value = (Vec<Piece>, Vec<BodyTarget>)> {
        let pieces = prop::collection::vec((0u32..3, 0u32..40, 0u32..20), 1..6);
        let targets =
            prop::collection::vec((0u32..100, -3.0f32..3.0, -3f32..3.0, -3f32..3.0), 0..4);
        (pieces, targets).prop_map(|(pieces, targets)| {
            let pieces: Vec<Piece> = pieces
                .into_iter()
                .map(|(clip, from, more)| piece(clip, from, from + more))
                .collect();
            let n_frames: usize = pieces.iter().map(|piece| piece.n_frames()).sum();
            let mut targets: Vec<BodyTarget> = targets
                .into_iter()
                .map(|(frame, heading_rad, x, z)| BodyTarget {
                    frame: FrameIdx(frame % n_frames as u32),
                    world_from_torso: PlanarTransform::new(heading_rad, Vec2::new(x, z), 0.0),
                    height: false,
                })
                .collect();
            targets.sort_by_key(|target| target.frame);
            targets.dedup_by_key(|target| target.frame);
            (pieces, targets)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]

        #[test]
        fn every_plan_has_a_motion_that_meets_its_targets(
            (pieces, targets) in plans(), best in any::<bool>(), hard in 0u32..50,
        ) {
            let set = walks();
            let policies = if best { Policies::BEST } else { Policies::PAPER };
            let start = PlanarTransform::new(0.4, Vec2::new(1.0, 2.0), 0.0);
            let plan = Plan {
                pieces: &pieces, start, targets: &targets, hard_frames: &[FrameIdx(hard)],
            };
            let made = assemble(&set, &plan, policies).expect("a valid plan");
            let n_frames: usize = pieces.iter().map(|piece| piece.n_frames()).sum();
            prop_assert_eq!(made.motion.n_frames(), n_frames);
            prop_assert_eq!((made.contacts.len(), made.levels_m.len()), (n_frames, n_frames));
            prop_assert_eq!(made.starts.len(), pieces.len());
            for error in &made.errors {
                prop_assert!(error.position_m < 1e-4, "{:?}", error);
                prop_assert!(error.heading_rad.to_degrees() < 0.01, "{:?}", error);
            }
            for frame in 0..n_frames {
                prop_assert!(made.motion.rotations(frame).iter().all(|q| q.is_normalized()));
                prop_assert!(made.motion.root_positions_m()[frame].is_finite());
            }
        }
    }

    #[test]
    fn the_same_plan_makes_the_same_bits() {
        let set = walks();
        let pieces = [piece(0, 0, 30), piece(1, 10, 50), piece(2, 0, 40)];
        let plan = Plan {
            pieces: &pieces,
            start: PlanarTransform::IDENTITY,
            targets: &[],
            hard_frames: &[],
        };
        let make = || assemble(&set, &plan, Policies::BEST).expect("a valid plan");
        assert_eq!(make(), make());
    }

    #[test]
    fn plans_that_cannot_be_are_refused() {
        let set = walks();
        let start = PlanarTransform::IDENTITY;
        let plan = Plan { pieces: &[], start, targets: &[], hard_frames: &[] };
        assert_eq!(assemble(&set, &plan, Policies::BEST), Err(AssembleError::Empty));
        let late = BodyTarget { frame: FrameIdx(6), world_from_torso: start, height: false };
        let plan = Plan { pieces: &[piece(0, 0, 5)], start, targets: &[late], hard_frames: &[] };
        assert_eq!(
            assemble(&set, &plan, Policies::PAPER),
            Err(AssembleError::Target { target: 0, frame: FrameIdx(6) })
        );
    }
}
