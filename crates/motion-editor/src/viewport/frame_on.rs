//! How much room things take, so that the camera can bring them into view.

use glam::Vec3;
use motion_scene::bounds::Bounds;
use motion_session::selection::Selectable;
use motion_session::stage::Stage;
use motion_session::stage::pick::PickTarget;
use motion_session::{ConstraintKind, Shape};

use super::gesture::box_select::place_m;
use crate::mark::Mark;
use crate::obstacle_form;
use crate::state::EditorState;

/// A mark with what stands around it, metres.
const AROUND_M: f32 = 0.9;

/// Room for the whole motion and its marks.
pub fn whole_motion(stage: &Stage, marks: &[Mark]) -> Option<Bounds> {
    const N_MOMENTS: usize = 24;
    let last = stage.n_frames().saturating_sub(1) as f64;
    let moments = (0..=N_MOMENTS).map(|i| last * i as f64 / N_MOMENTS as f64);
    let bodies =
        moments.flat_map(|frame| stage.actors.iter().filter_map(move |a| a.bounds_at(frame)));
    let ways = marks.iter().filter_map(|mark| room_of_way(&mark.constraint.kind));
    let marks = marks.iter().filter_map(Mark::body).map(|(at_m, _)| {
        Bounds::of_point(Vec3::new(at_m[0] as f32, 0.0, at_m[1] as f32)).grown(0.4)
    });
    let obstacles = stage.obstacles.iter().map(|obstacle| room_of_shape(&obstacle.shape));
    bodies.chain(marks).chain(ways).chain(obstacles).reduce(Bounds::union)
}

/// Room for what is selected; nothing where nothing with a place is.
pub fn selection(state: &EditorState) -> Option<Bounds> {
    let document = state.session.document();
    let items = state.session.selection().items(document);
    items.filter_map(|item| room_of(item, state)).reduce(Bounds::union)
}

/// Room for a thing that is pointed at.
pub fn target(target: PickTarget, state: &EditorState) -> Option<Bounds> {
    match target {
        PickTarget::Actor { actor } => state.stage.actors.get(actor)?.bounds_at(state.frame()),
        PickTarget::Ghost { actor, frame } => {
            state.stage.actors.get(actor)?.bounds_at(frame as f64)
        }
        other => room_of(&state.selectable_of(other)?, state),
    }
}

fn room_of(item: &Selectable, state: &EditorState) -> Option<Bounds> {
    match item {
        Selectable::Constraint(at) => {
            let kind = &state.session.document().constraint(at)?.kind;
            if let Some(room) = room_of_way(kind) {
                return Some(room.grown(AROUND_M));
            }
            let at_m = place_m(kind)?;
            let room = Bounds::of_point(at_m).grown(AROUND_M);
            // The floor below it, and nothing under that.
            Some(Bounds { min_m: room.min_m.with_y(0.0), ..room })
        }
        Selectable::Character(character) | Selectable::Take(character, _) => {
            state.stage.actors.get(character.0)?.bounds_at(state.frame())
        }
        Selectable::Interaction(id) => {
            let places = &state.meeting_wish(id)?.places;
            let feet = places.iter().map(|place| place.translation_m());
            let feet: Vec<Vec3> = feet.collect();
            let room = Bounds::of_points(&feet)?.grown(AROUND_M);
            Some(Bounds { min_m: room.min_m.with_y(0.0), ..room })
        }
        Selectable::Obstacle(obstacle) => {
            let known = state.session.document().obstacle(*obstacle)?;
            Some(room_of_shape(&known.shape))
        }
    }
}

/// Room for a path.
fn room_of_way(kind: &ConstraintKind) -> Option<Bounds> {
    let ConstraintKind::Path { points_m, .. } = kind else { return None };
    let points = points_m.iter().map(|[x, z]| Vec3::new(*x as f32, 0.0, *z as f32));
    Bounds::of_points(&points.collect::<Vec<_>>())
}

/// Room for an obstacle, however it is turned.
fn room_of_shape(shape: &Shape) -> Bounds {
    let [x, y, z] = obstacle_form::center_m(shape).map(|metres| metres as f32);
    let [width, depth] = obstacle_form::floor_m(shape).map(|metres| metres as f32);
    let (bottom, top) = obstacle_form::levels_m(shape);
    let half =
        Vec3::new(0.5 * width.hypot(depth), 0.5 * (top - bottom) as f32, 0.5 * width.hypot(depth));
    let middle = Vec3::new(x, y, z);
    Bounds { min_m: middle - half, max_m: middle + half }
}
