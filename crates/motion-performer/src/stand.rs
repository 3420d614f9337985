//! Standing at the origin: where idling and jumping begin and end, and gait comes to rest.

use glam::{Quat, Vec2, Vec3};

use crate::body::sign;
use crate::foot_plan::print;
use crate::foot_pose::{FootPose, Print};
use crate::gait_curves::{Gait, UpperBody};
use crate::perform::HEAD_DIP_RAD;
use crate::pose::Pose;
use crate::travel::Moment;
use motion_core::contacts::Side;

/// Where a foot of a body at rest stands, `ahead_m` in front of the origin.
pub(crate) fn rest_print(side: Side, ahead_m: f32) -> Print {
    let at_rest = Moment {
        phase: 0.0,
        ground_m: Vec2::new(0.0, ahead_m),
        heading_rad: 0.0,
        turn_rad_s: 0.0,
        speed_m_s: 0.0,
        gait_speed_m_s: 0.0,
    };
    print(&at_rest, side, 0.0)
}

/// Trunk and arms at rest.
pub(crate) fn rest_upper_body() -> UpperBody {
    Gait::at_speed(0.0).upper_body(0.0, 1.0)
}

/// A pose on given feet that departs from rest by what is said; looks along +Z.
pub(crate) struct Departure {
    /// Added to the hips' place at rest.
    pub(crate) hips_m: Vec3,
    /// Rotation of the hips about the world.
    pub(crate) lean: Quat,
    /// Added to the rotation vectors of arm and forearm, as for the left arm.
    pub(crate) arms: [Vec3; 2],
    /// Added to the rotation vector of spine, spine1 and spine2, in equal parts.
    pub(crate) spine: Vec3,
    /// Where the head looks: turn to the left and dip.
    pub(crate) gaze_rad: [f32; 2],
}

impl Departure {
    pub(crate) fn pose(&self, feet: [FootPose; 2]) -> Pose {
        let mut upper = rest_upper_body();
        for side in Side::BOTH {
            let mirror = Vec3::new(1.0, sign(side), sign(side));
            for (part, added) in upper.arms[side.idx()].iter_mut().zip(self.arms) {
                *part += added * mirror;
            }
        }
        for part in &mut upper.trunk[1..] {
            *part += self.spine / 3.0;
        }
        let [turn, dip] = self.gaze_rad;
        let gaze = Quat::from_rotation_y(turn) * Quat::from_rotation_x(HEAD_DIP_RAD + dip);
        let hips_m = self.hips_m + Vec3::Y * upper.hips_height_m;
        Pose::new(hips_m, self.lean, &upper, gaze, feet)
    }
}
