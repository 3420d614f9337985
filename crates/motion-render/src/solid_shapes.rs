//! The triangles of boxes, cylinders and balls of size 1.

use std::f32::consts::{PI, TAU};

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use motion_scene::solid::Shape;

/// All shapes, in the order of their numbers.
pub(crate) const SHAPES: [Shape; 3] = [Shape::Box, Shape::Cylinder, Shape::Sphere];

/// A corner of a triangle. Keep in sync with `Vertex` in solids.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct ShapeVertex {
    position: [f32; 3],
    normal: [f32; 3],
}

const N_AROUND: usize = 48;
const N_UP: usize = 24;

/// Its triangles, three vertices each, counter-clockwise seen from outside.
pub(crate) fn shape_triangles(shape: Shape) -> Vec<ShapeVertex> {
    match shape {
        Shape::Box => cube(),
        Shape::Cylinder => cylinder(),
        Shape::Sphere => sphere(),
    }
}

fn vertex(position: Vec3, normal: Vec3) -> ShapeVertex {
    ShapeVertex { position: position.into(), normal: normal.into() }
}

fn cube() -> Vec<ShapeVertex> {
    let mut out = Vec::with_capacity(36);
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let normal = Vec3::AXES[axis] * sign;
            let along = Vec3::AXES[(axis + 1) % 3] * sign;
            let across = Vec3::AXES[(axis + 2) % 3];
            let at = |a: f32, b: f32| vertex(0.5 * (normal + along * a + across * b), normal);
            out.extend([at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0)]);
            out.extend([at(-1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]);
        }
    }
    out
}

fn around(i: usize) -> Vec3 {
    let angle = i as f32 / N_AROUND as f32 * TAU;
    Vec3::new(angle.sin(), 0.0, angle.cos())
}

fn cylinder() -> Vec<ShapeVertex> {
    let mut out = Vec::new();
    for i in 0..N_AROUND {
        let (a, b) = (around(i), around(i + 1));
        let rim = |direction: Vec3, y: f32| 0.5 * (direction + Vec3::Y * y);
        let wall = |direction: Vec3, y: f32| vertex(rim(direction, y), direction);
        out.extend([wall(a, -1.0), wall(b, -1.0), wall(b, 1.0)]);
        out.extend([wall(a, -1.0), wall(b, 1.0), wall(a, 1.0)]);
        let cap = |direction: Vec3, y: f32| vertex(rim(direction, y), Vec3::Y * y);
        let middle = |y: f32| vertex(Vec3::Y * 0.5 * y, Vec3::Y * y);
        out.extend([middle(1.0), cap(a, 1.0), cap(b, 1.0)]);
        out.extend([middle(-1.0), cap(b, -1.0), cap(a, -1.0)]);
    }
    out
}

fn sphere() -> Vec<ShapeVertex> {
    let at = |i: usize, k: usize| {
        let up = PI * (k as f32 / N_UP as f32 - 0.5);
        let direction = around(i) * up.cos() + Vec3::Y * up.sin();
        vertex(0.5 * direction, direction)
    };
    let mut out = Vec::new();
    for i in 0..N_AROUND {
        for k in 0..N_UP {
            out.extend([at(i, k), at(i + 1, k), at(i + 1, k + 1)]);
            out.extend([at(i, k), at(i + 1, k + 1), at(i, k + 1)]);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_closed_and_look_outwards() {
        let volumes = [1.0, PI / 4.0, PI / 6.0];
        for (shape, expected) in SHAPES.into_iter().zip(volumes) {
            let triangles = shape_triangles(shape);
            let mut volume = 0.0;
            for triangle in triangles.chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|i| Vec3::from(triangle[i].position));
                volume += a.dot(b.cross(c)) / 6.0;
                let normal = Vec3::from(triangle[0].normal);
                assert!(a.dot(normal) > 0.0, "{shape:?}");
                assert!((b - a).cross(c - a).dot(normal) >= -1e-6, "{shape:?}");
            }
            assert!((volume / expected - 1.0).abs() < 0.02, "{shape:?}: {volume} for {expected}");
        }
        assert_eq!(SHAPES.map(|shape| shape as usize), [0, 1, 2]);
    }
}
