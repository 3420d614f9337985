//! What of a project and its motions is to be seen, as a [`Scene`].
//!
//! A [`Stage`] has actors (a figure, a skeleton, a motion each) and what the project says about
//! them. [`Stage::scene_at`] shows a moment, [`Stage::fan`] the whole motion at once; [`shot`] says
//! from where they are looked at. Who draws them is not known here.

pub mod actor;
pub mod cast;
pub mod character;
pub mod figure;
pub mod pick;

pub mod body_plan;
pub mod fan;
pub mod head_droop;
pub mod meeting_wishes;
pub mod obstacles;
mod path_wish;
pub mod pose;
pub mod pose_wishes;
pub mod ramp;
pub mod standing;
pub mod wishes;

pub mod framing;
pub mod shot;
pub mod smooth;
pub mod viewpoint;

use glam::Vec3;
use motion_core::ids::JointIdx;
use motion_io::project_file::{Constraint, Obstacle};
use motion_io::report_file::ConstraintReport;
use motion_scene::body::{GHOST_ALPHA, Look};
use motion_scene::color::{ColorRole, LinearRgba, Theme};
use motion_scene::label::{Anchor, LABEL_PT, Label, LabelPlace};
use motion_scene::line::{Line, Occlusion};
use motion_scene::scene::Scene;
use motion_scene::trail::Trail;

use actor::Actor;
use meeting_wishes::MeetingWish;
use pick::{PickTarget, Picks};
use pose_wishes::PoseWish;
use wishes::Reality;

/// Actors and what is around them.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Surroundings.
    pub theme: Theme,
    /// Who is seen.
    pub actors: Vec<Actor>,
    /// What the project says of each actor, in the actors' order; shorter where it says nothing.
    pub roles: Vec<Role>,
    /// What stands in the way.
    pub obstacles: Vec<Obstacle>,
    /// Where they meet, where somebody could pose them.
    pub meetings: Vec<MeetingWish>,
}

/// What a project says of an actor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Role {
    /// What the motion must meet.
    pub constraints: Vec<Constraint>,
    /// How far off it is.
    pub misses: Vec<ConstraintReport>,
    /// Where the body's root is by frame, as the constraints count it: on the library's skeleton,
    /// whose legs may be longer than the figure's.
    pub root_path_m: Vec<Vec3>,
    /// Bodies in the poses that are asked for, where somebody could pose them.
    pub poses: Vec<PoseWish>,
}

/// What is shown of a moment besides bodies and obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Show {
    /// Constraints.
    pub wishes: bool,
    /// The root's way over the floor.
    pub trail: bool,
    /// So many poses of the same motion at other times.
    pub ghosts: usize,
}

impl Default for Show {
    fn default() -> Self {
        Self { wishes: true, trail: false, ghosts: 0 }
    }
}

/// A scene, and what the names in it mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Staged {
    /// What is to be seen.
    pub scene: Scene,
    /// What can be pointed at.
    pub picks: Picks,
}

/// Over a head, metres: where a frame number stands.
const OVER_HEAD_M: f32 = 0.06;
/// The way over the floor changes its colour in so many steps.
const N_TRAIL_STEPS: usize = 48;
const TRAIL_PT: f32 = 2.5;

impl Stage {
    /// Actors alone.
    pub fn new(theme: Theme, actors: Vec<Actor>) -> Self {
        Self { theme, actors, roles: Vec::new(), obstacles: Vec::new(), meetings: Vec::new() }
    }

    /// Frames of the longest motion; actors whose motions are over hold their last pose.
    pub fn n_frames(&self) -> usize {
        self.actors.iter().map(Actor::n_frames).max().unwrap_or_default()
    }

    /// A moment, which may lie between two frames.
    pub fn scene_at(&self, frame: f64, show: Show) -> Staged {
        let mut staged = self.empty(show.wishes);
        let Staged { scene, picks } = &mut staged;
        for (nth, actor) in self.actors.iter().enumerate() {
            let mut body = actor.body_at(frame, actor.look);
            body.pick = picks.name(PickTarget::Actor { actor: nth });
            scene.bodies.push(body);
        }
        for actor in &self.actors {
            if show.trail {
                let points_m = actor.ground_path_m();
                let now = pose::between(points_m.len(), frame).0;
                scene.trails.push(Trail { points_m, now });
            }
        }
        for (nth, actor) in self.actors.iter().enumerate() {
            self.add_ghosts(&mut staged, nth, &fan::spread(actor.n_frames(), show.ghosts));
        }
        staged
    }

    /// Several moments at once, solid, coloured and numbered by time, on the way that leads through
    /// them. `frames` has a list for each actor.
    pub fn fan(&self, frames: &[Vec<usize>], show: Show) -> Staged {
        let mut staged = self.empty(show.wishes);
        let Staged { scene, picks } = &mut staged;
        for (nth, (actor, frames)) in self.actors.iter().zip(frames).enumerate() {
            for &frame in frames {
                let look = painted(actor.look, self.time_color(frame, actor.n_frames()));
                let mut body = actor.body_at(frame as f64, look);
                body.pick = picks.name(PickTarget::Ghost { actor: nth, frame });
                let bounds = actor.figure.bounds(&body.world_from_joint);
                scene.bodies.push(body);
                let Some(bounds) = bounds else { continue };
                let over_m = bounds.center().with_y(bounds.max_m.y + OVER_HEAD_M);
                // Of several people it is said whose frame it is.
                let number = match self.actors.len() {
                    1 => frame.to_string(),
                    _ => format!("{} {frame}", actor.name),
                };
                scene.labels.push(self.label(number, over_m));
            }
            if show.trail {
                scene.lines.extend(self.coloured_way(actor));
            }
        }
        staged
    }

    /// Everything but the actors.
    fn empty(&self, with_wishes: bool) -> Staged {
        let mut scene = Scene::empty(self.theme);
        let mut picks = Picks::default();
        scene.solids = obstacles::obstacles(&self.obstacles, self.theme, &mut picks);
        if !with_wishes {
            return Staged { scene, picks };
        }
        for (nth, role) in self.roles.iter().enumerate() {
            let reality = (!role.root_path_m.is_empty())
                .then_some(Reality { root_path_m: &role.root_path_m, misses: &role.misses });
            let found = wishes::wishes(&role.constraints, nth, reality, self.theme, &mut picks);
            scene.checkpoints.extend(found.checkpoints);
            scene.joint_targets.extend(found.joint_targets);
            scene.lines.extend(found.lines);
            scene.solids.extend(found.solids);
            scene.labels.extend(found.labels);
            for pose in &role.poses {
                let (body, label) = pose.staged(nth, &role.misses, self.theme, &mut picks);
                scene.bodies.push(body);
                scene.labels.push(label);
            }
        }
        for meeting in &self.meetings {
            meeting.add_to(&mut scene, self.theme, &mut picks);
        }
        Staged { scene, picks }
    }

    /// Puts an actor beside itself, at other frames, faint and in the colours of those times.
    pub fn add_ghosts(&self, staged: &mut Staged, actor: usize, frames: &[usize]) {
        let Some(of) = self.actors.get(actor) else { return };
        for &frame in frames {
            let color = self.time_color(frame, of.n_frames());
            let mut body = of.body_at(frame as f64, Look::Ghost(color.with_alpha(GHOST_ALPHA)));
            body.pick = staged.picks.name(PickTarget::Ghost { actor, frame });
            staged.scene.bodies.push(body);
        }
    }

    /// Draws the way of an actor's joint, a dot for every frame, what is past at `frame` in another
    /// colour than what is to come.
    pub fn add_joint_trail(&self, staged: &mut Staged, actor: usize, joint: JointIdx, frame: f64) {
        let Some(of) = self.actors.get(actor) else { return };
        let points_m = of.motion.joint_path_m(&of.skeleton, joint);
        let now = pose::between(points_m.len(), frame).0;
        staged.scene.trails.push(Trail { points_m, now });
    }

    /// The colour of a frame among `n_frames`.
    fn time_color(&self, frame: usize, n_frames: usize) -> LinearRgba {
        let last = n_frames.saturating_sub(1).max(1);
        ramp::time_color(frame as f32 / last as f32, self.theme)
    }

    /// An actor's way over the floor, in the colours of its times.
    fn coloured_way(&self, actor: &Actor) -> Vec<Line> {
        let path = actor.ground_path_m();
        let mut ends = fan::spread(path.len(), N_TRAIL_STEPS + 1);
        ends.dedup();
        let piece = |pair: &[usize]| {
            let color = self.time_color(pair[0], path.len()).with_alpha(0.9);
            Line::new(path[pair[0]..=pair[1]].to_vec(), color, TRAIL_PT)
        };
        ends.windows(2).map(piece).collect()
    }

    fn label(&self, text: String, at_m: Vec3) -> Label {
        Label {
            text,
            place: LabelPlace::World(at_m),
            anchor: Anchor::Below,
            clear_m: 0.0,
            occlusion: Occlusion::Shown,
            size_pt: LABEL_PT,
            color: ColorRole::Text.color(self.theme),
            plate: Some(ColorRole::TextPlate.color(self.theme).with_alpha(0.82)),
        }
    }
}

/// A look in the colour of a time; what has colours of its own keeps half of them.
fn painted(look: Look, time: LinearRgba) -> Look {
    const KEPT: f32 = 0.5;
    match look == Look::own_colors() {
        true => Look::Solid(time.mixed(LinearRgba::WHITE, KEPT)),
        false => Look::Solid(time),
    }
}

#[cfg(test)]
pub(crate) mod tests;
