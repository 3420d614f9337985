//! Joint constraints.

use glam::DVec3;
use motion_core::constraint::JointConstraint;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{Constraint, ConstraintKind};

use super::asking::Asking;
use super::tolerance::position_m as tolerance_m;

/// The wish of a joint constraint. Fails where the body has no such joint.
pub(super) fn wish(
    constraint: &Constraint,
    asking: &Asking<'_>,
) -> Result<Option<JointConstraint>, FileError> {
    let ConstraintKind::Joint { frame, joint, position_m, velocity_m_s } = &constraint.kind else {
        return Ok(None);
    };
    let Some(joint_idx) = asking.library.clips.skeleton().find(joint) else {
        return Err(asking.refuse(
            constraint,
            &format!("speaks of {joint:?}, which this body does not have"),
            "name a joint of the library's skeleton, or a role such as Head or LeftHand",
        ));
    };
    let vector = |metres: [f64; 3]| DVec3::from(metres).as_vec3();
    Ok(Some(JointConstraint {
        frame: *frame,
        joint: joint_idx,
        position_m: vector(*position_m),
        velocity_m_s: velocity_m_s.map(vector),
        weight: constraint.weight.unwrap_or(1.0) as f32,
        tolerance_m: tolerance_m(constraint.tolerance.as_ref()),
    }))
}
