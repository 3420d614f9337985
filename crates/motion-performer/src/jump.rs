//! Jumping: crouch, take-off, ballistic flight, landing.
//!
//! The hips follow polynomials of degree five on the floor and a parabola of true gravity in the
//! air; position, velocity and acceleration are continuous at every joint between them, so the
//! acceleration is that of gravity from the instant of take-off to the instant of landing.

use std::f32::consts::PI;

use glam::{Quat, Vec3};

use crate::body::{ANKLE_HEIGHT_M, HIPS_HEIGHT_M, LEFT_HIP_M, SHIN_M, THIGH_M, sign};
use crate::foot_pose::FootPose;
use crate::perform::Take;
use crate::pose::{Pose, lower_to_reach};
use crate::signal::{Ease, Keys, Quintic, State, smoothstep};
use crate::stand::{Departure, rest_print, rest_upper_body};
use crate::travel::GRID_HZ;
use motion_core::contacts::Side;

const GRAVITY_M_S2: f32 = 9.81;
/// Before and after.
const STAND_S: f32 = 0.4;
/// From rest down to the lowest point, and from there to take-off.
const CROUCH_S: f32 = 0.55;
const PUSH_S: f32 = 0.30;
/// From touch-down to the lowest point, and from there to rest.
const ABSORB_S: f32 = 0.34;
const RECOVER_S: f32 = 0.80;
/// Pitch of the feet as they leave the floor and as they meet it.
const OFF_PITCH_RAD: f32 = 0.75;
const LAND_PITCH_RAD: f32 = 0.35;
/// From touch-down of the toes to the flat sole.
const LAND_FLAT_S: f32 = 0.10;

/// A jump from rest to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Jump {
    /// How much higher than at take-off the hips come.
    pub(crate) rise_m: f32,
    /// How far ahead the feet land.
    pub(crate) ahead_m: f32,
}

/// A jump with all its times and curves.
struct Plan {
    jump: Jump,
    crouched_s: f32,
    off_s: f32,
    land_s: f32,
    absorbed_s: f32,
    rest_s: f32,
    down: Quintic<Vec3>,
    push: Quintic<Vec3>,
    off: State<Vec3>,
    absorb: Quintic<Vec3>,
    recover: Quintic<Vec3>,
}

impl Plan {
    fn new(jump: Jump) -> Self {
        let rest_m = rest_upper_body().hips_height_m;
        // At take-off the legs are all but straight and the heels up.
        let off_height_m = HIPS_HEIGHT_M + 0.035;
        // A landing begins with bent knees, which would otherwise have to snap.
        let land_height_m = HIPS_HEIGHT_M - 0.06;
        let up_m_s = (2.0 * GRAVITY_M_S2 * jump.rise_m).sqrt();
        let fall_m = off_height_m + jump.rise_m - land_height_m;
        let flight_s = up_m_s / GRAVITY_M_S2 + (2.0 * fall_m / GRAVITY_M_S2).sqrt();
        // The hips leave ahead of the feet and land behind them, so they fly less far.
        let lead_m = 0.21 * jump.ahead_m;
        let ahead_m_s = (jump.ahead_m - 1.5 * lead_m) / flight_s;

        let at = |z: f32, y: f32| Vec3::new(0.0, y, z);
        let still = |value: Vec3| State { value, rate: Vec3::ZERO, accel: Vec3::ZERO };
        let gravity = Vec3::new(0.0, -GRAVITY_M_S2, 0.0);
        let off =
            State { value: at(lead_m, off_height_m), rate: at(ahead_m_s, up_m_s), accel: gravity };
        let landing = State {
            value: off.value + off.rate * flight_s + gravity * (0.5 * flight_s * flight_s),
            rate: off.rate + gravity * flight_s,
            accel: gravity,
        };
        let low = 0.36 + 0.1 * jump.rise_m;
        let crouched = State {
            value: at(-0.03 + 0.1 * jump.ahead_m, rest_m - low),
            rate: Vec3::ZERO,
            accel: at(0.8 * jump.ahead_m, 9.0),
        };
        let absorbed = State {
            value: at(jump.ahead_m - 0.02, rest_m - 0.8 * low),
            rate: Vec3::ZERO,
            accel: at(0.0, 9.0),
        };
        let crouched_s = STAND_S + CROUCH_S;
        let off_s = crouched_s + PUSH_S;
        let land_s = off_s + flight_s;
        let absorbed_s = land_s + ABSORB_S;
        Self {
            jump,
            crouched_s,
            off_s,
            land_s,
            absorbed_s,
            rest_s: absorbed_s + RECOVER_S,
            down: Quintic::between(still(at(0.0, rest_m)), crouched, CROUCH_S),
            push: Quintic::between(crouched, off, PUSH_S),
            off,
            absorb: Quintic::between(landing, absorbed, ABSORB_S),
            recover: Quintic::between(absorbed, still(at(jump.ahead_m, rest_m)), RECOVER_S),
        }
    }

    fn hips_m(&self, secs: f32) -> Vec3 {
        let gravity = Vec3::new(0.0, -GRAVITY_M_S2, 0.0);
        if secs < self.crouched_s {
            self.down.at((secs - STAND_S).max(0.0))
        } else if secs < self.off_s {
            self.push.at(secs - self.crouched_s)
        } else if secs < self.land_s {
            let t = secs - self.off_s;
            self.off.value + self.off.rate * t + gravity * (0.5 * t * t)
        } else if secs < self.absorbed_s {
            self.absorb.at(secs - self.land_s)
        } else {
            self.recover.at((secs - self.absorbed_s).min(RECOVER_S))
        }
    }

    fn hips_rate_m_s(&self, secs: f32) -> Vec3 {
        const H: f32 = 0.004;
        (self.hips_m(secs + H) - self.hips_m(secs - H)) / (2.0 * H)
    }

    /// Pitch of the feet as they roll up before take-off.
    fn off_pitch(&self, secs: f32) -> State<f32> {
        let span = 0.45 * PUSH_S;
        let t = ((secs - self.off_s) / span + 1.0).clamp(0.0, 1.0);
        let p = OFF_PITCH_RAD;
        State { value: p * t * t, rate: 2.0 * p * t / span, accel: 2.0 * p / (span * span) }
    }

    fn foot(&self, side: Side, secs: f32) -> FootPose {
        let (from, to) = (rest_print(side, 0.0), rest_print(side, self.jump.ahead_m));
        if secs <= self.off_s {
            return from.rolled(self.off_pitch(secs).value);
        }
        if secs >= self.land_s {
            let t = (secs - self.land_s) / LAND_FLAT_S;
            return to.rolled(LAND_PITCH_RAD * (1.0 - smoothstep(t)));
        }
        // In the air the ankle moves relative to the hips, from where it leaves the floor to
        // where it meets it again, and is drawn up in between.
        let flight_s = self.land_s - self.off_s;
        let (t, at_s) = ((secs - self.off_s) / flight_s, secs - self.off_s);
        let leave = from.ankle_state(self.off_pitch(self.off_s));
        let still = State { value: LAND_PITCH_RAD, rate: 0.0, accel: 0.0 };
        let meet = to.ankle_state(still);
        let from_hips = |s: State<Vec3>, secs: f32| State {
            value: s.value - self.hips_m(secs),
            rate: s.rate - self.hips_rate_m_s(secs),
            accel: Vec3::ZERO,
        };
        let way =
            Quintic::between(from_hips(leave, self.off_s), from_hips(meet, self.land_s), flight_s);
        let s = 4.0 * t * (1.0 - t);
        let drawn_up = Vec3::new(0.0, 0.06 + 0.12 * self.jump.ahead_m, -0.05) * (s * s);
        let mut from_hip = way.at(at_s) + drawn_up - hip_from_hips(side);
        // Straight legs are approached, not hit.
        let reach_m = 0.99 * (THIGH_M + SHIN_M);
        let distance_m = from_hip.length();
        let soft_m = 0.03;
        if distance_m > reach_m - soft_m {
            let over = (distance_m - reach_m + soft_m) / soft_m;
            from_hip *= (reach_m - soft_m * (-over).exp()) / distance_m;
        }
        let ankle_m = self.hips_m(secs) + hip_from_hips(side) + from_hip;
        let point = OFF_PITCH_RAD + (LAND_PITCH_RAD - OFF_PITCH_RAD) * smoothstep(t);
        let turn = Quintic::between(
            State { value: 0.0, rate: self.off_pitch(self.off_s).rate, accel: 0.0 },
            State { value: 0.0, rate: 0.0, accel: 0.0 },
            flight_s,
        );
        FootPose {
            ankle_m: Vec3::new(ankle_m.x, ankle_m.y.max(ANKLE_HEIGHT_M), ankle_m.z),
            yaw_rad: from.yaw_rad,
            pitch_rad: point + 0.3 * turn.at(at_s),
            toe_bend_rad: -OFF_PITCH_RAD * (1.0 - smoothstep(t / 0.3))
                - LAND_PITCH_RAD * smoothstep((t - 0.7) / 0.3),
            planted: false,
        }
    }

    fn departure(&self, secs: f32) -> Departure {
        let span = |from: f32, to: f32| smoothstep((secs - from) / (to - from));
        let crouch = span(STAND_S, self.crouched_s) - span(self.crouched_s + 0.05, self.off_s);
        let absorb = span(self.land_s - 0.05, self.absorbed_s) - span(self.absorbed_s, self.rest_s);
        // Arms go back in the crouch, up with the push and come down in flight.
        let arms = Keys::new(
            Ease::Smooth,
            vec![
                (STAND_S, 0.0),
                (self.crouched_s - 0.12, -0.35),
                (self.off_s + 0.12, 1.55),
                (self.land_s + 0.06, 0.55),
                (self.absorbed_s + 0.1, 0.35),
                (self.rest_s, 0.0),
            ],
        )
        .at(secs);
        let flight = span(self.crouched_s, self.off_s) - span(self.land_s - 0.1, self.absorbed_s);
        let lean = 0.62 * crouch + 0.5 * absorb + 0.12 * flight * self.jump.ahead_m;
        let rest_m = rest_upper_body().hips_height_m;
        Departure {
            hips_m: self.hips_m(secs) - Vec3::Y * rest_m,
            lean: Quat::from_rotation_x(lean),
            arms: [arm_raised(arms), Vec3::new(0.0, -0.5 * flight - 0.15 * (crouch + absorb), 0.0)],
            spine: Vec3::X * (0.30 * crouch + 0.25 * absorb),
            gaze_rad: [0.0, 0.15 * crouch + 0.12 * absorb],
        }
    }
}

/// From the hips to a hip joint, for hips that are not turned.
fn hip_from_hips(side: Side) -> Vec3 {
    Vec3::new(sign(side) * LEFT_HIP_M.x, LEFT_HIP_M.y, LEFT_HIP_M.z)
}

/// What is added to a hanging left arm's rotation vector to swing it ahead by an angle.
fn arm_raised(angle_rad: f32) -> Vec3 {
    let rest = rest_upper_body().arms[0][0];
    let hanging = motion_core::rotation::exp(rest);
    let raised = Quat::from_rotation_x(-angle_rad.clamp(-PI, PI)) * hanging;
    motion_core::rotation::log(raised) - rest
}

impl Jump {
    pub(crate) fn take(&self) -> Take {
        let plan = Plan::new(*self);
        let secs = plan.rest_s + STAND_S;
        let n_shown = (secs * GRID_HZ as f32).round() as usize + 1;
        let mut poses: Vec<Pose> = (0..n_shown)
            .map(|i| {
                let secs = i as f32 / GRID_HZ as f32;
                let feet = Side::BOTH.map(|side| plan.foot(side, secs));
                plan.departure(secs).pose(feet)
            })
            .collect();
        lower_to_reach(&mut poses, GRID_HZ / 15);
        Take { poses, first: 0, n_shown }
    }
}
