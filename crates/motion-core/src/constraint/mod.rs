//! What an animator asks for, one kind a file (AF02 section 4; `docs/method.md`, A4).
//!
//! Errors are counted in **tolerances**: 10 frames, 0.30 m and 10° are one each, and a soft
//! constraint adds the square of its error times its weight to the score.
//!
//! The search meets lengths, body constraints and the ground; the other kinds have their data
//! here and are reported as not considered.

pub mod body;
pub mod environment;
pub mod follow;
pub mod joint;
pub mod length;
pub mod lock;
pub mod pose;
pub mod style;

pub use body::{BodyConstraint, BodyError};
pub use environment::SupportCost;
pub use follow::FollowConstraint;
pub use joint::JointConstraint;
pub use length::{LengthMode, LengthWish};
pub use lock::LockConstraint;
pub use pose::PoseConstraint;
pub use style::StyleConstraint;

/// One tolerance of time.
pub const TOLERANCE_FRAMES: f32 = 10.0;
/// One tolerance of place, metres.
pub const TOLERANCE_M: f32 = 0.30;
/// One tolerance of heading: 10°.
pub const TOLERANCE_RAD: f32 = 10.0 * std::f32::consts::PI / 180.0;
