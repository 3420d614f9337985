//! Whether what is hard can be shown at all: frames that are there, cuts that are there, and a way from
//! each pose or lock to the next in the time between.

use super::hard::HardStretch;
use super::library::SearchLibrary;
use super::seeds::{Anchors, Wayfinder};
use super::target::Target;
use super::{Problem, ProblemError};
use crate::graph::EdgeId;

/// The anchors of a problem's seeds, or why what is hard cannot be met.
pub(super) fn anchors_of(
    library: &SearchLibrary,
    target: &Target,
    problem: &Problem,
) -> Result<Anchors, ProblemError> {
    let scope = (problem.allowed_clips.as_slice(), problem.bridges);
    let mut inner_cuts = Vec::with_capacity(target.hard.len());
    for hard in &target.hard {
        let is_there = |piece: &crate::path::Piece| {
            piece.clip.idx() < library.graph().n_clips()
                && scope.0[piece.clip.idx()]
                && piece.to.0 < library.n_frames(piece.clip)
        };
        if !hard.pieces.iter().all(is_there) {
            return Err(ProblemError::HardNotThere(hard.wish));
        }
        inner_cuts.push(cuts_within(library, scope.1, hard)?);
    }
    let anchors = Anchors::new(library, target, scope, inner_cuts);
    for (nth, pair) in target.hard.windows(2).enumerate() {
        let last = pair[0].pieces[pair[0].pieces.len() - 1];
        let available = pair[1].first - pair[0].last;
        let after = |ways: &Wayfinder| ways.least_frames(last.clip, last.to.0);
        if after(&anchors.hard[nth + 1].ways) <= available {
            continue;
        }
        // The seeds' ways are by chosen cuts; what is refused is refused over all.
        let first = pair[1].pieces[0];
        let all = Wayfinder::by_every_cut(library, scope, (first.clip, first.from.0));
        let least = after(&all);
        if least > available {
            return Err(ProblemError::HardTooFar {
                from: pair[0].wish,
                to: pair[1].wish,
                needed: (least != u32::MAX).then_some(least),
                available,
            });
        }
    }
    Ok(anchors)
}

/// The edges between a stretch's pieces.
fn cuts_within(
    library: &SearchLibrary,
    bridges: bool,
    hard: &HardStretch,
) -> Result<Vec<EdgeId>, ProblemError> {
    let cut = |pair: &[crate::path::Piece]| {
        let view = library.pair(pair[0].clip, pair[1].clip)?;
        let (from, to) = (pair[0].to.0 + 1, pair[1].from.0);
        let fits = |cut: &&super::library::Cut| {
            cut.from == from && cut.to == to && (bridges || cut.id.0 < view.first_bridge)
        };
        view.leaves.iter().find(fits).map(|cut| cut.id)
    };
    hard.pieces.windows(2).map(|pair| cut(pair).ok_or(ProblemError::HardNoCut(hard.wish))).collect()
}
