//! The ground: a planted foot above the floor with nothing under it costs.
//!
//! A clip that climbs steps carries the body upwards; without this a motion could end in the
//! air. Obstacles will join here.

use crate::clip::Clip;

/// A planted foot this far off its ground for one second costs 1.
pub const SUPPORT_TOLERANCE_M: f32 = 0.10;

/// Running sums over a clip from which the cost of any stretch at any offset follows in O(1).
///
/// With `h` the support height in the clip and `δ` the level that placement adds, the cost of
/// frames `a..b` is `Σ (h + δ)² = Σ h² + 2δ Σ h + δ² n` over the planted frames.
#[derive(Clone, Debug, PartialEq)]
pub struct SupportCost {
    /// Entry `f` covers frames `0..f`; one more entry than frames.
    sums: Vec<Sums>,
}

/// Count, sum and sum of squares of the support heights of planted frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    n: f64,
    height: f64,
    squared: f64,
}

impl Sums {
    /// The cost of these frames when everything is raised by `level_m`.
    #[inline]
    pub fn cost_at(&self, level_m: f32, frame_secs: f32) -> f32 {
        let level = f64::from(level_m);
        let sum = self.squared + 2.0 * level * self.height + level * level * self.n;
        sum.max(0.0) as f32 * frame_secs / (SUPPORT_TOLERANCE_M * SUPPORT_TOLERANCE_M)
    }

    /// These frames with their heights counted from `level_m` lower.
    #[inline]
    #[must_use]
    pub fn raised(&self, level_m: f32) -> Self {
        let level = f64::from(level_m);
        Self {
            n: self.n,
            height: self.height + level * self.n,
            squared: self.squared + 2.0 * level * self.height + level * level * self.n,
        }
    }

    /// Both together.
    #[inline]
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            n: self.n + other.n,
            height: self.height + other.height,
            squared: self.squared + other.squared,
        }
    }
}

impl SupportCost {
    /// The sums of `clip`.
    pub fn new(clip: &Clip) -> Self {
        let mut sums = vec![Sums::default()];
        let track = &clip.track;
        for (torso, contacts) in track.world_from_torso.iter().zip(&track.contacts) {
            let mut sum = sums[sums.len() - 1];
            if contacts.any() {
                let height = f64::from(torso.level_m);
                sum.n += 1.0;
                sum.height += height;
                sum.squared += height * height;
            }
            sums.push(sum);
        }
        Self { sums }
    }

    /// The sums of frames `from..to`.
    #[inline]
    pub fn between(&self, from: u32, to: u32) -> Sums {
        let (a, b) = (self.sums[from as usize], self.sums[to as usize]);
        Sums { n: b.n - a.n, height: b.height - a.height, squared: b.squared - a.squared }
    }

    /// Whether the clip leaves the floor's level anywhere.
    pub fn leaves_the_floor(&self) -> bool {
        self.sums[self.sums.len() - 1].squared > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_give_the_cost_of_a_loop() {
        let heights = [0.0, 0.1, 0.3, 0.3];
        let sum = heights
            .iter()
            .fold(Sums::default(), |s, &h| s.plus(&Sums { n: 1.0, height: h, squared: h * h }));
        let level = -0.2f32;
        let slow: f64 = heights.iter().map(|h| (h + f64::from(level)).powi(2)).sum::<f64>() / 0.01;
        assert!((f64::from(sum.cost_at(level, 1.0)) - slow).abs() < 1e-4, "{slow}");
        let raised = sum.raised(level);
        assert!((raised.cost_at(0.0, 1.0) - sum.cost_at(level, 1.0)).abs() < 1e-4, "{raised:?}");
    }
}
