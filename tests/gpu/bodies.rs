//! Bodies for tests of drawing.

use std::f32::consts::TAU;
use std::sync::Arc;

use glam::{Mat4, Vec2, Vec3};
use motion_scene::color::LinearRgba;
use motion_scene::mesh::{BodyModel, Material, MeshId, MeshPart, SkinnedMesh, Texture, Vertex};

/// The name under which tests make a model known.
pub(crate) const TUBE: MeshId = MeshId(1);

/// An upright tube of radius 0.2 m from the floor to 2 m with a joint at each third, lower and
/// upper, whose weights pass smoothly from one to the other; `n` steps around and up.
pub(crate) fn tube(n: usize, texture: Option<Texture>) -> Arc<SkinnedMesh> {
    let mut vertices = Vec::new();
    for k in 0..=n {
        let up = k as f32 / n as f32;
        for i in 0..=n {
            let around = i as f32 / n as f32;
            let normal = Vec3::new((around * TAU).sin(), 0.0, (around * TAU).cos());
            let upper = ((up - 0.3) / 0.4).clamp(0.0, 1.0);
            let upper = upper * upper * (3.0 - 2.0 * upper);
            vertices.push(Vertex {
                position_m: 0.2 * normal + Vec3::Y * 2.0 * up,
                normal,
                uv: Vec2::new(4.0 * around, 4.0 * up),
                joints: [0, 1, 0, 0],
                weights: [1.0 - upper, upper, 0.0, 0.0],
            });
        }
    }
    let at = |i: usize, k: usize| (k * (n + 1) + i) as u32;
    let mut triangles = Vec::new();
    for k in 0..n {
        for i in 0..n {
            triangles.push([at(i, k), at(i + 1, k), at(i + 1, k + 1)]);
            triangles.push([at(i, k), at(i + 1, k + 1), at(i, k + 1)]);
        }
    }
    let part = MeshPart {
        first_triangle: 0,
        n_triangles: triangles.len() as u32,
        material: Material {
            base_color: LinearRgba::WHITE,
            texture: texture.map(Arc::new),
            roughness: 0.6,
            alpha_cutoff: 0.0,
            double_sided: true,
        },
    };
    let joint_from_mesh = JOINTS_M.map(|joint| Mat4::from_translation(-joint)).to_vec();
    let mesh = SkinnedMesh::new(vertices, triangles, joint_from_mesh, vec![part]);
    Arc::new(mesh.expect("a tube is a mesh"))
}

const JOINTS_M: [Vec3; 2] = [Vec3::new(0.0, 0.66, 0.0), Vec3::new(0.0, 1.0, 0.0)];

/// A model of tubes with ever fewer triangles.
pub(crate) fn tube_model() -> BodyModel {
    BodyModel::new([64, 24, 10].map(|n| tube(n, None)).to_vec()).expect("tubes are alike")
}

/// Joints of a tube at a place whose upper half leans forward by `bend_rad`.
pub(crate) fn bent(at_m: Vec3, bend_rad: f32) -> Vec<Mat4> {
    let place = Mat4::from_translation(at_m);
    vec![
        place * Mat4::from_translation(JOINTS_M[0]),
        place * Mat4::from_translation(JOINTS_M[1]) * Mat4::from_rotation_x(bend_rad),
    ]
}

/// Squares in two colours.
pub(crate) fn checks() -> Texture {
    let rgba = [[230, 80, 60, 255], [240, 240, 240, 255], [240, 240, 240, 255], [230, 80, 60, 255]];
    Texture { width: 2, height: 2, rgba: rgba.concat() }
}
