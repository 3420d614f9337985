//! What an animator asks for, one kind a file (AF02 section 4; `docs/method.md`, A4).
//!
//! Errors are counted in **tolerances**: 10 frames, 0.30 m and 10° are one each, and a soft
//! constraint adds the square of its error times its weight to the score.
//!
//! Poses and locks are hard: a motion that does not show them is none. The others are soft.

pub mod body;
pub mod clearance;
pub mod environment;
pub mod follow;
pub mod joint;
pub mod length;
pub mod lock;
pub mod obstacle;
pub mod pose;
pub mod style;
pub mod tolerance;

pub use body::{BodyConstraint, BodyError};
pub use clearance::OtherBody;
pub use environment::SupportCost;
pub use follow::{FollowConstraint, FollowError};
pub use joint::{JointConstraint, JointError};
pub use length::{LengthMode, LengthWish};
pub use lock::LockConstraint;
pub use obstacle::Obstacle;
pub use pose::PoseConstraint;
pub use style::StyleConstraint;
pub use tolerance::Tolerance;

/// One tolerance of time.
pub const TOLERANCE_FRAMES: f32 = 10.0;
/// One tolerance of place, metres.
pub const TOLERANCE_M: f32 = 0.30;
/// One tolerance of heading: 10°.
pub const TOLERANCE_RAD: f32 = 10.0 * std::f32::consts::PI / 180.0;
