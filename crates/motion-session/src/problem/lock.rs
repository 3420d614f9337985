//! Lock constraints: stretches of takes that stay.

use motion_core::constraint::LockConstraint;
use motion_core::path::Piece;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{Constraint, ConstraintKind};

use super::asking::Asking;

/// The wish of a lock constraint. Fails where its pieces are not in the library or do not show as
/// many frames as it speaks of.
pub(super) fn wish(
    constraint: &Constraint,
    asking: &Asking<'_>,
) -> Result<Option<LockConstraint>, FileError> {
    let ConstraintKind::Lock { from, to, pieces } = &constraint.kind else { return Ok(None) };
    let mut wished = Vec::with_capacity(pieces.len());
    let mut n_shown = 0u64;
    for piece in pieces {
        let clip = asking.clip(constraint, &piece.clip, (piece.from, piece.to))?;
        wished.push(Piece { clip, from: FrameIdx(piece.from), to: FrameIdx(piece.to) });
        n_shown += u64::from(piece.to - piece.from) + 1;
    }
    let n_asked = u64::from(to.saturating_sub(*from)) + 1;
    if n_shown != n_asked {
        return Err(asking.refuse(
            constraint,
            &format!("speaks of {n_asked} frames and its pieces show {n_shown}"),
            &format!("correct its \"to\", its \"from\" or its pieces, so that both are {n_asked}"),
        ));
    }
    Ok(Some(LockConstraint { from: *from, to: *to, pieces: wished }))
}
