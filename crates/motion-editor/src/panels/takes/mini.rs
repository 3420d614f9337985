//! What is to be seen on a take's small picture: three poses along its way.

use egui::Vec2;
use glam::{Mat4, Vec3};
use motion_scene::body::Look;
use motion_scene::camera::{OrbitCamera, StandardView, Viewport};
use motion_scene::color::{ColorRole, Theme};
use motion_scene::ground::Ground;
use motion_scene::line::Line;
use motion_scene::scene::Scene;
use motion_session::stage::actor::Actor;
use motion_session::stage::framing::{Margins, frame_points};

/// The picture, points.
pub const MINI_PT: Vec2 = Vec2::new(112.0, 64.0);
/// Where along the motion the poses are, and how much of the take's colour each has: the later the
/// more.
const POSES: [(f64, f32); 3] = [(0.06, 0.15), (0.5, 0.5), (0.94, 0.9)];
/// On so small a picture a long way would make dots of bodies: it is brought together to this,
/// metres.
const REACH_M: f32 = 3.0;
/// Points of the way.
const N_WAY: usize = 32;
const WAY_PT: f32 = 2.0;

/// The scene, and from where it is seen.
pub fn mini(actor: &Actor, hue: usize, theme: Theme) -> (Scene, OrbitCamera) {
    let ground = Ground { has_grid: false, has_metre_marks: false };
    let mut scene = Scene { ground: Some(ground), ..Scene::empty(theme) };
    let last = actor.n_frames().saturating_sub(1);
    let frames = POSES.map(|(share, tint)| (share * last as f64, tint));
    let roots = frames.map(|(frame, _)| actor.root_at_m(frame).with_y(0.0));
    let middle = roots.iter().sum::<Vec3>() / roots.len() as f32;
    let reach_m = roots.iter().map(|root| 2.0 * root.distance(middle)).fold(0.0, f32::max);
    let nearer = (REACH_M / reach_m.max(1e-3)).min(1.0);
    // The way and its turns keep their shape.
    let placed = |at: Vec3| middle + (at - middle) * Vec3::new(nearer, 1.0, nearer);
    let color = ColorRole::Take(hue).color(theme);
    let plain = ColorRole::Body.color(theme);
    let mut points_m: Vec<Vec3> = Vec::new();
    for ((frame, tint), root) in frames.into_iter().zip(roots) {
        let mut body = actor.body_at(frame, Look::Solid(plain.mixed(color, tint)));
        let moved = Mat4::from_translation(placed(root) - root);
        body.world_from_joint.iter_mut().for_each(|joint| *joint = moved * *joint);
        points_m.extend(actor.figure.reach_m(&body.world_from_joint));
        scene.bodies.push(body);
    }
    let way = actor.ground_path_m();
    let step = (way.len() / N_WAY).max(1);
    let way: Vec<Vec3> = way.iter().step_by(step).chain(way.last()).map(|at| placed(*at)).collect();
    scene.lines.push(Line::new(way, color.with_alpha(0.9), WAY_PT));
    let mut camera = OrbitCamera::standard(StandardView::ThreeQuarter, middle, 4.0);
    let margins = Margins { side: 0.04, top: 0.06, bottom: 0.08 };
    frame_points(&mut camera, &points_m, Viewport::new(MINI_PT.x, MINI_PT.y), margins);
    (scene, camera)
}
