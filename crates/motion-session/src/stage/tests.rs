use std::sync::Arc;

use glam::{Mat4, Vec2};
use motion_io::project_file::{Extra, Shape};
use motion_scene::color::LinearRgba;
use motion_scene::mesh::{BodyModel, Material, MeshId, MeshPart, SkinnedMesh, Vertex};

use super::figure::Figure;
use super::*;
use crate::fixture::library;

/// A figure of a triangle at every joint; only its joints matter here.
fn stick_figure(n_joints: usize) -> Figure {
    let vertex = |joint: usize, x: f32| Vertex {
        position_m: Vec3::new(x, 0.0, 0.0),
        normal: Vec3::Z,
        uv: Vec2::ZERO,
        joints: [joint as u16, 0, 0, 0],
        weights: [1.0, 0.0, 0.0, 0.0],
    };
    let vertices: Vec<Vertex> =
        (0..n_joints).flat_map(|j| [-0.05, 0.0, 0.05].map(|x| vertex(j, x))).collect();
    let triangles: Vec<[u32; 3]> =
        (0..n_joints as u32).map(|j| [3 * j, 3 * j + 1, 3 * j + 2]).collect();
    let material = Material {
        base_color: LinearRgba::WHITE,
        texture: None,
        roughness: 1.0,
        alpha_cutoff: 0.0,
        double_sided: true,
    };
    let parts = vec![MeshPart { first_triangle: 0, n_triangles: n_joints as u32, material }];
    let mesh =
        SkinnedMesh::new(vertices, triangles, vec![Mat4::IDENTITY; n_joints], parts).unwrap();
    Figure::new(MeshId(7), BodyModel::new(vec![Arc::new(mesh)]).unwrap())
}

/// The fixture's first walk (90 frames, 1.2 m/s ahead).
pub(crate) fn walk_stage() -> Stage {
    let library = library();
    let skeleton = library.clips.skeleton().clone();
    let actor = Actor {
        name: "A".to_owned(),
        figure: Arc::new(stick_figure(skeleton.n_joints())),
        skeleton: Arc::new(skeleton),
        motion: Arc::new(library.clips.clips()[0].motion.clone()),
        look: Look::neutral(Theme::Dark),
    };
    Stage::new(Theme::Dark, vec![actor])
}

#[test]
fn a_moment_has_its_actors_where_they_are() {
    let stage = walk_stage();
    let Staged { scene, picks } = stage.scene_at(40.5, Show::default());
    let [body] = scene.bodies.as_slice() else { panic!("one body") };
    let root_m = body.world_from_joint[0].w_axis.truncate();
    assert!(root_m.distance(stage.actors[0].root_at_m(40.5)) < 1e-6);
    let target = body.pick.and_then(|id| picks.target(id));
    assert_eq!(target, Some(PickTarget::Actor { actor: 0 }));
    assert!(scene.trails.is_empty() && scene.labels.is_empty());
}

#[test]
fn ghosts_and_trails_are_added_when_asked_for() {
    let stage = walk_stage();
    let show = Show { ghosts: 5, trail: true, ..Show::default() };
    let Staged { scene, picks } = stage.scene_at(10.0, show);
    assert_eq!(scene.bodies.len(), 6);
    let frames: Vec<_> = scene.bodies[1..].iter().filter_map(|b| picks.target(b.pick?)).collect();
    let expected = fan::spread(stage.n_frames(), 5);
    assert_eq!(
        frames,
        expected.iter().map(|&frame| PickTarget::Ghost { actor: 0, frame }).collect::<Vec<_>>()
    );
    assert!(scene.bodies[1..].iter().all(|body| matches!(body.look, Look::Ghost(_))));
    assert_eq!((scene.trails[0].now, scene.trails[0].points_m.len()), (10, stage.n_frames()));
}

#[test]
fn a_fan_numbers_its_poses_over_their_heads() {
    let stage = walk_stage();
    let frames = vec![0, 45, 89];
    let Staged { scene, .. } = stage.fan(&[frames], Show { trail: true, ..Show::default() });
    let texts: Vec<&str> = scene.labels.iter().map(|label| label.text.as_str()).collect();
    assert_eq!(texts, ["0", "45", "89"]);
    for (label, body) in scene.labels.iter().zip(&scene.bodies) {
        let LabelPlace::World(at_m) = label.place else { panic!("a place in the world") };
        let bounds = stage.actors[0].figure.bounds(&body.world_from_joint).unwrap();
        assert!(at_m.y > bounds.max_m.y, "{at_m}");
    }
    let way = stage.actors[0].ground_path_m();
    assert_eq!(scene.lines.first().map(|l| l.points_m[0]), way.first().copied());
    assert_eq!(scene.lines.last().and_then(|l| l.points_m.last()), way.last());
}

#[test]
fn what_the_project_says_is_there_unless_it_is_not_asked_for() {
    let mut stage = walk_stage();
    let shape = Shape::Cylinder { center_m: [1.0, 0.5, 2.0], radius_m: 0.3, height_m: 1.0 };
    stage.obstacles = vec![Obstacle { shape, extra: Extra::new() }];
    let sample = crate::sample::sample().unwrap();
    let constraints = sample.characters[0].constraints.clone();
    stage.roles = vec![Role { constraints, ..Role::default() }];
    let scene = stage.scene_at(0.0, Show::default()).scene;
    assert_eq!((scene.checkpoints.len(), scene.solids.len()), (3, 1));
    assert_eq!(scene.checkpoints[1].position_m, Vec3::new(1.0, 0.0, 4.2));
    let bare = stage.scene_at(0.0, Show { wishes: false, ..Show::default() }).scene;
    assert_eq!((bare.checkpoints.len(), bare.solids.len()), (0, 1));
}
