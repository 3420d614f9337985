//! The foot plan: where each foot stands, from when to when.
//!
//! A foot stands where the body is when the hips pass over it, half a stance width to its side
//! and toed out a little. Feet therefore alternate, follow the path around turns, come closer
//! on the inside and farther on the outside by themselves, and end up side by side where the
//! body stops.

use glam::Vec2;

use crate::body::sign;
use crate::foot_pose::{FootPose, Print};
use crate::signal::{State, smoothstep};
use crate::travel::{GRID_HZ, Moment, Travel};
use motion_core::contacts::Side;

/// Half the distance between the ankles' tracks: standing, walking, running.
const HALF_WIDTH_M: [f32; 3] = [0.095, 0.065, 0.05];
/// How far the toes point out: standing, walking, running.
const TOE_OUT_RAD: [f32; 3] = [0.14, 0.10, 0.06];
/// Walking backwards lands on the toes and lifts the whole sole.
const BACK_STRIKE_PITCH_RAD: f32 = 0.30;
const BACK_OFF_PITCH_RAD: f32 = 0.0;
/// How the pitch of a stepping, not striding, foot compares.
const STAND_STRIKE_PITCH_RAD: f32 = -0.10;
const STAND_OFF_PITCH_RAD: f32 = 0.28;

/// One foot's stay on the floor. Times are seconds on the travel's grid; a stance that began
/// before or ends after everything planned has infinite ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stance {
    pub(crate) strike_s: f32,
    pub(crate) flat_s: f32,
    pub(crate) heel_off_s: f32,
    pub(crate) off_s: f32,
    pub(crate) print: Print,
    pub(crate) strike_pitch_rad: f32,
    pub(crate) off_pitch_rad: f32,
    /// The speed that sets the gait as the foot lifts.
    pub(crate) gait_speed_m_s: f32,
}

impl Stance {
    /// The foot's pitch during the stance: down onto the sole in an S, up onto the toes with a
    /// power of time, as measured.
    pub(crate) fn pitch(&self, secs: f32) -> State<f32> {
        const POWER: f32 = 2.0;
        if secs < self.flat_s {
            let span = self.flat_s - self.strike_s;
            if !span.is_finite() {
                return State { value: 0.0, rate: 0.0, accel: 0.0 };
            }
            let t = ((secs - self.strike_s) / span).clamp(0.0, 1.0);
            let p = self.strike_pitch_rad;
            return State {
                value: p * (1.0 - smoothstep(t)),
                rate: -p * 6.0 * t * (1.0 - t) / span,
                accel: -p * 6.0 * (1.0 - 2.0 * t) / (span * span),
            };
        }
        if secs > self.heel_off_s {
            let span = self.off_s - self.heel_off_s;
            let t = ((secs - self.heel_off_s) / span).clamp(0.0, 1.0);
            let p = self.off_pitch_rad;
            return State {
                value: p * t.powf(POWER),
                rate: p * POWER * t.powf(POWER - 1.0) / span,
                accel: p * POWER * (POWER - 1.0) * t.powf(POWER - 2.0) / (span * span),
            };
        }
        State { value: 0.0, rate: 0.0, accel: 0.0 }
    }

    pub(crate) fn pose(&self, secs: f32) -> FootPose {
        self.print.rolled(self.pitch(secs).value)
    }
}

/// The stances of one foot in order of time, at least one.
pub(crate) fn stances(travel: &Travel, side: Side) -> Vec<Stance> {
    // The right foot's cycle is half a cycle late.
    let offset = if side == Side::Left { 0.0 } else { 0.5 };
    let cycle = |m: &Moment| m.phase + offset;
    let (Some(first), Some(last)) = (travel.moments.first(), travel.moments.last()) else {
        return Vec::new();
    };
    let first_cycle = cycle(first).floor() as i32 - 1;
    let last_cycle = cycle(last).ceil() as i32;

    (first_cycle..=last_cycle)
        .filter_map(|k| {
            let crossing = |event: &dyn Fn(&Moment) -> f32| {
                crossing_s(travel, &|m| cycle(m) - k as f32 - event(m))
            };
            let strike_s = crossing(&|m| m.gait().events().strike);
            let off_s = crossing(&|m| m.gait().events().toe_off);
            if strike_s == f32::INFINITY || off_s == f32::NEG_INFINITY {
                return None;
            }
            let over_s = crossing(&|m| m.gait().events().over);
            let over = travel.at(over_s * GRID_HZ as f32);
            let forward = travel.drift_rad.cos();
            let pitch = |secs: f32, ahead: &dyn Fn(&Moment) -> f32, back: f32| {
                let moment = travel.at(secs * GRID_HZ as f32);
                let share = moment.gait().stride();
                if forward >= 0.0 { ahead(moment) * forward } else { -forward * back * share }
            };
            Some(Stance {
                strike_s,
                flat_s: crossing(&|m| m.gait().events().flat),
                heel_off_s: crossing(&|m| m.gait().events().heel_off),
                off_s,
                print: print(over, side, travel.drift_rad),
                strike_pitch_rad: pitch(
                    strike_s,
                    &|m| m.gait().mix(STAND_STRIKE_PITCH_RAD, |g| g.strike_pitch_rad),
                    BACK_STRIKE_PITCH_RAD,
                ),
                off_pitch_rad: pitch(
                    off_s,
                    &|m| m.gait().mix(STAND_OFF_PITCH_RAD, |g| g.off_pitch_rad),
                    BACK_OFF_PITCH_RAD,
                ),
                gait_speed_m_s: travel.at(off_s * GRID_HZ as f32).gait_speed_m_s,
            })
        })
        .collect()
}

/// Where a foot stands when the hips pass over it at `over`.
pub(crate) fn print(over: &Moment, side: Side, drift_rad: f32) -> Print {
    let gait = over.gait();
    let by_gait = |of: [f32; 3]| {
        let walking = gait.mix(of[0], |_| of[1]);
        walking + (of[2] - of[1]) * gait.run()
    };
    // Sideways, the feet would cross: they are spread by what the body moves in half a step.
    let sideways_m_s = (over.speed_m_s * drift_rad.sin()).abs();
    let half_width_m = by_gait(HALF_WIDTH_M) + 0.25 * sideways_m_s * gait.cycle_s();
    Print {
        ground_m: over.ground_m + over.left() * (sign(side) * half_width_m),
        yaw_rad: over.heading_rad + sign(side) * by_gait(TOE_OUT_RAD),
    }
}

/// When `value` rises through 0, in seconds on the grid; infinite where it is above from the
/// start or stays below.
fn crossing_s(travel: &Travel, value: &dyn Fn(&Moment) -> f32) -> f32 {
    let moments = &travel.moments;
    // Phase grows with time and events move little, so the sign changes once.
    let after = moments.partition_point(|m| value(m) < 0.0);
    if after == 0 {
        return f32::NEG_INFINITY;
    }
    if after == moments.len() {
        return f32::INFINITY;
    }
    let (a, b) = (value(&moments[after - 1]), value(&moments[after]));
    (after as f32 - b / (b - a)) / GRID_HZ as f32
}

/// The ground to which a weight shift leads: the mean of the feet that carry, sample by sample.
/// Where no foot carries, the line between the feet around the flight is followed.
pub(crate) fn support_m(feet: &[Vec<FootPose>; 2]) -> Vec<Vec2> {
    let n = feet[0].len().min(feet[1].len());
    let ground = |f: &FootPose| Vec2::new(f.ankle_m.x, f.ankle_m.z);
    let mut support: Vec<Option<Vec2>> = Vec::with_capacity(n);
    for (left, right) in feet[0].iter().zip(&feet[1]) {
        support.push(match (carries(left), carries(right)) {
            (true, true) => Some((ground(left) + ground(right)) * 0.5),
            (true, false) => Some(ground(left)),
            (false, true) => Some(ground(right)),
            (false, false) => None,
        });
    }
    let mut filled = Vec::with_capacity(n);
    let mut before: Option<(usize, Vec2)> = None;
    for i in 0..n {
        if let Some(here) = support[i] {
            before = Some((i, here));
            filled.push(here);
            continue;
        }
        let next = (i..n).find_map(|j| support[j].map(|s| (j, s)));
        filled.push(match (before, next) {
            (Some((a, pa)), Some((b, pb))) => pa.lerp(pb, (i - a) as f32 / (b - a) as f32),
            (Some((_, p)), None) | (None, Some((_, p))) => p,
            (None, None) => Vec2::ZERO,
        });
    }
    filled
}

/// A foot carries while it is on the floor, heel or toe.
fn carries(foot: &FootPose) -> bool {
    foot.planted || foot.pitch_rad < 0.0 && foot.ankle_m.y < 0.1
}
