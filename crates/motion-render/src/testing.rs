//! Devices for tests.

use crate::gpu::{AdapterChoice, Gpu};

/// A software device, which draws the same everywhere; any other where there is none.
///
/// Without an adapter: `None` and a word on stderr, so that a test can pass without testing; a
/// panic where `GAITWAY_REQUIRE_GPU=1` says that there must be one, as in CI.
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
pub fn gpu_or_skip() -> Option<Gpu> {
    match Gpu::open(AdapterChoice::Software) {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            let is_required = std::env::var_os("GAITWAY_REQUIRE_GPU").is_some_and(|v| v == "1");
            assert!(!is_required, "GAITWAY_REQUIRE_GPU is 1, but: {error}");
            eprintln!("skipped: {error}");
            None
        }
    }
}
