//! How long the pictures of a GIF are shown: whole hundredths of a second.

/// Pictures are shown at most so often: viewers slow down what is faster.
pub(crate) const MAX_FPS: f64 = 50.0;

/// For how many hundredths of a second the picture `nth` of a film with `fps` is shown, so that
/// every picture appears at the last hundredth before its time and no error adds up: 3, 3, 4 at 30
/// pictures a second.
pub(crate) fn delay_cs(nth: usize, fps: f64) -> u16 {
    // Slack against 33.3333 being a hair below its third.
    let at = |n: usize| (n as f64 * 100.0 / fps + 1e-6).floor();
    (at(nth + 1) - at(nth)).clamp(2.0, f64::from(u16::MAX)) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirds_of_a_hundredth_do_not_add_up() {
        let delays: Vec<u16> = (0..6).map(|n| delay_cs(n, 30.0)).collect();
        assert_eq!(delays, [3, 3, 4, 3, 3, 4]);
        for (fps, n, expected_cs) in [(30.0, 3000, 10_000), (25.0, 100, 400), (24.0, 240, 1000)] {
            let sum: u32 = (0..n).map(|n| u32::from(delay_cs(n, fps))).sum();
            assert_eq!(sum, expected_cs, "{n} pictures at {fps}");
        }
    }

    #[test]
    fn no_picture_is_too_short_or_too_long() {
        assert_eq!(delay_cs(0, 1000.0), 2);
        assert_eq!(delay_cs(7, 1e-6), u16::MAX);
    }
}
