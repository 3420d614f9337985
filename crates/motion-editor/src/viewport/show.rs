//! The scene of a moment, with what is hovered and selected marked.

use motion_scene::body::{Emphasis, Look, PickId};
use motion_scene::color::ColorRole;
use motion_session::selection::Selectable;
use motion_session::stage::pick::PickTarget;
use motion_session::stage::{Show, Staged};

use super::compare;
use crate::state::EditorState;

/// Poses of the same motion at other times.
const N_GHOSTS: usize = 7;
/// A clip that is only looked at must not pass for a take.
const PREVIEW_ALPHA: f32 = 0.45;

/// What is to be seen now; nothing while there is no take.
pub fn staged(state: &EditorState) -> Option<Staged> {
    if state.stage.actors.is_empty() {
        return None;
    }
    let mut staged = state.stage.scene_at(state.frame(), choices(state));
    if let Some(preview) = &state.preview {
        let color = ColorRole::Pose.color(state.settings.theme).with_alpha(PREVIEW_ALPHA);
        staged.scene.bodies.push(preview.actor.body_at(preview.frame, Look::Ghost(color)));
    }
    compare::add_others(&mut staged.scene, state);
    // What is selected is said last, so that it shows under the pointer too.
    if let Some(hovered) = state.hovered {
        let hovered = whole(hovered);
        mark(&mut staged, |target| target == hovered, Emphasis::Hovered);
    }
    let document = state.session.document();
    let selected: Vec<&Selectable> = state.session.selection().items(document).collect();
    let is_selected = |target: PickTarget| {
        whole(target) == target
            && !matches!(target, PickTarget::Actor { .. } | PickTarget::Ghost { .. })
            && state.selectable_of(target).is_some_and(|item| selected.contains(&&item))
    };
    mark(&mut staged, is_selected, Emphasis::Selected);
    Some(staged)
}

/// What is shown besides bodies.
pub fn choices(state: &EditorState) -> Show {
    Show {
        wishes: true,
        trail: state.settings.trail,
        ghosts: if state.settings.ghosts { N_GHOSTS } else { 0 },
    }
}

fn mark(staged: &mut Staged, is_meant: impl Fn(PickTarget) -> bool, emphasis: Emphasis) {
    let Staged { scene, picks } = staged;
    let is = |pick: Option<PickId>| pick.and_then(|id| picks.target(id)).is_some_and(&is_meant);
    for body in scene.bodies.iter_mut().filter(|body| is(body.pick)) {
        body.emphasis = emphasis;
    }
    for mark in scene.checkpoints.iter_mut().filter(|mark| is(mark.pick)) {
        mark.emphasis = emphasis;
    }
    for mark in scene.joint_targets.iter_mut().filter(|mark| is(mark.pick)) {
        mark.emphasis = emphasis;
    }
    for solid in scene.solids.iter_mut().filter(|solid| is(solid.pick)) {
        solid.emphasis = emphasis;
    }
}

/// A checkpoint and the tip of its arrow are selected together.
pub fn whole(target: PickTarget) -> PickTarget {
    match target {
        PickTarget::CheckpointTip { character, constraint } => {
            PickTarget::Checkpoint { character, constraint }
        }
        other => other,
    }
}
