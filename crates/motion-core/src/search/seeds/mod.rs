//! Where lines begin: paths grown by a randomized beam that knows time and place, and known good
//! paths with a stretch replaced.

mod anchors;
mod beam;
mod countdown;
mod perturb;
mod schedule;
mod wayfinder;

pub(crate) use anchors::Anchors;
pub(crate) use beam::{Growth, grow};
pub(crate) use perturb::perturb;
pub(crate) use wayfinder::Wayfinder;
