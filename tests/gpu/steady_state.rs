//! After the first pictures nothing is made on the device any more.

use glam::vec3;
use motion_render::view::View;
use motion_scene::body::{Body, Emphasis, Look};
use motion_scene::camera::{OrbitCamera, StandardView};
use motion_scene::color::Theme;
use motion_scene::scene::Scene;
use motion_scene::trail::Trail;

use crate::bodies::{TUBE, bent, tube_model};
use crate::pictures::offscreen;

#[test]
fn nothing_is_made_in_steady_state() {
    let Some(mut offscreen) = offscreen() else { return };
    offscreen.set_model(TUBE, &tube_model());
    let mut after_first = None;
    for frame in 0..30 {
        let t = frame as f32 / 30.0;
        let mut scene = Scene::empty(Theme::Dark);
        for i in 0..5 {
            let at_m = vec3(i as f32 - 2.0, 0.0, 2.0 * t);
            let mut body = Body::new(TUBE, bent(at_m, t), Look::neutral(scene.theme));
            if i == frame % 5 {
                body.emphasis = Emphasis::Hovered;
            }
            scene.bodies.push(body);
        }
        let points_m = (0..60).map(|k| vec3(0.1 * k as f32, t, 0.0)).collect();
        scene.trails.push(Trail { points_m, now: frame });
        let mut camera =
            OrbitCamera::standard(StandardView::ThreeQuarter, vec3(0.0, 1.0, 0.0), 8.0);
        camera.orbit(t, 0.0);
        let view = View { camera, width_px: 96, height_px: 64, pixels_per_point: 1.0 };
        let stats = offscreen.draw_only(&scene, &view).unwrap();
        offscreen.pick(&scene, &view, glam::vec2(40.0, 30.0)).unwrap();
        // The second picture has met everything there is once.
        match after_first {
            None if frame == 1 => after_first = Some(offscreen.gpu().created()),
            None => {}
            Some(created) => assert_eq!(stats.created, created, "picture {frame}"),
        }
    }
}

#[test]
fn bodies_of_one_model_are_one_draw() {
    let Some(mut offscreen) = offscreen() else { return };
    offscreen.set_model(TUBE, &tube_model());
    let mut scene = Scene::empty(Theme::Dark);
    for i in 0..100 {
        let at_m = vec3((i % 10) as f32 - 5.0, 0.0, (i / 10) as f32 - 5.0);
        scene.bodies.push(Body::new(TUBE, bent(at_m, 0.3), Look::neutral(scene.theme)));
    }
    let camera = OrbitCamera::standard(StandardView::Top, vec3(0.0, 0.0, 0.0), 30.0);
    let view = View { camera, width_px: 96, height_px: 96, pixels_per_point: 1.0 };
    let stats = offscreen.draw_only(&scene, &view).unwrap();
    assert_eq!(stats.n_body_batches, 1);
    let coarsest = tube_model().levels().last().unwrap().triangles().len() as u64;
    assert_eq!(stats.n_body_triangles, 100 * coarsest, "small bodies need few triangles");
}
