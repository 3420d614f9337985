//! Sums over readings from which their cost after any planar move follows at once.
//!
//! Let `p` be where points are, `q` where they should be, `w` their factors, and `c`, `g` the weighted
//! means of `p` and `q`. After a move `D = (R, t)` the cost on the ground is
//!
//! ```text
//! Σ w |R p + t − q|² = W |D c − g|² + Σ w (|p − c|² + |q − g|²) − 2 (cos θ · u + sin θ · v)
//! ```
//!
//! with `u` and `v` the sums of `w` times the dot and cross products of `q − g` and `p − c`. Counting
//! from the means keeps the numbers small: f32 is enough.

use glam::{Vec2, Vec3};

use super::reading::{Reading, Subject};
use crate::planar::{PlanarTransform, wrap_angle_rad};

/// The sums of any number of readings.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    weight: f32,
    mean_m: Vec2,
    goal_m: Vec2,
    spread: f32,
    dot: f32,
    cross: f32,
    turn: f32,
    /// Of the heading errors `e` before the move: `Σ w cos e`, `Σ w sin e`, `Σ w e`, `Σ w e²`.
    turn_cos: f32,
    turn_sin: f32,
    turn_sum: f32,
    turn_squared: f32,
    /// The largest `|e|`.
    turn_largest_rad: f32,
    rise_weight: f32,
    rise_m: f32,
    rise_spread: f32,
}

impl Moments {
    /// Those of one reading; `read` is what stands there before the move.
    pub(crate) fn of(reading: &Reading, (point, heading_rad): (Vec3, f32)) -> Self {
        let mut new = Self::default();
        let (p, q) = (Vec2::new(point.x, point.z), Vec2::new(reading.wished.x, reading.wished.z));
        let (ground, off) = (reading.ground, point.y - reading.wished.y);
        if let Subject::Velocity(_) = reading.subject {
            // It is turned, not moved: there is no mean to count from.
            new.spread = ground * (p.length_squared() + q.length_squared());
            new.dot = ground * q.dot(p);
            new.cross = ground * (q.x * p.y - q.y * p.x);
            new.rise_spread = reading.height * off * off;
            return new;
        }
        (new.weight, new.mean_m, new.goal_m) = (ground, p, q);
        (new.rise_weight, new.rise_m) = (reading.height, off);
        if reading.turn > 0.0 {
            let error = wrap_angle_rad(heading_rad - reading.heading_rad);
            let (sin, cos) = error.sin_cos();
            new.turn = reading.turn;
            (new.turn_cos, new.turn_sin) = (reading.turn * cos, reading.turn * sin);
            (new.turn_sum, new.turn_squared) = (reading.turn * error, reading.turn * error * error);
            new.turn_largest_rad = error.abs();
        }
        new
    }

    /// Those of both together.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let weight = self.weight + other.weight;
        let (mean_apart, goal_apart) = (other.mean_m - self.mean_m, other.goal_m - self.goal_m);
        // Parts of the whole; a weightless side has no say in the means.
        let share = if weight > 0.0 { other.weight / weight } else { 0.0 };
        let joint = self.weight * share;
        let rise_weight = self.rise_weight + other.rise_weight;
        let rise_share = if rise_weight > 0.0 { other.rise_weight / rise_weight } else { 0.0 };
        let rise_apart = other.rise_m - self.rise_m;
        Self {
            weight,
            mean_m: self.mean_m + share * mean_apart,
            goal_m: self.goal_m + share * goal_apart,
            spread: self.spread
                + other.spread
                + joint * (mean_apart.length_squared() + goal_apart.length_squared()),
            dot: self.dot + other.dot + joint * goal_apart.dot(mean_apart),
            cross: self.cross
                + other.cross
                + joint * (goal_apart.x * mean_apart.y - goal_apart.y * mean_apart.x),
            turn: self.turn + other.turn,
            turn_cos: self.turn_cos + other.turn_cos,
            turn_sin: self.turn_sin + other.turn_sin,
            turn_sum: self.turn_sum + other.turn_sum,
            turn_squared: self.turn_squared + other.turn_squared,
            turn_largest_rad: self.turn_largest_rad.max(other.turn_largest_rad),
            rise_weight,
            rise_m: self.rise_m + rise_share * rise_apart,
            rise_spread: self.rise_spread
                + other.rise_spread
                + self.rise_weight * rise_share * rise_apart * rise_apart,
        }
    }

    /// The cost on the ground and of heights after the move.
    #[inline]
    pub(crate) fn place_cost(&self, moved: PlanarTransform) -> f32 {
        let off = moved.turn_ground(self.mean_m) + moved.ground_m() - self.goal_m;
        let rise = self.rise_m + moved.level_m;
        let around = self.spread - 2.0 * (moved.cos() * self.dot + moved.sin() * self.cross);
        self.weight * off.length_squared()
            + around.max(0.0)
            + self.rise_weight * rise * rise
            + self.rise_spread
    }

    /// A lower bound of the cost of headings after the move: a chord is never longer than its arc.
    #[inline]
    pub(crate) fn turn_cost_at_least(&self, moved: PlanarTransform) -> f32 {
        let chords = self.turn - (moved.cos() * self.turn_cos - moved.sin() * self.turn_sin);
        2.0 * chords.max(0.0)
    }

    /// The cost of headings after a turn by `turn_rad` (within a half turn either way); `None` where
    /// an error would be carried past a half turn, so that the sums do not know it.
    #[inline]
    pub(crate) fn turn_cost(&self, turn_rad: f32) -> Option<f32> {
        if turn_rad.abs() + self.turn_largest_rad > std::f32::consts::PI {
            return None;
        }
        let cost =
            self.turn * turn_rad * turn_rad + 2.0 * turn_rad * self.turn_sum + self.turn_squared;
        Some(cost.max(0.0))
    }

    /// Whether headings count at all.
    #[inline]
    pub(crate) fn has_turn(&self) -> bool {
        self.turn > 0.0
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::ids::JointIdx;

    fn any_vec() -> impl Strategy<Value = Vec3> {
        (-9f32..9.0, -1f32..2.0, -9f32..9.0).prop_map(Vec3::from)
    }

    fn any_reading() -> impl Strategy<Value = (Reading, (Vec3, f32))> {
        let factors = (0f32..12.0, 0f32..12.0, 0f32..30.0, 0u8..3);
        (any_vec(), any_vec(), -3f32..3.0, -3f32..3.0, factors).prop_map(
            |(wished, point, wish_rad, heading_rad, (ground, height, turn, kind))| {
                let (subject, turn) = match kind {
                    0 => (Subject::Torso, turn),
                    1 => (Subject::Joint(JointIdx(1)), 0.0),
                    _ => (Subject::Velocity(JointIdx(1)), 0.0),
                };
                let heading = wish_rad;
                let reading = Reading {
                    frame: 0,
                    subject,
                    wished,
                    ground,
                    height,
                    heading_rad: heading,
                    turn,
                };
                (reading, (point, heading_rad))
            },
        )
    }

    proptest! {
        #[test]
        fn the_sums_say_what_every_reading_says(
            readings in prop::collection::vec(any_reading(), 1..8),
            turn_rad in -3f32..3.0, x in -5f32..5.0, z in -5f32..5.0, level_m in -1f32..1.0,
        ) {
            let moved = PlanarTransform::new(turn_rad, Vec2::new(x, z), level_m);
            let slow: f32 = readings
                .iter()
                .map(|(reading, (point, heading_rad))| {
                    let at = match reading.subject {
                        Subject::Velocity(_) => moved.turn(*point),
                        _ => moved.apply(*point),
                    };
                    reading.cost_of((at, heading_rad + turn_rad))
                })
                .sum();
            let sums = readings
                .iter()
                .map(|(reading, read)| Moments::of(reading, *read))
                .fold(Moments::default(), |sum, one| sum.plus(&one));
            let place = sums.place_cost(moved);
            let bound = place + sums.turn_cost_at_least(moved);
            prop_assert!(bound <= slow * 1.001 + 0.05, "{bound} is no bound of {slow}");
            if let Some(turn) = sums.turn_cost(turn_rad) {
                let fast = place + turn;
                prop_assert!((fast - slow).abs() <= 2e-4 * slow + 0.05, "{fast} is not {slow}");
            }
        }
    }
}
