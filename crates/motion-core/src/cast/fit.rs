//! The place of an interaction that suits all of its members best.

use glam::DVec2;

use crate::constraint::Tolerance;
use crate::planar::{PlanarTransform, wrap_angle_rad};

/// Headings that are tried before the best is refined. The sum has at most one minimum for every
/// member's heading and one for the way that the places lie.
const N_HEADINGS: usize = 72;
/// Thirds of a bracket of two steps: 10° shrink below a millionth of a degree.
const N_THIRDS: usize = 44;

/// Where one member is or would be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sight {
    /// Where its torso stands in the interaction.
    pub(super) interaction_from_torso: PlanarTransform,
    /// Where it is in the world.
    pub(super) world_from_torso: PlanarTransform,
    /// What a squared metre of error counts.
    pub(super) per_m2: f32,
    /// What a squared radian counts.
    pub(super) per_rad2: f32,
}

impl Sight {
    /// Errors count as those of a body constraint with this weight and tolerance.
    pub(super) fn new(
        interaction_from_torso: PlanarTransform,
        world_from_torso: PlanarTransform,
        weight: f32,
        tolerance: &Tolerance,
    ) -> Self {
        Self {
            interaction_from_torso,
            world_from_torso,
            per_m2: weight / (tolerance.position_m * tolerance.position_m),
            per_rad2: weight / (tolerance.heading_rad * tolerance.heading_rad),
        }
    }
}

/// Sums over all sights for
///
/// `cost(T) = Σ g |p − T r|² + h wrap(θ + ρ − η)²`,
///
/// where T turns by θ, `p, η` are a member's place and heading in the world and `r, ρ` those in the
/// interaction. For a given θ the best translation is the difference of the weighted means, and the
/// ground's part is a constant − 2 (A cos θ + B sin θ), as in Kovar 2002's alignment of point
/// clouds (`docs/method.md`, B1).
#[derive(Clone, Debug)]
pub(super) struct Fit {
    mean_world_m: DVec2,
    mean_relative_m: DVec2,
    constant: f64,
    along: f64,
    across: f64,
    /// `(η − ρ, h)`.
    headings: Vec<(f64, f64)>,
}

impl Fit {
    /// `None` where no sight says anything of a place.
    pub(super) fn new(sights: &[Sight]) -> Option<Self> {
        let weight: f64 = sights.iter().map(|s| f64::from(s.per_m2)).sum();
        if weight <= 0.0 {
            return None;
        }
        let mean = |place: &dyn Fn(&Sight) -> DVec2| {
            sights.iter().map(|s| place(s) * f64::from(s.per_m2)).sum::<DVec2>() / weight
        };
        let world = |s: &Sight| s.world_from_torso.ground_m().as_dvec2();
        let relative = |s: &Sight| s.interaction_from_torso.ground_m().as_dvec2();
        let (mean_world_m, mean_relative_m) = (mean(&world), mean(&relative));
        let (mut constant, mut along, mut across) = (0.0, 0.0, 0.0);
        for sight in sights {
            let (p, r) = (world(sight) - mean_world_m, relative(sight) - mean_relative_m);
            let g = f64::from(sight.per_m2);
            constant += g * (p.length_squared() + r.length_squared());
            along += g * p.dot(r);
            across += g * (p.x * r.y - p.y * r.x);
        }
        let heading = |s: &Sight| {
            let turn = s.world_from_torso.heading_rad() - s.interaction_from_torso.heading_rad();
            (f64::from(turn), f64::from(s.per_rad2))
        };
        let headings = sights.iter().map(heading).collect();
        Some(Self { mean_world_m, mean_relative_m, constant, along, across, headings })
    }

    /// The least cost for this heading.
    pub(super) fn cost(&self, heading_rad: f64) -> f64 {
        let (sin, cos) = heading_rad.sin_cos();
        let ground = self.constant - 2.0 * (self.along * cos + self.across * sin);
        let turns = self.headings.iter().map(|&(wished, h)| {
            let off = f64::from(wrap_angle_rad((heading_rad - wished) as f32));
            h * off * off
        });
        ground.max(0.0) + turns.sum::<f64>()
    }

    /// The best place for this heading.
    pub(super) fn place(&self, heading_rad: f64) -> PlanarTransform {
        let turn = PlanarTransform::new(heading_rad as f32, glam::Vec2::ZERO, 0.0);
        let turned = turn.turn_ground(self.mean_relative_m.as_vec2());
        let ground_m = self.mean_world_m.as_vec2() - turned;
        PlanarTransform::new(heading_rad as f32, ground_m, 0.0)
    }

    /// Headings that no near one is better than, each with its cost, the best first.
    pub(super) fn minima(&self) -> Vec<(f64, f64)> {
        let step = std::f64::consts::TAU / N_HEADINGS as f64;
        let costs: Vec<f64> = (0..N_HEADINGS).map(|nth| self.cost(nth as f64 * step)).collect();
        let at = |nth: usize| costs[nth % N_HEADINGS];
        // Of equal neighbours the first counts, so that a flat cost has a minimum.
        let is_least = |nth: &usize| {
            let nth = *nth;
            at(nth) <= at(nth + 1) && (at(nth) < at(nth + N_HEADINGS - 1) || nth == 0)
        };
        let mut minima: Vec<(f64, f64)> = (0..N_HEADINGS)
            .filter(is_least)
            .map(|nth| self.refined(nth as f64 * step, step))
            .collect();
        minima.sort_by(|a, b| a.1.total_cmp(&b.1));
        minima
    }

    /// The best place of all, and its cost.
    pub(super) fn best(&self) -> (PlanarTransform, f64) {
        let minima = self.minima();
        let (heading_rad, cost) = minima.first().copied().unwrap_or((0.0, self.cost(0.0)));
        (self.place(heading_rad), cost)
    }

    fn refined(&self, heading_rad: f64, step: f64) -> (f64, f64) {
        let (mut low, mut high) = (heading_rad - step, heading_rad + step);
        for _ in 0..N_THIRDS {
            let third = (high - low) / 3.0;
            if self.cost(low + third) <= self.cost(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        let middle = 0.5 * (low + high);
        // The grid's own point, where rounding is all that is gained.
        let (there, here) = (self.cost(middle), self.cost(heading_rad));
        if there < here { (middle, there) } else { (heading_rad, here) }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;

    fn at(heading_deg: f32, x: f32, z: f32) -> PlanarTransform {
        PlanarTransform::new(heading_deg.to_radians(), Vec2::new(x, z), 0.0)
    }

    fn sight(relative: PlanarTransform, world: PlanarTransform) -> Sight {
        Sight::new(relative, world, 1.0, &Tolerance::default())
    }

    #[test]
    fn members_that_are_where_they_should_be_say_where_the_interaction_is() {
        let relatives = [at(0.0, 0.0, 0.0), at(180.0, 0.0, 1.0), at(-70.0, 2.0, 0.5)];
        for place in [at(0.0, 0.0, 0.0), at(135.0, 3.0, -2.0), at(-179.0, -1.0, 4.0)] {
            let sights: Vec<Sight> = relatives.iter().map(|&r| sight(r, place * r)).collect();
            for n in 1..=3 {
                let (found, cost) = Fit::new(&sights[..n]).expect("there are sights").best();
                assert!(found.ground_m().distance(place.ground_m()) < 1e-4, "{n} {found:?}");
                assert!((found.inverse() * place).heading_rad().abs() < 1e-4, "{n} {found:?}");
                assert!(cost < 1e-5, "{cost}");
            }
        }
    }

    #[test]
    fn no_place_near_the_best_one_costs_less() {
        let tolerance = Tolerance::default();
        let relatives = [at(0.0, 0.0, 0.0), at(180.0, 0.0, 1.0)];
        let worlds = [at(20.0, -0.4, 0.3), at(-120.0, 0.2, 1.9)];
        let sights = [
            Sight::new(relatives[0], worlds[0], 1.0, &tolerance),
            Sight::new(relatives[1], worlds[1], 3.0, &tolerance),
        ];
        let cost_at = |place: PlanarTransform| -> f32 {
            let of = |s: &Sight| {
                let there = place * s.interaction_from_torso;
                let off = wrap_angle_rad(there.heading_rad() - s.world_from_torso.heading_rad());
                s.per_m2 * there.ground_m().distance_squared(s.world_from_torso.ground_m())
                    + s.per_rad2 * off * off
            };
            sights.iter().map(of).sum()
        };
        let (best, cost) = Fit::new(&sights).expect("there are sights").best();
        assert!((cost_at(best) - cost as f32).abs() < 1e-3 * cost_at(best), "{cost}");
        for turn_deg in [-2.0f32, 0.0, 2.0] {
            for (x, z) in [(0.02, 0.0), (0.0, 0.02), (-0.02, 0.0), (0.0, -0.02), (0.0, 0.0)] {
                let near = PlanarTransform::new(
                    best.heading_rad() + turn_deg.to_radians(),
                    best.ground_m() + Vec2::new(x, z),
                    0.0,
                );
                assert!(cost_at(near) >= cost_at(best) - 1e-4, "{turn_deg} {x} {z}");
            }
        }
    }

    #[test]
    fn who_is_nowhere_says_nothing() {
        assert!(Fit::new(&[]).is_none());
    }
}
