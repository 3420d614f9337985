//! What a project calls the wishes that the search knows by their numbers.

use motion_core::search::HardWish;

/// Ids of constraints, kind by kind, in the order of the search's wishes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ConstraintIds {
    /// Of body constraints, in the order of their frames.
    pub body: Vec<String>,
    /// Of joint constraints.
    pub joints: Vec<String>,
    /// Of pose constraints.
    pub poses: Vec<String>,
    /// Of lock constraints.
    pub locks: Vec<String>,
    /// Of style constraints.
    pub styles: Vec<String>,
    /// Of path constraints.
    pub follows: Vec<String>,
}

impl ConstraintIds {
    /// What must be shown, in words: `pose "kick"`.
    pub fn hard(&self, wish: HardWish) -> String {
        let (kind, ids, nth) = match wish {
            HardWish::Pose(nth) => ("pose", &self.poses, nth),
            HardWish::Lock(nth) => ("locked stretch", &self.locks, nth),
        };
        ids.get(nth).map_or(kind.to_owned(), |id| format!("{kind} {id:?}"))
    }
}
