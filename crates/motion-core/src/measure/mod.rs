//! How good a motion is: the figures of `measure` (`docs/files.md`), one function each.
//!
//! Everything is in metres, seconds and radians here; files and the command line show
//! centimetres and degrees. A figure that a motion has no occasion for (slide without plants) is
//! `None`. [`DEFINITIONS`] says in words what each figure is.

pub mod dynamics;
pub mod feet;
pub mod seams;
pub mod support;

use crate::motion::Motion;
use crate::skeleton::Skeleton;
use crate::units::Fps;
pub use feet::{Skate, Slide};
pub use support::Support;

/// The quality figures of one motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Frames of the motion.
    pub n_frames: usize,
    /// Its rate.
    pub fps: Fps,
    /// Slide by the plain rule that fits motions of any origin.
    pub slide: Option<Slide>,
    /// Slide judged on the contacts that came with the motion, where some did.
    pub carried_slide: Option<Slide>,
    /// Deepest that a sole is below its support, metres.
    pub penetration_max_m: Option<f32>,
    /// Highest that a planted sole is above its support, metres.
    pub float_max_m: Option<f32>,
    /// The field's skate figures.
    pub skate: Option<Skate>,
    /// Largest speed of any joint, m/s.
    pub joint_speed_max_m_s: f32,
    /// 99th percentile of joint accelerations, m/s².
    pub joint_acceleration_p99_m_s2: f32,
    /// 99th percentile of joint jerks, m/s³.
    pub joint_jerk_p99_m_s3: f32,
    /// Largest change of a joint's rotation between neighbouring frames, radians.
    pub rotation_step_max_rad: f32,
    /// Length of the root's way over the ground, metres.
    pub travel_m: f32,
    /// Change of the heading from the first frame to the last, radians, left positive; whole
    /// turns count.
    pub turn_rad: f32,
}

/// Each figure's name in files and its definition in use, in the order of the report.
pub const DEFINITIONS: &[(&str, &str)] = &[
    ("foot_slide_cm_per_s", feet::SLIDE_DEFINITION),
    ("foot_slide_max_cm", feet::SLIDE_MAX_DEFINITION),
    ("foot_slide_carried_cm_per_s", feet::CARRIED_SLIDE_DEFINITION),
    ("planted", crate::contacts::LOWEST_DEFINITION),
    ("carried", crate::contacts::DEFINITION),
    ("ground_penetration_max_cm", support::PENETRATION_DEFINITION),
    ("float_max_cm", support::FLOAT_DEFINITION),
    ("skate_ratio", feet::SKATE_DEFINITION),
    ("skate_ratio_kimodo", feet::SKATE_KIMODO_DEFINITION),
    ("toe_speed_below_5cm_m_s", feet::LOW_TOE_DEFINITION),
    ("joint_speed_max_m_s", dynamics::SPEED_DEFINITION),
    ("joint_acceleration_p99_m_s2", dynamics::ACCELERATION_DEFINITION),
    ("joint_jerk_p99_m_s3", dynamics::JERK_DEFINITION),
    ("rotation_step_max_deg", dynamics::ROTATION_STEP_DEFINITION),
    ("travel_m", dynamics::TRAVEL_DEFINITION),
    ("turn_deg", dynamics::TURN_DEFINITION),
    ("seam_acceleration_ratio", seams::DEFINITION),
];

/// Measures a motion. With `carried`, support and contacts are taken from there; without, the
/// support is found from the motion's own plants ([`Support::found_in`]).
pub fn measure(skeleton: &Skeleton, motion: &Motion, carried: Option<&Support>) -> Quality {
    let positions_m = motion.joint_positions_m(skeleton);
    let toes = feet::toe_paths_m(skeleton, motion);
    let found;
    let support = match carried {
        Some(support) => support,
        None => {
            found = Support::found_in(skeleton, motion);
            &found
        }
    };
    let fps = motion.fps();
    Quality {
        n_frames: motion.n_frames(),
        fps,
        slide: feet::slide(&toes, fps),
        carried_slide: carried.and_then(|support| feet::carried_slide(&toes, fps, support)),
        penetration_max_m: support::penetration_max_m(&toes, support),
        float_max_m: support::float_max_m(&toes, support),
        skate: feet::skate(&toes, fps, support),
        joint_speed_max_m_s: dynamics::speed_max_m_s(&positions_m, motion),
        joint_acceleration_p99_m_s2: dynamics::acceleration_p99_m_s2(&positions_m, motion),
        joint_jerk_p99_m_s3: dynamics::jerk_p99_m_s3(&positions_m, motion),
        rotation_step_max_rad: dynamics::rotation_step_max_rad(motion),
        travel_m: dynamics::travel_m(motion),
        turn_rad: dynamics::turn_rad(motion),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Walk, legs};

    #[test]
    fn a_walk_with_planted_feet_measures_as_one() {
        let walk = Walk { n_frames: 121, speed_m_s: 0.5, turn_rad_s: 0.25, phase: 0.0 }.motion();
        let quality = measure(&legs(), &walk, None);
        let slide = quality.slide.expect("plants");
        assert!(slide.mean_m_s < 0.02, "{slide:?}");
        assert!(quality.penetration_max_m.is_some_and(|m| m < 0.005), "{quality:?}");
        assert!(quality.float_max_m.is_some_and(|m| m < 0.02), "{quality:?}");
        assert!((quality.travel_m - 2.0).abs() < 0.01, "{}", quality.travel_m);
        assert!((quality.turn_rad - 1.0).abs() < 0.01, "{}", quality.turn_rad);
        assert_eq!(quality.carried_slide, None);
    }

    #[test]
    fn one_frame_of_one_joint_is_measured_too() {
        use crate::testing::joint;
        let dot = Skeleton::new(vec![joint("dot", None, [0.0; 3])]).expect("one joint");
        let at = vec![glam::Vec3::Y];
        let motion =
            Motion::new(Fps::THIRTY, 1, at, vec![glam::Quat::IDENTITY]).expect("one frame");
        let quality = measure(&dot, &motion, None);
        assert_eq!((quality.slide, quality.skate, quality.penetration_max_m), (None, None, None));
        assert_eq!((quality.travel_m, quality.joint_jerk_p99_m_s3), (0.0, 0.0));
    }

    #[test]
    fn every_definition_has_a_name_of_its_own() {
        let mut names: Vec<&str> = DEFINITIONS.iter().map(|(name, _)| *name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), DEFINITIONS.len());
    }
}
