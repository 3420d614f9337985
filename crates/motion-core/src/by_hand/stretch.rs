//! A stretch of time in which something has an effect, coming and going softly.

/// Frames in which an offset is fully there, and over how many it comes and goes.
///
/// Both ends count: from `from` to `to` the weight is 1. It leaves 0 at `from − ease_in` and is
/// back at 0 at `to + ease_out`; an ease of 0 frames is a jump. Eases may reach beyond the motion,
/// which then begins or ends in the middle of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stretch {
    /// The first frame with the full effect.
    pub from: u32,
    /// The last frame with the full effect. Before `from`, the effect is nowhere full.
    pub to: u32,
    /// Frames from nothing to the full effect.
    pub ease_in: u32,
    /// Frames from the full effect to nothing.
    pub ease_out: u32,
}

impl Stretch {
    /// How much of the effect there is at `frame`, 0 to 1.
    ///
    /// Eases follow 10t³ − 15t⁴ + 6t⁵: value, velocity and acceleration have no jump (C²), and the
    /// weight changes by no more than 1.875 / ease per frame.
    pub fn weight(&self, frame: usize) -> f32 {
        let frame = frame as f64;
        let before = f64::from(self.from) - frame;
        let after = frame - f64::from(self.to);
        ramp(before, self.ease_in).min(ramp(after, self.ease_out)) as f32
    }

    /// Whether there is any effect at `frame`.
    pub fn touches(&self, frame: usize) -> bool {
        self.weight(frame) > 0.0
    }
}

/// 1 up to the stretch's end, 0 from `ease` frames `outside` of it.
fn ramp(outside: f64, ease: u32) -> f64 {
    if outside <= 0.0 {
        return 1.0;
    }
    let ease = f64::from(ease);
    if outside >= ease {
        return 0.0;
    }
    let t = 1.0 - outside / ease;
    t * t * t * (10.0 + t * (6.0 * t - 15.0))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A row of the table at the type.
    #[track_caller]
    fn check((from, to, ease_in, ease_out): (u32, u32, u32, u32), frame: usize, expected: f32) {
        let weight = Stretch { from, to, ease_in, ease_out }.weight(frame);
        assert!((weight - expected).abs() < 1e-6, "{weight} at {frame}");
    }

    #[test]
    fn ends_count() {
        check((10, 20, 4, 8), 6, 0.0);
        check((10, 20, 4, 8), 8, 0.5);
        check((10, 20, 4, 8), 10, 1.0);
        check((10, 20, 4, 8), 20, 1.0);
        check((10, 20, 4, 8), 24, 0.5);
        check((10, 20, 4, 8), 28, 0.0);
        check((10, 10, 0, 0), 9, 0.0);
        check((10, 10, 0, 0), 10, 1.0);
        check((10, 10, 0, 0), 11, 0.0);
        check((0, 5, 30, 0), 0, 1.0);
        check((3, 5, 6, 0), 0, 0.5);
        check((20, 10, 0, 0), 15, 0.0);
    }

    proptest! {
        #[test]
        fn eases_are_smooth(from in 20u32..60, more in 0u32..30, ease_in in 2u32..20, ease_out in 2u32..20) {
            let stretch = Stretch { from, to: from + more, ease_in, ease_out };
            let weight: Vec<f32> = (0..140).map(|frame| stretch.weight(frame)).collect();
            let shortest = ease_in.min(ease_out) as f32;
            for w in weight.windows(3) {
                prop_assert!((0.0..=1.0).contains(&w[1]));
                prop_assert!((w[1] - w[0]).abs() <= 1.875 / shortest + 1e-6);
                // The largest second derivative of the ease is 10/√3.
                prop_assert!((w[2] - 2.0 * w[1] + w[0]).abs() <= 5.78 / (shortest * shortest) + 1e-5);
            }
        }
    }
}
