//! Which frame of a motion is shown when.

/// Most knots of a curve.
pub const MAX_KNOTS: usize = 256;
/// Knots are at output frames below this: twenty minutes at 30 frames per second.
pub const MAX_OUTPUT_FRAMES: u32 = 36_000;
/// The most source frames that an output frame may skip on, from knot to knot.
pub const MAX_SPEED: f64 = 8.0;
/// Source frames are at most this.
const MAX_SOURCE: f64 = 1e6;

/// At `output`, frame `source` is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// The frame of the motion that is made.
    pub output: u32,
    /// The frame of the motion that it is made of; between two frames where it is no whole number.
    pub source: f64,
}

/// A curve from output frames to source frames that never goes back in time.
///
/// Through the knots runs the monotone cubic of Fritsch & Carlson 1980, *Monotone Piecewise Cubic
/// Interpolation*: it has no corner (C¹), never overshoots, stands still only between knots of the
/// same source frame, and is never steeper than three times the way from knot to knot.
///
/// Before the first knot it begins with frame 0 at frame 0; behind the last it goes on a frame a
/// frame until the source's last frame, which is always met. Knots behind the source's end show its
/// last frame. So a knot changes the motion's length, unless the last one is at the end.
///
/// Invariants, checked by [`Retime::new`]:
/// 1. At most [`MAX_KNOTS`] knots, none behind [`MAX_OUTPUT_FRAMES`].
/// 2. Output frames grow from knot to knot.
/// 3. Source frames are finite, not negative and do not shrink.
/// 4. From knot to knot, and from frame 0 to the first, time goes [`MAX_SPEED`] times as fast at
///    most. A knot at output frame 0 begins anywhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Retime {
    knots: Vec<Knot>,
}

/// Why knots are no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RetimeError {
    /// Rule 1.
    #[error("a curve has at most {MAX_KNOTS} knots")]
    TooMany,
    /// Rule 1.
    #[error("a knot must be at a frame below {MAX_OUTPUT_FRAMES}")]
    TooLate,
    /// Rule 2.
    #[error("two knots are at the same frame or out of order")]
    Order,
    /// Rule 3.
    #[error("a source frame is negative or no number, or time goes back")]
    Backwards,
    /// Rule 4.
    #[error("time goes more than {MAX_SPEED} times as fast between two knots")]
    TooFast,
}

impl Retime {
    /// A curve through `knots`; none is the identity.
    pub fn new(knots: Vec<Knot>) -> Result<Self, RetimeError> {
        if knots.len() > MAX_KNOTS {
            return Err(RetimeError::TooMany);
        }
        let mut last = Knot { output: 0, source: 0.0 };
        for (nth, knot) in knots.iter().enumerate() {
            if knot.output >= MAX_OUTPUT_FRAMES {
                return Err(RetimeError::TooLate);
            }
            if nth > 0 && knot.output <= last.output {
                return Err(RetimeError::Order);
            }
            if !(last.source..=MAX_SOURCE).contains(&knot.source) {
                return Err(RetimeError::Backwards);
            }
            let frames = f64::from(knot.output - last.output);
            if frames > 0.0 && knot.source - last.source > MAX_SPEED * frames {
                return Err(RetimeError::TooFast);
            }
            last = *knot;
        }
        Ok(Self { knots })
    }

    /// The knots, in order.
    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// Whether it is the curve without knots.
    pub fn is_identity(&self) -> bool {
        self.knots.is_empty()
    }

    /// For every output frame the source frame that is shown, of a source with `n_source` frames
    /// (at least 1): never falling, within 0 and `n_source − 1`, the last one the source's last.
    pub fn source_frames(&self, n_source: usize) -> Vec<f64> {
        if self.is_identity() {
            return (0..n_source.max(1)).map(|frame| frame as f64).collect();
        }
        let last = n_source.saturating_sub(1) as f64;
        let points = self.points(last);
        let slopes = slopes(&points);
        let mut frames = Vec::new();
        let mut shown = points[0].1;
        let mut segment = 0;
        for output in 0..=points[points.len() - 1].0 as u64 {
            let at = output as f64;
            while segment + 2 < points.len() && at > points[segment + 1].0 {
                segment += 1;
            }
            let source = match points.get(segment + 1) {
                Some(_) => hermite(&points[segment..segment + 2], &slopes[segment..], at),
                None => points[segment].1,
            };
            // Rounding must neither go back nor miss a frame that is meant.
            let whole = source.round();
            let source = if (source - whole).abs() < 1e-9 * (1.0 + whole) { whole } else { source };
            shown = source.clamp(shown, last.max(shown));
            frames.push(shown);
        }
        frames
    }

    /// The knots with both ends, for a source whose last frame is `last`: `(output, source)`.
    fn points(&self, last: f64) -> Vec<(f64, f64)> {
        let mut points = Vec::with_capacity(self.knots.len() + 2);
        if self.knots.first().is_some_and(|knot| knot.output > 0) {
            points.push((0.0, 0.0));
        }
        points.extend(self.knots.iter().map(|k| (f64::from(k.output), k.source.min(last))));
        if let Some(&(output, source)) = points.last()
            && source < last
        {
            points.push((output + (last - source).ceil(), last));
        }
        points
    }
}

/// The slope of the curve at each point (Fritsch & Carlson 1980, section 4).
fn slopes(points: &[(f64, f64)]) -> Vec<f64> {
    let secants: Vec<f64> =
        points.windows(2).map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0)).collect();
    let Some((&first, &last)) = secants.first().zip(secants.last()) else {
        return vec![0.0; points.len()];
    };
    let mut slopes = vec![first];
    slopes.extend(secants.windows(2).map(|d| 0.5 * (d[0] + d[1])));
    slopes.push(last);
    for (nth, &secant) in secants.iter().enumerate() {
        if secant <= 0.0 {
            (slopes[nth], slopes[nth + 1]) = (0.0, 0.0);
            continue;
        }
        let (alpha, beta) = (slopes[nth] / secant, slopes[nth + 1] / secant);
        let length = alpha.hypot(beta);
        if length > 3.0 {
            slopes[nth] = 3.0 * alpha / length * secant;
            slopes[nth + 1] = 3.0 * beta / length * secant;
        }
    }
    slopes
}

/// The cubic between two points with these slopes, at `at`.
fn hermite(points: &[(f64, f64)], slopes: &[f64], at: f64) -> f64 {
    let ((x0, y0), (x1, y1)) = (points[0], points[1]);
    let span = x1 - x0;
    let t = ((at - x0) / span).clamp(0.0, 1.0);
    let (t2, t3) = (t * t, t * t * t);
    let rise = 3.0 * t2 - 2.0 * t3;
    y0 + (y1 - y0) * rise + span * (slopes[0] * (t3 - 2.0 * t2 + t) + slopes[1] * (t3 - t2))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn retime(knots: &[(u32, f64)]) -> Result<Retime, RetimeError> {
        Retime::new(knots.iter().map(|&(output, source)| Knot { output, source }).collect())
    }

    /// Length and some source frames of ten frames under these knots.
    #[track_caller]
    fn check(knots: &[(u32, f64)], n_output: usize, expected: &[(usize, f64)]) {
        let frames = retime(knots).expect("a curve").source_frames(10);
        assert_eq!(frames.len(), n_output, "{frames:?}");
        for &(output, source) in expected {
            assert!((frames[output] - source).abs() < 1e-9, "{output}: {frames:?}");
        }
    }

    #[test]
    fn ends_are_met_and_lengths_follow() {
        check(&[], 10, &[(0, 0.0), (5, 5.0), (9, 9.0)]);
        check(&[(5, 5.0)], 10, &[(0, 0.0), (3, 3.0), (9, 9.0)]);
        check(&[(18, 9.0)], 19, &[(0, 0.0), (9, 4.5), (18, 9.0)]);
        check(&[(3, 6.0)], 7, &[(0, 0.0), (3, 6.0), (6, 9.0)]);
        check(&[(4, 4.0), (7, 4.0)], 13, &[(4, 4.0), (5, 4.0), (7, 4.0), (12, 9.0)]);
        check(&[(0, 4.0)], 6, &[(0, 4.0), (1, 5.0), (5, 9.0)]);
        check(&[(9, 9.0), (14, 9.0)], 15, &[(9, 9.0), (14, 9.0)]);
        check(&[(20, 30.0)], 21, &[(0, 0.0), (20, 9.0)]);
        check(&[(2, 1.5)], 11, &[(2, 1.5), (10, 9.0)]);
    }

    #[test]
    fn what_is_no_curve_is_refused() {
        assert_eq!(retime(&[(5, 5.0), (5, 6.0)]), Err(RetimeError::Order));
        assert_eq!(retime(&[(5, 5.0), (8, 4.0)]), Err(RetimeError::Backwards));
        assert_eq!(retime(&[(5, f64::NAN)]), Err(RetimeError::Backwards));
        assert_eq!(retime(&[(5, -1.0)]), Err(RetimeError::Backwards));
        assert_eq!(retime(&[(1, 9.0)]), Err(RetimeError::TooFast));
        assert_eq!(retime(&[(u32::MAX, 9.0)]), Err(RetimeError::TooLate));
        let many: Vec<(u32, f64)> = (0..300).map(|n| (n, f64::from(n))).collect();
        assert_eq!(retime(&many), Err(RetimeError::TooMany));
    }

    proptest! {
        #[test]
        fn time_never_goes_back_and_never_rushes(
            steps in prop::collection::vec((1u32..40, 0.0f64..3.0), 0..8), n_source in 1usize..300,
        ) {
            let (mut output, mut source, mut knots) = (0, 0.0, Vec::new());
            let mut fastest = 1.0f64;
            for (frames, speed) in steps {
                output += frames;
                source += speed * f64::from(frames);
                fastest = fastest.max(speed);
                knots.push((output, source));
            }
            let retime = retime(&knots).expect("a curve");
            let frames = retime.source_frames(n_source);
            let last = (n_source - 1) as f64;
            prop_assert_eq!((frames[0], frames[frames.len() - 1]), (0.0, last));
            for pair in frames.windows(2) {
                let step = pair[1] - pair[0];
                prop_assert!((0.0..=3.0 * fastest + 1e-6).contains(&step), "{:?}", pair);
            }
            for (output, source) in knots {
                prop_assert!((frames[output as usize] - source.min(last)).abs() < 1e-6);
            }
        }
    }
}
