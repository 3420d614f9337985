//! What is under the pointer is what is named.

use glam::{Vec3, vec3};
use motion_render::offscreen::Offscreen;
use motion_render::view::View;
use motion_scene::body::{Body, Emphasis, Look, PickId};
use motion_scene::camera::{OrbitCamera, StandardView};
use motion_scene::color::{ColorRole, Theme};
use motion_scene::line::Line;
use motion_scene::marker::{Checkpoint, JointTarget};
use motion_scene::scene::Scene;
use motion_scene::solid::Solid;

use crate::bodies::{TUBE, bent, tube_model};
use crate::pictures::offscreen;

const BODY: Option<PickId> = PickId::nth(0);
const GHOST: Option<PickId> = PickId::nth(1);
const RING: Option<PickId> = PickId::nth(2);
const TIP: Option<PickId> = PickId::nth(3);
const TARGET: Option<PickId> = PickId::nth(4);
const BOX: Option<PickId> = PickId::nth(5);
const LINE: Option<PickId> = PickId::nth(6);

fn scene() -> Scene {
    let mut scene = Scene::empty(Theme::Dark);
    let body = Body::new(TUBE, bent(Vec3::ZERO, 0.0), Look::neutral(scene.theme));
    scene.bodies.push(Body { pick: BODY, ..body.clone() });
    let look = Look::ghost(ColorRole::Take(0), scene.theme);
    let ghost = bent(vec3(1.2, 0.0, 0.0), 0.0);
    scene.bodies.push(Body { pick: GHOST, ..Body::new(TUBE, ghost, look) });
    // A body without a name stands before the first one and is looked through.
    scene.bodies.push(Body::new(TUBE, bent(vec3(0.5, 0.0, 0.8), 0.0), look));
    scene.checkpoints.push(Checkpoint {
        position_m: vec3(-1.5, 0.0, 0.0),
        heading_rad: 0.0,
        is_exact: true,
        tolerance_m: None,
        label: String::new(),
        is_off: false,
        emphasis: Emphasis::None,
        pick: RING,
        pick_tip: TIP,
    });
    scene.joint_targets.push(JointTarget {
        position_m: vec3(-2.2, 1.5, 0.0),
        floor_m: 0.0,
        label: String::new(),
        is_off: false,
        emphasis: Emphasis::None,
        pick: TARGET,
    });
    let mut block = Solid::obstacle_box(vec3(2.5, 0.5, 0.0), Vec3::ONE, 0.0, scene.theme);
    block.pick = BOX;
    scene.solids.push(block);
    let ends = vec![vec3(-1.0, 2.4, 0.0), vec3(1.0, 2.4, 0.0)];
    let mut line = Line::new(ends, ColorRole::Past.color(scene.theme), 1.5);
    line.pick = LINE;
    scene.lines.push(line);
    scene
}

fn view(of: StandardView) -> View {
    let camera = OrbitCamera::standard(of, vec3(0.0, 1.0, 0.0), 9.0);
    View { camera, width_px: 640, height_px: 360, pixels_per_point: 1.0 }
}

#[track_caller]
fn check(offscreen: &mut Offscreen, of: StandardView, at_m: Vec3, expected: Option<PickId>) {
    let view = view(of);
    let at = view.camera.project(at_m, view.viewport()).expect("it is in view");
    let picked = offscreen.pick(&scene(), &view, at.px).unwrap();
    assert_eq!(picked, expected, "{of:?}: {at_m} is at {}", at.px);
}

#[test]
fn what_is_under_the_pointer() {
    let Some(mut offscreen) = offscreen() else { return };
    offscreen.set_model(TUBE, &tube_model());
    for of in [StandardView::ThreeQuarter, StandardView::Front] {
        let mut at = |at_m, expected| check(&mut offscreen, of, at_m, expected);
        at(vec3(0.0, 1.0, 0.0), BODY);
        at(vec3(0.0, 1.9, 0.0), BODY);
        at(vec3(1.2, 1.5, 0.0), GHOST);
        at(vec3(-2.2, 1.5, 0.0), TARGET);
        at(vec3(-2.2, 0.7, 0.0), TARGET);
        at(vec3(2.5, 0.7, 0.0), BOX);
        at(vec3(0.9, 2.4, 0.0), LINE);
        at(vec3(-0.7, 2.4, 0.0), LINE);
        at(vec3(0.0, 3.0, 0.0), None);
        at(vec3(-0.9, 1.5, 0.0), None);
    }
    let mut on_floor = |at_m, expected| {
        check(&mut offscreen, StandardView::ThreeQuarter, at_m, expected);
        check(&mut offscreen, StandardView::Top, at_m, expected);
    };
    on_floor(vec3(-1.5, 0.0, 0.0), RING);
    on_floor(vec3(-1.5, 0.0, 0.5), TIP);
    on_floor(vec3(-1.5, 0.0, -1.0), None);
}

#[test]
fn near_misses_count_and_far_ones_do_not() {
    let Some(mut offscreen) = offscreen() else { return };
    let view = view(StandardView::Front);
    let at = view.camera.project(vec3(-2.2, 1.5, 0.0), view.viewport()).unwrap().px;
    // The ball's radius is 3.5 pixels here.
    for (off_px, expected) in [(0.0, TARGET), (6.0, TARGET), (14.0, None)] {
        let px = at - glam::Vec2::new(off_px, 0.0);
        assert_eq!(offscreen.pick(&scene(), &view, px).unwrap(), expected, "{off_px} px beside");
    }
}

#[test]
fn the_corners_of_the_picture_and_beyond_are_nothing_special() {
    let Some(mut offscreen) = offscreen() else { return };
    let view = view(StandardView::Front);
    for px in [(0.0, 0.0), (639.0, 359.0), (-50.0, 4000.0)] {
        assert_eq!(offscreen.pick(&scene(), &view, px.into()).unwrap(), None);
    }
}
