//! Cameras for a film of a motion: one for every picture.

use std::f32::consts::TAU;

use glam::Vec3;
use motion_scene::bounds::Bounds;
use motion_scene::camera::{OrbitCamera, StandardView, Viewport};

use super::Stage;
use super::framing::{Margins, distance_to_hold, frame_points};
use super::smooth::smoothed;
use super::viewpoint::{Standpoint, best_yaw_rad};

/// How a camera takes a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shot {
    /// From beside and above, with all of the motion in the picture; it stands still.
    #[default]
    ThreeQuarter,
    /// It goes with the body, which stays as large as it is.
    Follow,
    /// It goes with the body and circles it once.
    Turntable,
    /// From +Z, without vanishing points; it stands still.
    Front,
    /// From −X, so that who walks ahead walks to the right; it stands still.
    Side,
    /// From above; it stands still.
    Top,
}

/// Down on the scene by this much: 15°, more for many poses at once.
const PITCH_RAD: f32 = 0.26;
/// How long a camera that follows takes to take up what the body does, seconds (a standard
/// deviation either way: it knows what is coming).
const FOLLOW_SECS: f64 = 0.45;
/// At most so many moments are looked at to find how much room a motion takes.
const MAX_LOOKS: usize = 120;
/// Poses that stand for the motion when a side is chosen to look from.
const N_STANDPOINTS: usize = 7;

/// A film to be taken.
#[derive(Clone, Copy, Debug)]
pub struct Take<'a> {
    /// Of what.
    pub stage: &'a Stage,
    /// The frame of every picture; between frames is allowed.
    pub frames: &'a [f64],
    /// Pictures per second, as they are to be shown.
    pub fps: f64,
    /// Whether constraints must be in the picture too.
    pub wishes: bool,
    /// The pictures' size.
    pub viewport: Viewport,
    /// What stays free at their edges.
    pub margins: Margins,
}

impl Take<'_> {
    /// A camera for every picture.
    pub fn cameras(&self, shot: Shot) -> Vec<OrbitCamera> {
        match shot {
            Shot::Follow => self.moving(0.0),
            Shot::Turntable => self.moving(TAU),
            _ => vec![self.still(shot); self.frames.len()],
        }
    }

    /// A camera that has all of the pictures' bodies in view.
    pub fn still(&self, shot: Shot) -> OrbitCamera {
        let view = match shot {
            Shot::Front => StandardView::Front,
            Shot::Side => StandardView::Right,
            Shot::Top => StandardView::Top,
            Shot::ThreeQuarter | Shot::Follow | Shot::Turntable => StandardView::ThreeQuarter,
        };
        let mut camera = OrbitCamera::standard(view, Vec3::Y, 4.0);
        if view == StandardView::ThreeQuarter {
            camera.yaw_rad = self.yaw_rad();
            camera.pitch_rad = PITCH_RAD;
        }
        let mut points = self.body_points_m();
        points.extend(self.wish_points_m(&points));
        frame_points(&mut camera, &points, self.viewport, self.margins);
        camera
    }

    /// A camera that goes with the bodies and turns by `turn_rad` meanwhile.
    fn moving(&self, turn_rad: f32) -> Vec<OrbitCamera> {
        let rooms: Vec<Option<Bounds>> = self.frames.iter().map(|&f| self.room_at(f)).collect();
        let reaches: Vec<Vec<Vec3>> = self.frames.iter().map(|&f| self.reach_at_m(f)).collect();
        let Some(first) = rooms.iter().flatten().next().copied() else {
            return vec![self.still(Shot::ThreeQuarter); self.frames.len()];
        };
        let centers: Vec<Vec3> = rooms
            .iter()
            .scan(first, |last, room| {
                *last = room.unwrap_or(*last);
                Some(last.center())
            })
            .collect();
        let path = smoothed(&centers, FOLLOW_SECS * self.fps);
        let start =
            OrbitCamera { yaw_rad: self.yaw_rad(), pitch_rad: PITCH_RAD, ..OrbitCamera::default() };
        let n = self.frames.len() as f32;
        let mut cameras: Vec<OrbitCamera> = path
            .iter()
            .enumerate()
            .map(|(nth, &target_m)| {
                let yaw_rad = start.yaw_rad + turn_rad * nth as f32 / n;
                OrbitCamera { target_m, yaw_rad, ..start }
            })
            .collect();
        // One distance for the whole film: a camera that zooms with every step makes sick.
        let needs = cameras.iter().zip(&reaches).map(|(camera, reach)| {
            let (target_m, viewport) = (camera.target_m, self.viewport);
            distance_to_hold(camera, target_m, reach, viewport, self.margins.evened())
        });
        let distance_m = needs.fold(0.0, f32::max);
        for camera in &mut cameras {
            camera.distance_m = distance_m;
            self.margins.aim(camera);
        }
        cameras
    }

    /// From which side the pictures' poses are seen best.
    fn yaw_rad(&self) -> f32 {
        let picked = super::fan::spread(self.frames.len(), N_STANDPOINTS);
        let frames: Vec<f64> = picked.into_iter().map(|nth| self.frames[nth]).collect();
        best_yaw_rad(&standpoints(self.stage, &frames), PITCH_RAD, self.viewport)
    }

    /// What holds all bodies at a frame.
    pub fn room_at(&self, frame: f64) -> Option<Bounds> {
        let each = self.stage.actors.iter().filter_map(|actor| actor.bounds_at(frame));
        each.reduce(Bounds::union)
    }

    /// Points that reach as far as all bodies at a frame, metres.
    pub fn reach_at_m(&self, frame: f64) -> Vec<Vec3> {
        self.stage.actors.iter().flat_map(|actor| actor.reach_at_m(frame)).collect()
    }

    /// Points that reach as far as the bodies over the film.
    fn body_points_m(&self) -> Vec<Vec3> {
        let picked = super::fan::spread(self.frames.len(), MAX_LOOKS);
        picked.into_iter().flat_map(|nth| self.reach_at_m(self.frames[nth])).collect()
    }

    /// Points around the markers of constraints and obstacles near the bodies.
    fn wish_points_m(&self, bodies_m: &[Vec3]) -> Vec<Vec3> {
        /// A ring with its arrow and words.
        const MARK_M: f32 = 0.65;
        /// Obstacles are shown so far beyond where bodies go.
        const BEYOND_M: f32 = 1.0;
        if !self.wishes {
            return Vec::new();
        }
        let scene = self.stage.scene_at(0.0, super::Show::default()).scene;
        let marks = scene.checkpoints.iter().map(|mark| mark.position_m);
        let around =
            |at: Vec3| [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z].map(|side| at + side * MARK_M);
        let mut points: Vec<Vec3> = marks.flat_map(around).collect();
        points.extend(scene.joint_targets.iter().map(|target| target.position_m));
        if let Some(room) = Bounds::of_points(bodies_m).map(|room| room.grown(BEYOND_M)) {
            let unit = Bounds { min_m: Vec3::splat(-0.5), max_m: Vec3::splat(0.5) };
            let corners = scene.solids.iter().flat_map(|solid| {
                unit.corners().map(|corner| solid.world_from_solid.transform_point3(corner))
            });
            points.extend(corners.map(|corner| corner.clamp(room.min_m, room.max_m)));
        }
        points
    }
}

/// The poses of all actors at some frames, as [`best_yaw_rad`] looks at them.
pub fn standpoints(stage: &Stage, frames: &[f64]) -> Vec<Standpoint> {
    let mut found = Vec::new();
    for &frame in frames {
        for actor in &stage.actors {
            let Some(room) = actor.bounds_at(frame) else { continue };
            let root = super::pose::pose_at(&actor.skeleton, &actor.motion, frame)[0];
            let foot_m = room.center().with_y(room.min_m.y);
            let head_m = foot_m.with_y(room.max_m.y);
            found.push(Standpoint { foot_m, head_m, facing: root.z_axis.truncate() });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::tests::walk_stage;

    fn take<'a>(stage: &'a Stage, frames: &'a [f64]) -> Take<'a> {
        let viewport = Viewport::new(640.0, 360.0);
        let margins = Margins::new(viewport, 1.0);
        Take { stage, frames, fps: 30.0, wishes: true, viewport, margins }
    }

    const ALL: [Shot; 6] =
        [Shot::ThreeQuarter, Shot::Follow, Shot::Turntable, Shot::Front, Shot::Side, Shot::Top];

    #[test]
    fn nobody_is_cut_off_in_any_shot() {
        let stage = walk_stage();
        let frames: Vec<f64> = (0..stage.n_frames()).map(|f| f as f64).collect();
        let take = take(&stage, &frames);
        for shot in ALL {
            let cameras = take.cameras(shot);
            assert_eq!(cameras.len(), frames.len());
            for (camera, &frame) in cameras.iter().zip(&frames) {
                for corner in stage.actors[0].reach_at_m(frame) {
                    let px = camera.project(corner, take.viewport).unwrap().px;
                    let inside = (1.0..639.0).contains(&px.x) && (1.0..359.0).contains(&px.y);
                    assert!(inside, "{shot:?}, frame {frame}: {px}");
                }
            }
        }
    }

    #[test]
    fn cameras_that_move_move_smoothly() {
        let stage = walk_stage();
        let frames: Vec<f64> = (0..stage.n_frames()).map(|f| f as f64).collect();
        let cameras = take(&stage, &frames).cameras(Shot::Follow);
        let steps: Vec<Vec3> =
            cameras.windows(2).map(|pair| pair[1].eye_m() - pair[0].eye_m()).collect();
        for pair in steps.windows(2) {
            assert!(pair[0].distance(pair[1]) < 0.004, "{pair:?}");
        }
        assert!(cameras.iter().all(|camera| camera.distance_m == cameras[0].distance_m));
    }

    #[test]
    fn a_turntable_comes_round_once() {
        let stage = walk_stage();
        let frames: Vec<f64> = (0..36).map(f64::from).collect();
        let cameras = take(&stage, &frames).cameras(Shot::Turntable);
        let step = cameras[1].yaw_rad - cameras[0].yaw_rad;
        assert!((step - TAU / 36.0).abs() < 1e-5);
        let back = cameras[35].yaw_rad + step - cameras[0].yaw_rad;
        assert!((back - TAU).abs() < 1e-4, "the picture after the last is the first");
    }

    #[test]
    fn a_film_of_nothing_has_no_cameras() {
        let stage = walk_stage();
        assert!(take(&stage, &[]).cameras(Shot::Turntable).is_empty());
        let nobody = Stage::new(stage.theme, Vec::new());
        assert_eq!(take(&nobody, &[0.0, 1.0]).cameras(Shot::Follow).len(), 2);
    }
}
