//! Obstacles of a project as solids.

use glam::Vec3;
use motion_io::project_file::{Obstacle, Shape};
use motion_scene::color::Theme;
use motion_scene::solid::Solid;

use super::pick::{PickTarget, Picks};

/// The project's obstacles, in its order.
pub fn obstacles(obstacles: &[Obstacle], theme: Theme, picks: &mut Picks) -> Vec<Solid> {
    let named = obstacles.iter().enumerate().map(|(nth, obstacle)| {
        let mut solid = solid_of(&obstacle.shape, theme);
        solid.pick = picks.name(PickTarget::Obstacle { obstacle: nth });
        solid
    });
    named.collect()
}

fn solid_of(shape: &Shape, theme: Theme) -> Solid {
    match *shape {
        Shape::Box { center_m, size_m, heading_deg } => {
            Solid::obstacle_box(vec3(center_m), vec3(size_m), radians(heading_deg), theme)
        }
        Shape::Cylinder { center_m, radius_m, height_m } => {
            Solid::obstacle_cylinder(vec3(center_m), radius_m as f32, height_m as f32, theme)
        }
        Shape::Ceiling { center_m, size_m: [width_m, _, depth_m], heading_deg } => {
            let (width_m, depth_m) = (width_m as f32, depth_m as f32);
            Solid::ceiling(vec3(center_m), width_m, depth_m, radians(heading_deg), theme)
        }
    }
}

fn vec3(numbers: [f64; 3]) -> Vec3 {
    Vec3::from_array(numbers.map(|x| x as f32))
}

fn radians(degrees: f64) -> f32 {
    degrees.to_radians() as f32
}

#[cfg(test)]
mod tests {
    use motion_io::project_file::Extra;

    use super::*;

    #[test]
    fn solids_fill_what_the_project_says() {
        let shapes = [
            Shape::Box { center_m: [1.0, 0.5, 2.0], size_m: [2.0, 1.0, 1.0], heading_deg: 90.0 },
            Shape::Cylinder { center_m: [0.0, 1.0, 3.0], radius_m: 0.4, height_m: 2.0 },
            Shape::Ceiling { center_m: [0.0, 1.4, 5.0], size_m: [2.0, 0.0, 1.0], heading_deg: 0.0 },
        ];
        let all: Vec<Obstacle> =
            shapes.into_iter().map(|shape| Obstacle { shape, extra: Extra::new() }).collect();
        let mut picks = Picks::default();
        let solids = obstacles(&all, Theme::Dark, &mut picks);
        let corner = |nth: usize, p: Vec3| solids[nth].world_from_solid.transform_point3(p);
        // The box's own x (2 m long) lies along −Z after a quarter turn.
        assert!(corner(0, Vec3::X * 0.5).distance(Vec3::new(1.0, 0.5, 1.0)) < 1e-5);
        assert!(corner(1, Vec3::Y * 0.5).distance(Vec3::new(0.0, 2.0, 3.0)) < 1e-5);
        assert!((corner(2, Vec3::Y * -0.5).y - 1.4).abs() < 1e-5, "its lower side is the limit");
        let second = solids[1].pick.and_then(|id| picks.target(id));
        assert_eq!(second, Some(PickTarget::Obstacle { obstacle: 1 }));
    }
}
