//! Where a performance goes: from its spec to samples over time.
//!
//! Speed and heading are given over gait phase, not over time, so that "two cycles straight,
//! then turn by 90° within one and a half" can be said directly, and clips begin and end at a
//! chosen phase. Time follows from the gait: `dt = cycle_s(speed) · dφ`.

use glam::Vec2;

use crate::gait_curves::{Gait, REST_PHASE};
use crate::signal::Keys;

/// Samples per second of everything that is planned: a multiple of the library's rate, fine
/// enough to find the instants of foot events by linear interpolation.
pub(crate) const GRID_HZ: usize = 120;
/// Planned before and after what is shown, so that steps and smoothing have a context: longer
/// than any gait cycle.
const PAD_SECS: f32 = 1.6;
/// How much a turn on the spot counts as stepping speed, in metres per radian: about the
/// distance from the middle of the body to the farther foot.
const STEP_PER_TURN_M: f32 = 0.25;

/// How a performance begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edge {
    /// Mid-stride: gait goes on beyond the edge at the edge's speed.
    Moving,
    /// At rest on both feet for `secs`; the edge's phase must be one of rest
    /// ([`REST_PHASE`], or half a cycle more) and its speed 0.
    Standing {
        /// How long.
        secs: f32,
    },
}

/// What a body should do: the spec of a stretch of gait.
///
/// The body starts at the origin of the ground. Speed and heading are read at the phase of the
/// gait, in cycles: left foot lands at whole numbers, right foot at halves.
///
/// Rules, checked before anything is performed:
/// 1. All of it lasts at most an hour: cycles are above 0 and at most 3,000, rests at most an
///    hour.
/// 2. Speed is never below 0 (to go back, drift by π).
/// 3. A standing edge has a phase at which both soles are flat, and speed 0 there.
#[derive(Clone, Debug, PartialEq)]
pub struct Performance {
    /// Phase of the first shown frame.
    pub from_phase: f32,
    /// How many gait cycles are shown; above 0.
    pub cycles: f32,
    /// Metres per second over phase. The gait goes from walking to running with it.
    pub speed_m_s: Keys,
    /// Heading of the body over phase, radians; a left turn is positive.
    pub heading_rad: Keys,
    /// Direction of travel relative to the heading: 0 ahead, π/2 to the left, π back.
    pub drift_rad: f32,
    /// How it begins.
    pub before: Edge,
    /// How it ends.
    pub after: Edge,
}

impl Performance {
    /// Straight ahead at one speed, mid-stride at both ends.
    pub fn straight(speed_m_s: f32, cycles: f32) -> Self {
        Self {
            from_phase: 0.0,
            cycles,
            speed_m_s: Keys::constant(speed_m_s),
            heading_rad: Keys::constant(0.0),
            drift_rad: 0.0,
            before: Edge::Moving,
            after: Edge::Moving,
        }
    }
}

/// Which rule of [`Performance`] a spec breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpecError {
    /// Rule 1.
    #[error("a performance has more than 0 and at most 3000 cycles, and rests of at most an hour")]
    Length,
    /// Rule 2.
    #[error("speed is below 0; drift by half a turn to go back")]
    Speed,
    /// Rule 3.
    #[error("a body can stand still only where both feet are flat, at phase 0.085 or 0.585")]
    Rest,
}

impl Performance {
    /// Checks the rules.
    pub fn check(&self) -> Result<(), SpecError> {
        let to_phase = self.from_phase + self.cycles;
        let long =
            |edge| matches!(edge, Edge::Standing { secs } if !(0.0..=3600.0).contains(&secs));
        if !(self.cycles > 0.0 && self.cycles <= 3000.0 && self.from_phase.abs() <= 1e4)
            || long(self.before)
            || long(self.after)
        {
            return Err(SpecError::Length);
        }
        if self.speed_m_s.lowest() < 0.0 {
            return Err(SpecError::Speed);
        }
        let at_rest = |edge, phase: f32| match edge {
            Edge::Moving => true,
            Edge::Standing { .. } => {
                let off_rest = (phase - REST_PHASE).rem_euclid(0.5);
                !(0.004..=0.496).contains(&off_rest) && self.speed_m_s.at(phase) < 0.01
            }
        };
        if at_rest(self.before, self.from_phase) && at_rest(self.after, to_phase) {
            Ok(())
        } else {
            Err(SpecError::Rest)
        }
    }
}

/// One instant of a [`Travel`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    pub(crate) phase: f32,
    pub(crate) ground_m: Vec2,
    pub(crate) heading_rad: f32,
    /// Turn rate, radians per second.
    pub(crate) turn_rad_s: f32,
    pub(crate) speed_m_s: f32,
    /// The speed that sets the gait: that of travel, and of the feet in a turn.
    pub(crate) gait_speed_m_s: f32,
}

impl Moment {
    pub(crate) fn gait(&self) -> Gait {
        Gait::at_speed(self.gait_speed_m_s)
    }

    /// The unit vector to the body's left.
    pub(crate) fn left(&self) -> Vec2 {
        Vec2::new(self.heading_rad.cos(), -self.heading_rad.sin())
    }
}

/// A performance sampled at [`GRID_HZ`], with a margin before and after what is shown.
#[derive(Clone, Debug)]
pub(crate) struct Travel {
    pub(crate) moments: Vec<Moment>,
    /// The first shown moment.
    pub(crate) first: usize,
    /// How many moments are shown.
    pub(crate) n_shown: usize,
    pub(crate) drift_rad: f32,
}

impl Travel {
    pub(crate) fn new(spec: &Performance) -> Self {
        let pad = (PAD_SECS * GRID_HZ as f32) as usize;
        let (from, to) = (spec.from_phase, spec.from_phase + spec.cycles.max(0.01));
        let hold = |edge: Edge| match edge {
            Edge::Moving => 0,
            Edge::Standing { secs } => (secs * GRID_HZ as f32).round() as usize,
        };

        let mut phases = vec![from; hold(spec.before)];
        let mut phase = from;
        while phase < to {
            phases.push(phase);
            phase = phase_after(spec, phase, 1.0);
        }
        let n_moving = phases.len();
        phases.resize(n_moving + hold(spec.after), to);
        // The gait never ends exactly on a sample, so a moving end shows the sample before.
        let n_shown = phases.len();
        for _ in 0..pad {
            phase = match spec.after {
                Edge::Moving => {
                    phases.push(phase);
                    phase_after(spec, phase, 1.0)
                }
                Edge::Standing { .. } => {
                    phases.push(to);
                    to
                }
            };
        }
        let mut before = Vec::with_capacity(pad);
        let mut phase = from;
        for _ in 0..pad {
            if spec.before == Edge::Moving {
                phase = phase_after(spec, phase, -1.0);
            }
            before.push(phase);
        }
        let phases: Vec<f32> = before.into_iter().rev().chain(phases).collect();
        Self {
            moments: moments(spec, &phases, pad),
            first: pad,
            n_shown,
            drift_rad: spec.drift_rad,
        }
    }

    /// The moment nearest to a time on the grid, in samples, clamped to what is planned.
    pub(crate) fn at(&self, sample: f32) -> &Moment {
        let last = self.moments.len() - 1;
        &self.moments[(sample.round().max(0.0) as usize).min(last)]
    }
}

/// The phase one sample later (`direction` 1) or earlier (−1), by the midpoint rule.
fn phase_after(spec: &Performance, phase: f32, direction: f32) -> f32 {
    let dt = direction / GRID_HZ as f32;
    let rate = |phase: f32| 1.0 / Gait::at_speed(gait_speed_m_s(spec, phase)).cycle_s();
    phase + dt * rate(phase + 0.5 * dt * rate(phase))
}

fn gait_speed_m_s(spec: &Performance, phase: f32) -> f32 {
    spec.speed_m_s.at(phase).hypot(STEP_PER_TURN_M * spec.heading_rad.slope(phase))
}

/// Integrates the path so that it is at the origin at sample `origin`.
fn moments(spec: &Performance, phases: &[f32], origin: usize) -> Vec<Moment> {
    let dt = 1.0 / GRID_HZ as f32;
    let direction = |heading_rad: f32| {
        let (sin, cos) = (heading_rad + spec.drift_rad).sin_cos();
        Vec2::new(sin, cos)
    };
    let mut ground_m = Vec2::ZERO;
    let mut all: Vec<Moment> = Vec::with_capacity(phases.len());
    for (i, &phase) in phases.iter().enumerate() {
        let heading_rad = spec.heading_rad.at(phase);
        let speed_m_s = spec.speed_m_s.at(phase);
        if let Some(before) = all.last() {
            let velocity_before = direction(before.heading_rad) * before.speed_m_s;
            ground_m += (velocity_before + direction(heading_rad) * speed_m_s) * (0.5 * dt);
        }
        let (a, b) = (phases[i.saturating_sub(1)], phases[(i + 1).min(phases.len() - 1)]);
        let turned = spec.heading_rad.at(b) - spec.heading_rad.at(a);
        all.push(Moment {
            phase,
            ground_m,
            heading_rad,
            turn_rad_s: turned / (2.0 * dt),
            speed_m_s,
            gait_speed_m_s: gait_speed_m_s(spec, phase),
        });
    }
    let start = all.get(origin).map_or(Vec2::ZERO, |m| m.ground_m);
    for moment in &mut all {
        moment.ground_m -= start;
    }
    all
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;
    use crate::signal::Ease;

    #[test]
    fn a_straight_path_goes_at_its_speed() {
        let travel = Travel::new(&Performance::straight(1.3, 3.0));
        let shown = &travel.moments[travel.first..travel.first + travel.n_shown];
        let secs = (shown.len() - 1) as f32 / GRID_HZ as f32;
        let end = shown[shown.len() - 1].ground_m;
        assert!(shown[0].ground_m.length() < 1e-6);
        assert!((end.y / secs - 1.3).abs() < 1e-3 && end.x.abs() < 1e-6, "{end}");
        assert!((secs - 3.0 * Gait::at_speed(1.3).cycle_s()).abs() < 2.0 / GRID_HZ as f32);
    }

    #[test]
    fn a_left_turn_leads_to_the_left() {
        let mut spec = Performance::straight(1.0, 3.0);
        spec.heading_rad = Keys::new(Ease::Smooth, vec![(1.0, 0.0), (2.0, FRAC_PI_2)]);
        let travel = Travel::new(&spec);
        let end = travel.moments[travel.first + travel.n_shown - 1];
        assert!(end.ground_m.x > 0.5, "+X is left: {}", end.ground_m);
        assert!((end.heading_rad - FRAC_PI_2).abs() < 1e-6);
    }

    #[test]
    fn specs_that_no_body_can_follow_are_refused() {
        let good = Performance::straight(1.3, 3.0);
        assert_eq!(good.check(), Ok(()));
        let standing = Edge::Standing { secs: 1.0 };
        for (spec, error) in [
            (Performance { cycles: f32::INFINITY, ..good.clone() }, SpecError::Length),
            (Performance { cycles: f32::NAN, ..good.clone() }, SpecError::Length),
            (Performance { cycles: 0.0, ..good.clone() }, SpecError::Length),
            (Performance { speed_m_s: Keys::constant(-1.0), ..good.clone() }, SpecError::Speed),
            (Performance { before: standing, ..good.clone() }, SpecError::Rest),
            (
                Performance { before: standing, from_phase: REST_PHASE, ..good.clone() },
                SpecError::Rest,
            ),
        ] {
            assert_eq!(spec.check(), Err(error));
        }
    }

    #[test]
    fn standing_edges_stand_and_moving_edges_move() {
        let mut spec = Performance::straight(1.2, 2.0);
        spec.speed_m_s = Keys::new(Ease::Smooth, vec![(0.0, 0.0), (1.0, 1.2)]);
        spec.before = Edge::Standing { secs: 0.5 };
        let travel = Travel::new(&spec);
        assert_eq!(travel.moments[0].ground_m, travel.moments[travel.first].ground_m);
        let (last, end) = (travel.moments.len() - 1, travel.first + travel.n_shown);
        assert!(travel.moments[last].ground_m.y > travel.moments[end].ground_m.y + 1.0);
    }
}
