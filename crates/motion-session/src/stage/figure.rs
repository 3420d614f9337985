//! What a character looks like: a model, and how much room it takes.

use std::sync::Arc;

use glam::{Mat4, Vec3};
use motion_core::floor::Soles;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_scene::bounds::Bounds;
use motion_scene::mannequin::mannequin;
use motion_scene::mesh::{BodyModel, MeshId, SkinnedMesh, Vertex};

use super::body_plan::body_plan;

/// So many vertices tell how much room a body takes.
const MAX_OUTLINE: usize = 1500;

/// A model under the name by which scenes speak of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its name in scenes.
    pub mesh: MeshId,
    /// Its surface; its joints are those of the actor's skeleton, in that order.
    pub model: Arc<BodyModel>,
    /// Vertices spread over it.
    outline: Vec<Vertex>,
    /// What becomes of them in a pose is found through these.
    joint_from_mesh: Vec<Mat4>,
}

impl Figure {
    /// A figure of a model.
    pub fn new(mesh: MeshId, model: BodyModel) -> Self {
        // Never empty; the coarsest has all of the body with the fewest vertices.
        let coarse = model.levels().last().map(Arc::as_ref);
        let vertices = coarse.map_or(&[][..], SkinnedMesh::vertices);
        let step = vertices.len().div_ceil(MAX_OUTLINE).max(1);
        let outline = vertices.iter().copied().step_by(step).collect();
        let joint_from_mesh = coarse.map_or(Vec::new(), |mesh| mesh.joint_from_mesh().to_vec());
        Self { mesh, model: Arc::new(model), outline, joint_from_mesh }
    }

    /// A mannequin with the proportions of `skeleton`. `motion` helps where its rest pose is not one
    /// to stand in.
    pub fn mannequin(
        mesh: MeshId,
        skeleton: &Skeleton,
        motion: Option<&Motion>,
        soles: Soles,
    ) -> Self {
        Self::new(mesh, mannequin(&body_plan(skeleton, motion, soles)))
    }

    /// How many joints a pose of it has.
    pub fn n_joints(&self) -> usize {
        self.joint_from_mesh.len()
    }

    /// Points of the body in a pose that between them reach as far as it does, in 26 directions
    /// (sides, edges and corners of a box), within a finger's width. What holds them holds the body.
    pub fn reach_m(&self, world_from_joint: &[Mat4]) -> Vec<Vec3> {
        let points = self.points_m(world_from_joint);
        let furthest = |direction: Vec3| {
            let along = |point: &Vec3| point.dot(direction);
            points.iter().copied().max_by(|a, b| along(a).total_cmp(&along(b)))
        };
        let steps = [-1.0f32, 0.0, 1.0];
        let directions = steps
            .into_iter()
            .flat_map(|x| steps.into_iter().flat_map(move |y| steps.map(|z| Vec3::new(x, y, z))));
        directions.filter(|direction| *direction != Vec3::ZERO).filter_map(furthest).collect()
    }

    /// What holds the body in a pose, within a finger's width (not every vertex is looked at).
    pub fn bounds(&self, world_from_joint: &[Mat4]) -> Option<Bounds> {
        Bounds::of_points(&self.points_m(world_from_joint)).map(|bounds| bounds.grown(0.02))
    }

    /// Points all over the body in a pose, metres; finite ones only.
    fn points_m(&self, world_from_joint: &[Mat4]) -> Vec<Vec3> {
        if world_from_joint.len() != self.n_joints() {
            return world_from_joint.iter().map(|world| world.w_axis.truncate()).collect();
        }
        let pairs = world_from_joint.iter().zip(&self.joint_from_mesh);
        let world_from_mesh: Vec<Mat4> = pairs.map(|(world, joint)| *world * *joint).collect();
        let skinned = |vertex| SkinnedMesh::skinned_position_m(vertex, &world_from_mesh);
        self.outline.iter().map(skinned).filter(|point| point.is_finite()).collect()
    }
}
