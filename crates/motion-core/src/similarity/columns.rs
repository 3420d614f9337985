//! What a frame is compared by: columns of three numbers, and how much each counts.

use crate::ids::JointIdx;
use crate::skeleton::{JointRole, Skeleton};

/// What a column measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnSource {
    /// A joint's position in the torso frame; derived: its velocity there.
    Joint(JointIdx),
    /// The root's velocity, turned into the torso frame; derived: its acceleration.
    TorsoVelocity,
    /// The root's rotational velocity, turned into the torso frame; derived: its acceleration.
    TorsoTurn,
}

/// A column of `D` and of `Ḋ` with its weights (AF02 equation 5).
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The joint's name, `torso velocity` or `torso turn`.
    pub name: String,
    /// What is measured.
    pub source: ColumnSource,
    /// `M_k`: weight of the column itself.
    pub weight: f64,
    /// `W_k`: weight of its time derivative.
    pub derivative_weight: f64,
}

/// Feet are much heavier than hands: a foot that jumps slides on the floor, where everyone sees
/// it, while an arm can be eased over a second. Parts that move with a heavier neighbour
/// (shoulders of a chest, hip joints of the hips) have weight 0 and are left out.
const ROLE_WEIGHTS: &[(JointRole, f64)] = &[
    (JointRole::Hips, 0.5),
    (JointRole::Spine1, 0.25),
    (JointRole::Head, 0.25),
    (JointRole::LeftArm, 0.1),
    (JointRole::RightArm, 0.1),
    (JointRole::LeftForeArm, 0.1),
    (JointRole::RightForeArm, 0.1),
    (JointRole::LeftHand, 0.1),
    (JointRole::RightHand, 0.1),
    (JointRole::LeftLeg, 2.0),
    (JointRole::RightLeg, 2.0),
    (JointRole::LeftFoot, 4.0),
    (JointRole::RightFoot, 4.0),
    (JointRole::LeftToeBase, 4.0),
    (JointRole::RightToeBase, 4.0),
];

/// How much the derivative of a column counts against the column itself.
const DERIVATIVE_SHARE: f64 = 0.5;

/// How much each of the two torso velocities counts.
const TORSO_WEIGHT: f64 = 1.5;

/// The columns for `skeleton`: the joints with a role (all joints, equally, on a body without
/// recognised legs), then the two torso velocities.
pub fn metric_columns(skeleton: &Skeleton) -> Vec<Column> {
    let human = skeleton.by_role(JointRole::LeftFoot).is_some()
        && skeleton.by_role(JointRole::RightFoot).is_some();
    let mut columns = Vec::new();
    for (idx, joint) in skeleton.joints().iter().enumerate() {
        let joint_idx = JointIdx::from_idx(idx);
        let weight = if human {
            let role = skeleton.roles().role_of(joint_idx);
            ROLE_WEIGHTS.iter().find(|(r, _)| Some(*r) == role).map_or(0.0, |&(_, w)| w)
        } else {
            8.0 / skeleton.n_joints() as f64
        };
        if weight > 0.0 {
            columns.push(Column {
                name: joint.name.clone(),
                source: ColumnSource::Joint(joint_idx),
                weight,
                derivative_weight: weight * DERIVATIVE_SHARE,
            });
        }
    }
    for (name, source) in
        [("torso velocity", ColumnSource::TorsoVelocity), ("torso turn", ColumnSource::TorsoTurn)]
    {
        columns.push(Column {
            name: name.to_owned(),
            source,
            weight: TORSO_WEIGHT,
            derivative_weight: TORSO_WEIGHT * DERIVATIVE_SHARE,
        });
    }
    columns
}
