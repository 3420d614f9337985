//! What the renderer draws, on a software device where there is one. Without any adapter tests
//! pass after a word, unless `GAITWAY_REQUIRE_GPU=1`.
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests fail as tests do, at the line that was wrong"
)]

mod bodies;
mod device_loss;
mod picking;
mod pictures;
mod primitives;
mod scenes;
mod skinning;
mod steady_state;
