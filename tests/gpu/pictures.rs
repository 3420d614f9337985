//! Devices for tests, and what they draw beside what was kept.

use image::RgbaImage;
use motion_render::gpu::{AdapterChoice, Gpu, NoAdapter};
use motion_render::offscreen::Offscreen;
use motion_render::picture::Picture;
use motion_tests::kept_picture;

/// A device for pictures, or `None` after a word.
pub(crate) fn offscreen() -> Option<Offscreen> {
    or_skip(Offscreen::new(AdapterChoice::Software))
}

/// A device alone, or `None` after a word.
pub(crate) fn gpu() -> Option<Gpu> {
    or_skip(Gpu::open(AdapterChoice::Software))
}

/// `None` and a word, so that a test can pass without testing; a panic where
/// `GAITWAY_REQUIRE_GPU=1` says that there must be a device, as in CI.
fn or_skip<T>(opened: Result<T, NoAdapter>) -> Option<T> {
    match opened {
        Ok(opened) => Some(opened),
        Err(error) => {
            let is_required = std::env::var_os("GAITWAY_REQUIRE_GPU").is_some_and(|v| v == "1");
            assert!(!is_required, "GAITWAY_REQUIRE_GPU is 1, but: {error}");
            eprintln!("skipped: {error}");
            None
        }
    }
}

/// Fails unless `picture` is the kept one of that name.
#[track_caller]
pub(crate) fn assert_is_kept(name: &str, picture: &Picture) {
    let ours = RgbaImage::from_raw(picture.width_px, picture.height_px, picture.rgba.clone())
        .expect("a picture has as many bytes as its size says");
    kept_picture::assert_is_kept(name, &ours);
}
