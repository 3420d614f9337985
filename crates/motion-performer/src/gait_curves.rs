//! What a body does at a speed: timing of the feet and curves of trunk and arms.
//!
//! Between the measured gaits everything is interpolated linearly in speed; below the slowest
//! one it fades to a stand. One function of speed and phase for all clips is what makes the
//! library one connected whole: wherever two clips go at the same speed, they share poses.

use glam::Vec3;

use crate::gait_figures::{FAST_WALK, RUN, WALK};

/// A periodic curve of period 1: `a₀ + Σ aₖ cos 2πkp + bₖ sin 2πkp`, as `[(a₀, 0), (a₁, b₁), …]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fourier(pub(crate) &'static [(f32, f32)]);

/// Harmonics that a series may have beyond its mean.
const MAX_HARMONICS: usize = 8;

/// Sines and cosines of a phase and its multiples, shared by all series read at that phase.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Harmonics([(f32, f32); MAX_HARMONICS]);

impl Harmonics {
    pub(crate) fn at(phase: f32) -> Self {
        let (sin, cos) = (std::f32::consts::TAU * phase.rem_euclid(1.0)).sin_cos();
        let mut waves = [(cos, sin); MAX_HARMONICS];
        // cos kx and sin kx by adding the angle once more each time.
        for k in 1..MAX_HARMONICS {
            let (cos_k, sin_k) = waves[k - 1];
            waves[k] = (cos_k * cos - sin_k * sin, sin_k * cos + cos_k * sin);
        }
        Self(waves)
    }

    /// Half a cycle later: odd harmonics change sign.
    pub(crate) fn half_later(mut self) -> Self {
        for (cos_k, sin_k) in self.0.iter_mut().step_by(2) {
            (*cos_k, *sin_k) = (-*cos_k, -*sin_k);
        }
        self
    }
}

impl Fourier {
    pub(crate) fn mean(self) -> f32 {
        self.0.first().map_or(0.0, |a0| a0.0)
    }

    /// The curve without its mean.
    pub(crate) fn swing(self, harmonics: &Harmonics) -> f32 {
        let waves = self.0.iter().skip(1).zip(&harmonics.0);
        waves.map(|(&(a, b), &(cos_k, sin_k))| a * cos_k + b * sin_k).sum()
    }

    pub(crate) fn at(self, harmonics: &Harmonics) -> f32 {
        self.mean() + self.swing(harmonics)
    }
}

/// When things happen to a foot, in shares of the cycle; the left foot's cycle is the body's,
/// the right foot's is half a cycle late.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GaitEvents {
    /// The foot lands (walking: on the heel).
    pub(crate) strike: f32,
    /// The sole lies flat.
    pub(crate) flat: f32,
    /// The hips pass over the ankle.
    pub(crate) over: f32,
    /// The heel leaves the floor.
    pub(crate) heel_off: f32,
    /// The toes leave the floor.
    pub(crate) toe_off: f32,
}

/// A measured gait; see `gait_figures.rs`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GaitFigures {
    pub(crate) events: GaitEvents,
    /// Pitch of the foot as it lands, below 0 with the toes up.
    pub(crate) strike_pitch_rad: f32,
    /// Pitch of the foot as its toes leave the floor, above 0 with the heel up.
    pub(crate) off_pitch_rad: f32,
    pub(crate) speed_m_s: f32,
    pub(crate) cycle_s: f32,
    pub(crate) hips: [Fourier; 3],
    pub(crate) spine: [Fourier; 3],
    pub(crate) spine1: [Fourier; 3],
    pub(crate) spine2: [Fourier; 3],
    pub(crate) left_arm: [Fourier; 3],
    pub(crate) left_fore_arm: [Fourier; 3],
    pub(crate) bob: Fourier,
    pub(crate) surge: Fourier,
    pub(crate) ankle_ahead: Fourier,
    pub(crate) ankle_height: Fourier,
    pub(crate) foot_pitch: Fourier,
}

/// The measured hips joint sits this much higher over its hip joints than the built-in one, less
/// what the built-in legs are longer.
const BOB_TO_HIPS_M: f32 = -0.027;

/// Stepping without going anywhere. The flat phase is over half a cycle long, so that there is a
/// phase (just after `flat`) at which both feet stand flat and a body can come to rest.
const STAND_EVENTS: GaitEvents =
    GaitEvents { strike: 0.0, flat: 0.08, over: 0.30, heel_off: 0.59, toe_off: 0.66 };
const STAND_CYCLE_S: f32 = 1.25;
const STAND_HIPS_HEIGHT_M: f32 = 0.983;
/// Arms hang a little off the body, elbows a little bent.
const STAND_ARM: Vec3 = Vec3::new(0.12, -0.12, -1.48);
const STAND_FORE_ARM: Vec3 = Vec3::new(0.0, -0.26, 0.15);
const STAND_TRUNK: [Vec3; 4] = [
    Vec3::new(0.0, 0.0, 0.0),
    Vec3::new(0.05, 0.0, 0.0),
    Vec3::new(0.0, 0.0, 0.0),
    Vec3::new(-0.03, 0.0, 0.0),
];

/// Phase, past a foot's landing, at which a body comes to rest or sets off: both soles are flat.
pub const REST_PHASE: f32 = 0.085;

/// The gait at a speed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gait {
    a: &'static GaitFigures,
    b: &'static GaitFigures,
    /// Share of `b`.
    t: f32,
    /// 0 for a stand, 1 from the slowest measured gait on.
    stride: f32,
    /// 0 for walking, 1 for running.
    run: f32,
}

/// What trunk and arms do: rotation vectors, local except for the hips, which are relative to
/// the heading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UpperBody {
    /// Hips, spine, spine1, spine2.
    pub(crate) trunk: [Vec3; 4],
    /// Arm and forearm, left and right.
    pub(crate) arms: [[Vec3; 2]; 2],
    /// Height of the hips joint.
    pub(crate) hips_height_m: f32,
    /// How far the hips are ahead of even progress.
    pub(crate) surge_m: f32,
}

impl Gait {
    pub(crate) fn at_speed(speed_m_s: f32) -> Self {
        let v = speed_m_s.max(0.0);
        // A little beyond the fastest measured run the curves still hold.
        let share = |a: &GaitFigures, b: &GaitFigures| {
            ((v - a.speed_m_s) / (b.speed_m_s - a.speed_m_s)).clamp(0.0, 1.15)
        };
        if v < WALK.speed_m_s {
            Self { a: &WALK, b: &WALK, t: 0.0, stride: v / WALK.speed_m_s, run: 0.0 }
        } else if v < FAST_WALK.speed_m_s {
            let t = share(&WALK, &FAST_WALK);
            Self { a: &WALK, b: &FAST_WALK, t, stride: 1.0, run: 0.0 }
        } else {
            let t = share(&FAST_WALK, &RUN);
            Self { a: &FAST_WALK, b: &RUN, t, stride: 1.0, run: t.min(1.0) }
        }
    }

    /// 0 for a stand, 1 from the slowest measured gait on.
    pub(crate) fn stride(self) -> f32 {
        self.stride
    }

    /// 0 for walking, 1 for running.
    pub(crate) fn run(self) -> f32 {
        self.run
    }

    /// A figure between its values for the gaits; `stand` is its value for a stand.
    pub(crate) fn mix(self, stand: f32, figure: impl Fn(&GaitFigures) -> f32) -> f32 {
        stand + (self.moving(figure) - stand) * self.stride
    }

    /// A figure of the gait; below walking speed, that of walking.
    pub(crate) fn moving(self, figure: impl Fn(&GaitFigures) -> f32) -> f32 {
        if self.t == 0.0 {
            return figure(self.a);
        }
        figure(self.a) + (figure(self.b) - figure(self.a)) * self.t
    }

    pub(crate) fn cycle_s(self) -> f32 {
        self.mix(STAND_CYCLE_S, |g| g.cycle_s)
    }

    pub(crate) fn events(self) -> GaitEvents {
        let s = STAND_EVENTS;
        GaitEvents {
            strike: self.mix(s.strike, |g| g.events.strike),
            flat: self.mix(s.flat, |g| g.events.flat),
            over: self.mix(s.over, |g| g.events.over),
            heel_off: self.mix(s.heel_off, |g| g.events.heel_off),
            toe_off: self.mix(s.toe_off, |g| g.events.toe_off),
        }
    }

    /// Trunk and arms at a phase; `vigour` scales what swings (1 as measured).
    pub(crate) fn upper_body(self, phase: f32, vigour: f32) -> UpperBody {
        let here = Harmonics::at(phase);
        let half_later = here.half_later();
        let curve = |stand: f32, at: &Harmonics, of: &dyn Fn(&GaitFigures) -> Fourier| {
            self.mix(stand, |g| of(g).mean()) + vigour * self.mix(0.0, |g| of(g).swing(at))
        };
        let vector = |stand: Vec3, at: &Harmonics, of: &dyn Fn(&GaitFigures) -> [Fourier; 3]| {
            Vec3::new(
                curve(stand.x, at, &|g| of(g)[0]),
                curve(stand.y, at, &|g| of(g)[1]),
                curve(stand.z, at, &|g| of(g)[2]),
            )
        };
        let arm = |at: &Harmonics| {
            [
                vector(STAND_ARM, at, &|g| g.left_arm),
                vector(STAND_FORE_ARM, at, &|g| g.left_fore_arm),
            ]
        };
        // The right arm does what the left one does half a cycle away, mirrored.
        let mirror = Vec3::new(1.0, -1.0, -1.0);
        UpperBody {
            trunk: [
                vector(STAND_TRUNK[0], &here, &|g| g.hips),
                vector(STAND_TRUNK[1], &here, &|g| g.spine),
                vector(STAND_TRUNK[2], &here, &|g| g.spine1),
                vector(STAND_TRUNK[3], &here, &|g| g.spine2),
            ],
            arms: [arm(&here), arm(&half_later).map(|v| v * mirror)],
            hips_height_m: self.mix(STAND_HIPS_HEIGHT_M, |g| g.bob.mean() + BOB_TO_HIPS_M)
                + self.mix(0.0, |g| g.bob.swing(&here)),
            surge_m: self.mix(0.0, |g| g.surge.swing(&here)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fourier_series_by_recurrence_is_the_sum_of_its_waves() {
        let curve = Fourier(&[(0.3, 0.0), (0.1, -0.2), (0.05, 0.4), (0.0, 0.7)]);
        for phase in [-1.3f32, 0.0, 0.21, 0.5, 0.99, 7.4] {
            let wave = |k: usize, (a, b): (f32, f32)| {
                let x = std::f32::consts::TAU * phase * k as f32;
                a * x.cos() + b * x.sin()
            };
            let slow: f32 = curve.0.iter().enumerate().map(|(k, &ab)| wave(k, ab)).sum();
            assert!((curve.at(&Harmonics::at(phase)) - slow).abs() < 1e-5, "phase {phase}");
        }
    }

    #[test]
    fn speed_changes_the_gait_without_jumps() {
        let mut before = Gait::at_speed(0.0);
        for step in 1..=400 {
            let gait = Gait::at_speed(step as f32 * 0.01);
            assert!((gait.cycle_s() - before.cycle_s()).abs() < 0.01, "at step {step}");
            let (a, b) = (gait.events(), before.events());
            assert!((a.toe_off - b.toe_off).abs() < 0.005, "at step {step}");
            let order = [a.strike, a.flat, a.over, a.heel_off, a.toe_off, a.strike + 1.0];
            assert!(order.is_sorted(), "events out of order at step {step}: {order:?}");
            before = gait;
        }
    }

    #[test]
    fn walking_has_a_double_support_and_running_a_flight() {
        let support = |v: f32| {
            let e = Gait::at_speed(v).events();
            e.toe_off - e.strike
        };
        assert!(support(1.2) > 0.55, "two feet on the floor in walking");
        assert!(support(3.5) < 0.35, "no foot on the floor for a while in running");
    }

    #[test]
    fn arms_swing_against_each_other() {
        let gait = Gait::at_speed(1.4);
        for phase in [0.0f32, 0.2, 0.35] {
            let now = gait.upper_body(phase, 1.0).arms;
            let half_later = gait.upper_body(phase + 0.5, 1.0).arms;
            let mirrored = now[0][0] * Vec3::new(1.0, -1.0, -1.0);
            assert!(mirrored.distance(half_later[1][0]) < 1e-5, "phase {phase}");
        }
    }
}
