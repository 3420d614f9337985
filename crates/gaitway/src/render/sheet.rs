//! Contact sheets: a whole motion in one picture.

use glam::{Vec2, Vec3};
use motion_core::cancel::CancelToken;
use motion_render::picture::Picture;
use motion_scene::camera::{OrbitCamera, Viewport};
use motion_scene::color::ColorRole;
use motion_scene::ground::Surroundings;
use motion_scene::label::{Anchor, LABEL_PT, Label, LabelPlace};
use motion_scene::line::Occlusion;
use motion_scene::scene::Scene;
use motion_session::stage::framing::{Margins, distance_to_hold};
use motion_session::stage::shot::{Shot, Take};
use motion_session::stage::{Show, Stage, fan};

use super::canvas::{Rect, canvas, place};
use super::film::stopped;
use super::painter::{Painter, pixels_per_point};
use super::sheet_layout::SheetLayout;
use crate::args::render::Size;
use crate::output::{Bar, Failure};

/// A contact sheet to be made.
pub(crate) struct SheetPlan<'a> {
    pub(crate) stage: &'a Stage,
    /// What is written in its corner.
    pub(crate) title: &'a str,
    /// The frames to choose from.
    pub(crate) frames: &'a [usize],
    pub(crate) size: Size,
    pub(crate) shot: Shot,
    pub(crate) show: Show,
}

/// A motion that covers less than this over the ground has no way to be shown along, metres.
const TRAVELS_M: f32 = 1.3;
/// Poses of a fan are chosen from so many, at least so far from each other over the ground, metres.
const N_CANDIDATES: usize = 40;
const APART_M: f32 = 0.3;
/// They may cover each other by this: at 1 they would just touch.
const CLEAR: f32 = 0.72;
const MAX_FAN: usize = 16;
/// What a fan takes of the height at first, and at least when it does not need it.
const FAN_SHARE: f32 = 0.73;
const MIN_FAN_SHARE: f32 = 0.58;
/// Rows of a header, points.
const HEADER_PT: f32 = 2.0 * LABEL_PT;
/// Beside what its bodies take of its height, a fan has this share for words and air.
const FAN_AIR: f32 = 0.2;

impl SheetPlan<'_> {
    /// Draws the sheet.
    pub(crate) fn make(
        &self,
        painter: &mut Painter,
        cancel: &CancelToken,
        bar: &Bar,
    ) -> Result<Picture, Failure> {
        let Size { width, height } = self.size;
        let gap = (height / 400).clamp(1, 8);
        let travels = self.paths_m().iter().any(|path| fan::extent_m(path) >= TRAVELS_M);
        let scale = pixels_per_point(height) * 0.72;
        // Without a fan that has room for it, the title stands above all.
        let header = if travels { 0 } else { ((HEADER_PT * scale) as u32).min(height / 8) };
        let new_layout = |share: Option<f32>| {
            let below = height - header;
            SheetLayout::new(width, below, gap, share, self.frames.len()).below(header)
        };
        let mut layout = new_layout(travels.then_some(FAN_SHARE));
        if let Some(at) = layout.fan {
            // A way across needs no height: the moments below take what it leaves.
            let used = self.fan(at, scale).used_share + FAN_AIR;
            layout = new_layout(Some((FAN_SHARE * used).clamp(MIN_FAN_SHARE, FAN_SHARE)));
        }
        let background = Surroundings::of(self.stage.theme).sky_top.to_srgb8();
        let mut sheet = canvas(width, height, background);
        let mut angle = OrbitCamera::default();
        if let Some(at) = layout.fan {
            bar.set("drawing the way", 0.0);
            let fan = self.fan(at, scale);
            angle = fan.camera;
            let picture = painter.paint(&fan.scene, fan.camera, size_of(at), scale)?;
            place(&mut sheet, &picture, at);
        }
        if header > 0 {
            let mut scene = Scene::empty(self.stage.theme);
            scene.ground = None;
            let middle = Vec2::new(10.0, 0.5 * header as f32 / scale);
            scene.labels.push(self.label(self.title.to_owned(), middle, ColorRole::FaintText));
            let at = Rect { left: 0, top: 0, width, height: header };
            place(&mut sheet, &painter.paint(&scene, angle, size_of(at), scale)?, at);
        }
        let cells: Vec<(usize, Rect)> = fan::spread(self.frames.len(), layout.cells.len())
            .into_iter()
            .map(|nth| self.frames[nth])
            .zip(layout.cells.iter().copied())
            .collect();
        let cameras = self.cell_cameras(&cells, layout.fan.is_some().then_some(angle), scale);
        for (nth, (&(frame, at), camera)) in cells.iter().zip(cameras).enumerate() {
            if cancel.is_cancelled() {
                return Err(stopped());
            }
            bar.set("drawing moments", nth as f64 / cells.len() as f64);
            let show = Show { wishes: false, trail: false, ghosts: 0 };
            let mut scene = self.stage.scene_at(frame as f64, show).scene;
            if let Some(ground) = &mut scene.ground {
                ground.has_metre_marks = false;
            }
            let corner = Vec2::new(7.0, 4.0 + 0.5 * LABEL_PT);
            scene.labels.push(self.label(format!("f {frame}"), corner, ColorRole::Text));
            place(&mut sheet, &painter.paint(&scene, camera, size_of(at), scale)?, at);
        }
        Ok(sheet)
    }

    /// The way of every root over the frames to show, metres.
    fn paths_m(&self) -> Vec<Vec<Vec3>> {
        let path = |actor: &motion_session::stage::actor::Actor| {
            self.frames.iter().map(|&frame| actor.root_at_m(frame as f64)).collect()
        };
        self.stage.actors.iter().map(path).collect()
    }

    /// The poses along the way, and a camera that has them all.
    fn fan(&self, at: Rect, scale: f32) -> Fan {
        let of_paths = self.paths_m();
        let candidates: Vec<Vec<usize>> = of_paths
            .iter()
            .map(|path| {
                let chosen = fan::fan(path, N_CANDIDATES, APART_M);
                chosen.into_iter().map(|nth| self.frames[nth]).collect()
            })
            .collect();
        let mut all: Vec<usize> = candidates.iter().flatten().copied().collect();
        all.sort_unstable();
        all.dedup();
        let all: Vec<f64> = all.into_iter().map(|frame| frame as f64).collect();
        let viewport = Viewport::new(at.width as f32, at.height as f32);
        let take = Take {
            stage: self.stage,
            frames: &all,
            fps: 30.0,
            wishes: self.show.wishes,
            viewport,
            margins: Margins::new(viewport, scale),
        };
        let camera = take.still(self.shot);
        let n_max = if self.show.ghosts == 0 { MAX_FAN } else { self.show.ghosts };
        let mut covered = Vec::new();
        let mut chosen = Vec::new();
        for (actor, frames) in self.stage.actors.iter().zip(&candidates) {
            let on_picture: Vec<fan::Covered> = frames
                .iter()
                .map(|&frame| on_picture(&camera, viewport, &actor.reach_at_m(frame as f64)))
                .collect();
            let clear = fan::clear_of_each_other(&on_picture, n_max, CLEAR);
            chosen.push(clear.iter().map(|&nth| frames[nth]).collect::<Vec<usize>>());
            covered.extend(on_picture);
        }
        let top = covered.iter().map(|c| c.min_px.y).fold(f32::INFINITY, f32::min);
        let bottom = covered.iter().map(|c| c.max_px.y).fold(f32::NEG_INFINITY, f32::max);
        let mut scene = self.stage.fan(&chosen, Show { trail: true, ..self.show }).scene;
        let corner = Vec2::new(10.0, 7.0 + 0.5 * LABEL_PT);
        scene.labels.push(self.label(self.title.to_owned(), corner, ColorRole::FaintText));
        let used_share = ((bottom - top) / viewport.height_px).clamp(0.0, 1.0);
        Fan { scene, camera, used_share }
    }

    /// A camera for every cell: all look the same way, from as far, at the body where it is.
    fn cell_cameras(
        &self,
        cells: &[(usize, Rect)],
        angle: Option<OrbitCamera>,
        scale: f32,
    ) -> Vec<OrbitCamera> {
        let frames: Vec<f64> = cells.iter().map(|(frame, _)| *frame as f64).collect();
        let Some(&(_, first)) = cells.first() else { return Vec::new() };
        let viewport = Viewport::new(first.width as f32, first.height as f32);
        let margins =
            Margins { side: 0.06, top: 0.07 + 18.0 * scale / viewport.height_px, bottom: 0.06 };
        let take = Take {
            stage: self.stage,
            frames: &frames,
            fps: 30.0,
            wishes: false,
            viewport,
            margins,
        };
        let angle = angle.unwrap_or_else(|| take.still(self.shot));
        let rooms: Vec<_> = frames.iter().map(|&frame| take.room_at(frame)).collect();
        let whole = rooms.iter().flatten().copied().reduce(motion_scene::bounds::Bounds::union);
        let middle_m = whole.map_or(1.0, |whole| whole.center().y);
        let mut cameras: Vec<OrbitCamera> = rooms
            .iter()
            .map(|room| {
                let center = room.map_or(angle.target_m, |room| room.center());
                OrbitCamera { target_m: center.with_y(middle_m), ..angle }
            })
            .collect();
        let needs = cameras.iter().zip(&frames).map(|(camera, &frame)| {
            let reach = take.reach_at_m(frame);
            distance_to_hold(camera, camera.target_m, &reach, viewport, margins.evened())
        });
        let distance_m = needs.fold(0.0, f32::max);
        for camera in &mut cameras {
            camera.distance_m = distance_m.max(0.5);
            margins.aim(camera);
        }
        cameras
    }

    fn label(&self, text: String, at_pt: Vec2, role: ColorRole) -> Label {
        Label {
            text,
            place: LabelPlace::Picture(at_pt),
            anchor: Anchor::Left,
            clear_m: 0.0,
            occlusion: Occlusion::Shown,
            size_pt: LABEL_PT,
            color: role.color(self.stage.theme),
            plate: None,
        }
    }
}

/// The poses along the way.
struct Fan {
    scene: Scene,
    camera: OrbitCamera,
    /// What the bodies take of the picture's height.
    used_share: f32,
}

/// What holds points on a picture.
fn on_picture(camera: &OrbitCamera, viewport: Viewport, points_m: &[Vec3]) -> fan::Covered {
    let seen = points_m.iter().filter_map(|&point| Some(camera.project(point, viewport)?.px));
    let min_px = seen.clone().reduce(Vec2::min).unwrap_or_default();
    let max_px = seen.reduce(Vec2::max).unwrap_or_default();
    fan::Covered { min_px, max_px }
}

fn size_of(at: Rect) -> Size {
    Size { width: at.width, height: at.height }
}
