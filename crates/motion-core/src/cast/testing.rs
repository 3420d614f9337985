//! Casts for tests, on the library of wanderers.

use std::sync::Arc;

use glam::Vec2;

use super::{Interaction, Member};
use crate::constraint::{BodyConstraint, LengthMode, LengthWish, Tolerance};
use crate::ids::ClipId;
use crate::planar::PlanarTransform;
use crate::score::Wishes;
use crate::search::{Problem, SearchLibrary};
use crate::testing::wander;
use crate::units::FrameIdx;

/// Clips of [`library`].
const N_CLIPS: usize = 8;

/// Walks that curve either way.
pub(crate) fn library() -> Arc<SearchLibrary> {
    let clips = wander::clips(N_CLIPS, 120, false, 5);
    let graph = wander::graph(&clips);
    Arc::new(SearchLibrary::new(Arc::new(clips), Arc::new(graph)))
}

/// A place to be at a frame.
pub(crate) fn checkpoint(frame: u32, x_m: f32, z_m: f32, heading_deg: f32) -> BodyConstraint {
    BodyConstraint {
        frame,
        position_m: Vec2::new(x_m, z_m),
        heading_rad: heading_deg.to_radians(),
        height_m: None,
        weight: 1.0,
        tolerance: Tolerance::default(),
    }
}

/// Someone who shall be at these places; as long as the last says.
pub(crate) fn problem(body: Vec<BodyConstraint>) -> Problem {
    let frames = body.last().map_or(1, |last| last.frame + 1).max(105);
    let length = Some(LengthWish { frames, mode: LengthMode::Preferred, weight: 1.0 });
    let wishes = Wishes { length, body, ..Wishes::default() };
    Problem { wishes, allowed_clips: vec![true; N_CLIPS], bridges: true }
}

/// The first two characters face each other, `apart_m` from each other.
pub(crate) fn meeting(frame: u32, apart_m: f32) -> Interaction {
    let member = |character: usize, heading_rad, z_m| Member {
        character,
        clip: ClipId(character as u32),
        clip_frame: FrameIdx(80),
        interaction_from_torso: PlanarTransform::new(heading_rad, Vec2::new(0.0, z_m), 0.0),
    };
    Interaction {
        frame,
        members: vec![member(0, 0.0, 0.0), member(1, std::f32::consts::PI, apart_m)],
        weight: 4.0,
        tolerance: Tolerance::default(),
    }
}
