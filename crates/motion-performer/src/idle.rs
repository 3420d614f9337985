//! Standing with small life: breath, a slow sway, a shift of weight, a look around.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};

use crate::perform::Take;
use crate::pose::{Pose, lower_to_reach};
use crate::signal::{Ease, Keys, smoothstep};
use crate::stand::{Departure, rest_print};
use crate::travel::GRID_HZ;
use motion_core::contacts::Side;

/// What a standing body does.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Idle {
    pub(crate) secs: f32,
    /// Weight to the left, metres of the hips over time.
    pub(crate) shift_m: Keys,
    /// Turn of the head to the left, radians over time.
    pub(crate) look_rad: Keys,
}

impl Idle {
    /// Breath and sway only.
    pub(crate) fn still(secs: f32) -> Self {
        Self { secs, shift_m: Keys::constant(0.0), look_rad: Keys::constant(0.0) }
    }

    /// The weight goes over one foot and comes back.
    pub(crate) fn shifting(secs: f32, shift_m: f32) -> Self {
        let keys = vec![(0.4, 0.0), (1.6, shift_m), (secs - 1.7, shift_m), (secs - 0.4, 0.0)];
        Self { shift_m: Keys::new(Ease::Smooth, keys), ..Self::still(secs) }
    }

    /// A look to the left, then to the right.
    pub(crate) fn looking(secs: f32, look_rad: f32) -> Self {
        let at = |share: f32| share * secs;
        let keys = vec![
            (at(0.08), 0.0),
            (at(0.28), look_rad),
            (at(0.40), look_rad),
            (at(0.66), -look_rad),
            (at(0.76), -look_rad),
            (at(0.94), 0.0),
        ];
        Self { look_rad: Keys::new(Ease::Smooth, keys), ..Self::still(secs) }
    }

    pub(crate) fn take(&self) -> Take {
        let n_shown = (self.secs * GRID_HZ as f32).round() as usize + 1;
        let feet = Side::BOTH.map(|side| rest_print(side, 0.0).rolled(0.0));
        let mut poses: Vec<Pose> =
            (0..n_shown).map(|i| self.departure(i as f32 / GRID_HZ as f32).pose(feet)).collect();
        lower_to_reach(&mut poses, GRID_HZ / 5);
        Take { poses, first: 0, n_shown }
    }

    fn departure(&self, secs: f32) -> Departure {
        // Life begins and ends at rest, so that every clip can follow.
        let life = smoothstep(secs / 0.8) * smoothstep((self.secs - secs) / 0.8);
        let wave = |period_s: f32, phase: f32| life * (TAU * (secs / period_s + phase)).sin();
        let breath = wave(3.4, 0.0);
        let shift_m = self.shift_m.at(secs);
        let look_rad = self.look_rad.at(secs);
        Departure {
            hips_m: Vec3::new(
                shift_m + 0.006 * wave(4.3, 0.1),
                -0.9 * shift_m * shift_m,
                0.005 * wave(2.9, 0.3),
            ),
            // The hip of the free leg sinks; the trunk stays upright.
            lean: Quat::from_rotation_z(0.9 * shift_m)
                * Quat::from_rotation_y(0.15 * look_rad + 0.01 * wave(5.1, 0.6)),
            arms: [
                Vec3::new(0.015 * breath, 0.02 * wave(4.7, 0.2), 0.02 * breath),
                Vec3::new(0.0, -0.03 * life + 0.02 * wave(3.9, 0.5), 0.0),
            ],
            spine: Vec3::new(-0.025 * breath, 0.2 * look_rad, -1.1 * shift_m),
            gaze_rad: [look_rad, 0.01 * breath],
        }
    }
}
