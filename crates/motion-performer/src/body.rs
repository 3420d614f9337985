//! The built-in body: a person of 1.75 m with Mixamo's joint names.
//!
//! Lengths follow the usual shares of body height (Winter, *Biomechanics and Motor Control of
//! Human Movement*: thigh 0.245 H, shin 0.246 H, hip joint at 0.53 H, shoulders at 0.82 H, upper
//! arm 0.186 H from the acromion, forearm 0.146 H), rounded to half centimetres. The legs are
//! as long as those of the person whose gait was measured (`gait_figures.rs`), so that measured
//! heights fit.
//!
//! Rest pose: T-pose facing +Z, Y up, +X to the left, every rotation the identity, the hips
//! joint at the origin and the soles [`HIPS_HEIGHT_M`] below it. Legs are straight and plumb, so
//! that a knee is a pure hinge about +X; arms lie along X. The body is its own mirror image.

use glam::Vec3;
use motion_core::contacts::Side;
use motion_core::ids::JointIdx;
use motion_core::skeleton::{Joint, Skeleton, SkeletonError};

/// Height of the hips joint over the soles in the rest pose.
pub const HIPS_HEIGHT_M: f32 = 0.99;
/// From the hips joint to the left hip joint; the right one mirrors it.
pub(crate) const LEFT_HIP_M: Vec3 = Vec3::new(0.092, -0.065, 0.0);
pub(crate) const THIGH_M: f32 = 0.42;
pub(crate) const SHIN_M: f32 = 0.425;
/// Height of the ankle over the sole of a flat foot: what is left below the legs.
pub(crate) const ANKLE_HEIGHT_M: f32 = HIPS_HEIGHT_M + LEFT_HIP_M.y - THIGH_M - SHIN_M;
/// From the ankle to the joint of the toes (the ball of the foot).
pub(crate) const TOE_FROM_ANKLE_M: Vec3 = Vec3::new(0.0, TOE_HEIGHT_M - ANKLE_HEIGHT_M, 0.125);
/// Height of the toe joint over the sole.
pub(crate) const TOE_HEIGHT_M: f32 = 0.025;
/// From the ankle to the lowest point of the heel, which the foot rolls over as it lands.
pub(crate) const HEEL_FROM_ANKLE_M: Vec3 = Vec3::new(0.0, -ANKLE_HEIGHT_M, -0.045);

/// +1 for the left side, −1 for the right: the sign of X.
#[inline]
pub(crate) fn sign(side: Side) -> f32 {
    match side {
        Side::Left => 1.0,
        Side::Right => -1.0,
    }
}

/// Joints of the built-in skeleton by position, parents first.
pub(crate) mod joint {
    pub(crate) const HIPS: usize = 0;
    pub(crate) const SPINE: usize = 1;
    pub(crate) const NECK: usize = 4;
    pub(crate) const HEAD: usize = 5;
    /// Shoulder, arm, forearm, hand follow each other.
    pub(crate) const SHOULDER: [usize; 2] = [6, 10];
    /// Thigh, shin, foot, toes follow each other.
    pub(crate) const UP_LEG: [usize; 2] = [14, 18];
    pub(crate) const COUNT: usize = 22;
}

/// The built-in skeleton.
///
/// The error is that of [`Skeleton::new`]; it does not happen (a test holds that) but a library
/// does not panic to say so.
pub fn skeleton() -> Result<Skeleton, SkeletonError> {
    let mut joints: Vec<Joint> = Vec::with_capacity(joint::COUNT);
    let mut add = |name: &str, parent: Option<usize>, offset_m: Vec3, end_site_m: Option<Vec3>| {
        joints.push(Joint {
            name: name.to_owned(),
            parent: parent.map(JointIdx::from_idx),
            offset_m,
            end_site_m,
        });
        joints.len() - 1
    };
    let up = |y: f32, z: f32| Vec3::new(0.0, y, z);

    let hips = add("Hips", None, Vec3::ZERO, None);
    let spine = add("Spine", Some(hips), up(0.09, -0.01), None);
    let spine1 = add("Spine1", Some(spine), up(0.115, -0.005), None);
    let spine2 = add("Spine2", Some(spine1), up(0.125, 0.0), None);
    let neck = add("Neck", Some(spine2), up(0.145, 0.0), None);
    add("Head", Some(neck), up(0.09, 0.015), Some(up(0.195, 0.01)));
    for side in Side::BOTH {
        let at = |x: f32, y: f32, z: f32| Vec3::new(sign(side) * x, y, z);
        let name = |part: &str| format!("{side:?}{part}");
        let shoulder = add(&name("Shoulder"), Some(spine2), at(0.055, 0.105, 0.0), None);
        let arm = add(&name("Arm"), Some(shoulder), at(0.125, 0.0, 0.0), None);
        let fore_arm = add(&name("ForeArm"), Some(arm), at(0.285, 0.0, 0.0), None);
        add(&name("Hand"), Some(fore_arm), at(0.25, 0.0, 0.0), Some(at(0.18, 0.0, 0.0)));
    }
    for side in Side::BOTH {
        let name = |part: &str| format!("{side:?}{part}");
        let hip = Vec3::new(sign(side) * LEFT_HIP_M.x, LEFT_HIP_M.y, LEFT_HIP_M.z);
        let up_leg = add(&name("UpLeg"), Some(hips), hip, None);
        let leg = add(&name("Leg"), Some(up_leg), up(-THIGH_M, 0.0), None);
        let foot = add(&name("Foot"), Some(leg), up(-SHIN_M, 0.0), None);
        add(&name("ToeBase"), Some(foot), TOE_FROM_ANKLE_M, Some(up(-0.005, 0.07)));
    }
    Skeleton::new(joints)
}

#[cfg(test)]
mod tests {
    use motion_core::skeleton::JointRole;

    use super::*;

    #[test]
    fn every_role_is_there_and_where_the_indices_say() {
        let skeleton = skeleton().unwrap();
        assert_eq!(skeleton.n_joints(), joint::COUNT);
        for &role in JointRole::ALL {
            assert!(skeleton.by_role(role).is_some(), "{role:?}");
        }
        let name = |idx: usize| skeleton.joints()[idx].name.as_str();
        assert_eq!(name(joint::HIPS), "Hips");
        assert_eq!(name(joint::SPINE), "Spine");
        assert_eq!((name(joint::NECK), name(joint::HEAD)), ("Neck", "Head"));
        for side in Side::BOTH {
            assert_eq!(name(joint::SHOULDER[side.idx()]), format!("{side:?}Shoulder"));
            assert_eq!(name(joint::SHOULDER[side.idx()] + 3), format!("{side:?}Hand"));
            assert_eq!(name(joint::UP_LEG[side.idx()]), format!("{side:?}UpLeg"));
            assert_eq!(name(joint::UP_LEG[side.idx()] + 3), format!("{side:?}ToeBase"));
        }
    }

    #[test]
    fn a_person_of_a_metre_seventy_five_stands_on_the_floor() {
        let skeleton = skeleton().unwrap();
        let rest = skeleton.rest_positions_m();
        let height = rest[joint::HEAD].y + 0.195 + HIPS_HEIGHT_M;
        assert!((height - 1.75).abs() < 0.011, "{height}");
        let toe = rest[joint::UP_LEG[0] + 3];
        assert!((toe.y + HIPS_HEIGHT_M - TOE_HEIGHT_M).abs() < 1e-6, "toe joint at {toe}");
    }

    #[test]
    fn the_body_is_its_own_mirror_image() {
        let skeleton = skeleton().unwrap();
        let rest = skeleton.rest_positions_m();
        for (idx, joint) in skeleton.joints().iter().enumerate() {
            let role = JointRole::from_name(&joint.name).unwrap();
            let other = rest[skeleton.by_role(role.opposite()).unwrap().idx()];
            assert_eq!(rest[idx] * Vec3::new(-1.0, 1.0, 1.0), other, "{}", joint.name);
        }
    }
}
