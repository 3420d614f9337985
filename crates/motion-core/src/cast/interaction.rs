//! Poses that several characters take at one frame, placed to each other (AF02 figure 9).

use crate::constraint::{PoseConstraint, Tolerance};
use crate::ids::ClipId;
use crate::planar::PlanarTransform;
use crate::units::FrameIdx;

/// What one character does in an interaction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Who: an index into [`super::CastProblem::characters`].
    pub character: usize,
    /// Which clip of that character's library.
    pub clip: ClipId,
    /// Which frame of it.
    pub clip_frame: FrameIdx,
    /// Where the torso's frame stands in the interaction's own frame.
    pub interaction_from_torso: PlanarTransform,
}

/// A handshake, a tackle: hard poses at one frame, at places relative to each other. Where in the
/// world all of it happens, `world_from_interaction`, is for the search to say.
#[derive(Clone, Debug, PartialEq)]
pub struct Interaction {
    /// When, for everybody.
    pub frame: u32,
    /// Who takes which pose where. Nobody is in it twice.
    pub members: Vec<Member>,
    /// Factor of the squared errors of the places, as long as motions are searched.
    pub weight: f32,
    /// How far off a place is well before correction; after it places are exact.
    pub tolerance: Tolerance,
}

impl Interaction {
    /// What `character` does in it.
    pub fn member(&self, character: usize) -> Option<&Member> {
        self.members.iter().find(|member| member.character == character)
    }

    /// The pose of `member`, at its place if the interaction's is said.
    pub fn pose(
        &self,
        member: &Member,
        world_from_interaction: Option<PlanarTransform>,
    ) -> PoseConstraint {
        let pose = PoseConstraint::new(self.frame, member.clip, member.clip_frame);
        let place = world_from_interaction.map(|place| place * member.interaction_from_torso);
        PoseConstraint {
            ground_m: place.map(PlanarTransform::ground_m),
            heading_rad: place.map(PlanarTransform::heading_rad),
            weight: self.weight,
            tolerance: self.tolerance,
            ..pose
        }
    }
}
