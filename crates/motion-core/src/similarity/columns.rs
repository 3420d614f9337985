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

/// Feet are heavier than hands: a foot that jumps slides on the floor, where everyone sees it.
/// Parts that move with a heavier neighbour (toes of a foot, shoulders of a chest) are left out
/// or light. A column that is left out has weight 0.
const ROLE_WEIGHTS: &[(JointRole, f64)] = &[
    (JointRole::Hips, 1.0),
    (JointRole::Spine1, 0.5),
    (JointRole::Head, 0.5),
    (JointRole::LeftArm, 0.25),
    (JointRole::RightArm, 0.25),
    (JointRole::LeftForeArm, 0.35),
    (JointRole::RightForeArm, 0.35),
    (JointRole::LeftHand, 0.35),
    (JointRole::RightHand, 0.35),
    (JointRole::LeftLeg, 0.8),
    (JointRole::RightLeg, 0.8),
    (JointRole::LeftFoot, 1.2),
    (JointRole::RightFoot, 1.2),
    (JointRole::LeftToeBase, 1.2),
    (JointRole::RightToeBase, 1.2),
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
