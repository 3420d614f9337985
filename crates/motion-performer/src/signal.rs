//! Curves over time or phase, and smoothing of sampled ones.

use std::ops::{Add, Mul, Sub};

/// `3t² − 2t³` between 0 and 1, constant beyond: value and slope are continuous.
#[inline]
pub(crate) fn smoothstep(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// How a curve goes from one key to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ease {
    /// In a straight line.
    Linear,
    /// With slope 0 at every key.
    Smooth,
}

/// A curve through keys, constant before the first and after the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Keys {
    keys: Vec<(f32, f32)>,
    ease: Ease,
}

impl Keys {
    /// A curve through `(at, value)` pairs, put into order of `at`.
    pub fn new(ease: Ease, mut keys: Vec<(f32, f32)>) -> Self {
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { keys, ease }
    }

    /// The same value everywhere.
    pub fn constant(value: f32) -> Self {
        Self { keys: vec![(0.0, value)], ease: Ease::Linear }
    }

    /// The value at `at`; 0 for a curve without keys.
    pub fn at(&self, at: f32) -> f32 {
        let next = self.keys.partition_point(|key| key.0 <= at);
        match (next.checked_sub(1).map(|i| self.keys[i]), self.keys.get(next)) {
            (None, None) => 0.0,
            (Some((_, value)), None) | (None, Some(&(_, value))) => value,
            (Some((x0, y0)), Some(&(x1, y1))) => {
                let t = (at - x0) / (x1 - x0);
                let t = if self.ease == Ease::Smooth { smoothstep(t) } else { t };
                y0 + (y1 - y0) * t
            }
        }
    }

    /// The lowest key.
    pub(crate) fn lowest(&self) -> f32 {
        self.keys.iter().map(|key| key.1).fold(f32::INFINITY, f32::min)
    }

    /// The slope at `at`, by a central difference over 0.02.
    pub(crate) fn slope(&self, at: f32) -> f32 {
        (self.at(at + 0.01) - self.at(at - 0.01)) / 0.02
    }
}

/// Value, first and second derivative of something at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State<T> {
    pub(crate) value: T,
    pub(crate) rate: T,
    pub(crate) accel: T,
}

/// The polynomial of degree five that leads from one state to another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quintic<T> {
    coefficients: [T; 6],
    duration_s: f32,
}

impl<T> Quintic<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>,
{
    /// From `a` at time 0 to `b` at `duration_s`, which must be above 0.
    pub(crate) fn between(a: State<T>, b: State<T>, duration_s: f32) -> Self {
        let d = duration_s;
        let (c0, c1, c2) = (a.value, a.rate * d, a.accel * (0.5 * d * d));
        let p = b.value - c0 - c1 - c2;
        let v = b.rate * d - c1 - c2 * 2.0;
        let w = b.accel * (d * d) - c2 * 2.0;
        Self {
            coefficients: [
                c0,
                c1,
                c2,
                p * 10.0 - v * 4.0 + w * 0.5,
                v * 7.0 - p * 15.0 - w,
                p * 6.0 - v * 3.0 + w * 0.5,
            ],
            duration_s,
        }
    }

    pub(crate) fn at(&self, secs: f32) -> T {
        let t = secs / self.duration_s;
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        ((((c5 * t + c4) * t + c3) * t + c2) * t + c1) * t + c0
    }
}

/// Smooths samples with a Gaussian of `sigma` samples; beyond the ends the end values go on.
pub(crate) fn gaussian(samples: &[f32], sigma: f32) -> Vec<f32> {
    let (Some(&first), Some(&last)) = (samples.first(), samples.last()) else {
        return Vec::new();
    };
    let reach = (3.0 * sigma).ceil().max(1.0) as usize;
    let weight = |k: usize| (-0.5 * (k as f32 / sigma).powi(2)).exp();
    let weights: Vec<f32> = (0..=reach).map(weight).collect();
    let total = weights[0] + 2.0 * weights[1..].iter().sum::<f32>();

    let mut padded = vec![first; reach];
    padded.extend_from_slice(samples);
    padded.resize(samples.len() + 2 * reach, last);
    padded
        .windows(2 * reach + 1)
        .map(|window| {
            let (before, rest) = window.split_at(reach);
            let around = before.iter().rev().zip(&rest[1..]).zip(&weights[1..]);
            let sum: f32 = around.map(|((a, b), w)| (a + b) * w).sum();
            (rest[0] * weights[0] + sum) / total
        })
        .collect()
}

/// The largest sample within `reach` samples on either side.
pub(crate) fn dilated(samples: &[f32], reach: usize) -> Vec<f32> {
    (0..samples.len())
        .map(|i| {
            let window = &samples[i.saturating_sub(reach)..(i + reach + 1).min(samples.len())];
            window.iter().copied().fold(f32::NEG_INFINITY, f32::max)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_met_and_extended() {
        for ease in [Ease::Linear, Ease::Smooth] {
            let keys = Keys::new(ease, vec![(2.0, 5.0), (1.0, 3.0)]);
            for (at, value) in [(0.0, 3.0), (1.0, 3.0), (1.5, 4.0), (2.0, 5.0), (9.0, 5.0)] {
                assert_eq!(keys.at(at), value, "{ease:?} at {at}");
            }
        }
        assert_eq!(Keys::new(Ease::Linear, Vec::new()).at(1.0), 0.0);
    }

    #[test]
    fn a_quintic_meets_both_states() {
        let a = State { value: 1.0f32, rate: -2.0, accel: 3.0 };
        let b = State { value: -0.5, rate: 0.7, accel: -4.0 };
        let curve = Quintic::between(a, b, 0.8);
        let h = 0.01;
        for (at, state) in [(0.0, a), (0.8, b)] {
            let (before, here, after) = (curve.at(at - h), curve.at(at), curve.at(at + h));
            assert!((here - state.value).abs() < 1e-5);
            assert!(((after - before) / (2.0 * h) - state.rate).abs() < 2e-2);
            assert!(((after - 2.0 * here + before) / (h * h) - state.accel).abs() < 0.2);
        }
    }

    #[test]
    fn smoothing_keeps_lines_and_means() {
        let line: Vec<f32> = (0..50).map(|i| i as f32).collect();
        let smooth = gaussian(&line, 3.0);
        for i in 10..40 {
            assert!((smooth[i] - line[i]).abs() < 1e-3, "sample {i}: {}", smooth[i]);
        }
    }

    #[test]
    fn dilation_takes_the_largest_neighbour() {
        assert_eq!(dilated(&[0.0, 3.0, 1.0, 0.0, 2.0], 1), [3.0, 3.0, 3.0, 2.0, 2.0]);
    }
}
