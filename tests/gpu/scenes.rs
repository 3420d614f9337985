//! Whole scenes: a person on the floor, ghosts, obstacles, wishes.

use std::sync::Arc;

use glam::{Vec3, vec3};
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;
use motion_io::diagnostic::Warnings;
use motion_io::import::{ReadOptions, read_motion_file};
use motion_render::picture::Picture;
use motion_render::view::View;
use motion_scene::body::{Emphasis, Look};
use motion_scene::bounds::Bounds;
use motion_scene::camera::OrbitCamera;
use motion_scene::color::{ColorRole, Theme};
use motion_scene::marker::{Checkpoint, JointTarget};
use motion_scene::mesh::MeshId;
use motion_scene::scene::Scene;
use motion_scene::solid::Solid;
use motion_scene::trail::Trail;
use motion_session::stage::actor::Actor;
use motion_session::stage::figure::Figure;
use motion_session::stage::standing::set_on_floor;
use motion_tests::shared_dir;

use crate::pictures::{assert_is_kept, offscreen};

fn actor(skeleton: Skeleton, motion: Motion, theme: Theme) -> Actor {
    let standing = set_on_floor(&skeleton, motion, None);
    let motion = standing.motion;
    let figure = Figure::mannequin(MeshId(7), &skeleton, Some(&motion), standing.soles);
    Actor {
        name: "A".to_owned(),
        figure: Arc::new(figure),
        skeleton: Arc::new(skeleton),
        motion: Arc::new(motion),
        look: Look::neutral(theme),
    }
}

/// A built-in clip on the built-in body.
pub(crate) fn performer(clip: &str, theme: Theme) -> Actor {
    let clips = motion_performer::builtin_clips().unwrap();
    let found = clips.clips().iter().find(|c| c.id == clip).expect("it is built in");
    actor(clips.skeleton().clone(), found.motion.clone(), theme)
}

/// 320 × 240, everything in `bounds` in view.
fn drawn(actor: &Actor, scene: &Scene, bounds: &Bounds, yaw_rad: f32) -> Option<Picture> {
    let mut offscreen = offscreen()?;
    offscreen.set_model(actor.figure.mesh, &actor.figure.model);
    let mut view = View {
        camera: OrbitCamera { yaw_rad, ..OrbitCamera::default() },
        width_px: 320,
        height_px: 240,
        pixels_per_point: 1.0,
    };
    view.camera.frame(bounds, view.viewport(), 0.08);
    Some(offscreen.render(scene, &view).unwrap())
}

#[test]
fn a_person_walks() {
    for (name, theme) in [("person_dark", Theme::Dark), ("person_light", Theme::Light)] {
        let actor = performer("walk", theme);
        let mut scene = Scene::empty(theme);
        scene.bodies.push(actor.body_at(20.0, actor.look));
        let bounds = actor.bounds_at(20.0).unwrap();
        let Some(picture) = drawn(&actor, &scene, &bounds, 0.65) else { return };
        assert_is_kept(name, &picture);
    }
}

#[test]
fn a_captured_person_runs() {
    let Some(shared) = shared_dir() else { return };
    let path = shared.join("mocap/cmu/16_35.bvh");
    let file = read_motion_file(&path, &ReadOptions::default(), &mut Warnings::new()).unwrap();
    let motion = file.motion.resampled(Fps::THIRTY);
    let actor = actor(file.skeleton, motion, Theme::Dark);
    let mut scene = Scene::empty(Theme::Dark);
    scene.bodies.push(actor.body_at(20.0, actor.look));
    let bounds = actor.bounds_at(20.0).unwrap();
    let Some(picture) = drawn(&actor, &scene, &bounds, 1.2) else { return };
    assert_is_kept("person_captured", &picture);
}

#[test]
fn ten_ghosts_an_obstacle_and_wishes() {
    let theme = Theme::Dark;
    let actor = performer("walk", theme);
    let mut scene = Scene::empty(theme);
    let mut bounds = actor.bounds_at(0.0).unwrap();
    let last = actor.n_frames() as f64 - 1.0;
    for k in 0..10 {
        let look = Look::ghost(ColorRole::Take(k), theme);
        let frame = last * k as f64 / 9.0;
        scene.bodies.push(actor.body_at(frame, look));
        bounds = bounds.union(actor.bounds_at(frame).unwrap());
    }
    let mut shown = actor.body_at(0.5 * last, actor.look);
    shown.emphasis = Emphasis::Selected;
    scene.bodies.push(shown);
    let end = actor.root_at_m(last).with_y(0.0);
    scene.checkpoints.push(Checkpoint {
        position_m: end,
        heading_rad: 0.0,
        is_exact: true,
        tolerance_m: None,
        label: format!("2 · f {last}"),
        is_off: false,
        emphasis: Emphasis::None,
        pick: None,
        pick_tip: None,
    });
    scene.joint_targets.push(JointTarget {
        position_m: actor.root_at_m(0.5 * last) + vec3(0.6, 0.8, 0.0),
        floor_m: 0.0,
        label: "Head".to_owned(),
        is_off: false,
        emphasis: Emphasis::None,
        pick: None,
    });
    let beside = vec3(-0.9, 0.35, 0.5 * end.z);
    scene.solids.push(Solid::obstacle_box(beside, Vec3::splat(0.7), 0.4, theme));
    scene.trails.push(Trail { points_m: actor.ground_path_m(), now: last as usize / 2 });
    let Some(picture) = drawn(&actor, &scene, &bounds, 1.1) else { return };
    assert_is_kept("ghosts_obstacle_wishes", &picture);
}

/// Feet stand on the floor in the picture: seen level from the side, the lowest row in which the
/// body shows is that of the floor.
#[test]
fn soles_end_where_the_floor_begins() {
    use motion_scene::camera::StandardView;

    let Some(mut offscreen) = offscreen() else { return };
    let actor = performer("idle", Theme::Light);
    offscreen.set_model(actor.figure.mesh, &actor.figure.model);
    let mut scene = Scene { ground: None, ..Scene::empty(Theme::Light) };
    let camera = OrbitCamera::standard(StandardView::Left, vec3(0.0, 0.1, 0.0), 1.2);
    let view = View { camera, width_px: 300, height_px: 300, pixels_per_point: 1.0 };
    let bare = offscreen.render(&scene, &view).unwrap();
    scene.bodies.push(actor.body_at(0.0, Look::neutral(Theme::Dark)));
    let with_body = offscreen.render(&scene, &view).unwrap();
    let differs = |y: u32| (0..300).any(|x| bare.pixel(x, y) != with_body.pixel(x, y));
    let lowest = (0..300).rev().find(|&y| differs(y)).expect("there are feet");
    let floor_px = camera.project(Vec3::ZERO, view.viewport()).unwrap().px.y;
    let mm = (floor_px - (lowest + 1) as f32) * 1e3 * camera.metres_per_px(1.0, view.viewport());
    assert!(mm.abs() < 4.0, "soles end {mm} mm over the floor");
}
