//! A stretch of a take that is kept while the rest is searched. Hard.

use crate::path::Piece;

/// A stretch to keep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LockConstraint {
    /// First frame.
    pub from: u32,
    /// Last frame.
    pub to: u32,
    /// What is shown there, in order.
    pub pieces: Vec<Piece>,
}
