//! The tree of nodes, and where they are.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::document::Document;
use crate::diagnostic::FileError;
use crate::limits::MAX_NODE_DEPTH;

/// A node's place in its parent's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) translation: DVec3,
    pub(super) rotation: DQuat,
    pub(super) scale: DVec3,
}

impl Place {
    fn affine(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

/// All nodes, parents before children in [`order`](Self::order).
pub(super) struct Nodes {
    pub(super) parents: Vec<Option<usize>>,
    /// How many nodes are above each.
    pub(super) depths: Vec<usize>,
    /// Every node once, parents first.
    pub(super) order: Vec<usize>,
    pub(super) places: Vec<Place>,
    /// Where a node's matrix is more than a place (sheared), it counts while not animated.
    matrices: Vec<Option<DAffine3>>,
}

impl Nodes {
    /// Fails for a node with two parents, for cycles and for places that are no numbers.
    pub(super) fn new(document: &Document) -> Result<Self, FileError> {
        let nodes = &document.root.nodes;
        let mut parents = vec![None; nodes.len()];
        let children = |idx: usize| nodes[idx].children.iter().flatten().map(|c| c.value());
        for idx in 0..nodes.len() {
            for child in children(idx) {
                match parents.get_mut(child) {
                    None => return Err(document.error(format!("node {idx} has no child {child}"))),
                    Some(Some(_)) => {
                        return Err(document.error(format!("node {child} has two parents")));
                    }
                    Some(parent) => *parent = Some(idx),
                }
            }
        }
        let mut order: Vec<usize> = (0..nodes.len()).filter(|&n| parents[n].is_none()).collect();
        let mut depths = vec![0; nodes.len()];
        let mut at = 0;
        while at < order.len() {
            let node = order[at];
            for child in children(node) {
                depths[child] = depths[node] + 1;
                order.push(child);
            }
            at += 1;
        }
        if depths.iter().any(|&depth| depth > MAX_NODE_DEPTH) {
            return Err(document.error(format!("its nodes hang more than {MAX_NODE_DEPTH} deep")));
        }
        if order.len() != nodes.len() {
            return Err(document.error("its nodes go in a circle"));
        }
        let mut places = Vec::with_capacity(nodes.len());
        let mut matrices = Vec::with_capacity(nodes.len());
        for (idx, node) in nodes.iter().enumerate() {
            let matrix = node.matrix.map(|m| {
                let matrix = DMat4::from_cols_array(&m.map(f64::from));
                DAffine3::from_mat4(matrix)
            });
            let place = match matrix {
                Some(matrix) => {
                    let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
                    Place { translation, rotation, scale }
                }
                None => Place {
                    translation: node.translation.map_or(DVec3::ZERO, vec3),
                    rotation: node.rotation.map_or(DQuat::IDENTITY, |q| quat(q.0)),
                    scale: node.scale.map_or(DVec3::ONE, vec3),
                },
            };
            let finite = matrix.is_none_or(|matrix| matrix.is_finite())
                && place.translation.is_finite()
                && place.scale.is_finite();
            if !finite {
                return Err(document.error(format!("node {idx} is nowhere")));
            }
            // A matrix without an extent has no rotation.
            let rotation =
                if place.rotation.is_finite() { place.rotation } else { DQuat::IDENTITY };
            places.push(Place { rotation, ..place });
            matrices.push(matrix);
        }
        Ok(Self { parents, depths, order, places, matrices })
    }

    /// Where every node is in the world, at rest.
    pub(super) fn world_at_rest(&self) -> Vec<DAffine3> {
        self.world(|node| self.matrices[node].unwrap_or_else(|| self.places[node].affine()))
    }

    /// The same with other places for the nodes that `is_moved` tells of.
    pub(super) fn world_with(&self, places: &[Place], is_moved: &[bool]) -> Vec<DAffine3> {
        self.world(|node| match self.matrices[node] {
            Some(matrix) if !is_moved[node] => matrix,
            _ => places[node].affine(),
        })
    }

    fn world(&self, local: impl Fn(usize) -> DAffine3) -> Vec<DAffine3> {
        let mut world = vec![DAffine3::IDENTITY; self.parents.len()];
        for &node in &self.order {
            let parent = self.parents[node].map_or(DAffine3::IDENTITY, |parent| world[parent]);
            world[node] = parent * local(node);
        }
        world
    }

    /// The nearest of a node's ancestors, itself not counted, for which `is_wanted` holds.
    pub(super) fn ancestor(&self, node: usize, is_wanted: impl Fn(usize) -> bool) -> Option<usize> {
        let mut at = self.parents[node]?;
        while !is_wanted(at) {
            at = self.parents[at]?;
        }
        Some(at)
    }
}

/// A vector in double precision.
pub(super) fn vec3(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// A unit quaternion; the identity where there is no direction in the numbers.
pub(super) fn quat(q: [f32; 4]) -> DQuat {
    let q = DQuat::from_array(q.map(f64::from));
    let length = q.length();
    if length.is_finite() && length > 1e-9 { q / length } else { DQuat::IDENTITY }
}

/// The rotation nearest to a linear map that may also scale and shear a little (polar
/// decomposition by Newton's iteration, Higham 1986); the identity where it is flat.
pub(super) fn nearest_rotation(linear: DMat3) -> DQuat {
    let mut m = linear;
    for _ in 0..20 {
        let determinant = m.determinant();
        if !determinant.is_finite() || determinant.abs() < 1e-18 {
            return DQuat::IDENTITY;
        }
        // Scaling to determinant 1 makes the iteration quick from any size.
        let m1 = m * (1.0 / determinant.abs().cbrt());
        let next = (m1 + m1.inverse().transpose()) * 0.5;
        let step = (next - m).abs_diff_eq(DMat3::ZERO, 1e-13);
        m = next;
        if step {
            break;
        }
    }
    let m = if m.determinant() < 0.0 { m * -1.0 } else { m };
    let q = DQuat::from_mat3(&m).normalize();
    if q.is_finite() { q } else { DQuat::IDENTITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_rotation_of_a_scaled_one_is_it() {
        for q in [DQuat::from_rotation_x(2.0), DQuat::from_rotation_z(-0.3)] {
            let scaled = DMat3::from_quat(q) * DMat3::from_diagonal(DVec3::splat(0.01));
            assert!(nearest_rotation(scaled).dot(q).abs() > 1.0 - 1e-12);
        }
        assert_eq!(nearest_rotation(DMat3::ZERO), DQuat::IDENTITY);
    }
}
