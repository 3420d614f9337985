//! What is to be seen, as plain data.
//!
//! A [`scene::Scene`] says everything about a picture but the camera: bodies in their poses,
//! floor, obstacles, wishes as markers, paths as trails, words. Whoever knows clips and constraints
//! makes one anew for every picture; `motion-render` draws it and knows nothing of either.
//!
//! Conventions: Y up, metres, radians, a body at rest looks along +Z with its left at +X.
//! Colours are linear light; [`color::ColorRole`] names them by meaning.
//!
//! ```
//! use glam::{Mat4, Vec2, Vec3};
//! use motion_scene::body::{Body, Look};
//! use motion_scene::camera::{OrbitCamera, Viewport};
//! use motion_scene::color::Theme;
//! use motion_scene::mesh::MeshId;
//! use motion_scene::scene::Scene;
//!
//! let mut scene = Scene::empty(Theme::Dark);
//! let standing = vec![Mat4::from_translation(Vec3::Y)];
//! scene.bodies.push(Body::new(MeshId(1), standing, Look::neutral(scene.theme)));
//!
//! let viewport = Viewport::new(640.0, 360.0);
//! let mut camera = OrbitCamera::default();
//! if let Some(bounds) = scene.body_bounds() {
//!     camera.frame(&bounds, viewport, 0.1);
//! }
//! let middle = camera.project(Vec3::Y, viewport).map(|at| at.px);
//! assert!(middle.is_some_and(|px| px.distance(Vec2::new(320.0, 180.0)) < 0.5));
//! ```

pub mod scene;

pub mod body;
pub mod ground;
pub mod label;
pub mod light;
pub mod line;
pub mod marker;
pub mod solid;
pub mod trail;

pub mod bounds;
pub mod camera;
pub mod color;

pub mod body_plan;
pub mod mannequin;
pub mod mesh;
