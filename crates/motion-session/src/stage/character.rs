//! Characters from glTF files as figures, and motions of other bodies done by them.

use std::collections::BTreeMap;
use std::sync::Arc;

use motion_core::contacts::{self, Side};
use motion_core::floor::Soles;
use motion_core::retarget::{PathScale, Retarget, RetargetError};
use motion_io::gltf::{Alpha, Character};
use motion_scene::body::Look;
use motion_scene::color::LinearRgba;
use motion_scene::mesh::{
    BodyModel, Material, MeshError, MeshId, MeshPart, SkinnedMesh, Texture, Vertex,
};

use super::actor::Actor;
use super::body_plan::standing_pose;
use super::cast::Part;
use super::figure::Figure;

/// Materials of other programs say little about how matt they are; skin and cloth are.
const ROUGHNESS: f32 = 0.8;

/// The character's surface, in its file's colours.
///
/// Fails where its numbers are no mesh: a vertex without a direction, say.
pub fn figure_of_character(mesh: MeshId, character: &Character) -> Result<Figure, MeshError> {
    let Character { mesh: surface, joint_from_mesh, .. } = character;
    let vertex = |nth: usize| Vertex {
        position_m: surface.positions_m[nth],
        normal: surface.normals[nth].normalize_or(glam::Vec3::Y),
        uv: surface.uvs[nth],
        joints: surface.joints[nth],
        weights: surface.weights[nth],
    };
    let vertices = (0..surface.positions_m.len()).map(vertex).collect();
    let mut textures = BTreeMap::new();
    let parts = surface
        .parts
        .iter()
        .map(|part| MeshPart {
            first_triangle: part.triangles.start as u32,
            n_triangles: part.triangles.len() as u32,
            material: material_of(character, part.material, &mut textures),
        })
        .collect();
    let (triangles, joints) = (surface.triangles.clone(), joint_from_mesh.clone());
    let skinned = SkinnedMesh::new(vertices, triangles, joints, parts)?;
    let model = BodyModel::new(vec![Arc::new(skinned)]).ok_or(MeshError::Empty)?;
    Ok(Figure::new(mesh, model))
}

/// A material with its texture; textures that several materials have are shared.
fn material_of(
    character: &Character,
    nth: usize,
    textures: &mut BTreeMap<usize, Arc<Texture>>,
) -> Material {
    let material = character.materials.get(nth).cloned().unwrap_or_default();
    let texture = material.base_colour_texture.and_then(|nth| {
        let picture = character.textures.get(nth)?;
        let texture = textures.entry(nth).or_insert_with(|| {
            let (width, height, rgba) = (picture.width, picture.height, picture.rgba8_srgb.clone());
            Arc::new(Texture { width, height, rgba })
        });
        Some(Arc::clone(texture))
    });
    let [r, g, b, _] = material.base_colour_linear;
    Material {
        // What is half there (hair, lashes) is drawn where more than half of it is.
        base_color: LinearRgba([r, g, b, 1.0]),
        texture,
        roughness: ROUGHNESS,
        alpha_cutoff: match material.alpha {
            Alpha::Opaque => 0.0,
            Alpha::Mask(cutoff) => cutoff,
            Alpha::Blend => 0.5,
        },
        double_sided: material.double_sided,
    }
}

/// How high the character's toe joints are above its soles.
pub fn soles_of_character(character: &Character) -> Soles {
    let pose = character.bind_pose();
    let height_m = Side::BOTH.map(|side| {
        contacts::toe_joint(&character.skeleton, side)
            .map_or(0.0, |toe| pose.positions_m()[toe.idx()].y)
    });
    Soles { height_m }
}

/// An actor in the body of `character`, which does the motion of `part`. `path` says whether the
/// way over the ground is kept or fitted to the legs.
///
/// A motion on the character's own skeleton is done as it is.
pub fn dressed(
    part: Part,
    character: &Character,
    figure: Arc<Figure>,
    path: PathScale,
) -> Result<Actor, RetargetError> {
    let Part { name, skeleton, motion, soles } = part;
    let look = Look::own_colors();
    if *skeleton == character.skeleton {
        return Ok(Actor { name, figure, skeleton, motion, look });
    }
    let source = standing_pose(&skeleton, Some(&motion), soles);
    let target = character.bind_pose();
    let retarget = Retarget::new(&skeleton, &source, &character.skeleton, &target)?.with_path(path);
    let motion = Arc::new(retarget.apply(&motion));
    Ok(Actor { name, figure, skeleton: Arc::new(character.skeleton.clone()), motion, look })
}
