//! A body for tests.

use glam::{Quat, Vec3};
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::skeleton::{Joint, Skeleton};
use motion_core::units::Fps;

/// A grown-up in a T-pose, hips 0.93 m high, facing +Z with Y up, times `scale`.
pub(crate) fn body(scale: f32) -> Skeleton {
    let joints = [
        ("Hips", None, [0.0, 0.0, 0.0]),
        ("LeftUpLeg", Some(0), [0.09, -0.06, 0.0]),
        ("LeftLeg", Some(1), [0.0, -0.40, 0.0]),
        ("LeftFoot", Some(2), [0.0, -0.41, 0.0]),
        ("RightUpLeg", Some(0), [-0.09, -0.06, 0.0]),
        ("RightLeg", Some(4), [0.0, -0.40, 0.0]),
        ("RightFoot", Some(5), [0.0, -0.41, 0.0]),
        ("Spine", Some(0), [0.0, 0.25, 0.0]),
        ("Neck", Some(7), [0.0, 0.25, 0.01]),
        ("Head", Some(8), [0.0, 0.12, 0.02]),
        ("LeftArm", Some(7), [0.18, 0.2, 0.0]),
        ("LeftForeArm", Some(10), [0.28, 0.0, 0.0]),
        ("LeftHand", Some(11), [0.25, 0.0, 0.0]),
        ("RightArm", Some(7), [-0.18, 0.2, 0.0]),
        ("RightForeArm", Some(13), [-0.28, 0.0, 0.0]),
        ("RightHand", Some(14), [-0.25, 0.0, 0.0]),
    ];
    let joints = joints.map(|(name, parent, offset): (&str, Option<u32>, [f32; 3])| Joint {
        name: name.to_owned(),
        parent: parent.map(JointIdx),
        offset_m: Vec3::from(offset) * scale,
        end_site_m: None,
    });
    Skeleton::new(joints.to_vec()).unwrap()
}

/// The same body with its rest pose turned.
pub(crate) fn turned(skeleton: &Skeleton, turn: Quat) -> Skeleton {
    let mut joints = skeleton.joints().to_vec();
    for joint in &mut joints {
        joint.offset_m = turn * joint.offset_m;
    }
    Skeleton::new(joints).unwrap()
}

/// Five frames of the rest pose with the root turned.
pub(crate) fn still(skeleton: &Skeleton, root: Quat) -> Motion {
    let n = skeleton.n_joints();
    let mut motion =
        Motion::new(Fps::THIRTY, n, vec![Vec3::ZERO; 5], vec![Quat::IDENTITY; 5 * n]).unwrap();
    for frame in 0..5 {
        motion.rotations_mut(frame)[0] = root;
    }
    motion
}
