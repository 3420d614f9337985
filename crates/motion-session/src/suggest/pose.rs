//! A pose earlier or later.

use motion_core::constraint::TOLERANCE_FRAMES;

use super::candidate::{Candidate, later};
use super::{Case, Change};
use crate::command::Command;
use crate::unmet::missed::Missed;

/// How many frames later poses are tried; below 0 earlier.
const FRAMES: [i64; 4] = [-20, -10, 10, 20];

/// Every pose a little earlier and later, where what is missed may be because of it.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let may_help = case.missed.iter().any(|missed| !matches!(missed, Missed::Style(_)));
    if !may_help {
        return Vec::new();
    }
    let named = case.asked.ids.poses.iter().zip(&case.wishes().poses);
    let all = named.flat_map(|(id, wish)| FRAMES.map(|frames| (id, wish.frame, frames)));
    let candidate = |(id, frame, frames): (&String, u32, i64)| {
        let to = u32::try_from(i64::from(frame) + frames).ok()?;
        Some(Candidate {
            change: Change::Pose,
            about: id.clone(),
            words: format!("take the pose {id:?} {}", later(frames)),
            size: frames.unsigned_abs() as f32 / TOLERANCE_FRAMES,
            commands: vec![Command::Retime { at: case.at(id), frame: to }],
        })
    };
    all.filter_map(candidate).collect()
}
