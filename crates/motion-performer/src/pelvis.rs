//! The path of the hips: what the body's middle does between the feet and the plan.

use glam::{Quat, Vec2, Vec3};

use crate::foot_plan::support_m;
use crate::foot_pose::FootPose;
use crate::signal::gaussian;
use crate::travel::{GRID_HZ, Moment, Travel};

const GRAVITY_M_S2: f32 = 9.81;
/// The weight goes over the foot that carries: this share of the way, smoothed over this time.
/// Chosen so that a walk sways by the measured 2 cm to each side.
const SWAY: f32 = 0.55;
const SWAY_SIGMA_S: f32 = 0.20;
const LEAN_SIGMA_S: f32 = 0.12;
/// Height of what leans over the feet: the hips.
const LEAN_HEIGHT_M: f32 = 0.93;
/// In a turn the hips take this share of the lean that balances it, and never more than the
/// second figure: beyond, feet that stay on the path would pull the hips to the floor.
const TURN_LEAN: f32 = 0.85;
const MOST_LEAN_RAD: f32 = 0.5;
/// Speeding up tilts the trunk by this share of the balancing angle.
const SPEED_LEAN: f32 = 0.45;

/// Where the hips are led, apart from height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lead {
    pub(crate) ground_m: Vec2,
    /// Heading and lean, before the swing of the hips themselves.
    pub(crate) world_from_lean: Quat,
    /// Sideways lean (rotation about the heading), for the spine to give back a part of.
    pub(crate) roll_rad: f32,
}

/// The lead of every moment of a travel, given both feet at every moment.
pub(crate) fn leads(travel: &Travel, feet: &[Vec<FootPose>; 2]) -> Vec<Lead> {
    let moments = &travel.moments;
    let hz = GRID_HZ as f32;
    let smooth = |raw: Vec<f32>, sigma_s: f32| gaussian(&raw, sigma_s * hz);

    let aside = |(m, s): (&Moment, &Vec2)| (*s - m.ground_m).dot(m.left());
    let sway = smooth(moments.iter().zip(&support_m(feet)).map(aside).collect(), SWAY_SIGMA_S);

    let to_center = |m: &Moment| {
        let balanced_rad = (m.speed_m_s * m.turn_rad_s / GRAVITY_M_S2).atan();
        MOST_LEAN_RAD * (TURN_LEAN * balanced_rad / MOST_LEAN_RAD).tanh()
    };
    let roll = smooth(moments.iter().map(to_center).collect(), LEAN_SIGMA_S);

    let forward = travel.drift_rad.cos();
    let last = moments.len() - 1;
    let speeding_up = |i: usize| {
        let (a, b) = (&moments[i.saturating_sub(1)], &moments[(i + 1).min(last)]);
        let accel_m_s2 = (b.speed_m_s - a.speed_m_s) * 0.5 * hz * forward;
        SPEED_LEAN * (accel_m_s2 / GRAVITY_M_S2).atan()
    };
    let pitch = smooth((0..=last).map(speeding_up).collect(), LEAN_SIGMA_S);

    moments
        .iter()
        .enumerate()
        .map(|(i, m)| {
            // Positive roll about +Z tips the head to the right; a left turn leans left.
            let roll_rad = -roll[i];
            Lead {
                ground_m: m.ground_m + m.left() * (SWAY * sway[i] + LEAN_HEIGHT_M * roll[i].tan()),
                world_from_lean: Quat::from_rotation_y(m.heading_rad)
                    * Quat::from_rotation_z(roll_rad)
                    * Quat::from_rotation_x(pitch[i]),
                roll_rad,
            }
        })
        .collect()
}

/// A point over the ground.
pub(crate) fn over(ground_m: Vec2, height_m: f32) -> Vec3 {
    Vec3::new(ground_m.x, height_m, ground_m.y)
}
