//! A device that goes is replaced, and the picture is the same.

use glam::vec3;
use motion_render::view::View;
use motion_scene::body::{Body, Look, PickId};
use motion_scene::camera::{OrbitCamera, StandardView};
use motion_scene::color::Theme;
use motion_scene::scene::Scene;

use crate::bodies::{TUBE, bent, tube_model};
use crate::pictures::offscreen;

#[test]
fn a_destroyed_device_is_replaced() {
    let Some(mut offscreen) = offscreen() else { return };
    offscreen.set_model(TUBE, &tube_model());
    let mut scene = Scene::empty(Theme::Dark);
    let body = Body::new(TUBE, bent(vec3(0.0, 0.0, 0.0), 0.4), Look::neutral(scene.theme));
    scene.bodies.push(Body { pick: PickId::nth(3), ..body });
    let camera = OrbitCamera::standard(StandardView::ThreeQuarter, vec3(0.0, 1.0, 0.0), 5.0);
    let view = View { camera, width_px: 96, height_px: 64, pixels_per_point: 1.0 };
    let before = offscreen.render(&scene, &view).unwrap();
    for n_lost in 1..=3 {
        offscreen.gpu().device().destroy();
        assert_eq!(offscreen.render(&scene, &view).unwrap(), before);
        assert_eq!(offscreen.n_lost(), n_lost);
    }
    offscreen.gpu().device().destroy();
    let middle = glam::vec2(48.0, 32.0);
    assert_eq!(offscreen.pick(&scene, &view, middle).unwrap(), PickId::nth(3));
    offscreen.gpu().device().destroy();
    assert!(offscreen.draw_only(&scene, &view).unwrap().n_body_triangles > 0);
    assert_eq!(offscreen.n_lost(), 5);
}

#[test]
fn impossible_sizes_are_errors() {
    let Some(mut offscreen) = offscreen() else { return };
    let scene = Scene::empty(Theme::Light);
    for (width_px, height_px) in [(0, 10), (10, 0), (u32::MAX, 1), (1, 1_000_000)] {
        let view =
            View { camera: OrbitCamera::default(), width_px, height_px, pixels_per_point: 1.0 };
        let error = offscreen.render(&scene, &view).unwrap_err();
        assert!(error.to_string().contains("at most"), "{error}");
    }
    assert_eq!(offscreen.n_lost(), 0);
}
