//! What a mannequin is built from: where joints are when the body stands, and what they are.

use glam::{Quat, Vec3};

/// Half of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// At +X of a body that looks along +Z.
    Left,
    /// At −X.
    Right,
}

impl Side {
    /// Left, then right.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// 0 for left, 1 for right.
    pub fn idx(self) -> usize {
        self as usize
    }
}

/// What a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BodyPart {
    /// The pelvis.
    Hips,
    /// A link of the back; there may be several.
    Spine,
    /// The neck.
    Neck,
    /// The head.
    Head,
    /// From the chest to the shoulder.
    Collar(Side),
    /// From the shoulder to the elbow.
    UpperArm(Side),
    /// From the elbow to the wrist.
    Forearm(Side),
    /// The hand below the wrist.
    Hand(Side),
    /// From the hip joint to the knee.
    Thigh(Side),
    /// From the knee to the ankle.
    Shin(Side),
    /// From the ankle to the ball of the foot.
    Foot(Side),
    /// What is before the ball of the foot.
    Toes(Side),
}

/// One joint of a [`BodyPlan`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanJoint {
    /// The joint that carries it: an index into [`BodyPlan::joints`], smaller than its own.
    pub parent: Option<usize>,
    /// Where it is in the bind pose, metres, with the floor at y = 0.
    pub position_m: Vec3,
    /// `world_from_joint` in the bind pose.
    pub world_from_joint: Quat,
    /// Where the bone of a joint without children ends in the bind pose, metres.
    pub end_m: Option<Vec3>,
    /// What it moves; `None` for fingers, helpers, tails.
    pub part: Option<BodyPart>,
}

/// A body that stands: Y up, looking along +Z, its left at +X, the floor at y = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPlan {
    /// Parents before children.
    pub joints: Vec<PlanJoint>,
    /// How high each toe joint (the ankle where there is none) is above the sole below it,
    /// metres; left, right. A foot stands on the floor exactly when its joint is this high.
    pub sole_m: [f32; 2],
}
