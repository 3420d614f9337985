//! A foot in space, and how it rolls over heel and toes.

use glam::{Quat, Vec2, Vec3};

use crate::body::{ANKLE_HEIGHT_M, HEEL_FROM_ANKLE_M, TOE_FROM_ANKLE_M};
use crate::signal::State;

/// Length of the toes, and how far their tips stay above the floor.
const TOES_M: f32 = 0.072;
const TIP_CLEARANCE_M: f32 = 0.008;

/// Where a foot is and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FootPose {
    pub(crate) ankle_m: Vec3,
    pub(crate) yaw_rad: f32,
    /// Above 0 with the heel up.
    pub(crate) pitch_rad: f32,
    /// Rotation of the toes against the foot, below 0 when bent up.
    pub(crate) toe_bend_rad: f32,
    /// The toe joint stands still on the floor.
    pub(crate) planted: bool,
}

impl FootPose {
    pub(crate) fn rotation(self) -> Quat {
        Quat::from_rotation_y(self.yaw_rad) * Quat::from_rotation_x(self.pitch_rad)
    }

    /// The same foot with its toes bent up as far as their tips need to stay off the floor.
    pub(crate) fn with_toes_off_the_floor(self) -> Self {
        let toe_m = self.ankle_m + self.rotation() * TOE_FROM_ANKLE_M;
        // The steepest that the toes may point down from where their joint is.
        let room = ((toe_m.y - TIP_CLEARANCE_M) / TOES_M).clamp(0.0, 1.0);
        let steepest_rad = room.asin();
        Self { toe_bend_rad: self.toe_bend_rad.min(steepest_rad - self.pitch_rad), ..self }
    }
}

/// Where a flat foot stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Print {
    /// Below the ankle of the flat foot.
    pub(crate) ground_m: Vec2,
    pub(crate) yaw_rad: f32,
}

impl Print {
    /// The foot on its print, rolled to a pitch: over the toe joint for a raised heel, over the
    /// heel for raised toes.
    pub(crate) fn rolled(self, pitch_rad: f32) -> FootPose {
        let roll = ankle_roll(State { value: pitch_rad, rate: 0.0, accel: 0.0 });
        FootPose {
            ankle_m: self.in_world(roll.value),
            yaw_rad: self.yaw_rad,
            pitch_rad,
            toe_bend_rad: -pitch_rad.max(0.0),
            planted: pitch_rad >= 0.0,
        }
    }

    /// The ankle's state while the foot rolls.
    pub(crate) fn ankle_state(self, pitch: State<f32>) -> State<Vec3> {
        let roll = ankle_roll(pitch);
        let turn = Quat::from_rotation_y(self.yaw_rad);
        State { value: self.in_world(roll.value), rate: turn * roll.rate, accel: turn * roll.accel }
    }

    fn in_world(self, p: Vec3) -> Vec3 {
        Vec3::new(self.ground_m.x, 0.0, self.ground_m.y) + Quat::from_rotation_y(self.yaw_rad) * p
    }
}

/// The ankle of a foot that rolls without sliding, in the frame of its print.
fn ankle_roll(pitch: State<f32>) -> State<Vec3> {
    let pivot = if pitch.value >= 0.0 { TOE_FROM_ANKLE_M } else { HEEL_FROM_ANKLE_M };
    let arm = Quat::from_rotation_x(pitch.value) * -pivot;
    // Derivative of Rx(θ)·v in θ: the x axis cross it.
    let turned = Vec3::X.cross(arm);
    State {
        value: Vec3::new(0.0, ANKLE_HEIGHT_M, 0.0) + pivot + arm,
        rate: turned * pitch.rate,
        accel: turned * pitch.accel - arm * (pitch.rate * pitch.rate),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINT: Print = Print { ground_m: Vec2::new(1.0, -2.0), yaw_rad: 0.7 };

    #[test]
    fn the_pivot_stays_where_it_is() {
        let flat = PRINT.rolled(0.0);
        for pitch in [-0.4f32, -0.1, 0.0, 0.2, 0.9] {
            let foot = PRINT.rolled(pitch);
            let pivot = if pitch >= 0.0 { TOE_FROM_ANKLE_M } else { HEEL_FROM_ANKLE_M };
            let now = foot.ankle_m + foot.rotation() * pivot;
            let before = flat.ankle_m + flat.rotation() * pivot;
            assert!(now.distance(before) < 1e-6, "pitch {pitch}: {now} is not {before}");
        }
    }

    #[test]
    fn rates_of_a_roll_are_derivatives() {
        for (start, rate) in [(0.3f32, 2.0f32), (-0.3, 1.5)] {
            let at = |t: f32| State { value: start + rate * t, rate, accel: 0.0 };
            let h = 0.01;
            let (a, b, c) =
                (PRINT.ankle_state(at(-h)), PRINT.ankle_state(at(0.0)), PRINT.ankle_state(at(h)));
            let slope = (c.value - a.value) / (2.0 * h);
            assert!(slope.distance(b.rate) < 1e-3, "{slope} is not {}", b.rate);
            let bend = (c.value - b.value * 2.0 + a.value) / (h * h);
            assert!(bend.distance(b.accel) < 2e-2, "{bend} is not {}", b.accel);
        }
    }
}
