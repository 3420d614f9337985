//! People of 22 joints: in a T-pose, in an A-pose, and with every bone along one axis.

use glam::{Quat, Vec3};

use crate::ids::JointIdx;
use crate::motion::Motion;
use crate::rotation;
use crate::skeleton::{Joint, Skeleton};
use crate::units::Fps;

/// Name, parent, and offset in a T-pose, metres.
const T_POSE: [(&str, Option<u32>, [f32; 3]); 22] = [
    ("Hips", None, [0.0, 0.0, 0.0]),
    ("LeftUpLeg", Some(0), [0.1, -0.05, 0.0]),
    ("LeftLeg", Some(1), [0.0, -0.42, 0.0]),
    ("LeftFoot", Some(2), [0.0, -0.41, 0.0]),
    ("LeftToe", Some(3), [0.0, -0.06, 0.14]),
    ("RightUpLeg", Some(0), [-0.1, -0.05, 0.0]),
    ("RightLeg", Some(5), [0.0, -0.42, 0.0]),
    ("RightFoot", Some(6), [0.0, -0.41, 0.0]),
    ("RightToe", Some(7), [0.0, -0.06, 0.14]),
    ("Spine", Some(0), [0.0, 0.08, 0.0]),
    ("Spine1", Some(9), [0.0, 0.12, 0.0]),
    ("Spine2", Some(10), [0.0, 0.12, 0.0]),
    ("Neck", Some(11), [0.0, 0.2, 0.0]),
    ("Head", Some(12), [0.0, 0.12, 0.0]),
    ("LeftShoulder", Some(11), [0.04, 0.15, 0.0]),
    ("LeftArm", Some(14), [0.13, 0.0, 0.0]),
    ("LeftForeArm", Some(15), [0.29, 0.0, 0.0]),
    ("LeftHand", Some(16), [0.25, 0.0, 0.0]),
    ("RightShoulder", Some(11), [-0.04, 0.15, 0.0]),
    ("RightArm", Some(18), [-0.13, 0.0, 0.0]),
    ("RightForeArm", Some(19), [-0.29, 0.0, 0.0]),
    ("RightHand", Some(20), [-0.25, 0.0, 0.0]),
];

fn body(offset_m: impl Fn(usize, Vec3) -> Vec3) -> Skeleton {
    let joints = T_POSE.iter().enumerate().map(|(idx, &(name, parent, offset))| Joint {
        name: name.to_owned(),
        parent: parent.map(JointIdx),
        offset_m: offset_m(idx, offset.into()),
        end_site_m: None,
    });
    Skeleton::new(joints.collect()).expect("valid by construction")
}

/// A grown-up times `scale`, arms straight out.
pub(crate) fn t_pose(scale: f32) -> Skeleton {
    body(|_, offset| offset * scale)
}

/// The same body with its arms at 45° and its feet a little apart.
pub(crate) fn a_pose(scale: f32) -> Skeleton {
    body(|idx, offset| {
        let lean = match idx {
            16 | 17 => -std::f32::consts::FRAC_PI_4,
            20 | 21 => std::f32::consts::FRAC_PI_4,
            2 | 3 => 0.15,
            6 | 7 => -0.15,
            _ => 0.0,
        };
        Quat::from_rotation_z(lean) * offset * scale
    })
}

/// The same lengths with the bones of limbs and back all along +Y, as files have them whose zero
/// pose is no pose.
pub(crate) fn along_one_axis() -> Skeleton {
    body(|idx, offset| match idx {
        0 | 1 | 5 | 14 | 18 => offset,
        _ => Vec3::Y * offset.length(),
    })
}

/// Twelve frames of a body whose zero pose is no pose: it bends and straightens, upright in
/// frame 7, at a heading of `heading_rad`.
pub(crate) fn standing_motion(skeleton: &Skeleton, heading_rad: f32) -> Motion {
    let half_turn = Quat::from_rotation_x(std::f32::consts::PI);
    let rotations = (0..12).flat_map(|frame| {
        let bend = 0.1 * (frame as f32 - 7.0).abs();
        (0..skeleton.n_joints()).map(move |idx| match idx {
            0 => Quat::from_rotation_y(heading_rad),
            1 | 5 => half_turn * Quat::from_rotation_x(-bend),
            2 | 6 => Quat::from_rotation_x(2.0 * bend),
            3 | 7 => Quat::from_rotation_x(-1.1),
            15 => Quat::from_rotation_z(-std::f32::consts::FRAC_PI_2),
            19 => Quat::from_rotation_z(std::f32::consts::FRAC_PI_2),
            _ => Quat::IDENTITY,
        })
    });
    let rotations = rotations.collect();
    Motion::new(Fps::THIRTY, skeleton.n_joints(), vec![Vec3::Y; 12], rotations)
        .expect("valid by construction")
}

/// Forty frames in which every joint swings its own way and the body goes its way.
pub(crate) fn lively(skeleton: &Skeleton) -> Motion {
    let n_frames = 40;
    let rotations = (0..n_frames).flat_map(|frame| {
        (0..skeleton.n_joints()).map(move |idx| {
            let (frame, idx) = (frame as f32, idx as f32);
            let wave = |k: f32| 0.35 * (0.13 * k * frame + idx * k).sin();
            rotation::exp(Vec3::new(wave(1.0), wave(1.7), wave(2.3)))
        })
    });
    let rotations = rotations.collect();
    let roots =
        (0..n_frames).map(|f| Vec3::new(0.03 * f as f32, 0.9, 1.0 - 0.02 * f as f32)).collect();
    Motion::new(Fps::THIRTY, skeleton.n_joints(), roots, rotations).expect("valid by construction")
}
