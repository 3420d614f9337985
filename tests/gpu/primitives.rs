//! One small picture for each kind of thing.

use glam::{Vec2, Vec3, vec3};
use motion_render::picture::Picture;
use motion_render::view::View;
use motion_scene::body::{Body, Emphasis, Look};
use motion_scene::camera::{OrbitCamera, StandardView};
use motion_scene::color::{ColorRole, LinearRgba, Theme};
use motion_scene::label::{Anchor, Label, LabelPlace};
use motion_scene::line::{Line, Occlusion};
use motion_scene::marker::{Checkpoint, JointTarget};
use motion_scene::mesh::BodyModel;
use motion_scene::scene::Scene;
use motion_scene::solid::Solid;
use motion_scene::trail::Trail;

use crate::bodies::{TUBE, bent, checks, tube, tube_model};
use crate::pictures::{assert_is_kept, offscreen};

/// Draws a scene 160 × 120 from the front left, looking at `target_m`.
fn drawn(scene: &Scene, model: &BodyModel, target_m: Vec3, distance_m: f32) -> Option<Picture> {
    let camera = OrbitCamera::standard(StandardView::ThreeQuarter, target_m, distance_m);
    drawn_from(scene, model, camera)
}

fn drawn_from(scene: &Scene, model: &BodyModel, camera: OrbitCamera) -> Option<Picture> {
    let mut offscreen = offscreen()?;
    offscreen.set_model(TUBE, model);
    let view = View { camera, width_px: 160, height_px: 120, pixels_per_point: 1.0 };
    Some(offscreen.render(scene, &view).unwrap())
}

#[track_caller]
fn check(name: &str, scene: &Scene, target_m: Vec3, distance_m: f32) {
    if let Some(picture) = drawn(scene, &tube_model(), target_m, distance_m) {
        assert_is_kept(name, &picture);
    }
}

/// Nothing but sky and what is added: grid and numbers have pictures of their own.
fn without_floor() -> Scene {
    Scene { ground: None, ..Scene::empty(Theme::Dark) }
}

fn plain_floor() -> Scene {
    let mut scene = Scene::empty(Theme::Dark);
    if let Some(ground) = &mut scene.ground {
        ground.has_grid = false;
    }
    scene
}

fn solid_body(at_m: Vec3, bend_rad: f32) -> Body {
    Body::new(TUBE, bent(at_m, bend_rad), Look::neutral(Theme::Dark))
}

#[test]
fn floor_grid() {
    check("floor_grid_dark", &Scene::empty(Theme::Dark), Vec3::ZERO, 9.0);
    check("floor_grid_light", &Scene::empty(Theme::Light), Vec3::ZERO, 9.0);
}

#[test]
fn floor_from_the_side_and_from_above() {
    for (name, view) in [("side", StandardView::Left), ("top", StandardView::Top)] {
        let camera = OrbitCamera::standard(view, Vec3::Y, 7.0);
        let mut scene = Scene::empty(Theme::Dark);
        scene.bodies.push(solid_body(Vec3::ZERO, 0.8));
        if let Some(picture) = drawn_from(&scene, &tube_model(), camera) {
            assert_is_kept(&format!("floor_{name}"), &picture);
        }
    }
}

#[test]
fn solid_body_with_shadow_and_contact() {
    let mut scene = plain_floor();
    scene.bodies.push(solid_body(Vec3::ZERO, 0.9));
    check("body_shadow", &scene, vec3(0.0, 0.9, 0.0), 7.0);
}

#[test]
fn textured_body() {
    let model = BodyModel::new(vec![tube(24, Some(checks()))]).unwrap();
    let mut scene = without_floor();
    scene.bodies.push(Body::new(TUBE, bent(Vec3::ZERO, 0.6), Look::own_colors()));
    if let Some(picture) = drawn(&scene, &model, vec3(0.0, 1.0, 0.2), 5.0) {
        assert_is_kept("body_textured", &picture);
    }
}

#[test]
fn ghosts_show_what_is_behind_and_not_their_insides() {
    let mut scene = plain_floor();
    scene.bodies.push(solid_body(vec3(0.0, 0.0, -0.8), 0.0));
    for (n, x) in [(0, -0.7), (1, 0.0), (2, 0.7)] {
        let look = Look::ghost(ColorRole::Take(n), scene.theme);
        scene.bodies.push(Body::new(TUBE, bent(vec3(x, 0.0, 0.0), 1.2), look));
    }
    check("ghosts", &scene, vec3(0.0, 0.9, 0.0), 7.0);
}

#[test]
fn outlines_of_selected_and_hovered() {
    let mut scene = without_floor();
    for (x, emphasis) in [(-0.6, Emphasis::Selected), (0.6, Emphasis::Hovered)] {
        let mut body = solid_body(vec3(x, 0.0, 0.0), 0.5);
        body.emphasis = emphasis;
        scene.bodies.push(body);
    }
    // Outlines are seen through what stands before them.
    scene.bodies.push(solid_body(vec3(-0.2, 0.0, 0.9), 0.0));
    check("outlines", &scene, vec3(0.0, 1.0, 0.0), 7.0);
}

#[test]
fn obstacles() {
    let mut scene = plain_floor();
    let theme = scene.theme;
    scene.solids.push(Solid::obstacle_box(vec3(-0.9, 0.4, 0.0), vec3(0.8, 0.8, 0.6), 0.4, theme));
    scene.solids.push(Solid::obstacle_cylinder(vec3(0.4, 0.6, -0.3), 0.25, 1.2, theme));
    scene.solids.push(Solid::ceiling(vec3(0.9, 1.5, 0.5), 1.0, 0.8, 0.0, theme));
    scene.solids.push(Solid::ball(vec3(1.1, 0.3, 0.6), 0.3, ColorRole::JointTarget.color(theme)));
    check("obstacles", &scene, vec3(0.0, 0.7, 0.0), 6.0);
}

#[test]
fn checkpoints() {
    let mut scene = plain_floor();
    let mark = |x: f32, heading_rad: f32, is_exact: bool, label: &str| Checkpoint {
        position_m: vec3(x, 0.0, 0.0),
        heading_rad,
        is_exact,
        tolerance_m: (!is_exact).then_some(0.45),
        label: label.to_owned(),
        is_off: false,
        emphasis: Emphasis::None,
        pick: None,
        pick_tip: None,
    };
    scene.checkpoints = vec![mark(-0.8, 0.0, true, "1 · f 0"), mark(0.8, 1.57, false, "2")];
    scene.checkpoints[1].emphasis = Emphasis::Selected;
    check("checkpoints", &scene, Vec3::ZERO, 5.0);
}

#[test]
fn joint_target() {
    let mut scene = plain_floor();
    scene.joint_targets.push(JointTarget {
        position_m: vec3(0.0, 1.2, 0.0),
        floor_m: 0.0,
        label: "Head 1.20 m".to_owned(),
        is_off: false,
        emphasis: Emphasis::None,
        pick: None,
    });
    check("joint_target", &scene, vec3(0.0, 0.7, 0.0), 4.0);
}

#[test]
fn trail_with_a_dot_for_every_frame() {
    let mut scene = without_floor();
    let points_m = (0..40).map(|i| i as f32 / 39.0);
    let points_m = points_m.map(|t| vec3(2.0 * t - 1.0, 0.3 * (6.0 * t).sin(), 0.0)).collect();
    scene.trails.push(Trail { points_m, now: 15 });
    check("trail", &scene, Vec3::ZERO, 4.0);
}

#[test]
fn lines_before_behind_and_through_a_body() {
    let mut scene = without_floor();
    scene.bodies.push(solid_body(Vec3::ZERO, 0.0));
    let line = |y: f32, z: f32, role: ColorRole| {
        Line::new(vec![vec3(-0.8, y, z), vec3(0.8, y, z)], role.color(Theme::Dark), 4.0)
    };
    scene.lines = vec![
        line(1.4, 0.6, ColorRole::Past),
        line(1.0, -0.6, ColorRole::Future),
        Line { occlusion: Occlusion::Shown, ..line(0.6, -0.6, ColorRole::Miss) },
    ];
    // Behind the eye on one end.
    let far = vec![vec3(0.0, 1.9, -30.0), vec3(4.0, 1.9, 30.0)];
    scene.lines.push(Line::new(far, ColorRole::Pose.color(Theme::Dark), 2.0));
    check("lines", &scene, vec3(0.0, 1.0, 0.0), 5.0);
}

#[test]
fn words() {
    let mut scene = without_floor();
    let label = |text: &str, place, anchor, plate: bool| Label {
        text: text.to_owned(),
        place,
        anchor,
        clear_m: 0.0,
        occlusion: Occlusion::Shown,
        size_pt: 13.0,
        color: ColorRole::Text.color(Theme::Dark),
        plate: plate.then_some(LinearRgba::from_srgb_hex(0x2B6CB0)),
    };
    scene.labels = vec![
        label("2 · f 80 · 4 cm", LabelPlace::World(Vec3::ZERO), Anchor::Below, true),
        label("→ −0.5°", LabelPlace::Picture(Vec2::new(6.0, 14.0)), Anchor::Left, false),
        label("Äé × 3", LabelPlace::Picture(Vec2::new(80.0, 100.0)), Anchor::Center, true),
    ];
    check("words", &scene, Vec3::ZERO, 5.0);
}

#[test]
fn finer_screens_show_the_same_with_more_pixels() {
    let Some(mut offscreen) = offscreen() else { return };
    let mut scene = plain_floor();
    scene.trails.push(Trail { points_m: vec![vec3(-1.0, 0.5, 0.0), vec3(1.0, 0.5, 0.0)], now: 0 });
    let camera = OrbitCamera::standard(StandardView::ThreeQuarter, Vec3::ZERO, 5.0);
    let view = View { camera, width_px: 320, height_px: 240, pixels_per_point: 2.0 };
    assert_is_kept("fine_screen", &offscreen.render(&scene, &view).unwrap());
}
