//! What the built-in library promises, clip by clip.

use std::sync::LazyLock;

use glam::Vec3;
use motion_core::clip::{Clip, ClipSet};
use motion_core::contacts::{Side, toe_joint};
use motion_core::rotation;
use motion_core::skeleton::JointRole;
use motion_performer::builtin_clips;

/// Height of the toe joint over a flat sole.
const TOE_HEIGHT_M: f32 = 0.025;

/// The library is made once for all tests.
static LIBRARY: LazyLock<ClipSet> =
    LazyLock::new(|| builtin_clips().expect("the built-in library can be made"));

fn has(clip: &Clip, tag: &str) -> bool {
    clip.tags.iter().any(|t| t == tag)
}

/// World path of a role's joint.
fn path_m(clip: &Clip, role: JointRole) -> Vec<Vec3> {
    let skeleton = LIBRARY.skeleton();
    let joint = skeleton.by_role(role).expect("the built-in body has every role");
    clip.motion.joint_path_m(skeleton, joint)
}

fn toe_path_m(clip: &Clip, side: Side) -> Vec<Vec3> {
    let skeleton = LIBRARY.skeleton();
    let toe = toe_joint(skeleton, side).expect("the built-in body has toes");
    clip.motion.joint_path_m(skeleton, toe)
}

fn ankle_path_m(clip: &Clip, side: Side) -> Vec<Vec3> {
    match side {
        Side::Left => path_m(clip, JointRole::LeftFoot),
        Side::Right => path_m(clip, JointRole::RightFoot),
    }
}

/// How far a foot's sole is tilted off the level in each frame, radians.
fn tilt_rad(clip: &Clip, side: Side) -> Vec<f32> {
    let skeleton = LIBRARY.skeleton();
    let role = match side {
        Side::Left => JointRole::LeftFoot,
        Side::Right => JointRole::RightFoot,
    };
    let foot = skeleton.by_role(role).expect("the built-in body has feet").idx();
    let (mut at, mut rotations) = (Vec::new(), Vec::new());
    (0..clip.n_frames())
        .map(|f| {
            clip.motion.forward_kinematics(skeleton, f, &mut at, &mut rotations);
            let up = rotations[foot] * Vec3::Y;
            up.x.hypot(up.z)
        })
        .collect()
}

fn planted(clip: &Clip, side: Side) -> Vec<bool> {
    clip.track.contacts.iter().map(|c| c.side(side)).collect()
}

/// Largest acceleration over all frames of the joints whose names `which` picks, m/s².
fn worst_accel_m_s2(clip: &Clip, which: fn(&str) -> bool) -> (f32, String) {
    let skeleton = LIBRARY.skeleton();
    let n = skeleton.n_joints();
    let at = clip.motion.joint_positions_m(skeleton);
    let mut worst = (0.0, String::new());
    for (joint, name) in skeleton.joints().iter().map(|j| &j.name).enumerate() {
        for frame in (1..clip.n_frames() - 1).filter(|_| which(name)) {
            let [a, b, c] = [frame - 1, frame, frame + 1].map(|f| at[f * n + joint]);
            let accel = (c - b * 2.0 + a).length() * 900.0;
            if accel > worst.0 {
                worst = (accel, format!("{name} at frame {frame}"));
            }
        }
    }
    worst
}

fn is_leg(name: &str) -> bool {
    ["Leg", "Foot", "Toe"].iter().any(|part| name.contains(part))
}

#[test]
fn there_are_forty_clips_of_all_kinds() {
    let clips = LIBRARY.clips();
    assert!(clips.len() >= 40, "{} clips", clips.len());
    for (tag, least) in [
        ("walk", 15),
        ("run", 10),
        ("turn", 18),
        ("start", 4),
        ("stop", 4),
        ("spot", 6),
        ("sidestep", 2),
        ("back", 2),
        ("jump", 2),
        ("idle", 2),
    ] {
        let n = clips.iter().filter(|clip| has(clip, tag)).count();
        assert!(n >= least, "{n} clips are tagged {tag}");
    }
    for clip in clips {
        let secs = clip.motion.fps().duration_secs(clip.n_frames());
        assert!((1.9..=5.5).contains(&secs), "{} lasts {secs} s", clip.id);
        assert!(!clip.tags.is_empty(), "{} has no tags", clip.id);
        assert!(clip.track.world_from_torso.iter().all(|t| t.level_m == 0.0));
    }
}

#[test]
fn the_library_is_always_the_same() {
    assert_eq!(builtin_clips().expect("can be made again"), *LIBRARY);
}

#[test]
fn planted_feet_do_not_move() {
    let mut n_flat = 0;
    for clip in LIBRARY.clips() {
        for side in Side::BOTH {
            let (toe, ankle) = (toe_path_m(clip, side), ankle_path_m(clip, side));
            let (planted, tilt) = (planted(clip, side), tilt_rad(clip, side));
            let at = |f: usize| format!("{} {side:?} at frame {f}", clip.id);
            // Where the plant began: drift counts over the whole of it, not frame by frame.
            let mut began = 0;
            for f in 0..clip.n_frames() {
                if !planted[f] {
                    began = f + 1;
                    continue;
                }
                let drift_m = toe[f].distance(toe[began]);
                assert!(drift_m < 1e-5, "{}: the toe joint drifts {drift_m}", at(f));
                assert!((toe[f].y - TOE_HEIGHT_M).abs() < 1e-5, "{}: off the floor", at(f));
                let flat = |f: usize| tilt[f] < 3e-5;
                if f > began && flat(f) && flat(f - 1) {
                    n_flat += 1;
                    let moved_m = ankle[f].distance(ankle[f - 1]);
                    assert!(moved_m < 1e-5, "{}: a flat foot's ankle moves {moved_m}", at(f));
                }
            }
        }
    }
    assert!(n_flat > 2000, "the flat phase was seen in {n_flat} frames only");
}

#[test]
fn no_part_of_a_foot_is_in_the_floor() {
    for clip in LIBRARY.clips() {
        for side in Side::BOTH {
            for (f, (toe, ankle)) in
                toe_path_m(clip, side).iter().zip(ankle_path_m(clip, side)).enumerate()
            {
                assert!(toe.y > TOE_HEIGHT_M - 1e-4, "{} frame {f}: toe at {}", clip.id, toe.y);
                assert!(ankle.y > 0.075, "{} frame {f}: ankle at {}", clip.id, ankle.y);
            }
        }
    }
}

#[test]
fn knees_bend_one_way_and_not_too_far() {
    let skeleton = LIBRARY.skeleton();
    for clip in LIBRARY.clips() {
        for role in [JointRole::LeftLeg, JointRole::RightLeg] {
            let knee = skeleton.by_role(role).expect("the built-in body has knees").idx();
            for f in 0..clip.n_frames() {
                let bend = rotation::log(clip.motion.rotations(f)[knee]);
                let degrees = bend.x.to_degrees();
                assert!((13.0..130.0).contains(&degrees), "{} frame {f}: {degrees}°", clip.id);
                assert!(bend.y.abs() + bend.z.abs() < 1e-3, "{} frame {f}: {bend}", clip.id);
            }
        }
    }
}

/// Limits taken from captured motion at 30 frames per second: walks of CMU subject 16 reach 40 to
/// 70 m/s² at the feet, his runs 60 to 110.
#[test]
fn nothing_pops() {
    for clip in LIBRARY.clips() {
        let (feet_m_s2, upper_m_s2) = if has(clip, "run") {
            (100.0, 40.0)
        } else if has(clip, "jump") {
            (80.0, 80.0)
        } else {
            (65.0, 20.0)
        };
        let (feet, at) = worst_accel_m_s2(clip, is_leg);
        assert!(feet < feet_m_s2, "{}: {feet} m/s² of {at}", clip.id);
        let (upper, at) = worst_accel_m_s2(clip, |name| !is_leg(name));
        assert!(upper < upper_m_s2, "{}: {upper} m/s² of {at}", clip.id);
    }
}

#[test]
fn no_joint_turns_or_travels_too_fast() {
    let skeleton = LIBRARY.skeleton();
    let n = skeleton.n_joints();
    for clip in LIBRARY.clips() {
        let at = clip.motion.joint_positions_m(skeleton);
        for f in 1..clip.n_frames() {
            for j in 0..n {
                let name = &skeleton.joints()[j].name;
                let speed = at[f * n + j].distance(at[(f - 1) * n + j]) * 30.0;
                assert!(speed < 10.0, "{} frame {f}: {name} at {speed} m/s", clip.id);
                let [a, b] = [f - 1, f].map(|f| clip.motion.rotations(f)[j]);
                let step = rotation::angle_between_rad(a, b).to_degrees();
                // A body that lands from a jump at 2.5 m/s has to bend its knees this fast.
                let limit = if has(clip, "jump") { 36.0 } else { 30.0 };
                assert!(step < limit, "{} frame {f}: {name} turns by {step}°", clip.id);
            }
        }
    }
}

#[test]
fn turns_turn_by_their_angle() {
    let mut n_checked = 0;
    for clip in LIBRARY.clips().iter().filter(|clip| has(clip, "turn") && !has(clip, "start")) {
        let degrees: f32 =
            clip.id.rsplit('_').next().and_then(|d| d.parse().ok()).expect("an angle in the id");
        let wished = if has(clip, "left") { degrees } else { -degrees };
        let track = &clip.track.world_from_torso;
        let turned: f32 =
            track.windows(2).map(|pair| (pair[0].inverse() * pair[1]).heading_rad()).sum();
        let turned = turned.to_degrees();
        assert!((turned - wished).abs() < 2.0, "{} turns by {turned}°", clip.id);
        n_checked += 1;
    }
    assert_eq!(n_checked, 18);
}

#[test]
fn straight_gait_goes_at_its_speed() {
    for (id, speed_m_s) in
        [("walk_slow", 0.95), ("walk", 1.3), ("walk_fast", 1.75), ("jog", 2.5), ("run", 3.4)]
    {
        let clip = LIBRARY.clip(LIBRARY.by_id(id).expect(id));
        let hips = clip.motion.root_positions_m();
        let way = hips[clip.n_frames() - 1] - hips[0];
        let secs = clip.motion.fps().duration_secs(clip.n_frames()) as f32;
        let speed = way.z / secs;
        assert!((speed - speed_m_s).abs() < 0.03 * speed_m_s, "{id} goes at {speed} m/s");
        assert!(way.x.abs() < 0.05, "{id} strays by {} m", way.x);
    }
}

#[test]
fn feet_take_turns() {
    for clip in LIBRARY.clips().iter().filter(|clip| has(clip, "walk") || has(clip, "run")) {
        let plants = Side::BOTH.map(|side| planted(clip, side));
        let mut onsets = Vec::new();
        for f in 1..clip.n_frames() {
            for side in Side::BOTH {
                if plants[side.idx()][f] && !plants[side.idx()][f - 1] {
                    onsets.push((f, side));
                }
            }
        }
        assert!(onsets.len() >= 4, "{}: {} steps", clip.id, onsets.len());
        for pair in onsets.windows(2) {
            assert_ne!(pair[0].1, pair[1].1, "{}: {pair:?} with one foot", clip.id);
        }
    }
}

#[test]
fn walkers_keep_a_foot_on_the_floor_and_runners_fly() {
    for clip in LIBRARY.clips() {
        let in_air: Vec<bool> = clip.track.contacts.iter().map(|c| !c.any()).collect();
        let longest = in_air.split(|&air| !air).map(<[bool]>::len).max().unwrap_or(0);
        if has(clip, "run") && has(clip, "straight") {
            assert!((3..=8).contains(&longest), "{}: {longest} frames without a plant", clip.id);
        } else if !has(clip, "run") && !has(clip, "jump") {
            // Between the lift of one foot's toes and the other's, which comes down on its heel.
            assert!(longest <= 2, "{}: {longest} frames without a plant", clip.id);
        }
    }
}

#[test]
fn jumps_fall_freely() {
    for (id, rise_m, ahead_m) in
        [("jump_up", 0.32, 0.0), ("jump_forward", 0.20, 0.75), ("jump_far", 0.24, 1.15)]
    {
        let clip = LIBRARY.clip(LIBRARY.by_id(id).expect(id));
        let hips = clip.motion.root_positions_m();
        let flight: Vec<usize> =
            (0..clip.n_frames()).filter(|&f| !clip.track.contacts[f].any()).collect();
        assert!(flight.len() >= 10, "{id} flies {} frames", flight.len());
        for &f in &flight[1..flight.len() - 1] {
            let accel = (hips[f + 1] - hips[f] * 2.0 + hips[f - 1]) * 900.0;
            assert!(accel.distance(Vec3::new(0.0, -9.81, 0.0)) < 0.1, "{id} frame {f}: {accel}");
        }
        let top_m = hips.iter().map(|p| p.y).fold(0.0, f32::max);
        assert!((top_m - 1.025 - rise_m).abs() < 0.01, "{id} rises to {top_m}");
        let way = hips[clip.n_frames() - 1] - hips[0];
        assert!((way.z - ahead_m).abs() < 1e-3, "{id} lands {} m ahead", way.z);
    }
}

#[test]
fn arms_swing_against_legs() {
    for id in ["walk", "run"] {
        let clip = LIBRARY.clip(LIBRARY.by_id(id).expect(id));
        let hips = clip.motion.root_positions_m();
        let ahead = |role: JointRole| -> Vec<f32> {
            path_m(clip, role).iter().zip(hips).map(|(p, h)| p.z - h.z).collect()
        };
        for (hand, foot) in [
            (JointRole::LeftHand, JointRole::LeftFoot),
            (JointRole::RightHand, JointRole::RightFoot),
        ] {
            let r = correlation(&ahead(hand), &ahead(foot));
            assert!(r < -0.6, "{id}: {hand:?} and {foot:?} go together by {r}");
        }
    }
}

fn correlation(a: &[f32], b: &[f32]) -> f32 {
    let mean = |v: &[f32]| v.iter().sum::<f32>() / v.len() as f32;
    let (ma, mb) = (mean(a), mean(b));
    let dot = |f: &dyn Fn(f32, f32) -> f32| a.iter().zip(b).map(|(&x, &y)| f(x, y)).sum::<f32>();
    let cov = dot(&|x, y| (x - ma) * (y - mb));
    cov / (dot(&|x, _| (x - ma).powi(2)) * dot(&|_, y| (y - mb).powi(2))).sqrt()
}

/// A motion graph can leave and enter every clip: near its first and last frames there is a
/// frame of another clip with nearly the same pose and nearly the same movement.
#[test]
fn every_clip_connects_to_others() {
    let skeleton = LIBRARY.skeleton();
    let n = skeleton.n_joints();
    // Joints about the torso frame, at a frame and at the next one.
    let poses: Vec<Vec<Vec<Vec3>>> = LIBRARY
        .clips()
        .iter()
        .map(|clip| {
            let at = clip.motion.joint_positions_m(skeleton);
            let frame = |f: usize| {
                let torso = clip.track.world_from_torso[f].inverse();
                at[f * n..(f + 1) * n].iter().map(|&p| torso.apply(p)).collect::<Vec<Vec3>>()
            };
            (0..clip.n_frames()).map(frame).collect()
        })
        .collect();
    let apart =
        |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f32::max);
    for (i, clip) in LIBRARY.clips().iter().enumerate() {
        for f in [0, clip.n_frames() - 2] {
            let nearest = poses
                .iter()
                .enumerate()
                .filter(|&(j, _)| j != i)
                .flat_map(|(_, other)| other.windows(2))
                .map(|pair| apart(&poses[i][f], &pair[0]).max(apart(&poses[i][f + 1], &pair[1])))
                .fold(f32::INFINITY, f32::min);
            assert!(nearest < 0.08, "{} frame {f}: the next pose is {nearest} m off", clip.id);
        }
    }
}
