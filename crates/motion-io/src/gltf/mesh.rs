//! A character's mesh: every skinned or carried mesh of a file in one, in our rest pose.

use std::ops::Range;

use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};

use super::body::{Body, inverse_binds};
use super::bound::{self, attribute};
use super::document::Document;
use super::material::Surfaces;
use super::nodes::{Nodes, vec3};
use crate::diagnostic::{FileError, Warnings, quoted};
use crate::limits::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES};

/// Vertices, what they are bound to, and the triangles between them.
///
/// Every list of a vertex's properties is as long as `positions_m`; triangles index them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// In the rest pose of the character's skeleton with its root at the origin, metres.
    pub positions_m: Vec<Vec3>,
    /// Of unit length, in the same pose.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, (0, 0) the upper left corner of the picture; zeros where there are
    /// none.
    pub uvs: Vec<Vec2>,
    /// Factors on the material's base colour, linear; empty where no vertex has one.
    pub colours_linear: Vec<[f32; 4]>,
    /// Joints of the character's skeleton.
    pub joints: Vec<[u16; 4]>,
    /// How much each of them counts; their sum is 1.
    pub weights: Vec<[f32; 4]>,
    /// Vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The triangles of each surface, one behind the other.
    pub parts: Vec<Part>,
}

/// Triangles of one surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Which triangles.
    pub triangles: Range<usize>,
    /// An index into the character's materials.
    pub material: usize,
}

/// How a mesh's vertices follow the body.
enum Binding {
    /// By a skin: for each of its joints, ours and what takes a vertex to our rest pose.
    Skin(Vec<(u16, DAffine3)>),
    /// Rigidly.
    Joint(u16, DAffine3),
}

/// The mesh of all nodes that follow the body, in the file's units and axes, the root of the body
/// at the origin.
pub(super) fn mesh(
    document: &Document,
    nodes: &Nodes,
    body: &Body,
    surfaces: &Surfaces,
    warnings: &mut Warnings,
) -> Result<Mesh, FileError> {
    let mut mesh = Mesh::default();
    let by_default = nodes.world_at_rest();
    let root = body.pivots[0];
    for node in 0..document.root.nodes.len() {
        let json = &document.root.nodes[node];
        let Some(index) = json.mesh else { continue };
        let source = document.root.meshes.get(index.value());
        let source =
            source.ok_or_else(|| document.error(format!("there is no mesh {}", index.value())))?;
        let binding = match json.skin {
            Some(skin) => Binding::Skin(skin_binding(document, body, skin.value())?),
            None => {
                let above = nodes.ancestor(node, |above| body.joint_of_node[above].is_some());
                let Some(above) = above else {
                    let name = quoted(json.name.as_deref().unwrap_or_default().as_bytes());
                    let what = format!("the mesh of {name} hangs on no joint and is left out");
                    warnings.warn(&document.path, None, what);
                    continue;
                };
                let joint = body.joint_of_node[above].unwrap_or(0);
                let from_node = by_default[above].inverse() * by_default[node];
                Binding::Joint(joint as u16, body.world_at_rest[joint] * from_node)
            }
        };
        for primitive in &source.primitives {
            add(document, primitive, &binding, root, surfaces, &mut mesh)?;
        }
    }
    if mesh.triangles.is_empty() {
        return Err(FileError::new(
            &document.path,
            "there is no mesh on its skeleton",
            "export the character with its mesh",
        ));
    }
    if !mesh.colours_linear.is_empty() {
        mesh.colours_linear.resize(mesh.positions_m.len(), [1.0; 4]);
    }
    Ok(mesh)
}

fn skin_binding(
    document: &Document,
    body: &Body,
    skin: usize,
) -> Result<Vec<(u16, DAffine3)>, FileError> {
    let json = document.root.skins.get(skin);
    let json = json.ok_or_else(|| document.error(format!("there is no skin {skin}")))?;
    let binds = inverse_binds(document, skin)?;
    let bound = json.joints.iter().zip(binds).map(|(node, bind)| {
        // A joint that was left out carries nothing.
        match body.joint_of_node.get(node.value()).copied().flatten() {
            Some(joint) => (joint as u16, body.world_at_rest[joint] * bind),
            None => (0, body.world_at_rest[0]),
        }
    });
    Ok(bound.collect())
}

/// Adds the triangles of a primitive; points and lines are passed over.
fn add(
    document: &Document,
    primitive: &Primitive,
    binding: &Binding,
    root: DVec3,
    surfaces: &Surfaces,
    mesh: &mut Mesh,
) -> Result<(), FileError> {
    let Some(position) = attribute(primitive, Semantic::Positions) else { return Ok(()) };
    let Checked::Valid(mode) = primitive.mode else {
        return Err(document.error("a mesh is of an unknown mode"));
    };
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(());
    }
    let positions = document.floats::<3>(position)?;
    let n_vertices = positions.len();
    let first = mesh.positions_m.len();
    if first + n_vertices > MAX_MESH_VERTICES {
        return Err(bound::too_many_vertices(document));
    }
    let fits = |n: usize, what: &str| -> Result<(), FileError> {
        let other =
            || document.error(format!("a mesh has other numbers of {what} than of vertices"));
        if n == n_vertices { Ok(()) } else { Err(other()) }
    };
    let indices: Vec<u32> = match primitive.indices {
        Some(indices) => document.integers::<1>(indices.value())?.into_iter().flatten().collect(),
        None => (0..n_vertices as u32).collect(),
    };
    if let Some(index) = indices.iter().find(|&&index| index as usize >= n_vertices) {
        return Err(document.error(format!("a triangle has vertex {index} of {n_vertices}")));
    }
    if mesh.triangles.len() + triangle_count(mode, indices.len()) > MAX_MESH_TRIANGLES {
        let what = format!("its meshes have more than {MAX_MESH_TRIANGLES} triangles together");
        return Err(FileError::new(&document.path, what, "export a simpler mesh"));
    }
    let rests = bind(document, primitive, binding, n_vertices, mesh)?;
    let is_turned_inside_out = rests.first().is_some_and(|rest| rest.matrix3.determinant() < 0.0);
    let mut triangles = triangles(mode, &indices);
    if is_turned_inside_out {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    for (rest, position) in rests.iter().zip(&positions) {
        mesh.positions_m.push((rest.transform_point3(vec3(*position)) - root).as_vec3());
    }
    match attribute(primitive, Semantic::Normals) {
        Some(normals) => {
            let normals = document.floats::<3>(normals)?;
            fits(normals.len(), "normals")?;
            let turned = normals.iter().zip(&rests).map(|(normal, rest)| {
                // Normals stay at right angles to what is scaled unevenly.
                let m = rest.matrix3;
                let cofactor = DMat3::from_cols(
                    m.y_axis.cross(m.z_axis),
                    m.z_axis.cross(m.x_axis),
                    m.x_axis.cross(m.y_axis),
                );
                let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
                (cofactor * vec3(*normal) * sign).try_normalize().unwrap_or(DVec3::Y).as_vec3()
            });
            mesh.normals.extend(turned);
        }
        None => mesh.normals.extend(smooth_normals(&mesh.positions_m[first..], &triangles)),
    }
    let material = primitive.material.map_or(surfaces.materials.len() - 1, |m| m.value());
    let uv_set = surfaces.uv_sets.get(material).copied();
    let uv_set =
        uv_set.ok_or_else(|| document.error(format!("there is no material {material}")))?;
    match attribute(primitive, Semantic::TexCoords(uv_set)) {
        Some(uvs) => {
            let uvs = document.floats::<2>(uvs)?;
            fits(uvs.len(), "texture coordinates")?;
            mesh.uvs.extend(uvs.into_iter().map(Vec2::from));
        }
        None => mesh.uvs.resize(first + n_vertices, Vec2::ZERO),
    }
    if let Some(colours) = attribute(primitive, Semantic::Colors(0)) {
        mesh.colours_linear.resize(first, [1.0; 4]);
        if document.n_components(colours) == 3 {
            let colours = document.floats::<3>(colours)?;
            fits(colours.len(), "colours")?;
            mesh.colours_linear.extend(colours.iter().map(|&[r, g, b]| [r, g, b, 1.0]));
        } else {
            let colours = document.floats::<4>(colours)?;
            fits(colours.len(), "colours")?;
            mesh.colours_linear.extend(colours);
        }
    }
    let n_before = mesh.triangles.len();
    let shift = first as u32;
    mesh.triangles.extend(triangles.iter().map(|triangle| triangle.map(|vertex| vertex + shift)));
    mesh.parts.push(Part { triangles: n_before..mesh.triangles.len(), material });
    Ok(())
}

/// Adds joints and weights of a primitive's vertices; returns what takes each to our rest pose.
fn bind(
    document: &Document,
    primitive: &Primitive,
    binding: &Binding,
    n_vertices: usize,
    mesh: &mut Mesh,
) -> Result<Vec<DAffine3>, FileError> {
    let skin = match binding {
        Binding::Skin(skin) => skin,
        Binding::Joint(joint, rest) => {
            mesh.joints.extend(std::iter::repeat_n([*joint, 0, 0, 0], n_vertices));
            mesh.weights.extend(std::iter::repeat_n([1.0, 0.0, 0.0, 0.0], n_vertices));
            return Ok(vec![*rest; n_vertices]);
        }
    };
    let all = bound::influences(document, primitive, n_vertices, skin.len())?;
    let mut all = all.ok_or_else(|| document.error("a mesh with a skin has no weights"))?;
    let mut rests = Vec::with_capacity(n_vertices);
    for influences in &mut all {
        // Equal ones keep the file's order, so that the four are always the same.
        influences.sort_by(|a, b| b.1.total_cmp(&a.1));
        influences.truncate(4);
        if influences.is_empty() {
            influences.push((0, 1.0));
        }
        let sum: f64 = influences.iter().map(|&(_, weight)| f64::from(weight)).sum();
        let (mut joints, mut weights) = ([0_u16; 4], [0.0_f32; 4]);
        let mut rest = [0.0_f64; 12];
        for (slot, &(joint, weight)) in influences.iter().enumerate() {
            let (ours, to_rest) = &skin[joint as usize];
            (joints[slot], weights[slot]) = (*ours, (f64::from(weight) / sum) as f32);
            for (sum, value) in rest.iter_mut().zip(to_rest.to_cols_array()) {
                *sum += f64::from(weights[slot]) * value;
            }
        }
        mesh.joints.push(joints);
        mesh.weights.push(weights);
        rests.push(DAffine3::from_cols_array(&rest));
    }
    Ok(rests)
}

fn triangle_count(mode: Mode, n_indices: usize) -> usize {
    if matches!(mode, Mode::Triangles) { n_indices / 3 } else { n_indices.saturating_sub(2) }
}

fn triangles(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(at, w)| if at % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            .collect(),
        Mode::TriangleFan => {
            indices.windows(2).skip(1).map(|pair| [indices[0], pair[0], pair[1]]).collect()
        }
        _ => indices.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect(),
    }
}

/// Normals of vertices that have none: the mean of their triangles, larger ones count more.
fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        let normal = (b - a).cross(c - a);
        for &vertex in triangle {
            normals[vertex as usize] += normal;
        }
    }
    normals.into_iter().map(|normal| normal.try_normalize().unwrap_or(Vec3::Y)).collect()
}
