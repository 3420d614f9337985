//! A foot through time: stances, and the swings between them.
//!
//! A swing takes its shape (how far along, how high, how pitched at which share of the swing)
//! from the measured gait at the speed of the step, and is then bent by a polynomial of degree
//! five so that position and velocity are those of the rolling foot at both ends. (Acceleration is
//! left alone: matched too, the polynomial would wander far in a long swing.)
//! Two bumps keep it clear: up from the floor and aside from the other leg.

use glam::{Quat, Vec2, Vec3};
use motion_core::planar::wrap_angle_rad;

use crate::body::{HEEL_FROM_ANKLE_M, TOE_FROM_ANKLE_M, TOE_HEIGHT_M, sign};
use crate::foot_plan::Stance;
use crate::foot_pose::{FootPose, Print};
use crate::gait_curves::{Gait, Harmonics};
use crate::signal::{Quintic, State, smoothstep};
use motion_core::contacts::Side;

/// Dip of the measured foot when flat.
const FLAT_DIP_RAD: f32 = 0.37;
/// A foot that only steps lifts this share of a walking foot's height and pitch.
const STAND_LIFT: f32 = 0.30;
const STAND_PITCH: f32 = 0.20;
/// The least distance between sole and floor in mid-swing.
const CLEARANCE_M: f32 = 0.015;
/// The least distance between the ankles as one passes the other, and how far ahead and behind
/// of the standing foot that counts as passing.
const PASSING_M: f32 = 0.10;
const PASSING_SPAN_M: f32 = 0.30;
/// Shortest time that a swing may take; shorter ones come of specs that no body can follow.
const MIN_SWING_S: f32 = 0.05;

/// From one stance of a foot to the next.
#[derive(Clone, Debug)]
struct Swing {
    from_s: f32,
    duration_s: f32,
    start: Vec3,
    travel: Vec3,
    yaw_rad: [f32; 2],
    gait: Gait,
    /// Phases of lift and landing, and the measured foot's progress there.
    phases: [f32; 2],
    progress: [f32; 2],
    /// Share of the measured height and pitch.
    lift: f32,
    pitch: f32,
    mend: Quintic<Vec3>,
    mend_pitch: Quintic<f32>,
    bump: Vec3,
    toe_bend_rad: [f32; 2],
}

impl Swing {
    fn new(side: Side, from: &Stance, to: &Stance, forward: f32, other: &[Stance]) -> Self {
        let gait = Gait::at_speed(0.5 * (from.gait_speed_m_s + to.gait_speed_m_s));
        let events = gait.events();
        let stride = gait.stride();
        let (pitch_off, pitch_on) = (from.pitch(from.off_s), to.pitch(to.strike_s));
        let (a, b) = (from.print.ankle_state(pitch_off), to.print.ankle_state(pitch_on));
        let turn = wrap_angle_rad(to.print.yaw_rad - from.print.yaw_rad);
        let duration_s = (to.strike_s - from.off_s).max(MIN_SWING_S);
        let nothing = State { value: Vec3::ZERO, rate: Vec3::ZERO, accel: Vec3::ZERO };
        let level = State { value: 0.0, rate: 0.0, accel: 0.0 };
        let phases = [events.toe_off, events.strike + 1.0];
        let mut swing = Self {
            from_s: from.off_s,
            duration_s,
            start: a.value,
            travel: b.value - a.value,
            yaw_rad: [from.print.yaw_rad, from.print.yaw_rad + turn],
            gait,
            phases,
            progress: phases.map(|p| progress(gait, p, &Harmonics::at(p))),
            lift: STAND_LIFT + (1.0 - STAND_LIFT) * stride,
            pitch: (STAND_PITCH + (1.0 - STAND_PITCH) * stride) * forward.max(0.0),
            mend: Quintic::between(nothing, nothing, duration_s),
            mend_pitch: Quintic::between(level, level, duration_s),
            bump: Vec3::ZERO,
            toe_bend_rad: [-pitch_off.value.max(0.0), -pitch_on.value.max(0.0)],
        };
        let missing = |wished: State<Vec3>, shape: State<Vec3>| State {
            value: wished.value - shape.value,
            rate: wished.rate - shape.rate,
            accel: Vec3::ZERO,
        };
        swing.mend = Quintic::between(
            missing(a, state(&|t| swing.shape(t), 0.0, duration_s)),
            missing(b, state(&|t| swing.shape(t), 1.0, duration_s)),
            duration_s,
        );
        let missing = |wished: State<f32>, shape: State<f32>| State {
            value: wished.value - shape.value,
            rate: wished.rate - shape.rate,
            accel: 0.0,
        };
        swing.mend_pitch = Quintic::between(
            missing(pitch_off, state(&|t| swing.pitch_shape(t), 0.0, duration_s)),
            missing(pitch_on, state(&|t| swing.pitch_shape(t), 1.0, duration_s)),
            duration_s,
        );
        swing.keep_clear(side, other);
        swing
    }

    /// The measured way at share `t` of the swing.
    fn shape(&self, t: f32) -> Vec3 {
        let phase = self.phase(t);
        let at = Harmonics::at(phase);
        let share = (progress(self.gait, phase, &at) - self.progress[0])
            / (self.progress[1] - self.progress[0]);
        let height = self.lift * self.gait.moving(|g| g.ankle_height.at(&at));
        let way = self.travel * share;
        Vec3::new(self.start.x + way.x, height, self.start.z + way.z)
    }

    fn pitch_shape(&self, t: f32) -> f32 {
        let at = Harmonics::at(self.phase(t));
        self.pitch * (self.gait.moving(|g| g.foot_pitch.at(&at)) - FLAT_DIP_RAD)
    }

    fn phase(&self, t: f32) -> f32 {
        self.phases[0] + (self.phases[1] - self.phases[0]) * t
    }

    fn pose(&self, secs: f32) -> FootPose {
        let t = ((secs - self.from_s) / self.duration_s).clamp(0.0, 1.0);
        let at_s = t * self.duration_s;
        let u = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
        let bend_rad = self.toe_bend_rad[0] * (1.0 - smoothstep(t / 0.45))
            + self.toe_bend_rad[1] * smoothstep((t - 0.6) / 0.4);
        FootPose {
            ankle_m: self.shape(t) + self.mend.at(at_s) + self.bump * bump(t),
            yaw_rad: self.yaw_rad[0] + (self.yaw_rad[1] - self.yaw_rad[0]) * u,
            pitch_rad: self.pitch_shape(t) + self.mend_pitch.at(at_s),
            toe_bend_rad: bend_rad,
            planted: false,
        }
        .with_toes_off_the_floor()
    }

    /// Adds what keeps the sole off the floor and the ankle off the other leg.
    fn keep_clear(&mut self, side: Side, other: &[Stance]) {
        const SAMPLES: usize = 24;
        let (mut lift_m, mut push_m, mut aside) = (0.0f32, 0.0f32, Vec3::ZERO);
        for i in 2..=SAMPLES - 2 {
            let t = i as f32 / SAMPLES as f32;
            let secs = self.from_s + t * self.duration_s;
            let foot = self.pose(secs);
            let (turn, ankle) = (foot.rotation(), foot.ankle_m);
            let toe_m = (ankle + turn * TOE_FROM_ANKLE_M).y - TOE_HEIGHT_M;
            let heel_m = (ankle + turn * HEEL_FROM_ANKLE_M).y;
            let wished_m = CLEARANCE_M * bump(t);
            lift_m = lift_m.max((wished_m - toe_m.min(heel_m)) / bump(t));

            let standing = other.iter().find(|s| s.strike_s <= secs && secs <= s.off_s);
            if let Some(standing) = standing {
                let (outwards, lacking_m) = lacking_gap(side, standing.print, ankle);
                let push = lacking_m / bump(t).max(0.3);
                if push > push_m {
                    (push_m, aside) = (push, outwards);
                }
            }
        }
        self.bump = aside * push_m.min(PASSING_M) + Vec3::Y * lift_m;
    }
}

/// The direction away from a standing foot to the side of the swinging one, and how much is
/// lacking of a gap as it passes.
fn lacking_gap(side: Side, standing: Print, ankle: Vec3) -> (Vec3, f32) {
    let turn = Quat::from_rotation_y(standing.yaw_rad);
    let outwards = turn * (Vec3::X * sign(side));
    let from_standing = ankle - Vec3::new(standing.ground_m.x, 0.0, standing.ground_m.y);
    // Far ahead or behind there is nothing to pass.
    let along = from_standing.dot(turn * Vec3::Z) / PASSING_SPAN_M;
    let wished_m = PASSING_M * (1.0 - along * along).max(0.0);
    (outwards, wished_m - from_standing.dot(outwards))
}

/// How far a foot of the measured gait has come at a phase, metres. Stepping in place was not
/// measured: it borrows the walk's share of the way.
fn progress(gait: Gait, phase: f32, at: &Harmonics) -> f32 {
    gait.moving(|g| phase * g.speed_m_s * g.cycle_s + g.ankle_ahead.at(at))
}

/// `64 t³ (1 − t)³`: 1 in the middle, 0 with two derivatives at the ends.
fn bump(t: f32) -> f32 {
    let s = 4.0 * t * (1.0 - t);
    s * s * s
}

/// Value and derivatives in time of a shape over its share, by central differences.
fn state<T>(shape: &dyn Fn(f32) -> T, t: f32, duration_s: f32) -> State<T>
where
    T: Copy
        + std::ops::Add<Output = T>
        + std::ops::Sub<Output = T>
        + std::ops::Mul<f32, Output = T>,
{
    const H: f32 = 0.02;
    let (a, b, c) = (shape(t - H), shape(t), shape(t + H));
    let per_s = 1.0 / (H * duration_s);
    State { value: b, rate: (c - a) * (0.5 * per_s), accel: (c - b * 2.0 + a) * (per_s * per_s) }
}

/// One foot for all time.
#[derive(Clone, Debug)]
pub(crate) struct FootTrack {
    stances: Vec<Stance>,
    /// `swings[i]` leads from stance `i` to stance `i + 1`.
    swings: Vec<Swing>,
}

impl FootTrack {
    /// A foot that goes through `stances` (at least one); `forward` is the cosine of the drift,
    /// and `other` are the stances of the other foot, to pass by.
    pub(crate) fn new(side: Side, stances: Vec<Stance>, forward: f32, other: &[Stance]) -> Self {
        let swings = stances
            .windows(2)
            .map(|pair| Swing::new(side, &pair[0], &pair[1], forward, other))
            .collect();
        Self { stances, swings }
    }

    pub(crate) fn pose(&self, secs: f32) -> FootPose {
        let started = self.stances.partition_point(|s| s.strike_s <= secs);
        let Some(last) = started.checked_sub(1) else {
            return self.stances.first().map_or_else(
                || Print { ground_m: Vec2::ZERO, yaw_rad: 0.0 }.rolled(0.0),
                |s| s.pose(s.strike_s),
            );
        };
        let stance = &self.stances[last];
        if secs <= stance.off_s {
            return stance.pose(secs);
        }
        match self.swings.get(last) {
            Some(swing) => swing.pose(secs),
            None => stance.pose(stance.off_s),
        }
    }
}
