//! Which moments of a motion the pictures of a film show.

use std::ops::RangeInclusive;

/// The rates that a film may have at most without a word about it.
const USUAL_FPS: f64 = 60.0;
const USUAL_GIF_FPS: f64 = 34.0;

/// The rate of a film of a motion with `motion_fps`: the motion's own, or where that is too fast for
/// the kind of film, the motion's own divided by the smallest whole number that slows it enough, so
/// that every picture shows a frame as it is.
pub(crate) fn usual_fps(motion_fps: f64, is_gif: bool) -> f64 {
    let most = if is_gif { USUAL_GIF_FPS } else { USUAL_FPS + 1.0 };
    motion_fps / (motion_fps / most).ceil().max(1.0)
}

/// The frames that the pictures show, some between two: `range` of a motion with `motion_fps`, shown
/// as fast as it is by a film with `film_fps`. Both ends of the range are shown where the rates fit.
pub(crate) fn film_frames(
    range: RangeInclusive<usize>,
    motion_fps: f64,
    film_fps: f64,
) -> impl ExactSizeIterator<Item = f64> {
    let (first, last) = (*range.start(), *range.end());
    let step = motion_fps / film_fps;
    // The slack keeps the last picture when the step is a hair too long.
    let n = ((last - first) as f64 / step + 1e-6).floor() as usize + 1;
    (0..n).map(move |nth| (first as f64 + nth as f64 * step).min(last as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_are_as_fast_as_their_motions_unless_that_is_too_fast() {
        for (motion_fps, gif_fps, video_fps) in [
            (30.0, 30.0, 30.0),
            (24.0, 24.0, 24.0),
            (60.0, 30.0, 60.0),
            (120.0, 30.0, 60.0),
            (100.0, 100.0 / 3.0, 50.0),
            (1.0, 1.0, 1.0),
        ] {
            assert_eq!(usual_fps(motion_fps, true), gif_fps, "{motion_fps}");
            assert_eq!(usual_fps(motion_fps, false), video_fps, "{motion_fps}");
        }
    }

    #[test]
    fn time_passes_as_in_the_motion() {
        let frames = |range, motion, film| film_frames(range, motion, film).collect::<Vec<_>>();
        assert_eq!(frames(0..=3, 30.0, 30.0), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(frames(10..=16, 120.0, 60.0), [10.0, 12.0, 14.0, 16.0]);
        assert_eq!(frames(0..=2, 30.0, 60.0), [0.0, 0.5, 1.0, 1.5, 2.0]);
        assert_eq!(frames(5..=5, 30.0, 1.0), [5.0]);
        assert_eq!(film_frames(0..=239, 30.0, 25.0).len(), 200);
    }
}
