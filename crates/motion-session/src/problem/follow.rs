//! Path constraints: curves on the ground to be followed.

use glam::Vec2;
use motion_core::constraint::FollowConstraint;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{Constraint, ConstraintKind, PathHeading};

use super::asking::Asking;
use super::tolerance::{heading_rad, position_m};

/// The wish of a path constraint. Fails where it is given no time.
pub(super) fn wish(
    constraint: &Constraint,
    asking: &Asking<'_>,
) -> Result<Option<FollowConstraint>, FileError> {
    let ConstraintKind::Path { from, to, points_m, heading } = &constraint.kind else {
        return Ok(None);
    };
    if from >= to {
        return Err(asking.refuse(
            constraint,
            &format!("begins and ends at frame {from}"),
            "give it a stretch of time: a \"to\" after \"from\"",
        ));
    }
    let asked = constraint.tolerance.as_ref();
    Ok(Some(FollowConstraint {
        from: *from,
        to: *to,
        points_m: points_m.iter().map(|[x, z]| Vec2::new(*x as f32, *z as f32)).collect(),
        looks_along: *heading == PathHeading::Along,
        weight: constraint.weight.unwrap_or(1.0) as f32,
        tolerance_m: position_m(asked),
        tolerance_rad: heading_rad(asked),
    }))
}
