//! A style less.

use super::candidate::Candidate;
use super::{Case, Change};
use crate::command::Command;

/// To do without a style is as much of a change as this, in tolerances: it is not what was wished any
/// more.
const SIZE: f32 = 4.0;

/// Without each of the styles: what is missed may be because of any of them.
pub(super) fn candidates(case: &Case<'_>) -> Vec<Candidate> {
    let named = case.asked.ids.styles.iter().zip(&case.wishes().styles);
    let candidate = |(id, wish): (&String, &motion_core::constraint::StyleConstraint)| Candidate {
        change: Change::Style,
        about: id.clone(),
        words: format!("do without the style {:?} ({id:?})", wish.tag),
        size: SIZE,
        commands: vec![Command::Remove { at: case.at(id) }],
    };
    named.map(candidate).collect()
}
