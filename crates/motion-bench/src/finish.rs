//! From a solution to its motion, as a solve does it.

use anyhow::Context as _;
use motion_core::assemble::{Assembled, Assembler, BodyTarget, Plan, Policies};
use motion_core::path::Piece;
use motion_core::planar::PlanarTransform;
use motion_core::search::{Search, Solution};
use motion_core::units::FrameIdx;

/// What assembly is given for a solution.
#[derive(Clone, Debug)]
pub struct Order {
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// Where the first frame's torso stands.
    pub start: PlanarTransform,
    /// The problem's checkpoints, the last one at the motion's last frame.
    pub targets: Vec<BodyTarget>,
}

impl Order {
    /// The order for a solution of `search`.
    pub fn new(search: &Search, solution: &Solution) -> anyhow::Result<Self> {
        let judged = search.judge(&solution.path).context("a solution is too short")?;
        let body = &search.problem().wishes.body;
        let mut targets: Vec<BodyTarget> = Vec::with_capacity(body.len());
        for (nth, constraint) in body.iter().enumerate() {
            let is_last = nth > 0 && nth + 1 == body.len();
            let frame = FrameIdx(if is_last { judged.n_frames - 1 } else { constraint.frame });
            targets.retain(|target| target.frame < frame);
            let world_from_torso = constraint.world_from_torso();
            let height = constraint.height_m.is_some();
            targets.push(BodyTarget { frame, world_from_torso, height });
        }
        let pieces = solution.path.pieces(search.library().graph());
        Ok(Self { pieces, start: judged.world_from_start, targets })
    }

    /// The finished motion.
    pub fn assemble(&self, assembler: &Assembler<'_>) -> anyhow::Result<Assembled> {
        let Self { pieces, start, targets } = self;
        let plan = Plan { pieces, start: *start, targets, hard_frames: &[] };
        Ok(assembler.assemble(&plan, Policies::BEST)?)
    }
}
