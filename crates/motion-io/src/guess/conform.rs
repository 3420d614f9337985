//! Bringing a body to metres, Y up, and a rest pose that looks along +Z.

use glam::Quat;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;

/// What is to be done to a skeleton and its motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conform {
    /// Factor of all lengths.
    pub scale: f32,
    /// Turn of the world: paths and root.
    pub world_from_file: Quat,
    /// Turn of the rest pose.
    pub canonical_from_rest: Quat,
}

impl Conform {
    /// Nothing is to be done.
    pub const NONE: Self =
        Self { scale: 1.0, world_from_file: Quat::IDENTITY, canonical_from_rest: Quat::IDENTITY };
}

/// The same body and motion in the new terms.
///
/// With A the turn of the rest pose and W that of the world, an offset o becomes A·o, a joint's
/// world rotation R becomes W·R·A⁻¹, so a local one A·r·A⁻¹ (the root's: W·r·A⁻¹), and every
/// joint's position p becomes W·p, all lengths scaled. The seen motion is the same.
pub fn conform(skeleton: Skeleton, mut motion: Motion, how: &Conform) -> (Skeleton, Motion) {
    if *how == Conform::NONE {
        return (skeleton, motion);
    }
    let Conform { scale, world_from_file, canonical_from_rest } = *how;
    for position in motion.root_positions_m_mut() {
        *position = world_from_file * *position * scale;
    }
    if world_from_file != Quat::IDENTITY || canonical_from_rest != Quat::IDENTITY {
        let rest_from_canonical = canonical_from_rest.inverse();
        for frame in 0..motion.n_frames() {
            for (idx, rotation) in motion.rotations_mut(frame).iter_mut().enumerate() {
                let left = if idx == 0 { world_from_file } else { canonical_from_rest };
                *rotation = (left * *rotation * rest_from_canonical).normalize();
            }
        }
    }
    (conform_skeleton(skeleton, how), motion)
}

/// The same body in the new terms, without a motion.
pub fn conform_skeleton(skeleton: Skeleton, how: &Conform) -> Skeleton {
    let Conform { scale, canonical_from_rest, .. } = *how;
    let roles = skeleton.roles().clone();
    let mut joints = skeleton.joints().to_vec();
    for joint in &mut joints {
        joint.offset_m = canonical_from_rest * joint.offset_m * scale;
        joint.end_site_m = joint.end_site_m.map(|end| canonical_from_rest * end * scale);
    }
    // Turning and scaling keeps every rule of a skeleton but finiteness, and lengths are limited
    // when a file is read; should it fail all the same, the body stays as it was.
    Skeleton::new(joints).map_or(skeleton, |new| new.with_roles(roles))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use motion_core::rotation;
    use motion_core::units::Fps;

    use super::*;
    use crate::guess::test_body::body;

    #[test]
    fn every_joint_goes_where_the_world_goes() {
        let skeleton = body(1.0);
        let n = skeleton.n_joints();
        let rotations: Vec<Quat> = (0..2 * n)
            .map(|i| rotation::exp(Vec3::new(0.1 * i as f32, 0.5, -0.05 * i as f32)))
            .collect();
        let motion =
            Motion::new(Fps::THIRTY, n, vec![Vec3::ONE, Vec3::new(1.0, 2.0, 3.0)], rotations)
                .unwrap();
        let how = Conform {
            scale: 2.0,
            world_from_file: Quat::from_rotation_x(-1.5),
            canonical_from_rest: Quat::from_rotation_y(0.7),
        };
        let before = motion.joint_positions_m(&skeleton);
        let (skeleton, motion) = conform(skeleton, motion, &how);
        for (a, b) in before.into_iter().zip(motion.joint_positions_m(&skeleton)) {
            assert!((how.world_from_file * a * 2.0).distance(b) < 1e-5);
        }
    }
}
