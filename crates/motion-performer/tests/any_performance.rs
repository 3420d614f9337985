//! Whatever is asked for within reason, feet stay planted and legs whole.

use glam::Vec3;
use motion_core::contacts::{Side, toe_joint};
use motion_core::rotation;
use motion_core::skeleton::JointRole;
use motion_performer::{Ease, Keys, Performance, body, perform};
use proptest::prelude::*;

fn spec() -> impl Strategy<Value = Performance> {
    let speeds = (0.0f32..3.8, 0.0f32..3.8);
    let turns = (-1f32..1.0, -1f32..1.0);
    (speeds, turns, -3.2f32..3.2, 0f32..1.0).prop_map(|(speeds, turns, drift_rad, from_phase)| {
        // Sideways and backwards nobody runs.
        let forward = 0.5 + 0.5 * drift_rad.cos();
        let least = if drift_rad.abs() < 0.3 { 1.0 } else { 0.25 * forward };
        let speed = |v: f32| v * least;
        // The faster, the wider the turn: up to about 7 m/s² to the side.
        let most = 1.2 / speed(speeds.0.max(speeds.1)).max(1.0);
        let turns = (turns.0 * most, turns.1 * most);
        Performance {
            from_phase,
            cycles: 4.0,
            speed_m_s: Keys::new(
                Ease::Smooth,
                vec![(0.5, speed(speeds.0)), (3.5, speed(speeds.1))],
            ),
            heading_rad: Keys::new(Ease::Smooth, vec![(0.8, 0.0), (2.2, turns.0), (3.6, turns.1)]),
            drift_rad,
            ..Performance::straight(1.0, 4.0)
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn feet_stay_planted_and_legs_whole(spec in spec()) {
        let skeleton = body::skeleton().expect("the built-in body is a skeleton");
        let performed = perform(&spec).expect("the spec keeps the rules");
        let motion = &performed.motion;
        for side in Side::BOTH {
            let toe = toe_joint(&skeleton, side).expect("the built-in body has toes");
            let toe_m: Vec<Vec3> = motion.joint_path_m(&skeleton, toe);
            for f in 1..motion.n_frames() {
                let planted = [f - 1, f].map(|f| performed.contacts[f].side(side));
                if planted == [true, true] {
                    let moved_m = toe_m[f].distance(toe_m[f - 1]);
                    prop_assert!(moved_m < 1e-5, "{side:?} toes move {moved_m} at frame {f}");
                }
                prop_assert!(toe_m[f].y > 0.0249, "{side:?} toes at {} at frame {f}", toe_m[f].y);
            }
        }
        for role in [JointRole::LeftLeg, JointRole::RightLeg] {
            let knee = skeleton.by_role(role).expect("the built-in body has knees").idx();
            for f in 0..motion.n_frames() {
                let degrees = rotation::log(motion.rotations(f)[knee]).x.to_degrees();
                prop_assert!((13.0..150.0).contains(&degrees), "{role:?} at {degrees}°, frame {f}");
            }
        }
    }
}
