//! A character: a skeleton with a mesh on it.

use std::path::Path;

use glam::{Mat4, Quat, Vec3};
use motion_core::bind_pose::BindPose;
use motion_core::skeleton::Skeleton;

use super::body::Body;
use super::document::Document;
use super::fit::guess_metres;
use super::material::{Material, Surfaces, Texture};
use super::mesh::{Mesh, mesh};
use super::nodes::Nodes;
use crate::content_hash::ContentHash;
use crate::diagnostic::{FileError, Warnings};
use crate::guess::{self, Conform, UpAxis};
use crate::limits::MAX_MOTION_FILE_BYTES;
use crate::read_file::read_file;
use crate::roles_file::RoleOverrides;

/// What overrides the guesses about a character.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CharacterOptions {
    /// Metres of one file unit; recognised where left out.
    pub metres_per_unit: Option<f64>,
    /// Which joints play which roles; recognised where left out.
    pub roles: RoleOverrides,
}

/// A body that can be shown in any pose of its skeleton: metres, Y up, rest pose facing +Z.
///
/// A vertex is where the weighted mean of `world_from_joint · joint_from_mesh` takes it, over its
/// joints; [`skinned_positions_m`](Self::skinned_positions_m) is that in slow words.
#[derive(Clone, Debug, PartialEq)]
pub struct Character {
    /// The skeleton, its root at the origin of the rest pose.
    pub skeleton: Skeleton,
    /// What is seen.
    pub mesh: Mesh,
    /// Of every joint of the skeleton, what takes the mesh to the joint at rest. The mesh is in
    /// the rest pose already and joints rest without rotation, so these are translations.
    pub joint_from_mesh: Vec<Mat4>,
    /// What the mesh's surfaces look like.
    pub materials: Vec<Material>,
    /// Pictures of materials.
    pub textures: Vec<Texture>,
    /// Metres of one unit of the file.
    pub metres_per_unit: f64,
    /// Hash of the file's bytes and of the data files it names.
    pub content_hash: ContentHash,
}

/// Reads the character of a `.glb` or `.gltf`.
///
/// Fails for a file without a skin or a mesh, for damaged and for compressed ones.
pub fn read_character(
    path: &Path,
    options: &CharacterOptions,
    warnings: &mut Warnings,
) -> Result<Character, FileError> {
    let bytes = read_file(path, MAX_MOTION_FILE_BYTES)?;
    let document = Document::new(&bytes, path)?;
    let content_hash = document.content_hash(&bytes);
    drop(bytes);
    if document.root.skins.is_empty() {
        let what = "there is no skin in the file: its mesh is bound to no skeleton";
        return Err(FileError::new(path, what, "export the character with its armature and skin"));
    }
    let nodes = Nodes::new(&document)?;
    let body = Body::new(&document, &nodes, &options.roles, warnings)?;
    let body = body.ok_or_else(|| document.error("its skins have no joints"))?;
    let surfaces = Surfaces::new(&document, warnings);
    let mut mesh = mesh(&document, &nodes, &body, &surfaces, warnings)?;
    let metres_per_unit =
        options.metres_per_unit.unwrap_or_else(|| guess_metres(&body.skeleton, path, warnings).0);
    let rest = guess::canonical_from_rest(&body.skeleton);
    let how = Conform {
        scale: metres_per_unit as f32,
        world_from_file: UpAxis::Y.y_up_from_file(),
        canonical_from_rest: if rest.sure { rest.value } else { Quat::IDENTITY },
    };
    for position in &mut mesh.positions_m {
        *position = how.canonical_from_rest * *position * how.scale;
    }
    for normal in &mut mesh.normals {
        *normal = how.canonical_from_rest * *normal;
    }
    if mesh.positions_m.iter().any(|position| !position.is_finite()) {
        return Err(document.error("a vertex is nowhere"));
    }
    let skeleton = guess::conform_skeleton(body.skeleton, &how);
    let joint_from_mesh =
        skeleton.rest_positions_m().iter().map(|at| Mat4::from_translation(-*at)).collect();
    let Surfaces { materials, textures, .. } = surfaces;
    Ok(Character {
        skeleton,
        mesh,
        joint_from_mesh,
        materials,
        textures,
        metres_per_unit,
        content_hash,
    })
}

impl Character {
    /// Where the mesh's vertices are when the skeleton's joints are at `positions_m`, turned by
    /// `world_from_joint` (linear blend skinning).
    ///
    /// # Panics
    /// When there are not as many as joints.
    pub fn skinned_positions_m(
        &self,
        positions_m: &[Vec3],
        world_from_joint: &[Quat],
    ) -> Vec<Vec3> {
        assert_eq!(positions_m.len(), self.skeleton.n_joints(), "another skeleton's pose");
        assert_eq!(world_from_joint.len(), self.skeleton.n_joints(), "another skeleton's pose");
        let world_from_mesh: Vec<Mat4> = positions_m
            .iter()
            .zip(world_from_joint)
            .zip(&self.joint_from_mesh)
            .map(|((at, turn), from_mesh)| Mat4::from_rotation_translation(*turn, *at) * *from_mesh)
            .collect();
        let bound = self.mesh.joints.iter().zip(&self.mesh.weights);
        let skinned =
            self.mesh.positions_m.iter().zip(bound).map(|(position, (joints, weights))| {
                let parts = joints.iter().zip(weights);
                parts
                    .map(|(&joint, &weight)| {
                        weight * world_from_mesh[joint as usize].transform_point3(*position)
                    })
                    .sum()
            });
        skinned.collect()
    }

    /// The pose in which it stands, with the mesh's lowest point on the ground: what motions of
    /// other bodies are [retargeted](motion_core::retarget) by.
    pub fn bind_pose(&self) -> BindPose {
        let bind = BindPose::of(&self.skeleton, None);
        let skinned = self.skinned_positions_m(bind.positions_m(), bind.world_from_joint());
        let low = skinned.iter().map(|position| position.y).fold(f32::INFINITY, f32::min);
        if low.is_finite() { bind.with_sole(-low) } else { bind }
    }
}
