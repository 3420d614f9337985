//! Skinned meshes: vertices that follow joints.

use std::sync::Arc;

use glam::{Mat4, Vec2, Vec3};

use crate::bounds::Bounds;
use crate::color::LinearRgba;

/// Names a mesh for as long as the program runs; a renderer keeps what it uploaded under it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshId(pub u64);

/// One vertex in its mesh's own space, in which the body stands in its bind pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is, metres.
    pub position_m: Vec3,
    /// Outwards, unit length.
    pub normal: Vec3,
    /// Where it is on the texture; 0,0 is the upper left corner.
    pub uv: Vec2,
    /// Which joints move it, as indices into [`SkinnedMesh::joint_from_mesh`].
    pub joints: [u16; 4],
    /// How much each of them does; they sum to 1.
    pub weights: [f32; 4],
}

/// Colours of a texture, row by row from the upper left corner, sRGB with straight alpha.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `4 · width · height` bytes.
    pub rgba: Vec<u8>,
}

/// What a part of a mesh is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Multiplied with the texture.
    pub base_color: LinearRgba,
    /// Colours over the surface.
    pub texture: Option<Arc<Texture>>,
    /// 0 a mirror, 1 chalk.
    pub roughness: f32,
    /// Texels below this alpha are not there; 0 keeps all.
    pub alpha_cutoff: f32,
    /// Whether the backs of triangles are seen, too.
    pub double_sided: bool,
}

/// Triangles of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshPart {
    /// The first of its triangles.
    pub first_triangle: u32,
    /// How many follow each other.
    pub n_triangles: u32,
    /// Of what.
    pub material: Material,
}

/// A surface that follows joints by linear blend skinning: a vertex v goes to
/// Σ wᵢ · `world_from_joint`ᵢ · `joint_from_mesh`ᵢ · v.
///
/// Invariants, checked by [`SkinnedMesh::new`]:
/// 1. There is at least one triangle and one joint, at most 65,536 joints.
/// 2. Triangles name vertices that exist, vertices name joints that exist.
/// 3. All numbers are finite; weights are not negative and sum to 1 within 1e-3; normals have
///    unit length within 1e-2.
/// 4. Parts cover the triangles, each once and in order.
#[derive(Clone, Debug, PartialEq)]
pub struct SkinnedMesh {
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    joint_from_mesh: Vec<Mat4>,
    parts: Vec<MeshPart>,
}

/// Why numbers are no mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// Rule 1.
    #[error("a skinned mesh needs a triangle and 1 to 65,536 joints")]
    Empty,
    /// Rule 2.
    #[error("triangle {0} names a vertex that does not exist")]
    Triangle(usize),
    /// Rules 2 and 3.
    #[error("vertex {0} has a joint, weight, normal or position that cannot be")]
    Vertex(usize),
    /// Rule 3.
    #[error("the bind matrix of joint {0} is not finite")]
    Joint(usize),
    /// Rule 4.
    #[error("part {0} does not begin where the one before it ends, or the last ends too early")]
    Part(usize),
}

impl SkinnedMesh {
    /// A mesh from its numbers.
    pub fn new(
        vertices: Vec<Vertex>,
        triangles: Vec<[u32; 3]>,
        joint_from_mesh: Vec<Mat4>,
        parts: Vec<MeshPart>,
    ) -> Result<Self, MeshError> {
        let n_joints = joint_from_mesh.len();
        if triangles.is_empty() || n_joints == 0 || n_joints > 1 << 16 {
            return Err(MeshError::Empty);
        }
        let names_none = |t: &[u32; 3]| t.iter().any(|&v| v as usize >= vertices.len());
        if let Some(bad) = triangles.iter().position(names_none) {
            return Err(MeshError::Triangle(bad));
        }
        let is_bad = |v: &Vertex| {
            let sum: f32 = v.weights.iter().sum();
            let is_near_one = |x: f32, tolerance: f32| (x - 1.0).abs() < tolerance; // false for NaN
            v.joints.iter().any(|&j| usize::from(j) >= n_joints)
                || !v.position_m.is_finite()
                || !v.uv.is_finite()
                || !is_near_one(v.normal.length(), 1e-2)
                || !is_near_one(sum, 1e-3)
                || v.weights.iter().any(|&w| w < 0.0)
        };
        if let Some(bad) = vertices.iter().position(is_bad) {
            return Err(MeshError::Vertex(bad));
        }
        if let Some(bad) = joint_from_mesh.iter().position(|m| !m.is_finite()) {
            return Err(MeshError::Joint(bad));
        }
        let mut next = 0;
        for (idx, part) in parts.iter().enumerate() {
            if part.first_triangle as usize != next {
                return Err(MeshError::Part(idx));
            }
            next += part.n_triangles as usize;
        }
        if next != triangles.len() {
            return Err(MeshError::Part(parts.len().saturating_sub(1)));
        }
        Ok(Self { vertices, triangles, joint_from_mesh, parts })
    }

    /// Its vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// Its triangles, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// From the mesh's space to each joint's, in the bind pose.
    pub fn joint_from_mesh(&self) -> &[Mat4] {
        &self.joint_from_mesh
    }

    /// Its triangles by material.
    pub fn parts(&self) -> &[MeshPart] {
        &self.parts
    }

    /// What [`Vertex::joints`] mean in a pose: `world_from_mesh` for each joint.
    pub fn skin_matrices(&self, world_from_joint: &[Mat4]) -> Vec<Mat4> {
        world_from_joint.iter().zip(&self.joint_from_mesh).map(|(w, j)| *w * *j).collect()
    }

    /// Where a vertex is in a pose: the formula at the type, in the order the graphics card takes.
    pub fn skinned_position_m(vertex: &Vertex, world_from_mesh: &[Mat4]) -> Vec3 {
        let blended = blend(vertex, world_from_mesh);
        blended.transform_point3(vertex.position_m)
    }

    /// Where its normal points in a pose.
    pub fn skinned_normal(vertex: &Vertex, world_from_mesh: &[Mat4]) -> Vec3 {
        blend(vertex, world_from_mesh).transform_vector3(vertex.normal).normalize_or_zero()
    }
}

fn blend(vertex: &Vertex, world_from_mesh: &[Mat4]) -> Mat4 {
    let mut blended = Mat4::ZERO;
    for (&joint, &weight) in vertex.joints.iter().zip(&vertex.weights) {
        blended += world_from_mesh[usize::from(joint)] * weight;
    }
    blended
}

/// A body's surface at several levels of detail, finest first, all for the same joints.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyModel {
    /// Never empty; each has fewer triangles than the one before.
    levels: Vec<Arc<SkinnedMesh>>,
    /// How far from each joint the surface goes that follows it, metres; 0 for joints that none
    /// does.
    reach_m: Vec<f32>,
}

/// A vertex that follows a joint by less than this stays with others.
const LEAST_SHARE: f32 = 0.15;

impl BodyModel {
    /// A model of one mesh or several, the finest first. `None` for none, or where joints differ.
    pub fn new(levels: Vec<Arc<SkinnedMesh>>) -> Option<Self> {
        let n_joints = levels.first()?.joint_from_mesh.len();
        let fits = levels.iter().all(|level| level.joint_from_mesh.len() == n_joints);
        let reach_m = reach_m(levels.last()?);
        fits.then_some(Self { levels, reach_m })
    }

    /// Its meshes, finest first.
    pub fn levels(&self) -> &[Arc<SkinnedMesh>] {
        &self.levels
    }

    /// How many joints a pose of it has.
    pub fn n_joints(&self) -> usize {
        self.reach_m.len()
    }

    /// Balls that hold the surface in a pose between them: middles and radii, metres. Joints that no
    /// surface follows have none.
    pub fn balls_m(&self, world_from_joint: &[Mat4]) -> impl Iterator<Item = (Vec3, f32)> {
        let joints = world_from_joint.iter().zip(&self.reach_m);
        joints.filter(|(_, reach_m)| **reach_m > 0.0).map(|(world, reach_m)| {
            let axes = [world.x_axis, world.y_axis, world.z_axis];
            let stretch = axes.map(|axis| axis.truncate().length()).into_iter().fold(0.0, f32::max);
            (world.w_axis.truncate(), reach_m * stretch)
        })
    }

    /// A box that holds the body in a pose; `None` where no joint is at a place.
    pub fn bounds(&self, world_from_joint: &[Mat4]) -> Option<Bounds> {
        self.balls_m(world_from_joint)
            .filter(|(middle, radius_m)| middle.is_finite() && radius_m.is_finite())
            .map(|(middle, radius_m)| Bounds::of_point(middle).grown(radius_m))
            .reduce(Bounds::union)
    }
}

fn reach_m(mesh: &SkinnedMesh) -> Vec<f32> {
    let mut reach_m = vec![0.0_f32; mesh.joint_from_mesh.len()];
    for vertex in &mesh.vertices {
        let most = vertex.weights.iter().copied().fold(0.0, f32::max);
        for (&joint, &weight) in vertex.joints.iter().zip(&vertex.weights) {
            if weight >= LEAST_SHARE.min(most) {
                let joint = usize::from(joint);
                let at = mesh.joint_from_mesh[joint].transform_point3(vertex.position_m);
                reach_m[joint] = reach_m[joint].max(at.length());
            }
        }
    }
    reach_m
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;

    fn parts(n_triangles: u32) -> Vec<MeshPart> {
        let material = Material {
            base_color: LinearRgba::WHITE,
            texture: None,
            roughness: 0.5,
            alpha_cutoff: 0.0,
            double_sided: false,
        };
        vec![MeshPart { first_triangle: 0, n_triangles, material }]
    }

    fn vertex(x: f32) -> Vertex {
        Vertex {
            position_m: Vec3::new(x, 1.0, 0.0),
            normal: Vec3::Z,
            uv: Vec2::ZERO,
            joints: [0, 1, 0, 0],
            weights: [0.25, 0.75, 0.0, 0.0],
        }
    }

    fn mesh(change: impl FnOnce(&mut Vec<Vertex>, &mut Vec<[u32; 3]>)) -> Result<(), MeshError> {
        let mut vertices = vec![vertex(0.0), vertex(1.0), vertex(2.0)];
        let mut triangles = vec![[0, 1, 2]];
        change(&mut vertices, &mut triangles);
        let parts = parts(triangles.len() as u32);
        SkinnedMesh::new(vertices, triangles, vec![Mat4::IDENTITY; 2], parts).map(|_| ())
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        assert_eq!(mesh(|_, _| {}), Ok(()));
        assert_eq!(mesh(|_, t| t.clear()), Err(MeshError::Empty));
        assert_eq!(mesh(|_, t| t.push([0, 1, 3])), Err(MeshError::Triangle(1)));
        assert_eq!(mesh(|v, _| v[1].joints[2] = 2), Err(MeshError::Vertex(1)));
        assert_eq!(mesh(|v, _| v[2].weights[0] = 0.5), Err(MeshError::Vertex(2)));
        assert_eq!(mesh(|v, _| v[0].weights = [1.5, -0.5, 0.0, 0.0]), Err(MeshError::Vertex(0)));
        assert_eq!(mesh(|v, _| v[0].weights[3] = f32::NAN), Err(MeshError::Vertex(0)));
        assert_eq!(mesh(|v, _| v[0].normal = Vec3::ZERO), Err(MeshError::Vertex(0)));
        assert_eq!(mesh(|v, _| v[0].position_m.y = f32::INFINITY), Err(MeshError::Vertex(0)));
        let three = vec![vertex(0.0); 3];
        let uncovered = SkinnedMesh::new(three, vec![[0, 1, 2]], vec![Mat4::IDENTITY; 2], parts(2));
        assert_eq!(uncovered, Err(MeshError::Part(0)));
    }

    #[test]
    fn skinning_is_the_weighted_mean_of_what_joints_do() {
        let lift = Mat4::from_translation(Vec3::Y);
        let turn = Mat4::from_quat(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2));
        let at = SkinnedMesh::skinned_position_m(&vertex(2.0), &[lift, turn]);
        // A quarter of (2, 2, 0) and three of (−1, 2, 0).
        assert!(at.distance(Vec3::new(-0.25, 2.0, 0.0)) < 1e-6, "{at}");
        let normal = SkinnedMesh::skinned_normal(&vertex(2.0), &[lift, turn]);
        assert!(normal.distance(Vec3::Z) < 1e-6, "{normal}");
    }

    #[test]
    fn models_have_levels_of_the_same_joints() {
        let of = |n_joints: usize| {
            let three = vec![vertex(0.0); 3];
            let joints = vec![Mat4::IDENTITY; n_joints];
            Arc::new(SkinnedMesh::new(three, vec![[0, 1, 2]], joints, parts(1)).unwrap())
        };
        assert!(BodyModel::new(Vec::new()).is_none());
        assert!(BodyModel::new(vec![of(2), of(3)]).is_none());
        assert_eq!(BodyModel::new(vec![of(2), of(2)]).unwrap().levels().len(), 2);
    }

    #[test]
    fn balls_hold_the_surface_in_every_pose() {
        let vertices = vec![vertex(0.0), vertex(1.0), vertex(2.0)];
        let bind = vec![
            Mat4::from_translation(-Vec3::Y),
            Mat4::from_translation(-Vec3::X),
            Mat4::IDENTITY,
        ];
        let mesh = SkinnedMesh::new(vertices, vec![[0, 1, 2]], bind, parts(1)).unwrap();
        let model = BodyModel::new(vec![Arc::new(mesh.clone())]).unwrap();
        let turn = Mat4::from_rotation_z(1.0);
        let pose =
            [Mat4::from_translation(Vec3::Y), turn * Mat4::from_scale(Vec3::splat(2.0)), turn];
        assert_eq!(model.balls_m(&pose).count(), 2, "nothing follows the third joint");
        let bounds = model.bounds(&pose).unwrap();
        let skin = mesh.skin_matrices(&pose);
        for vertex in mesh.vertices() {
            let at = SkinnedMesh::skinned_position_m(vertex, &skin);
            assert_eq!(bounds.union(Bounds::of_point(at)), bounds, "{at}");
        }
        assert_eq!(model.bounds(&[Mat4::NAN; 3]), None);
    }
}
