//! Bodies: a tree of joints with a rest pose.

pub mod mirror;
pub mod names;
pub mod roles;
mod shape;

use std::collections::HashMap;

use glam::Vec3;

use crate::ids::JointIdx;
pub use roles::{JointRole, RoleMap};

/// One joint of a [`Skeleton`].
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The joint's name, unique in its skeleton.
    pub name: String,
    /// The joint that carries this one; `None` for the root.
    pub parent: Option<JointIdx>,
    /// Where the joint sits in its parent's space, metres. For the root: usually zero.
    pub offset_m: Vec3,
    /// Where the bone of a leaf joint ends, in the joint's space, metres.
    pub end_site_m: Option<Vec3>,
}

/// A tree of joints.
///
/// Invariants, checked by [`Skeleton::new`]:
/// 1. There is at least one joint, and the first has no parent.
/// 2. Every other joint has a parent with a smaller index (parents before children).
/// 3. Names are not empty and unique.
/// 4. Offsets and end sites are finite.
///
/// The rest pose has every local rotation at identity; in a library it faces +Z with Y up.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    joints: Vec<Joint>,
    roles: RoleMap,
}

/// Why a list of joints is no skeleton.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SkeletonError {
    /// Rule 1: no joints.
    #[error("a skeleton needs at least one joint")]
    Empty,
    /// Rules 1 and 2: a second root, or a parent that comes after its child.
    #[error("joint {0:?} has no parent among the joints before it")]
    Parent(String),
    /// Rule 3.
    #[error("two joints have the name {0:?}, or it is empty")]
    Name(String),
    /// Rule 4.
    #[error("joint {0:?} has an offset that is not a finite number")]
    Offset(String),
}

impl Skeleton {
    /// A skeleton from its joints, parents first. Roles are recognised from the names and, where
    /// these say nothing, from the shape of the tree.
    pub fn new(joints: Vec<Joint>) -> Result<Self, SkeletonError> {
        if joints.is_empty() {
            return Err(SkeletonError::Empty);
        }
        let mut seen = HashMap::new();
        for (idx, joint) in joints.iter().enumerate() {
            if joint.name.is_empty() || seen.insert(joint.name.as_str(), idx).is_some() {
                return Err(SkeletonError::Name(joint.name.clone()));
            }
            let parent_ok = match joint.parent {
                None => idx == 0,
                Some(parent) => parent.idx() < idx,
            };
            if !parent_ok {
                return Err(SkeletonError::Parent(joint.name.clone()));
            }
            if !joint.offset_m.is_finite() || joint.end_site_m.is_some_and(|e| !e.is_finite()) {
                return Err(SkeletonError::Offset(joint.name.clone()));
            }
        }
        let mut roles = RoleMap::from_names(joints.iter().map(|j| j.name.as_str()));
        shape::complete(&joints, &mut roles);
        Ok(Self { joints, roles })
    }

    /// The same skeleton with roles set by hand.
    #[must_use]
    pub fn with_roles(mut self, roles: RoleMap) -> Self {
        self.roles = roles;
        self
    }

    /// The joints, parents before children.
    #[inline]
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// How many joints there are.
    #[inline]
    pub fn n_joints(&self) -> usize {
        self.joints.len()
    }

    /// The joint at `joint`.
    #[inline]
    pub fn joint(&self, joint: JointIdx) -> &Joint {
        &self.joints[joint.idx()]
    }

    /// Which joint plays which part.
    pub fn roles(&self) -> &RoleMap {
        &self.roles
    }

    /// The joint that plays `role`, if the skeleton has one.
    pub fn by_role(&self, role: JointRole) -> Option<JointIdx> {
        self.roles.joint(role)
    }

    /// The joint called `name` (exact).
    pub fn by_name(&self, name: &str) -> Option<JointIdx> {
        self.joints.iter().position(|j| j.name == name).map(JointIdx::from_idx)
    }

    /// The joint a person means: its own name, else a role's name.
    pub fn find(&self, name_or_role: &str) -> Option<JointIdx> {
        self.by_name(name_or_role)
            .or_else(|| JointRole::from_name(name_or_role).and_then(|role| self.by_role(role)))
    }

    /// Joint positions of the rest pose with the root at its offset, metres.
    pub fn rest_positions_m(&self) -> Vec<Vec3> {
        let mut positions: Vec<Vec3> = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            let parent = joint.parent.map_or(Vec3::ZERO, |p| positions[p.idx()]);
            positions.push(parent + joint.offset_m);
        }
        positions
    }

    /// Length of the left or right leg from hip joint to ankle along the bones, averaged over
    /// the legs that are there; `None` without recognised legs.
    pub fn leg_length_m(&self) -> Option<f32> {
        use JointRole::{LeftFoot, LeftLeg, RightFoot, RightLeg};
        let legs = [(LeftLeg, LeftFoot), (RightLeg, RightFoot)];
        let lengths: Vec<f32> = legs
            .into_iter()
            .filter_map(|(shin, foot)| {
                let thigh = self.joint(self.by_role(shin)?).offset_m.length();
                Some(thigh + self.joint(self.by_role(foot)?).offset_m.length())
            })
            .collect();
        if lengths.is_empty() {
            return None;
        }
        Some(lengths.iter().sum::<f32>() / lengths.len() as f32)
    }
}
