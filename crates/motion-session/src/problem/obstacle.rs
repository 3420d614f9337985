//! Obstacles, which are in everybody's way.

use glam::{DVec3, Vec2, Vec3};
use motion_core::constraint::Obstacle;
use motion_io::project_file::{self, Shape};

/// The solid of an obstacle.
pub(super) fn wish(obstacle: &project_file::Obstacle) -> Obstacle {
    let vector = |metres: [f64; 3]| DVec3::from(metres).as_vec3();
    match obstacle.shape {
        Shape::Box { center_m, size_m, heading_deg } => Obstacle::Box {
            center_m: vector(center_m),
            size_m: vector(size_m),
            heading_rad: heading_deg.to_radians() as f32,
        },
        Shape::Cylinder { center_m, radius_m, height_m } => Obstacle::Cylinder {
            center_m: vector(center_m),
            radius_m: radius_m as f32,
            height_m: height_m as f32,
        },
        Shape::Ceiling { center_m, size_m, heading_deg } => {
            let size_m: Vec3 = vector(size_m);
            Obstacle::Ceiling {
                center_m: vector(center_m),
                size_m: Vec2::new(size_m.x, size_m.z),
                heading_rad: heading_deg.to_radians() as f32,
            }
        }
    }
}
