//! What is bound to which joint: the influences of a primitive's vertices.

use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::validation::Checked;

use super::document::Document;
use crate::diagnostic::FileError;
use crate::limits::{MAX_INFLUENCE_SETS, MAX_MESH_VERTICES};

/// Joints of a skin and their weights, as many as a file has, a list per vertex.
pub(super) type Influences = Vec<Vec<(u32, f32)>>;

/// The index of the accessor of an attribute.
pub(super) fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|accessor| accessor.value())
}

/// The influences of a primitive's `n_vertices` vertices, weights as they are; `None` where it has
/// none.
///
/// Fails for joints that the skin does not have.
pub(super) fn influences(
    document: &Document,
    primitive: &Primitive,
    n_vertices: usize,
    n_joints: usize,
) -> Result<Option<Influences>, FileError> {
    let mut all: Option<Influences> = None;
    for set in 0..MAX_INFLUENCE_SETS {
        let joints = attribute(primitive, Semantic::Joints(set));
        let weights = attribute(primitive, Semantic::Weights(set));
        let (Some(joints), Some(weights)) = (joints, weights) else { break };
        let (joints, weights) = (document.integers::<4>(joints)?, document.floats::<4>(weights)?);
        if joints.len() != n_vertices || weights.len() != n_vertices {
            return Err(document.error("a mesh has other numbers of weights than of vertices"));
        }
        let all = all.get_or_insert_with(|| vec![Vec::with_capacity(4); n_vertices]);
        for (vertex, (joints, weights)) in all.iter_mut().zip(joints.iter().zip(&weights)) {
            for (&joint, &weight) in joints.iter().zip(weights) {
                if joint as usize >= n_joints {
                    let what = format!("a vertex is bound to joint {joint} of {n_joints}");
                    return Err(document.error(what));
                }
                if weight > 0.0 {
                    vertex.push((joint, weight));
                }
            }
        }
    }
    Ok(all)
}

/// The error about a mesh that is too large.
pub(super) fn too_many_vertices(document: &Document) -> FileError {
    let what = format!("its meshes have more than {MAX_MESH_VERTICES} vertices together");
    FileError::new(&document.path, what, "export a simpler mesh")
}

/// Which nodes carry vertices: as joints of a skin, or with a mesh of their own below them.
pub(super) fn used_nodes(document: &Document) -> Result<Vec<bool>, FileError> {
    let root = &document.root;
    let mut is_used = vec![false; root.nodes.len()];
    let mut seen = std::collections::HashSet::new();
    let mut n_all = 0_usize;
    for node in &root.nodes {
        let Some(mesh) = node.mesh.and_then(|mesh| root.meshes.get(mesh.value())) else { continue };
        let Some(skin) = node.skin.and_then(|skin| root.skins.get(skin.value())) else { continue };
        if !seen.insert((node.mesh.map(|m| m.value()), node.skin.map(|s| s.value()))) {
            continue;
        }
        for primitive in &mesh.primitives {
            let Some(position) = attribute(primitive, Semantic::Positions) else { continue };
            let count = root.accessors.get(position).map_or(0, |accessor| accessor.count.0);
            let n_vertices = usize::try_from(count).unwrap_or(usize::MAX);
            // Read before anything is taken for it, so that a claim alone costs nothing.
            document.floats::<3>(position)?;
            n_all = n_all.saturating_add(n_vertices);
            if n_all > MAX_MESH_VERTICES {
                return Err(too_many_vertices(document));
            }
            let all = influences(document, primitive, n_vertices, skin.joints.len())?;
            for (joint, _) in all.iter().flatten().flatten() {
                if let Some(used) = is_used.get_mut(skin.joints[*joint as usize].value()) {
                    *used = true;
                }
            }
        }
    }
    // A mesh that hangs on a joint keeps it, and what carries that.
    for (idx, node) in root.nodes.iter().enumerate() {
        is_used[idx] |= node.mesh.is_some() && node.skin.is_none();
        for child in node.children.iter().flatten().map(|child| child.value()) {
            let hangs = root.nodes.get(child).is_some_and(|c| c.mesh.is_some() && c.skin.is_none());
            is_used[idx] |= hangs;
        }
    }
    Ok(is_used)
}
