//! Pose constraints: hard, at a place or anywhere.

use glam::Vec2;
use motion_core::constraint::PoseConstraint;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{Constraint, ConstraintKind};

use super::asking::Asking;
use super::tolerance::tolerance;

/// The wish of a pose constraint. Fails where the clips in use do not have the frame.
pub(super) fn wish(
    constraint: &Constraint,
    asking: &Asking<'_>,
) -> Result<Option<PoseConstraint>, FileError> {
    let ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m } =
        &constraint.kind
    else {
        return Ok(None);
    };
    let clip = asking.clip(constraint, clip, (*clip_frame, *clip_frame))?;
    Ok(Some(PoseConstraint {
        frame: *frame,
        clip,
        clip_frame: FrameIdx(*clip_frame),
        ground_m: position_m.map(|[x, z]| Vec2::new(x as f32, z as f32)),
        heading_rad: heading_deg.map(|deg| deg.to_radians() as f32),
        height_m: height_m.map(|height| height as f32),
        weight: constraint.weight.unwrap_or(1.0) as f32,
        tolerance: tolerance(constraint.tolerance.as_ref()),
    }))
}
