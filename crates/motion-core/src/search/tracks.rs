//! How far bodies reach and where their middle is, frame by frame: a look at this spares most looks at
//! joints.

use glam::{Vec2, Vec3};

/// A cylinder around the torso frame's upright that holds every joint, and their mean.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Extent {
    /// Its radius, metres.
    pub(crate) reach_m: f32,
    /// Its height over the level of the support, metres.
    pub(crate) top_m: f32,
    /// The mean of the joints, in the torso frame.
    pub(crate) middle_m: Vec3,
}

impl Extent {
    /// Of joints in the torso frame.
    pub(crate) fn of(joints_m: &[Vec3]) -> Self {
        let middle_m = joints_m.iter().sum::<Vec3>() / joints_m.len().max(1) as f32;
        let mut extent = Self { reach_m: 0.0, top_m: f32::NEG_INFINITY, middle_m };
        for joint in joints_m {
            extent.reach_m = extent.reach_m.max(Vec2::new(joint.x, joint.z).length());
            extent.top_m = extent.top_m.max(joint.y);
        }
        extent
    }
}
